"""From a slider's input to the new picture in the browser: the studio in Chromium, one line of JSON.

python -m benchmarks.studio samples/four-square.toml motif.flower.petal.length

A value is put into the slider's own event every time the picture before it has been drawn, so that each is
waited for; the time runs in the browser, from the event to the frame after the picture is in the page. The
first that is seen of it ("first") is, where a pattern is slow, its motif alone. Then
it is dragged at the pace of a hand: how many values were given, and how many pictures were seen meanwhile.
Before that, seconds from the command to its address, and in the browser from the address to the first paint
and to the first picture.
"""

from __future__ import annotations

import contextlib
import json
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from tests.clients.studio import Page, Studio, browser, studio

VALUES = 40
WARM = 8
ONE = """
async ([id, value]) => {
  const { shown, alone } = studio.state, begun = performance.now();
  getElement(id).move(value);
  while (studio.state.shown === shown) {
    if (performance.now() - begun > 20000) return null;
    await new Promise(requestAnimationFrame);
  }
  const whole = studio.state.at - begun;
  return [whole, studio.state.alone === alone ? whole : Math.min(studio.state.aloneAt - begun, whole)];
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

FIRST = """
async () => {
  const paint = () => performance.getEntriesByName("first-contentful-paint")[0];
  while (!paint()) await new Promise((done) => setTimeout(done, 20));
  return [paint().startTime, studio.state.first];
}
"""


@contextlib.contextmanager
def started(folder: Path, recipe: Path) -> Iterator[tuple[Studio, float]]:
    """Start a studio; yield it with the seconds until it could be asked."""
    begun = time.perf_counter()
    with studio(folder, str(recipe)) as made:
        yield made, time.perf_counter() - begun


def measure(recipe: Path, path: str) -> dict[str, float | int | str]:
    """Return milliseconds from input to picture, and what is seen of a slider that is dragged."""
    with (
        tempfile.TemporaryDirectory() as folder,
        browser() as chromium,
        started(Path(folder) / "own", recipe) as (made, seconds),
    ):
        page = Page(chromium, made.address)
        paint, picture = page.page.evaluate(FIRST)
        slider = page.slider(path)
        slider.wait_for()
        number = int(str(slider.get_attribute("id")).removeprefix("c"))
        low, high = (float(str(slider.get_attribute(f"aria-value{end}"))) for end in ("min", "max"))
        middle, reach = (low + high) / 2, (high - low) / 8
        values = [middle + reach * (step % 20 - 10) / 10 for step in range(WARM + VALUES)]
        taken = [page.page.evaluate(ONE, [number, value]) for value in values][WARM:]
        seen = page.page.evaluate(DRAGGED, [number, values, 33])
    got = sorted(each[0] for each in taken if each is not None)
    first = sorted(each[1] for each in taken if each is not None)
    return {
        "recipe": recipe.stem,
        "start_s": round(seconds, 2),
        "first_paint_s": round(paint / 1000, 2),
        "first_picture_s": round(picture / 1000, 2),
        "median_ms": round(statistics.median(got), 1),
        "p95_ms": round(got[int(0.95 * (len(got) - 1))], 1),
        "first_median_ms": round(statistics.median(first), 1),
        "first_p95_ms": round(first[int(0.95 * (len(first) - 1))], 1),
        "lost": len(taken) - len(got),
        "dragged": len(values),
        "seen": seen,
    }


if __name__ == "__main__":
    print(json.dumps(measure(Path(sys.argv[1]), sys.argv[2])))
