"""What is no tile, or draws what is no geometry, is refused in words; what is guessed is told."""

from __future__ import annotations

import contextlib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import GeometryError
from batik_vector.importing import document, walk
from batik_vector.importing.svg import DrawingError, read_svg, read_tile
from tests.importing.drawings import DISC, MIXED, svg


@pytest.mark.parametrize(
    ("inner", "words"),
    [
        ('<image width="10" height="10"/>', "<image>: a picture has no outlines"),
        ('<text x="5">leaf</text>', "<text>: text hangs on a font; convert it to outlines first"),
        ('<foreignObject/>', "foreign content"),
        ('<g id="a" clip-path="circle(9px)"><path d="M0 0h9v9z"/></g>',
         '<g id="a">: is clipped; expand it to outlines first'),
        ('<g clip-path="url(#c)"><path d="M0 0h9v9z"/></g><clipPath id="c"><text>leaf</text></clipPath>',
         "<text>: text hangs on a font"),
        ('<g clip-path="url(#c)"><path d="M0 0h9v9z"/></g><clipPath id="c"><path d="M0 0q"/></clipPath>',
         'path command "q" has 0 numbers'),
        ('<clipPath id="c" clip-path="url(#c)"><circle r="9"/></clipPath><circle r="9" clip-path="url(#c)"/>',
         'is clipped by "#c", which it is part of'),
        ('<path d="M0 0h9v9z" style="mask:url(#m)"/>', "has a mask"),
        ('<path d="M0 0h9v9z" filter="url(#m)"/>', "has a filter"),
        ('<pattern id="p" width="1" height="1" patternUnits="userSpaceOnUse"><rect width=".01" height=".01"/>'
         '</pattern><path d="M0 0h999v999z" fill="url(#p)"/>', "is filled with a pattern of 1,000,000 cells"),
        ('<pattern id="p" width="9" height="9" patternUnits="userSpaceOnUse"><rect width="5" height="5" '
         'fill="url(#p)"/></pattern><path d="M0 0h9v9z" fill="url(#p)"/>', "a pattern that it is part of"),
        ('<pattern id="p" width="1em" height="1"><rect width="9" height="9"/></pattern>'
         '<path d="M0 0h9v9z" fill="url(#p)"/>', 'width = "1em", expected a length'),
        ('<pattern id="p" width="1" height="1"><rect width="9" height="9"/></pattern>'
         '<path d="M0 0h9v9z" stroke="url(#p)"/>', "is stroked with a pattern; expand"),
        ('<path d="M0 0h9v9z" stroke="red" marker-end="url(#m)"/>', "has markers"),
        ('<use href="other.svg#leaf"/>', 'refers to "other.svg#leaf", another file'),
        ('<use href="#nowhere"/>', 'refers to "#nowhere", nothing in the file'),
        ('<g id="a"><use href="#a"/></g>', 'refers to "#a", which it is part of'),
        ('<path d="M0 0h9v9z" transform="rotate(x)"/>', 'transform "rotate(x)" cannot be read'),
        ('<path d="M0 0h9v9z" transform="rotate()"/>', 'transform rotate() with 0 numbers'),
        ('<path d="M0 0h9v9z" style="transform:translate(50%)"/>',
         'transform "translate(50%)" cannot be read'),
        ('<path d="M0 0h9v9z" style="transform:scale(2mm)"/>', 'transform "scale(2mm)" cannot be read'),
        ('<path d="M0 0h9" transform="scale(2)" transform-origin="bottom 25%"/>', 'transform-origin "bottom'),
        ('<path d="M0 0h9v9z" transform="scale(2)" transform-origin="calc(1px)"/>', 'transform-origin "calc'),
        ('<path d="M0 0h9v9z" transform="scale(2)" style="transform-origin:center;transform-box:fill-box"/>',
         "transform-box: fill-box is not read"),
        ('<rect width="9" height="9" style="x:5px"/>', "takes its x from a style; write it as an attribute"),
        ('<circle r="9" style="r:20px"/>', "takes its r from a style"),
        ("<path d='M0 0h9v9z' style='d:path(\"M0 0h5v5z\")'/>", "takes its d from a style"),
        ('<g style="rotate:45deg"><circle r="9"/></g>', "is moved by the style rotate"),
        ('<path d="M0 0h9q1"/>', 'path command "q" has 1 number, expected 4'),
        ('<path d="L0 0h9"/>', 'path data begin with "L"'),
        ('<path d="M0 0 1e999 0"/>', "not finite"),
        ('<path d="M0 0H1e8V9z"/>', "reaches further than 1 km from the page"),
        ('<path d="M0 0H1V9z" transform="scale(1e300) scale(1e300)"/>', "is not finite"),
        ('<rect width="3em" height="5"/>', 'width = "3em", expected a length'),
    ],
)  # fmt: skip
def test_what_is_no_geometry_is_refused_with_its_line(inner: str, words: str) -> None:
    with pytest.raises(DrawingError) as found:
        read_tile(svg("<g>\n" + inner + "</g>"))
    (fault,) = found.value.faults
    assert words in fault.message
    assert fault.line == 3


def test_all_that_is_refused_is_told_at_once() -> None:
    with pytest.raises(DrawingError) as found:
        read_tile(svg("<text>a</text>\n<image/>\n<text>b</text>" + DISC))
    assert [fault.line for fault in found.value.faults] == [2, 3]


