"""The samples' pictures and their gallery show what the recipes say today."""

from __future__ import annotations

import io
import re
from pathlib import Path

import pytest
from PIL import Image, ImageOps

from batik_vector.library import included
from tools import golden, travel
from tools.starters_sheet import SHEET

MEND = "make golden draws it again; look at it before you keep it"


def picture(path: Path) -> bytes:
    return path.with_suffix(".png").read_bytes()


@pytest.mark.clients
@pytest.mark.every
@pytest.mark.parametrize("path", golden.samples(), ids=lambda path: path.stem)
def test_picture_and_words_are_up_to_date(path: Path) -> None:
    """The gallery's or the figures', what the library knows, and the way of a pen."""
    each = golden.sample(path)
    assert not golden.stale(each), MEND
    told = golden.entries(each)
    missing = [page.name for page, entry in told.items() if entry not in page.read_text(encoding="utf-8")]
    assert missing == [], MEND


@pytest.mark.parametrize("path", golden.samples(), ids=lambda path: path.stem)
def test_the_picture_is_small(path: Path) -> None:
    data = picture(path)
    assert len(data) <= golden.MOST_BYTES
    assert Image.open(io.BytesIO(data)).width <= golden.WIDTH


@pytest.mark.clients
def test_the_sheet_of_the_starters_is_up_to_date() -> None:
    assert not golden.sheet_is_stale(), MEND


@pytest.mark.clients
@pytest.mark.parametrize(
    ("name", "path"), [each for each in included.paths() if each[0].startswith("starter/")], ids=str
)
def test_what_the_library_knows_of_a_starter_is_up_to_date(name: str, path: Path) -> None:
    assert golden.included_line(name, path) in included.MEASURED.read_text(encoding="utf-8"), MEND


def test_every_sample_stands_on_its_page_in_turn() -> None:
    seen = []
    for page in (golden.GALLERY, golden.DRAWINGS, golden.FIGURES):
        text = (golden.SAMPLES / page).read_text(encoding="utf-8")
        shown = re.findall(r"^!\[.*\]\((.*)\.png\)$", text, re.MULTILINE)
        order = [each.stem for each in golden.samples() if each.stem in shown]
        assert shown == order
        assert (page == golden.FIGURES) == any(each.startswith("figure-") for each in shown)
        seen += shown
    assert sorted(seen) == sorted(each.stem for each in golden.samples())
    assert list(included.known()) == [name for name, _ in included.paths()]


@pytest.mark.parametrize("name", ["chrysanthemum-line", "kawung", "group-p6m"])
def test_the_way_of_a_pen_is_as_the_page_says(name: str) -> None:
    page = golden.sample(golden.SAMPLES / f"{name}.toml").page
    assert travel.row(name, page) in travel.PAGE.read_text(encoding="utf-8"), MEND


def test_every_sample_has_its_way_on_the_page() -> None:
    told = travel.PAGE.read_text(encoding="utf-8").split(travel.HEAD)[1].splitlines()
    assert [line.split(" | ")[0].removeprefix("| ") for line in told] == [
        path.stem for path in golden.samples()
    ]


def test_no_sample_or_starter_has_changed_since_the_library_measured_it() -> None:
    measured = {name: each.digest for name, each in included.known().items()}
    assert measured == {name: included.digest(path) for name, path in included.paths()}, MEND


def test_the_sheet_of_the_starters_is_small() -> None:
    assert SHEET.stat().st_size <= golden.MOST_BYTES


def test_another_picture_is_told() -> None:
    one = Image.new("RGB", (60, 40), "#1d2f5f")
    one.paste("#f4efe2", (10, 10, 22, 22))
    files = []
    for each in (one, ImageOps.mirror(one), one.resize((61, 40))):
        out = io.BytesIO()
        each.save(out, "PNG")
        files.append(out.getvalue())
    assert golden.same(files[0], files[0])
    assert not golden.same(files[0], files[1])
    assert not golden.same(files[0], files[2])


def test_the_comment_of_a_recipe_becomes_paragraphs() -> None:
    text = "# One,\n# two.\n#\n# Three.\n\n# not this\ntitle = 'x'\n"
    assert golden.leading_comment(text) == ["One, two.", "Three."]


@pytest.mark.parametrize(("shape", "expected"), [(1.0, (3, 2)), (2.0, (2, 3)), (0.5, (3, 1)), (1.5, (2, 2))])
def test_repeats_make_a_pleasant_shape(shape: float, expected: tuple[int, int]) -> None:
    assert golden.repeats(shape) == expected
