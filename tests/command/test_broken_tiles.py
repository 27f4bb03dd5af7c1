"""Tiles broken in one way each fail by it, where it is; the drawing that shows it leaves them as they are."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
import shapely

from batik_vector.importing.svg import read_svg
from tests.command.checking import GOOD, TILES, call, checked
from tests.thorough import rarely

PERIOD = 60.0

# What is broken in each tile: the kind of the fault, its ink, its place in mm (y up), and how near to that
# place it must be told. A place on an edge may be told on the opposite one. Where a symmetry is broken, any
# of the marks may be accused that the symmetry would carry into one another.
BROKEN: dict[str, tuple[str, str, tuple[float, float], float]] = {
    "clipped": ("unpaired", "soga", (24, 60), 0.01),
    "doubled-inside": ("double", "cotton", (9.9, 50.1), 0.4),
    "doubled-line": ("double", "#f4efe2 1.2 mm", (60, 49.5), 0.01),
    "duplicate": ("double", "madder", (37.2, 35.2), 0.5),
    "edge-moved": ("offset", "soga", (60, 22), 0.06),
    "gap": ("unpaired", "soga", (30, 0), 0.01),
    "kink": ("tangent", "cotton", (14, 60), 0.01),
    "line-moved": ("offset", "cotton", (46, 60), 0.09),
    "mirrored": ("symmetry", "madder", (30, 30), 16),
    "missing-mark": ("symmetry", "madder", (30, 30), 17),
    "one-sided": ("unpaired", "soga", (30, 0), 0.01),
    "pixel-off": ("unpaired", "soga", (60.265, 30), 0.01),
    "scaled": ("unpaired", "soga", (0, 31.875), 0.01),
    "short-line": ("unpaired", "cotton", (0, 14), 0.01),
    "sliver": ("sliver", "soga", (44.5, 0), 0.02),
    "wrong-drop": ("shift", "", (60, 4.5), 9),
    "wrong-ink": ("unpaired", "madder", (60, 30), 0.01),
}


def test_every_broken_tile_has_its_line() -> None:
    assert {path.stem for path in TILES.glob("*.svg")} == {*BROKEN, "good"}
    assert len(BROKEN) >= 14


@pytest.mark.parametrize("name", rarely(list(BROKEN), 2))
def test_a_broken_tile_fails_where_it_is_broken(name: str) -> None:
    kind, ink, (x, y), reach = BROKEN[name]
    # What is drawn twice shows nowhere, and so small a turn comes of rounding in most files.
    asked = {"double": ("--double", "0.005"), "tangent": ("--position", "0.001")}.get(kind, ())
    facts = checked(TILES / f"{name}.svg", "--group", "p4", *asked, code=1)
    mine = [each for each in facts["certificate"]["faults"] if (each["kind"], each["ink"]) == (kind, ink)]
    assert mine, facts["certificate"]["faults"]
    apart = [round_the_torus(each["where_mm"], (x, y)) for each in mine]
    assert min(apart) <= reach
    assert not facts["passed"]


@pytest.mark.parametrize("name", [name for name, (kind, *_) in BROKEN.items() if kind == "double"])
def test_what_a_stranger_drew_twice_is_told_and_passes(name: str, desk: Path) -> None:
    result = call(TILES / f"{name}.svg", "--pointers", ".")
    assert result.exit_code == 0
    assert "remark: at" in result.stdout
    assert "are drawn twice" in result.stdout
    assert "nothing is drawn twice" not in result.stdout
    assert (desk / f"{name}-check.svg").exists()
    facts = checked(TILES / f"{name}.svg")["certificate"]
    assert {each["kind"] for each in facts["remarks"]} == {"double"}
    assert facts["measures"]["doubled_length"] + facts["measures"]["doubled_area"] > 1


def round_the_torus(one: list[float], other: tuple[float, float]) -> float:
    """Return the larger of two places' differences, modulo the period."""
    gaps = ((a - b + PERIOD / 2) % PERIOD - PERIOD / 2 for a, b in zip(one, other, strict=True))
    return max(map(abs, gaps))


@pytest.mark.parametrize("name", ["mirrored", "missing-mark"])
def test_a_broken_symmetry_is_a_fault_only_where_it_is_asked_for(name: str) -> None:
    assert checked(TILES / f"{name}.svg")["certificate"]["symmetry"] == {"found": "p1", "asked": None}


def test_every_broken_tile_fails_by_its_fault_alone() -> None:
    """The table tells faults of the seam and inside; without them, the rest of each tile is the good one."""
    for name in BROKEN:
        text = (TILES / f"{name}.svg").read_text("utf-8")
        same = set(GOOD.splitlines()) & set(text.splitlines())
        assert len(same) >= 17, name


def test_pointers_show_each_fault_in_a_drawing_of_its_own(desk: Path) -> None:
    for name in ("good", "gap"):
        shutil.copy(TILES / f"{name}.svg", desk)
    before = (desk / "gap.svg").read_bytes()
    result = call("good.svg", "gap.svg", "--pointers", "shown")
    assert result.exit_code == 1
    assert 'shown/gap-check.svg  shows the faults in layer "check"' in result.stderr
    assert [path.name for path in (desk / "shown").iterdir()] == ["gap-check.svg"]
    text = (desk / "shown" / "gap-check.svg").read_text("utf-8")
    assert 'inkscape:label="check"' in text
    assert (desk / "gap.svg").read_bytes() == before
    # The drawing is left as it is, with the marks on top.
    body = before.decode().partition("<title>")[2].rpartition("</svg>")[0]
    assert body in text
    again = read_svg("shown/gap-check.svg")
    places = again.artwork.layers[-1].lines
    found = checked("gap.svg", code=1)["certificate"]["faults"][0]["where_mm"]
    at = shapely.Point(found)
    assert shapely.distance(shapely.union_all(places), at) < 0.025 * 60


def test_a_fault_is_pointed_at_in_the_picture_that_shows_it(desk: Path) -> None:
    """What lies on top, and tints, are faults that a drawing ink by ink would not show."""
    marks = '<circle cy="30" r="9" opacity=".4"/><circle cx="60" cy="30" r="9"/>'
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 60" width="120mm" height="120mm">'
    (desk / "tint.svg").write_text(f"{head}{marks}</svg>\n")
    assert call("tint.svg", "--pointers", "shown").exit_code == 1
    text = (desk / "shown" / "tint-check.svg").read_text("utf-8")
    assert text.startswith(head + marks)
    lines = read_svg("shown/tint-check.svg").artwork.layers[-1].lines

    assert shapely.distance(shapely.union_all(lines), shapely.Point(0, 60)) < 0.025 * 120


def test_a_drawing_whose_end_cannot_be_found_is_pointed_at_all_the_same(desk: Path) -> None:
    text = (TILES / "gap.svg").read_text("utf-8") + "<!-- drawn by hand -->\n"
    (desk / "gap.svg").write_text(text)
    assert call("gap.svg", "--pointers", "shown").exit_code == 1
    assert "check" in (desk / "shown" / "gap-check.svg").read_text("utf-8")
