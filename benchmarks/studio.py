"""From a slider's input to the new picture in the browser: the studio in Chromium, one line of JSON.

python -m benchmarks.studio samples/four-square.toml motif.flower.petal.length

A value is put into the slider's own event every time the picture before it has been drawn, so that each is
waited for; the time runs in the browser, from the event to the frame after the picture is in the page. Then
it is dragged at the pace of a hand: how many values were given, and how many pictures were seen meanwhile.
"""

from __future__ import annotations

import json
import statistics
import sys
import tempfile
from pathlib import Path

from tests.clients.studio import Page, browser, studio

VALUES = 40
WARM = 8
ONE = """
async ([id, value]) => {
  const before = studio.state.shown, begun = performance.now();
  getElement(id).move(value);
  while (studio.state.shown === before) {
    if (performance.now() - begun > 20000) return null;
    await new Promise(requestAnimationFrame);
  }
  return studio.state.at - begun;
}
"""
DRAGGED = """
async ([id, values, pace]) => {
  const seen = new Set([studio.state.shown]);
  for (const value of values) {
    getElement(id).move(value);
    const until = performance.now() + pace;
    while (performance.now() < until) {
      await new Promise(requestAnimationFrame);
      seen.add(studio.state.shown);
    }
  }
  return seen.size - 1;
}
"""


def measure(recipe: Path, path: str) -> dict[str, float | int | str]:
    """Return milliseconds from input to picture, and what is seen of a slider that is dragged."""
    with (
        tempfile.TemporaryDirectory() as folder,
        browser() as chromium,
        studio(Path(folder) / "own", str(recipe)) as made,
    ):
        page = Page(chromium, made.address)
        slider = page.slider(path)
        slider.wait_for()
        number = int(str(slider.get_attribute("id")).removeprefix("c"))
        low, high = (float(str(slider.get_attribute(f"aria-value{end}"))) for end in ("min", "max"))
        middle, reach = (low + high) / 2, (high - low) / 8
        values = [middle + reach * (step % 20 - 10) / 10 for step in range(WARM + VALUES)]
        taken = [page.page.evaluate(ONE, [number, value]) for value in values][WARM:]
        seen = page.page.evaluate(DRAGGED, [number, values, 33])
    got = sorted(each for each in taken if each is not None)
    return {
        "recipe": recipe.stem,
        "median_ms": round(statistics.median(got), 1),
        "p95_ms": round(got[int(0.95 * (len(got) - 1))], 1),
        "lost": len(taken) - len(got),
        "dragged": len(values),
        "seen": seen,
    }


if __name__ == "__main__":
    print(json.dumps(measure(Path(sys.argv[1]), sys.argv[2])))
