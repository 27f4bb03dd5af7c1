from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector import Artwork, Profile, Recipe, SvgOptions, compile_recipe, render
from batik_vector.errors import Fault, GeometryError
from batik_vector.recipe.loading import read_recipe
from batik_vector.studio import draping
from batik_vector.studio.asking import KINDS, View
from batik_vector.studio.changes import scaled
from batik_vector.studio.drafts import Draft
from batik_vector.studio.pictures import Picture, Pictures
from batik_vector.studio.views import Looker
from batik_vector.studio.worker import BEGUN, Answer, answer_of, request_of
from tests.studio.test_drafts import FLOWER

SAMPLES = Path(__file__).parents[2] / "samples"
SVG = "{http://www.w3.org/2000/svg}"
FIRST = Draft(FLOWER, stem="k")
SLOW = Draft.read(SAMPLES / "lotus-pond.toml").with_value("tolerance", 0.002)


def test_the_picture_is_the_writers_own() -> None:
    shown = Looker().look(FIRST, View())
    recipe = replace(FIRST.recipe, tolerance=View().tolerance)
    expected = render(compile_recipe(recipe), "svg", SvgOptions(profile=Profile.COMPACT))
    assert shown.svg.encode() == expected
    assert shown.facts["size_mm"] == [300, 300]
    assert shown.facts["layers"][0]["ink"] == "wax"


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("look", ["cloth", "lines"])
def test_every_view_is_a_picture(kind: str, look: str) -> None:
    shown = Looker().look(FIRST, View(kind, look))
    assert shown.faults == ()
    root = ET.fromstring(shown.svg)
    width, height = (float(root.get(side, "").removesuffix("mm")) for side in ("width", "height"))
    assert [width, height] == shown.facts["size_mm"]
    assert root.get("viewBox") == f"0 0 {width:g} {height:g}"
    ids = [each.get("id") for each in root.iter() if each.get("id")]
    assert len(ids) == len(set(ids))
    drawn = [each for each in root.iter(f"{SVG}path") if each.get("d")]
    assert drawn
    filled = [each for each in root.iter() if (each.get("fill") or "none").startswith("#000000")]
    assert filled == []


def test_lines_have_no_fill() -> None:
    root = ET.fromstring(Looker().look(FIRST, View(look="lines")).svg)
    groups = [each for each in root.iter(f"{SVG}g") if each.get("fill") and each.get("id") != "cloth"]
    assert root.find(f".//{SVG}polygon") is None
    assert {each.get("fill") for each in groups} == {"none"}
    assert all((each.get("stroke") or "").startswith("#") for each in groups)


def test_sizes_are_those_of_what_is_shown() -> None:
    looker = Looker()
    sizes = {kind: looker.look(FIRST, View(kind, across=2, up=5)).facts["size_mm"] for kind in KINDS}
    assert sizes["three"] == [900, 900]
    assert sizes["field"] == [600, 1500]
    assert sizes["yardage"] == [1000, 1000]
    cloth = FIRST.with_value("yardage.width", 400).with_value("yardage.length", 700)
    assert looker.look(cloth, View("yardage")).facts["size_mm"] == [400, 700]
    alone, _ = (SAMPLES / "border-p11m.toml").read_text(encoding="utf-8").split("# The field")
    borders = Draft(alone, stem="padi")
    assert looker.look(borders, View("tile")).facts["size_mm"] == [400, 300]


def test_another_view_of_a_draft_is_not_compiled_again(monkeypatch: pytest.MonkeyPatch) -> None:
    from batik_vector.studio import views

    counted = []

    def counting(recipe: Recipe, **rest: Any) -> Artwork:
        counted.append(recipe)
        return compile_recipe(recipe, **rest)

    monkeypatch.setattr(views, "compile_recipe", counting)
    looker = Looker()
    for view in (View(), View("three"), View(look="lines"), View(certify=True)):
        looker.look(FIRST, view)
    assert len(counted) == 1
    looker.look(FIRST.with_value("seed", 1), View())
    assert len(counted) == 2


def test_small_tiles_are_drawn_finer_and_a_slider_that_moves_coarser() -> None:
    counted = {}
    looker = Looker()
    for by in (0.5, 5):
        draft = scaled(FIRST, by).with_value("tolerance", 0.002)
        for rough in (False, True):
            shown = looker.look(draft, View(rough=rough))
            counted[by, rough] = shown.facts["vertices"], shown.facts["size_mm"][0]
    # Half a pixel is a part of what is shown, up to a tolerance in mm.
    assert counted[0.5, False][0] > 2 * counted[0.5, True][0]
    assert counted[5, False][0] > counted[0.5, False][0]
    assert counted[5, True][0] == pytest.approx(counted[0.5, True][0], rel=0.05)


