"""Small tiles as they come from the field, and the verdict that is right for each."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from batik_vector.command.cli import cli
from tests.calling import runner
from tests.thorough import slow

CASES = Path(__file__).with_name("cases")
SAMPLES = Path(__file__).resolve().parents[2] / "samples"

PASSED = {
    "c01-relative-closed": "",
    "c02-checkerboard": "passed; ink ends along the",
    "c02b-stripes-across": "passed; ink ends along the upper edge at x = 0 to 80 (exact there; welding",
    "c03-tangent-dots": "",
    "c04-narrow-stripe": "passed; ink ends along the left edge",
    "c05-pattern-element": "tile 6.35 × 9.525 mm",
    "c07-figma-frame": "symmetry pmm",
    "c09-clip-circle": "",
    "c16-traced-gap": "",
    "c17-double-in-pieces": "mm of a line are drawn twice",
    "c19-invisible": "",
    "c21-two-decimals": "--position 0.0027",
    "c26-inkscape-90dpi": "",
}
FAILED = {
    "c10-order-at-seam": ["what lies on top differs"],
    "c12-opacity-at-seam": ["two tints meet", "35 %", "100 %"],
    "c13-half-line-at-edge": ["2 of the 4 mm of a line's breadth are cut off", "do not come back"],
    "c15-edge-hair": ["a strip of ink 0.021 mm wide"],
    "c20-hexagon-rounded-page": ["13.748 mm (51.96 px) would be right"],
    "c22-half-drop-unit": ['--repeat "half-drop"'],
}


def checked(name: str, *options: str) -> tuple[int, str]:
    result = runner().invoke(cli, ["check", str(CASES / f"{name}.svg"), *options])
    return result.exit_code, result.stdout


def facts_of(name: str, *options: str) -> dict[str, Any]:
    result = runner().invoke(cli, ["check", str(CASES / f"{name}.svg"), "--json", *options])
    facts: dict[str, Any] = json.loads(result.stdout)["recipes"][0]
    return facts


def test_every_case_has_its_verdict() -> None:
    assert {path.stem for path in CASES.glob("*.svg")} == {*PASSED, *FAILED, "c18-symbol-overflow"}


@pytest.mark.parametrize("name", PASSED)
def test_what_is_seamless_passes(name: str) -> None:
    code, told = checked(name)
    assert code == 0, told
    assert ": passed" in told
    assert PASSED[name] in told


@pytest.mark.parametrize("name", FAILED)
def test_what_is_not_fails_and_says_why(name: str) -> None:
    code, told = checked(name)
    assert code == 1
    assert "FAILED" in told
    assert all(words in told for words in FAILED[name]), told


def test_borders_along_the_edges_have_their_true_lengths() -> None:
    along = facts_of("c02-checkerboard")["certificate"]["ends_along_edges"]
    assert {each["edge"] for each in along} == {"left", "right", "lower", "upper"}
    assert {each["to_mm"] - each["from_mm"] for each in along} == {40.0}


def test_a_recipe_tells_its_borders_as_its_drawing_does(tmp_path: Path) -> None:
    recipe = CASES / "r02-stripe-recipe.toml"
    assert runner().invoke(cli, ["compile", str(recipe), "-o", str(tmp_path)]).exit_code == 0
    (drawing,) = tmp_path.glob("*.svg")
    bare = re.sub("<metadata>.*</metadata>", "", drawing.read_text("utf-8"), flags=re.DOTALL)
    drawing.write_text(bare, "utf-8")
    told = []
    for source in (recipe, drawing):
        report = json.loads(runner().invoke(cli, ["check", str(source), "--json"]).stdout)
        along = report["recipes"][0]["certificate"]["ends_along_edges"]
        told.append(sorted((each["edge"], each["from_mm"], each["to_mm"]) for each in along))
    assert told[0] == told[1]
    assert {high - low for _, low, high in told[0]} == {40.0}


def test_a_polygon_has_as_many_vertices_as_corners(tmp_path: Path) -> None:
    recipe = CASES / "r07-polygon-vertices.toml"
    for sides in (3, 4, 5):
        curve = f'motif.square.elements=[{{curve={{kind="polygon",sides={sides}}}}}]'
        call = ["compile", str(recipe), "-o", str(tmp_path), "--json", "--set", curve]
        assert json.loads(runner().invoke(cli, call).stdout)["recipes"][0]["vertices"] == sides + 1


def test_a_case_fails_where_it_is_wrong() -> None:
    ((x, y),) = (each["where_mm"] for each in facts_of("c10-order-at-seam")["certificate"]["faults"])
    assert x in (0, 100)
    assert 45 <= y <= 50


def test_gaps_and_lines_between_inks_are_told_on_request() -> None:
    code, told = checked("c16-traced-gap", "--between-inks", "0.2")
    assert code == 1
    assert "a bare gap of 0.1 mm to ink #1d2f5f runs 60 mm" in told
    assert checked("c16-traced-gap", "--between-inks", "0.09")[0] == 0
    code, told = checked("c17-double-in-pieces", "--between-inks", "0.1")
    assert code == 1
    assert "40 mm of a line are drawn in ink #cc0000 0.3 mm too" in told
    assert told.count("are drawn twice") == 2


NUMBERS = re.compile(r"-?[0-9.]+")


def absolute(match: re.Match[str]) -> str:
    """Return path data rounded to two decimals, every line with its letter."""
    return NUMBERS.sub(lambda number: f"{float(number[0]):.2f}", match[0])


SAVED: dict[str, Callable[[str], str]] = {
    "as it is": lambda text: text,
    "by Inkscape": lambda text: text.replace("<svg ", '<svg inkscape:version="1.2.2" ').replace(
        "<path d=", '<path style="stroke-width:1" d='
    ),
    "with two decimals": lambda text: re.sub(r' d="[^"]*"', absolute, text),
}


LARGE = ("toss-leaves", "chrysanthemum-line", "miao-drum", "group-p3")


@pytest.fixture(
    scope="module",
    params=["kawung", "trellis", *(pytest.param(each, marks=slow) for each in LARGE)],
)
def drawing(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> str:
    """The drawing of a sample that passes, without its recipe."""
    recipe, folder = str(SAMPLES / f"{request.param}.toml"), tmp_path_factory.mktemp("drawing")
    for call in (["compile", recipe, "-o", str(folder), "-f", "svg"], ["check", recipe]):
        result = runner().invoke(cli, call)
        assert result.exit_code == 0, result.stderr
    text = (folder / f"{request.param}.svg").read_text("utf-8")
    return re.sub("<metadata>.*</metadata>", "", text, flags=re.DOTALL)


@pytest.mark.parametrize("saved", SAVED)
def test_our_own_drawing_keeps_its_verdict_where_its_recipe_is_lost(
    drawing: str, saved: str, tmp_path: Path
) -> None:
    bare = tmp_path / "bare.svg"
    bare.write_text(SAVED[saved](drawing), "utf-8")
    result = runner().invoke(cli, ["check", str(bare)])
    assert result.exit_code == 0, result.stderr


def test_many_files_end_in_a_table() -> None:
    files = [str(CASES / f"{name}.svg") for name in ("c02-checkerboard", "c22-half-drop-unit", "none")]
    result = runner().invoke(cli, ["check", *files])
    assert result.exit_code == 2
    *_, head, first, second, third = result.stdout.splitlines()
    assert head.split()[:3] == ["verdict", "faults", "remarks"]
    assert first.split()[:2] == [files[0], "passed"]
    assert second.split()[:3] == [files[1], "FAILED", "2"]
    assert third.split() == [files[2], "error"]
