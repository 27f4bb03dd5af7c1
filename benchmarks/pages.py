"""From a slider's input to the new picture in the browser, ours beside peers: one line of JSON.

python -m benchmarks.pages

The studio, a page of Bokeh's server, and a notebook of ipywidgets and matplotlib that voila serves, each in a
tab of the same Chromium, show the four-square flower with a slider for the length of its petals. In every
round each is given some new values, one after the other as from a hand that drags, of which the first finds
the tab just come to the front and does not count; then it is the next one's turn, there and back, so that
whatever else the machine does falls on all alike. Peers are moved by the key that their slider listens to.
The time runs in the browser: until the frame after the new picture is in the page; of Bokeh, which draws in
its own time, until the frame after its new data are. What peers draw are curves alone, 15,200 points; nothing
is cut, welded or gapped.

It ends within some minutes whatever happens: a picture that does not come is told as lost, after which a
round goes on, and no round is begun past the limit. Medians are of what came; how many times longer a peer
took is the median over the rounds in which both came.
"""

from __future__ import annotations

import contextlib
import json
import math
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from benchmarks.timing import ROOT
from tests.clients.studio import Page, browser, studio

PAGES = ROOT / ".venv-bench-pages" / "bin" / "python"
PEERS = ROOT / "benchmarks" / "peers"
SAMPLE, SLIDER = ROOT / "samples" / "four-square.toml", "motif.flower.petal.length"
WARM, ROUNDS = 1, 8
TURN = 4
"""Values of a turn, with the first."""
FEWEST = 3
"""Rounds without which nothing is told."""
MOST_MS = 8000
"""Milliseconds after which a picture is lost."""
LIMIT, BEGINNING = 240.0, 60.0
"""Seconds past which no round is begun, and that a peer has to show its first picture."""

OWN = """
async ([path, value]) => {
  const slider = document.querySelector(`[data-path="${path}"] .q-slider`);
  const before = studio.state.shown, begun = performance.now();
  getElement(Number(slider.id.slice(1))).move(value);
  while (studio.state.shown === before) await new Promise(requestAnimationFrame);
  return studio.state.at - begun;
}
"""
HANDLE = """
const handle = (root) => root.querySelector(".noUi-handle")
  || [...root.querySelectorAll("*")].map((each) => each.shadowRoot && handle(each.shadowRoot)).find(Boolean);
const press = () => handle(document).dispatchEvent(
  new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, cancelable: true }));
const frame = () => new Promise(requestAnimationFrame);
"""
BOKEH = f"""
async () => {{
  {HANDLE}
  const source = Bokeh.documents[0].get_model_by_name("flower"), begun = performance.now();
  const changed = new Promise((done) => source.connect(source.properties.data.change, done));
  press();
  await changed;
  await frame();
  return performance.now() - begun;
}}
"""
IPYWIDGETS = f"""
async () => {{
  {HANDLE}
  const drawn = () => document.querySelector("img[src^='data:image']");
  const before = drawn().src, begun = performance.now();
  press();
  while (!drawn() || drawn().src === before || !drawn().complete) await frame();
  await frame();
  return performance.now() - begun;
}}
"""

IN_TIME = """
(given) => Promise.race([(%s)(given), new Promise((done) => setTimeout(() => done(null), %d))])
"""
"""A page that draws no frames would keep whoever waits for one for ever; its clock goes on."""


@contextlib.contextmanager
def served(*command: str) -> Iterator[str]:
    """Start a peer's server at a free port, which its command names as {port}; yield its address."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    call = [str(PAGES), *(word.replace("{port}", str(port)) for word in command)]
    process = subprocess.Popen(call, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield f"http://127.0.0.1:{port}"
    finally:
        process.terminate()
        try:
            process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def notebook(folder: Path) -> Path:
    """Write the notebook of ipywidgets; return its path."""
    source = (PEERS / "ipywidgets_cell.py").read_text(encoding="utf-8")
    # What a notebook shows is what its last line says, and this module ends in one.
    cell: dict[str, Any] = {
        "cell_type": "code",
        "id": "one",
        "metadata": {},
        "execution_count": None,
        "outputs": [],
    }
    lines = source.replace("from __future__ import annotations\n", "%matplotlib inline\n").splitlines(True)
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    page = {"nbformat": 4, "nbformat_minor": 5, "metadata": kernel, "cells": [cell | {"source": lines}]}
    path = folder / "flower.ipynb"
    path.write_text(json.dumps(page), encoding="utf-8")
    return path


def opened(chromium: Any, address: str, ready: str) -> Any:
    """Return a peer's page once its picture is there."""
    context = chromium.new_context(viewport={"width": 1440, "height": 900})
    context.set_default_timeout(1000 * BEGINNING)
    page = context.new_page()
    until = time.monotonic() + BEGINNING
    while time.monotonic() < until:
        with contextlib.suppress(Exception):
            page.goto(address)
            break
        page.wait_for_timeout(500)
    page.wait_for_function(ready)
    return page