@pytest.mark.parametrize(
    ("repeat", "block"), [("grid", (20, 30)), ("half-drop", (40, 30)), ("brick", (20, 60))]
)
def test_cloth_too_fine_to_be_drawn_mark_by_mark_is_a_block_that_repeats(
    repeat: str, block: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    # One mark a tile, so that a block can be told from its neighbours by its edges alone.
    draft = Draft(FLOWER).with_values(
        {"tile.size": ["20 mm", "30 mm"], "tile.repeat": repeat, "place[0].width": "12 mm"}
    )
    monkeypatch.setattr(draping, "BLOCK", 1)
    monkeypatch.setattr(draping, "MOST", 5000)
    for kind in ("yardage", "shirt"):
        shown = Looker().look(draft, View(kind))
        assert not shown.faults
        assert f'width="{block[0]}" height="{block[1]}"' in shown.svg.partition("<pattern")[2][:200]
    monkeypatch.setattr(draping, "MOST", 10)
    assert "larger tolerance" in Looker().look(draft, View("shirt")).faults[0].message


@pytest.mark.parametrize("size", ['width = "28 cm"', 'scale = "90 mm"'])
def test_a_motif_is_looked_at_alone_as_large_as_it_is(size: str) -> None:
    text = FLOWER.replace('width = "28 cm"', f'{size}\ngap = "9 mm"\nsymmetry = "p2"')
    alone = Looker().look(Draft(text), View(motif="a"))
    assert not alone.faults
    _, _, width, height = map(float, ET.fromstring(alone.svg).attrib["viewBox"].split())
    drawn = compile_recipe(read_recipe(FLOWER.replace('width = "28 cm"', size)))
    left, low, right, high = shapely.total_bounds(np.concatenate([each.areas for each in drawn.layers]))
    # The cloth round it is 6 % of its larger side on either side.
    assert width == pytest.approx(1.12 * (right - left), rel=0.01)
    assert height == pytest.approx(1.12 * (high - low), rel=0.01)
    assert "no motif" in str(Looker().look(Draft(text), View(motif="b")).faults[0])


def test_faults_have_their_keys_and_lines() -> None:
    shown = Looker().look(FIRST.with_value("motif.a.petal.count", 999), View())
    assert [(each.key, each.line) for each in shown.faults] == [("motif.a.petal.count", 5)]
    late = Looker().look(FIRST.with_value("place[0].gap", -1), View())
    assert late.faults[0].key == "place[0].gap"
    assert Looker().look(Draft("[torn"), View()).faults[0].line == 1
    with pytest.raises(GeometryError, match="expected one of tile"):
        View("tiles")


def test_a_verdict_comes_with_pointers() -> None:
    shown = Looker().look(FIRST, View(certify=True, tolerance=0.0))
    assert shown.verdict["passed"] is True
    assert json.dumps(shown.verdict)
    assert Looker().look(FIRST, View()).verdict == {}


# By processes of their own.


@pytest.fixture(scope="module")
def loop() -> Iterator[asyncio.AbstractEventLoop]:
    made = asyncio.new_event_loop()
    yield made
    made.close()


@pytest.fixture(scope="module")
def pictures(loop: asyncio.AbstractEventLoop) -> Iterator[Pictures]:
    made = Pictures()
    loop.run_until_complete(made.warm())
    yield made
    made.close()


def has(picture: Picture | None) -> Picture:
    assert picture is not None
    return picture


def test_pictures_come_from_another_process(loop: asyncio.AbstractEventLoop, pictures: Pictures) -> None:
    picture = has(loop.run_until_complete(pictures.ask(FIRST)))
    assert picture.svg.decode() == Looker().look(FIRST, View()).svg
    assert picture.faults == ()
    assert 0 < picture.seconds < picture.waited
    faulty = has(loop.run_until_complete(pictures.ask(FIRST.with_value("motif.a.petal.count", 999))))
    assert (faulty.svg, faulty.faults[0].line) == (b"", 5)


def test_of_many_asks_the_first_and_the_newest_are_answered(
    loop: asyncio.AbstractEventLoop, pictures: Pictures
) -> None:
    async def drag() -> list[Picture | None]:
        drafts = [FIRST.with_value("motif.a.petal.count", number) for number in range(3, 13)]
        return await asyncio.gather(*(pictures.ask(draft) for draft in drafts))

    found = loop.run_until_complete(drag())
    assert [each is not None for each in found] == [True, *[False] * 8, True]
    assert "count = 12" in has(found[-1]).draft.text
    assert has(found[-1]).svg


def test_what_takes_long_is_cancelled_and_the_next_is_drawn(
    loop: asyncio.AbstractEventLoop, pictures: Pictures
) -> None:
    async def cancelled() -> Picture:
        asyncio.get_running_loop().call_later(0.1, pictures.cancel)
        return has(await pictures.ask(SLOW, View(tolerance=0.0)))

    assert loop.run_until_complete(cancelled()).faults[0].message == "cancelled"
    assert has(loop.run_until_complete(pictures.ask(FIRST))).svg


def test_what_is_stopped_before_it_is_begun_is_not_begun(
    loop: asyncio.AbstractEventLoop, pictures: Pictures
) -> None:
    async def cancelled() -> Picture:
        for _ in range(4):
            pictures._threads.submit(time.sleep, 0.5)
        asyncio.get_running_loop().call_later(0.1, pictures.cancel)
        return has(await pictures.ask(SLOW, View(tolerance=0.0)))

    loop.run_until_complete(pictures.warm())
    assert loop.run_until_complete(cancelled()).faults[0].message == "cancelled"
    assert has(loop.run_until_complete(pictures.ask(FIRST))).svg


def test_what_takes_too_long_is_stopped(loop: asyncio.AbstractEventLoop, pictures: Pictures) -> None:
    picture = has(loop.run_until_complete(pictures.ask(SLOW, View(tolerance=0.0), limit=0.1)))
    assert "took longer than 0.1 s" in picture.faults[0].message
    assert picture.waited < 60


def test_that_its_process_has_to_be_started_is_not_counted(
    loop: asyncio.AbstractEventLoop, monkeypatch: pytest.MonkeyPatch
) -> None:
    def exchange(hand: Any, number: int, request: bytes, tell: Callable[[str], None]) -> Answer:
        time.sleep(0.3)  # it starts
        tell(BEGUN)
        tell("drawing")
        time.sleep(next(pauses))
        return Answer(faults=(Fault(hand._stopped[1]),)) if hand._stopped[0] == number else Answer()

    monkeypatch.setattr("batik_vector.studio.pictures._Hand.exchange", exchange)
    pauses, stages = iter((0.0, 0.4)), list[str]()

    async def asked() -> Picture:
        async with Pictures(limit=0.2) as pictures:
            return has(await pictures.ask(FIRST, tell=stages.append))

    assert not loop.run_until_complete(asked()).faults
    assert "took longer than 0.2 s" in loop.run_until_complete(asked()).faults[0].message
    assert stages == ["drawing", "drawing"]


def test_a_task_that_is_cancelled_leaves_nothing_behind(
    loop: asyncio.AbstractEventLoop, pictures: Pictures
) -> None:
    async def given_up() -> Picture:
        task = asyncio.ensure_future(pictures.ask(SLOW, View(tolerance=0.0)))
        await asyncio.sleep(0.1)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task
        return has(await pictures.ask(FIRST))

    assert loop.run_until_complete(given_up()).svg


def test_a_process_that_dies_costs_one_picture(loop: asyncio.AbstractEventLoop, pictures: Pictures) -> None:
    async def killed() -> Picture:
        def kill() -> None:
            made = pictures._hands["front"]._now
            assert made is not None
            os.kill(made.process.pid, signal.SIGTERM)

        asyncio.get_running_loop().call_later(0.1, kill)
        return has(await pictures.ask(SLOW, View(tolerance=0.0)))

    picture = loop.run_until_complete(killed())
    assert "the process that drew it ended" in picture.faults[0].message
    assert has(loop.run_until_complete(pictures.ask(FIRST))).svg


def test_stages_are_told(loop: asyncio.AbstractEventLoop, pictures: Pictures) -> None:
    told: list[str] = []
    loop.run_until_complete(pictures.ask(FIRST.with_value("seed", 77), tell=told.append))
    assert told[:2] == ["placing a", "cutting the tile"]


class Reader:
    """A pipe of which nothing but bytes is read."""

    def __init__(self, *messages: bytes) -> None:
        self.messages = iter(messages)

    def recv_bytes(self) -> bytes:
        return next(self.messages)


def test_nothing_but_text_and_bytes_goes_through_the_pipe() -> None:
    sent = json.loads(request_of(FIRST, View()))
    assert sent["text"] == FIRST.text
    assert sent["view"]["kind"] == "tile"
    head = {"files": [""], "facts": {}, "verdict": {}, "faults": [], "seconds": 1.0, "defect": ""}
    answer = answer_of(Reader(json.dumps(head).encode(), b"<svg/>"))  # type: ignore[arg-type]
    assert (answer.svg, answer.stage) == (b"<svg/>", "")
    assert isinstance(answer, Answer)


CTRL_C = """
import asyncio, sys
from batik_vector.studio.asking import View
from batik_vector.studio.drafts import Draft
from batik_vector.studio.pictures import Pictures

async def main():
    async with Pictures() as pictures:
        await pictures.warm()
        print("begun", flush=True)
        await pictures.ask(Draft.read(sys.argv[1]).with_value("tolerance", 0.002), View(tolerance=0.0))
        # The process that draws hears Ctrl-C too, and its end may be told first.
        await asyncio.sleep(60)

if __name__ == "__main__":
    asyncio.run(main())
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_ctrl_c_ends_all_of_it_without_a_word_of_the_workers(tmp_path: Path) -> None:
    (tmp_path / "run.py").write_text(CTRL_C)
    with subprocess.Popen(
        [sys.executable, "run.py", str(SAMPLES / "lotus-pond.toml")],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(SAMPLES.parent)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as run:
        try:
            assert run.stdout is not None
            assert run.stdout.readline() == "begun\n"
            os.killpg(run.pid, signal.SIGINT)
            _, told = run.communicate(timeout=60)
        finally:
            run.kill()
    assert run.returncode != 0
    assert "KeyboardInterrupt" in told
    assert told.count("Traceback") <= 2, told
    assert all_gone(run.pid)


def all_gone(group: int) -> bool:
    """Wait until no process of a group is left."""
    for _ in range(100):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False
