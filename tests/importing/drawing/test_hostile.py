"""Drawings from strangers: broken, huge and hostile ones are refused in one line, with line and key."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from batik_vector import RecipeError, load_recipe
from batik_vector.importing import document
from batik_vector.importing.drawing import names

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 90 90"'
)
MOTIF = '[motif.m]\nkind = "svg"\nfile = "d.svg"\n'
REST = '[[place]]\nmotif = "m"\nscale = 1\n[tile]\nsize = [90, 90]\n'
BOMB = "".join(f'<g id="b{i}">' + f'<use href="#b{i + 1}"/>' * 10 + "</g>" for i in range(9))


def complaint(folder: Path, drawing: str | bytes, motif: str = "") -> str:
    """Return the one thing that is wrong with a recipe of a drawing, without the name of its file."""
    data = drawing.encode() if isinstance(drawing, str) else drawing
    (folder / "d.svg").write_bytes(data)
    path = folder / "k.toml"
    path.write_text(MOTIF + motif + REST)
    begun = time.process_time()
    with pytest.raises(RecipeError) as found:
        load_recipe(path)
    assert time.process_time() - begun < 5
    (fault,) = found.value.faults
    text = str(fault)
    assert "\n" not in text
    return text.removeprefix(f"{path}:")


def svg(inner: str, head: str = "") -> str:
    return f"{HEAD}{head}>\n{inner}</svg>"


@pytest.mark.parametrize(
    ("inner", "words"),
    [
        ("<text x='5'>leaf</text>",
         "d.svg:2: <text>: text hangs on a font; convert it to outlines first (Inkscape: Path → Object to"),
        ('<image id="i" href="x.png" width="9" height="9"/>',
         'd.svg:2: <image id="i">: a picture has no outlines; trace it (Inkscape: Path → Trace Bitmap), or'),
        ('<linearGradient id="g"><stop stop-color="red"/><stop offset="1"/></linearGradient>'
         '<rect width="9" height="9" fill="url(#g)"/>', "d.svg:2: <rect>: is painted with a gradient"),
        ('<pattern id="p" width="3" height="3" patternUnits="userSpaceOnUse"><rect width="1" height="1"/>'
         '</pattern><rect width="9" height="9" fill="url(#p)"/>', "<rect>: is filled with a pattern; make"),
        ('<clipPath id="c"><circle r="9"/></clipPath><rect width="9" height="9" clip-path="url(#c)"/>',
         "<rect>: is clipped; cut it first"),
        ('<g mask="url(#m)"><rect width="9" height="9"/></g>', "<g>: has a mask; expand it to outlines"),
        ('<rect width="9" height="9" filter="url(#f)"/>', "<rect>: has a filter"),
        ('<path d="M0 0h9" stroke="red" marker-end="url(#m)"/>', "<path>: has markers at its ends"),
        ('<foreignObject width="9" height="9"/>', "<foreignObject>: foreign content"),
        ('<use href="other.svg#leaf"/>', 'refers to "other.svg#leaf", another file'),
        ('<g id="a"><use href="#a"/></g>', 'refers to "#a", which it is part of'),
        ('<path d="M0 0 q1"/>', 'path command "q" has 1 number'),
        ('<path d="M0 0 1e999 0"/>', "not finite"),
        ('<path d="M0 0H1e8V9z"/>', "reaches further than 1 km"),
        ('<rect width="9" height="9" transform="rotate(x)"/>', "cannot be read"),
        ("", "nothing is drawn: no shape that was picked has a fill or a stroke"),
        ('<rect width="9" height="9" fill="none"/>', "nothing is drawn"),
        ('<g id="b9"><circle r="3"/></g>' + BOMB, "1,111,111,111 marks, once every use in it is followed"),
        ("".join(f'<g id="a{i}"><use href="#a{i + 1}"/></g>' for i in range(999)), "nested deeper than 200"),
        ("<g>" * 300 + "</g>" * 300, "nested deeper than 200 elements"),
    ],
)  # fmt: skip
def test_what_has_no_outline_of_one_colour_is_named_with_the_way_out(
    tmp_path: Path, inner: str, words: str
) -> None:
    found = complaint(tmp_path, svg(inner))
    assert found.startswith("3: motif.m.file: d.svg")
    assert words in found


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b"\x89PNG\r\n\x1a\n", "is a PNG picture"),
        (b"\x1f\x8b\x08", "compressed (.svgz)"),
        (b"<html></html>", "is XML, but no SVG"),
        (b"<svg><g></svg>", "is no well-formed XML"),
        (b"no drawing", "is no SVG"),
        (b'<!DOCTYPE svg [<!ENTITY a "b">]><svg xmlns="http://www.w3.org/2000/svg">&a;</svg>', "the entity"),
        (b'<svg xmlns="http://www.w3.org/2000/svg" width="wide"><rect width="9" height="9"/></svg>',
         'width = "wide", expected a length'),
        (b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 0 9"><rect width="9" height="9"/></svg>',
         "above zero"),
    ],
)  # fmt: skip
def test_what_is_no_drawing_says_why(tmp_path: Path, data: bytes, words: str) -> None:
    found = complaint(tmp_path, data)
    assert found.startswith("3: motif.m.file: d.svg")
    assert words in found


def test_what_is_not_picked_is_not_refused(tmp_path: Path) -> None:
    inner = '<g id="photo"><image href="x.png"/><text>a</text></g><rect id="leaf" width="9" height="9"/>'
    (tmp_path / "d.svg").write_text(svg(inner))
    path = tmp_path / "k.toml"
    path.write_text(f'{MOTIF}elements = "leaf"\n{REST}')
    assert "image" not in load_recipe(path).source


def test_a_file_past_the_limit_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batik_vector.recipe.reading.drawings.MAX_FILE", 1000)
    assert "1,190 bytes, expected at most 1,000" in complaint(tmp_path, svg(" " * 1080))


def test_too_many_elements_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(document, "MAX_ELEMENTS", 50)
    assert "more than 50 elements" in complaint(tmp_path, svg("<g/>" * 60))
    monkeypatch.setattr(document, "MAX_ELEMENTS", 10_000)
    monkeypatch.setattr(names, "MOST_MARKS", 50)
    found = complaint(tmp_path, svg('<circle r="3"/>' * 60), 'elements = "b3"\n')
    assert "d.svg: 60 marks, once every use in it is followed, expected at most 50 in a motif" in found


def test_names_of_stars_are_matched_in_time(tmp_path: Path) -> None:
    inner = "".join(f'<rect id="{"a" * 500}{i}" width="9" height="9"/>' for i in range(200))
    assert "has no element of that name" in complaint(tmp_path, svg(inner), f'elements = "{"*a" * 250}b"\n')


def test_a_mere_frame_clips_nothing_and_a_swatch_is_a_colour(tmp_path: Path) -> None:
    inner = (
        '<clipPath id="c"><rect width="90" height="90"/></clipPath>'
        '<clipPath id="d"><rect width="30" height="30"/></clipPath>'
        '<linearGradient id="g"><stop stop-color="#a0322b"/></linearGradient>'
        '<g clip-path="url(#c)">'
        '<rect x="5" y="5" width="9" height="9" fill="url(#g)" clip-path="url(#d)"/></g>'
    )
    (tmp_path / "d.svg").write_text(svg(inner))
    path = tmp_path / "k.toml"
    path.write_text(f"{MOTIF}colours = true\n{REST}")
    assert list(load_recipe(path).ink) == ["#a0322b"]