@pytest.mark.parametrize(
    ("inner", "note"),
    [
        ('<linearGradient id="g"><stop stop-color="red"/></linearGradient><circle r="9" fill="url(#g)"/>',
         "a gradient is taken as one ink"),
        ('<circle r="9" opacity=".5"/>', "half transparent"),
        ('<circle r="9" fill="none" stroke="red" stroke-dasharray="2 1"/>', "dashed lines are taken"),
        ('<circle r="9" fill="octarine"/>', '"octarine" is not understood'),
        ('<circle r="9"/><circle r="9" cx="200"/>', "1 marks lie wholly outside the page"),
        ('<style>a:nope(1 { fill: red }</style><circle r="9"/>', "style"),
    ],
)  # fmt: skip
def test_what_is_taken_for_something_else_is_told(inner: str, note: str) -> None:
    assert any(note in each for each in read_svg(svg(inner)).notes)


FRAME = '<clipPath id="c"><rect width="100" height="100"/></clipPath><g clip-path="url(#c)">' + DISC + "</g>"


def test_a_clip_that_is_a_mere_frame_round_the_page_is_none() -> None:
    assert len(read_tile(svg(FRAME)).layers) == 1


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "is empty"),
        (b"  \n", "is empty"),
        (b"\x89PNG\r\n\x1a\nxxxx", "is a PNG picture"),
        (b"%PDF-1.7", "is a PDF"),
        (b"\x1f\x8b\x08", "compressed"),
        (b"hello", "is no SVG"),
        (b"<svg><g></svg>", "is no well-formed XML: mismatched tag"),
        (b"<html></html>", "is XML, but no SVG: its root is <html>"),
        (svg(DISC, ""), "has no page size"),
        (svg(DISC, 'width="100%" height="100%"'), "its page has no size of its own"),
        (svg(DISC, 'width="wide" height="9"'), 'width = "wide", expected a length such as "280mm"'),
        (svg(DISC, 'width="0" height="9"'), "its width is 0 mm"),
        (svg(DISC, 'width="9" height="9" viewBox="0 0 0 9"'), "above zero"),
        (svg(DISC, 'width="9" height="9" viewBox="0 0 9"'), "expected four numbers"),
        (svg(DISC, 'width="99m" height="9"'), 'width = "99m"'),
        (svg(DISC, 'width="1e9mm" height="9"'), "expected 0.1 to 20,000 mm"),
        (svg(""), "nothing is drawn"),
        (svg('<path d=""/><circle r="0"/><rect fill="none" width="9" height="9"/>'), "nothing is drawn"),
        (svg('<path d="M1 1h5" fill="red"/>'), "nothing is drawn"),
        (svg('<path d="M1 1h5v5" fill="rgba(9, 9, 9, 0)"/>'), "nothing is drawn"),
        (svg('<rect width="100" height="100"/>'), "nothing is drawn on its ground"),
        (svg('<circle cx="-40" r="30"/>'), "all that it draws lies outside its page"),
    ],
)
def test_what_is_no_tile_says_why_in_one_line(data: bytes, words: str) -> None:
    with pytest.raises(DrawingError) as found:
        read_tile(data)
    assert words in str(found.value)
    assert "\n" not in str(found.value)


def test_a_wrong_repeat_says_what_was_expected() -> None:
    with pytest.raises(GeometryError, match="half-drop"):
        read_tile(svg(DISC), "half drop")


BOMB = (
    "".join(f'<g id="b{i}">' + f'<use href="#b{i + 1}"/>' * 10 + "</g>" for i in range(9))
    + '<g id="b9"><circle r="3"/></g>'
)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b'<!DOCTYPE svg [<!ENTITY a "b">]>' + svg(DISC), 'the entity "a"'),
        (b'<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]><svg>&a;</svg>', 'the entity "a"'),
        (b'<!DOCTYPE svg [<!ENTITY % a SYSTEM "x.dtd"> %a;]><svg/>', 'the entity "a"'),
        (b'<!DOCTYPE svg SYSTEM "x.dtd"><svg>&a;</svg>', 'the entity "a"'),
        (svg("<g>" * 300 + "</g>" * 300), "nested deeper than"),
        (svg(f"<defs>{BOMB}</defs><use href='#b0'/>"), "once every use in it is followed"),
    ],
)
def test_hostile_files_are_refused(data: bytes, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(walk, "MAX_SHAPES", 2000)
    with pytest.raises(DrawingError, match=words):
        read_tile(data)


def test_a_doctype_alone_is_no_fault() -> None:
    head = (
        b'<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    )
    assert len(read_tile(head + svg(DISC)).layers) == 1


def test_large_files_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(document, "MAX_FILE", 100)
    (tmp_path / "a.svg").write_bytes(svg(DISC))
    for source in (tmp_path / "a.svg", svg(DISC)):
        with pytest.raises(DrawingError, match="bytes, expected at most 100"):
            read_tile(source)


@settings(derandomize=True, max_examples=150, deadline=None)
@given(
    st.integers(0, 10**6),
    st.sampled_from([b"", b"<", b'"', b"0", b"-", b"url(#", b"/>", b"&a;", b"\xff", b"e9"]),
)
def test_no_broken_file_is_more_than_refused(at: int, change: bytes) -> None:
    data = svg(MIXED)
    at %= len(data)
    with contextlib.suppress(DrawingError):
        assert read_tile(data[:at] + change + data[at + 1 :]).layers