def measure(folder: Path) -> dict[str, list[float]]:
    """Return milliseconds of each entrant, round by round."""
    begun = time.monotonic()
    bokeh = "-m", "bokeh", "serve", str(PEERS / "bokeh_page.py"), "--port", "{port}", "--address", "127.0.0.1"
    voila = "-m", "voila", str(notebook(folder)), "--no-browser", "--port={port}"
    with (
        browser() as chromium,
        served(*bokeh, "--allow-websocket-origin", "127.0.0.1:{port}") as bokeh_address,
        served(*voila) as voila_address,
        studio(folder / "own", str(SAMPLE)) as made,
    ):
        ready = f"() => {{ {HANDLE} return %s && !!handle(document); }}"
        first = opened(chromium, f"{bokeh_address}/bokeh_page", ready % "window.Bokeh && Bokeh.documents[0]")
        second = opened(chromium, voila_address, ready % "document.querySelector(\"img[src^='data:image']\")")
        own = Page(chromium, made.address)
        own.slider(SLIDER).wait_for()
        entrants: dict[str, tuple[Any, Callable[[int], tuple[Any, ...]]]] = {
            "studio": (own.page, lambda step: (OWN, [SLIDER, 0.9 + 0.002 * (step + 1)])),
            "bokeh": (first, lambda _: (BOKEH,)),
            "ipywidgets": (second, lambda _: (IPYWIDGETS,)),
        }
        taken: dict[str, list[float]] = {name: [] for name in entrants}
        for step in range(WARM + ROUNDS):
            if time.monotonic() - begun > LIMIT:
                break
            for name, (page, asked) in list(entrants.items())[:: -1 if step % 2 else 1]:
                # What is not in front draws no frames.
                page.bring_to_front()
                each = []
                for value in range(TURN):
                    code, *given = asked(TURN * step + value)
                    found = page.evaluate(IN_TIME % (code, MOST_MS), *given)
                    each.append(math.nan if found is None else float(found))
                came = [milliseconds for milliseconds in each[1:] if math.isfinite(milliseconds)]
                taken[name].append(statistics.median(came) if came else math.nan)
            print(f"round {step}: {told_of(taken, -1)}", file=sys.stderr)
    return {name: each[WARM:] for name, each in taken.items()}


def told_of(taken: dict[str, list[float]], number: int) -> str:
    """Return what a round took, in words."""
    return ", ".join(f"{name} {each[number]:.0f} ms" for name, each in taken.items())


def told(taken: dict[str, list[float]]) -> dict[str, Any]:
    """Return medians in milliseconds, and by how much each peer takes longer, within a round.

    Raises:
        SystemExit: where too few rounds were done.
    """
    rounds = len(taken["studio"])
    came = {name: [each for each in found if math.isfinite(each)] for name, found in taken.items()}
    if min(map(len, came.values())) < FEWEST:
        counts = ", ".join(f"{name} {len(each)}" for name, each in came.items())
        raise SystemExit(f"too few pictures came of {rounds} rounds: {counts}")
    found: dict[str, Any] = {f"{name}_ms": round(statistics.median(each), 1) for name, each in came.items()}
    for name in ("bokeh", "ipywidgets"):
        pairs = zip(taken[name], taken["studio"], strict=True)
        ratios = [peer / own for peer, own in pairs if math.isfinite(peer / own)]
        found[f"{name}_times"] = round(statistics.median(ratios), 1) if ratios else None
    lost = {name: rounds - len(each) for name, each in came.items()}
    return found | {"rounds": rounds, "lost": lost, "load": round(os.getloadavg()[0], 1)}


if __name__ == "__main__":
    if not PAGES.exists():
        raise SystemExit(f"{PAGES.parents[1].name} is missing: tools/setup.sh peers makes it")
    with tempfile.TemporaryDirectory(prefix="batik-pages-") as root:
        print(json.dumps(told(measure(Path(root)))))
