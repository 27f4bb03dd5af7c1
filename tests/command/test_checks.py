"""The check: broken tiles fail where they are broken, whole ones pass whoever wrote them."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from batik_vector.command.checks import Wishes
from batik_vector.command.cli import cli
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import write_artwork
from batik_vector.recipe.loading import load_recipe
from batik_vector.tiling.cloth.field import with_bleed
from tests.calling import runner
from tests.command.checking import GOOD, TILES, call, checked
from tests.recipe.test_bad_input import BASE

CROSSING = BASE.replace('width = "280 mm"', 'width = "280 mm"\nat = ["20 mm", "70 mm"]')
"""A recipe whose marks cross every edge of the tile."""


def classes(text: str) -> str:
    """The tile as Illustrator writes it: style classes, points as px, a generator, a doctype."""
    rules = ".st0{fill:#A86F3A;}.st1{fill:none;stroke:#F4EFE2;stroke-width:1.2;}.st2{fill:#8C2F2B;}"
    for rule, old in (
        ("st0", 'fill="#a86f3a"'),
        ("st1", 'fill="none" stroke="#f4efe2" stroke-width="1.2"'),
        ("st2", 'fill="#8c2f2b"'),
    ):
        assert old in text
        text = text.replace(old, f'class="{rule}"')
    text = text.replace('width="60mm" height="60mm"', 'width="240px" height="240px" xml:space="preserve"')
    head = '<?xml version="1.0" encoding="utf-8"?>\n<!-- Generator: Adobe Illustrator 27.0 -->\n'
    head += (
        '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">\n'
    )
    return head + text.replace("<title>", f'<style type="text/css">{rules}</style><title>')


def turned(text: str) -> str:
    """The tile in a group that is scaled and moved, on a page whose viewBox begins elsewhere."""
    text = text.replace('viewBox="0 0 60 60"', 'viewBox="-30 -30 120 120"')
    text = text.replace("</title>", '</title><g transform="translate(90 -30) rotate(90) scale(2)">')
    return text.replace("</svg>", "</g></svg>")


def symbols(text: str) -> str:
    """The tile with its marks as symbols that are used."""
    marks = "".join(re.findall(r'<path id="(?:left|top|right|bottom)".*/>', text))
    for mark in re.findall(r'<path id="(?:left|top|right|bottom)".*/>\n', text):
        text = text.replace(mark, "")
    used = "".join(f'<use href="#{name}"/>' for name in ("left", "top", "right", "bottom"))
    return text.replace('fill="#a86f3a">', f'fill="#a86f3a">{used}').replace(
        "</svg>", f"<defs>{marks}</defs></svg>"
    )


@pytest.mark.parametrize("rewritten", [str, classes, turned, symbols])
def test_the_whole_tile_passes_however_it_is_written(desk: Path, rewritten: Any) -> None:
    (desk / "tile.svg").write_text(rewritten(GOOD))
    facts = checked("tile.svg", "--group", "p4")
    assert facts["passed"]
    assert facts["certificate"]["measures"]["crossings"] == 12
    assert facts["certificate"]["symmetry"]["found"] == "p4"
    assert facts["checked"] == "geometry"
    # Discs in the corners reach beyond the page, which shows a quarter of each.
    assert facts["layers"][0]["covers"] == pytest.approx(0.125, abs=0.001)


def test_a_drop_is_believed_as_it_is_told(desk: Path) -> None:
    assert checked(TILES / "good.svg", "--repeat", "half-drop", code=1)["drop"] == "1/2"
    stem = '<path d="M{0} {1}h10v8h-10z" fill="#a86f3a"/>'
    marks = "".join(stem.format(*place) for place in ((0, 10), (0, 40), (50, 25), (50, -5), (50, 55)))
    head = '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="30mm" viewBox="0 0 60 30">'
    (desk / "a.svg").write_text(f"{head}{marks}</svg>")
    assert call("a.svg", "--repeat", "half-drop").exit_code == 0
    # Straight, its stems would end along the edges: that may be meant, and is told.
    assert {each["edge"] for each in checked("a.svg")["certificate"]["ends_along_edges"]} == {"left", "right"}


def test_the_report_for_people_tells_where_and_what() -> None:
    result = call(TILES / "edge-moved.svg", "--group", "p4")
    assert result.stderr == ""
    lines = result.stdout.splitlines()
    assert "  tile 60 × 60 mm, repeats straight" in lines[1]
    assert "  symmetry p1, p4 asked for" in lines
    assert any(
        line.startswith("  at 0.000, 22.000 mm: soga: a border crosses the left edge") for line in lines
    )
    assert lines[-1].endswith("edge-moved.svg: FAILED: 2 faults")
    assert call(TILES / "good.svg").stdout.endswith("passed: opposite edges agree, nothing is drawn twice\n")


def test_limits_can_be_widened() -> None:
    assert call(TILES / "edge-moved.svg").exit_code == 1
    assert call(TILES / "edge-moved.svg", "--position", "0.1").exit_code == 0
    assert call(TILES / "sliver.svg", "--thin", "0.001").exit_code == 0
    assert call(TILES / "good.svg", "--striping", "5").exit_code == 1


def test_the_help_tells_the_true_defaults() -> None:
    words = " ".join(runner().invoke(cli, ["check", "--help"]).stdout.split())
    for name in ("position", "tangent", "near", "thin", "double"):
        default = re.search(rf"--{name} [A-Z]+ [^\[]*\[default: ([\d.]+)(?:; drawings ([\d.]+))?\]", words)
        assert default, name
        assert float(default[1]) == getattr(Wishes().limits_for(foreign=False), name)
        assert float(default[2] or default[1]) == getattr(Wishes().limits_for(foreign=True), name)


def compiled(*lines: str, name: str = "k") -> str:
    Path(f"{name}.toml").write_text(CROSSING[: CROSSING.index("[[output]]")] + "\n".join(lines))
    assert runner().invoke(cli, ["compile", f"{name}.toml"]).exit_code == 0
    return f"{name}.svg"


def test_our_own_drawing_is_measured_and_held_against_its_recipe(desk: Path) -> None:
    path = compiled()
    facts = checked(path)
    assert (facts["title"], facts["cell_mm"], facts["differences"]) == ("Test", [640.0, 320.0], [])
    assert facts["certificate"]["exact"]
    recipe = checked("k.toml")
    for key in ("cell_mm", "drop", "vertices", "layers"):
        assert facts[key] == recipe[key]
    assert facts["certificate"]["measures"] == recipe["certificate"]["measures"]


@pytest.mark.parametrize(
    "output",
    ["repeat = [2, 1]", 'curves = "bezier"', 'profile = "compact"', "cloth = false"],
)
def test_every_kind_of_our_own_drawings_is_known_again(desk: Path, output: str) -> None:
    facts = checked(compiled("[[output]]", 'format = "svg"', output))
    assert (facts["differences"], facts["broken"]) == ([], [])


def test_drawings_from_before_the_cloth_had_a_number_are_known_again(desk: Path) -> None:
    path = Path(compiled())
    ground = '<polygon points="0 0 640 0 640 320 0 320" />'
    text = path.read_text("utf-8")
    for new, old in (("%99 cloth", "%cloth"), (ground, '<path d="M0 0 640 0 640 320 0 320Z" />')):
        assert text.count(new) == 1
        text = text.replace(new, old)
    path.write_text(text)
    facts = checked(str(path))
    assert (facts["differences"], facts["broken"]) == ([], [])
    assert [layer["ink"] for layer in facts["layers"]] == ["wax"]


def test_a_bleed_is_known_and_measured(desk: Path) -> None:
    Path("k.toml").write_text(CROSSING)
    artwork = with_bleed(compile_recipe(load_recipe("k.toml")), 5.0)
    write_artwork(artwork, "k.svg")
    facts = checked("k.svg")
    assert (facts["page_mm"], facts["cell_mm"], facts["differences"]) == ([650, 330], [640, 320], [])
    # The same page with bare margins is no bleed.
    text = Path(compiled()).read_text("utf-8")
    for old, new in (("640mm", "650mm"), ("320mm", "330mm"), ("0 0 640 320", "-5 -5 650 330")):
        assert text.count(f'"{old}"') == 1
        text = text.replace(f'"{old}"', f'"{new}"')
    Path("k.svg").write_text(text)
    assert "promises 640 × 320 mm" in checked("k.svg", code=1)["broken"][0]


def test_a_unit_keeps_the_drop_that_its_recipe_gives_it(desk: Path) -> None:
    facts = checked(compiled('cut = "unit"'))
    assert (facts["drop"], facts["cell_mm"]) == ("1/2", [320.0, 320.0])


def touches_an_edge(mark: str) -> bool:
    numbers = [float(each) for each in re.findall(r"-?[\d.]+", mark.split('"')[1])]
    return bool({0.0, 640.0} & {*numbers[::2]} or {0.0, 320.0} & {*numbers[1::2]})


def test_our_own_drawing_that_was_changed_is_told_of(desk: Path) -> None:
    path = Path(compiled())
    text = path.read_text("utf-8")
    marks = re.findall(r'<path d="[^"]*" id="[^"]*" */>', text)
    inner = next(mark for mark in marks if not touches_an_edge(mark))
    path.write_text(text.replace(inner, ""))
    facts = checked(path)
    assert facts["differences"]
    assert "wax: the file and the recipe differ in" in facts["differences"][0]
    path.write_text(re.sub(r'width="640mm"', 'width="660mm"', text))
    facts = checked(path, code=1)
    assert facts["broken"] == ["the page is 660 × 320 mm, and the recipe in it promises 640 × 320 mm"]


SQUARE = """
title = "Square"
[motif.square]
kind = "rosette"
elements = [{ curve = { kind = "polygon", sides = 4, radius = 1.41421356 }, turn = 45 }]
[[place]]
motif = "square"
scale = "10 mm"
at = ["10 mm", "20 mm"]
[tile]
size = ["40 mm", "40 mm"]
"""


@pytest.mark.parametrize("output", ["", '[[output]]\nformat = "svg"\nrepeat = [2, 3]'])
def test_a_border_meant_to_run_along_the_seam_is_no_fault(desk: Path, output: str) -> None:
    Path("k.toml").write_text(SQUARE + output)
    assert runner().invoke(cli, ["compile", "k.toml"]).exit_code == 0
    assert checked("k.svg")["passed"]
    # Without its recipe it is told, as of a stranger's drawing, and as of the recipe itself.
    text = re.sub("<metadata>.*</metadata>", "", Path("k.svg").read_text("utf-8"), flags=re.DOTALL)
    Path("bare.svg").write_text(text)
    for source in ("k.toml", "bare.svg"):
        told = checked(source)["certificate"]["ends_along_edges"]
        assert {(round(each["from_mm"]) % 40, round(each["to_mm"]) % 40) for each in told} == {(10, 30)}


def test_a_file_that_shows_no_tile_says_what_it_shows(desk: Path) -> None:
    cloth = compiled('[yardage]\nwidth = "900 mm"\nlength = "400 mm"')
    result = call(cloth)
    assert result.exit_code == 2
    assert "k.svg: shows the cloth, and not the tile that fills it: check its recipe instead" in result.stderr
    assert call("k.toml").exit_code == 0


@pytest.mark.parametrize(
    ("place", "asked"), [("", "p4"), ('symmetry = "p2"', None), ('phase = ["5 mm", "0 mm"]', None)]
)
def test_the_symmetry_that_a_recipe_promises_is_asked_for(desk: Path, place: str, asked: str | None) -> None:
    text = CROSSING.replace('"half-drop"', '"p4"').replace('at = ["20 mm"', f'{place}\nat = ["20 mm"')
    Path("k.toml").write_text(text)
    assert checked("k.toml")["certificate"]["symmetry"]["asked"] == asked
    if asked:
        assert checked("k.toml", "--group", "p6", code=1)["certificate"]["symmetry"]["asked"] == "p6"


def test_a_stretch_is_told(desk: Path) -> None:
    Path("k.toml").write_text(CROSSING.replace('"half-drop"', '"grid"\nfit = { width = "642 mm" }'))
    assert checked("k.toml")["notes"] == ["stretched to fit: +0.313 % across, +0 % along the cloth"]


def test_a_recipe_that_cannot_be_read_leaves_a_drawing(desk: Path) -> None:
    path = Path(compiled())
    path.write_text(path.read_text("utf-8").replace("[motif.flower]", "[motif.flower"))
    facts = checked(path)
    assert any("its recipe cannot be read" in note for note in facts["notes"])
    assert facts["drop"] == "0"


@pytest.mark.parametrize(
    ("format", "end"), [(each, f".{each}") for each in ("pdf", "dxf", "png")] + [("swatch", "-swatch.svg")]
)
def test_of_other_formats_the_recipe_is_checked_and_said_to_be(desk: Path, format: str, end: str) -> None:
    Path("k.toml").write_text(CROSSING)
    runner().invoke(cli, ["compile", "k.toml", "-f", format])
    facts = checked(f"k{end}")
    assert (facts["checked"], facts["cell_mm"]) == ("recipe", [640.0, 320.0])
    assert facts["notes"] == ["the recipe that it carries was checked, not what the file draws"]


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (["a.png"], "a.png: carries no recipe, and only an SVG can be checked without one"),
        (["folder"], 'folder: is a folder, expected files, such as "folder/*.svg"'),
        (["goood.svg"], 'goood.svg: no such file: did you mean "good.svg"?'),
        (["nowhere"], "nowhere: no such file"),
        (["empty.svg"], "empty.svg: is empty, expected an SVG"),
        (["empty.toml"], "empty.toml: is empty, expected a recipe"),
        (["text.svg"], "text.svg:1: is no SVG"),
        (["percent.svg"], "its page has no size of its own"),
        (["a.jpg"], "a.jpg: is neither a recipe (.toml) nor an SVG drawing"),
        (["good.svg", "--set", "seed=1"], "is measured as it is drawn, which --set seed=1 cannot change"),
        (["good.svg", "--repeat", "halfdrop"], 'repeat "halfdrop": expected "grid", "half-drop"'),
        (["good.svg", "--group", "p5"], 'unknown group "p5"'),
        (["good.svg", "--pointers", "good.svg"], "good.svg is a file, expected a folder"),
        (["good.svg", "good.svg", "--pointers", "d"], 'would be shown in "d/good-check.svg"'),
    ],
)
def test_wrong_calls_say_what_is_wrong_and_write_nothing(desk: Path, args: list[str], words: str) -> None:
    shutil.copy(TILES / "good.svg", desk)
    (desk / "a.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    (desk / "a.jpg").write_bytes(b"\xff\xd8\xff\xe0")
    (desk / "folder").mkdir()
    for name in ("empty.svg", "empty.toml"):
        (desk / name).write_text("")
    (desk / "text.svg").write_text("hello")
    (desk / "percent.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="100%" height="100%"/>')
    before = sorted(desk.rglob("*"))
    result = call(*args)
    assert result.exit_code == 2, result.exception
    complaints = [line for line in result.stderr.splitlines() if line.startswith("batik-vector: error: ")]
    assert len(complaints) == 1
    assert words in complaints[0]
    assert sorted(desk.rglob("*")) == before


def test_one_source_that_cannot_be_read_keeps_back_no_other(desk: Path) -> None:
    Path("k.toml").write_text(CROSSING)
    shutil.copy(TILES / "gap.svg", desk)
    result = call("missing.svg", "k.toml", "gap.svg", "--json")
    assert result.exit_code == 2
    report = json.loads(result.stdout)
    assert [(each["recipe"], each["passed"]) for each in report["recipes"]] == [
        ("k.toml", True),
        ("gap.svg", False),
    ]
    assert [fault["source"] for fault in report["faults"]] == ["missing.svg"]


def test_a_drawing_under_another_name_is_known_by_its_beginning(desk: Path) -> None:
    (desk / "tile").write_text("\ufeff" + GOOD)
    assert checked("tile")["checked"] == "geometry"
