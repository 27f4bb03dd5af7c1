from __future__ import annotations

import zlib
from dataclasses import replace
from pathlib import Path

import pikepdf
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Provenance
from batik_vector.errors import RecipeError
from batik_vector.export import FORMATS, DxfOptions, HpglOptions, provenance, render, write_artwork
from batik_vector.export.provenance import MAX_RECIPE, _read, read_provenance

from .drawings import NASTY, empty, sample

PALETTES = {"gpl", "ase"}
"""Formats that hold colours alone."""
TEXTS = {
    "plain": 'title = "Kawung"\n',
    "empty": "",
    "nasty": NASTY,
    "no newline": "a=1",
    "carriage returns": "\r\r\n\n\r",
    "blank": "   \n\t ",
    "control": "\x00\x01\x1b\x7f\x85\u2028\ufffe\uffff",
    "surrogate": "a\ud800b",
    "tags": "</batik:recipe><batik:seed>1</batik:seed>&amp;&#13;<![CDATA[x]]>",
    "xpacket": '<?xpacket end="w"?> endstream endobj %%EOF',
}


@pytest.mark.parametrize("format", sorted(FORMATS.keys() - PALETTES))
@pytest.mark.parametrize("name", TEXTS)
def test_recipes_come_back_to_the_character(tmp_path: Path, format: str, name: str) -> None:
    told = Provenance(TEXTS[name], -(2**70), "1.0 <ä>")
    options = HpglOptions(comment=True) if format == "hpgl" else None
    suffix = FORMATS[format].suffix
    path = write_artwork(sample(provenance=told), tmp_path / f"a{suffix}", format, options)
    assert read_provenance(path) == told


def test_hpgl_carries_a_recipe_only_where_that_is_asked_for(tmp_path: Path) -> None:
    path = write_artwork(sample(), tmp_path / "a.hpgl")
    with pytest.raises(RecipeError, match=r"a\.hpgl: carries no recipe: HPGL does where comment = true"):
        read_provenance(path)


@pytest.mark.parametrize("name", [name for name in TEXTS if name != "nasty"])
def test_r12_carries_what_fits(tmp_path: Path, name: str) -> None:
    told = Provenance(TEXTS[name], 3, "1")
    path = write_artwork(sample(provenance=told), tmp_path / "a.dxf", options=DxfOptions("R12"))  # type: ignore[arg-type]
    assert read_provenance(path) == told


def test_r12_without_its_recipe_says_so(tmp_path: Path) -> None:
    told = Provenance(NASTY, 3, "1")
    path = write_artwork(sample(provenance=told), tmp_path / "a.dxf", options=DxfOptions("R12"))  # type: ignore[arg-type]
    with pytest.raises(RecipeError, match=r"a\.dxf: carries no recipe"):
        read_provenance(path)


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.text(st.characters(codec=None)), st.integers(), st.text(st.characters(codec=None), max_size=9))
def test_any_text_comes_back(recipe: str, seed: int, version: str) -> None:
    told = Provenance(recipe, seed, version)
    for format in ("svg", "pdf", "dxf"):
        assert _read(render(empty_with(told), format)) == told


def empty_with(told: Provenance) -> Artwork:
    return replace(empty(), provenance=told)


def test_the_recipe_in_an_svg_can_be_read_by_people() -> None:
    data = render(sample(provenance=Provenance('title = "Kawung"\n', 7, "1")), "svg")
    assert b'title = "Kawung"\n</batik:recipe>' in data
    assert b">7</batik:seed>" in data


def fault(tmp_path: Path, data: bytes) -> str:
    path = tmp_path / "given"
    path.write_bytes(data)
    with pytest.raises(RecipeError) as caught:
        read_provenance(path)
    assert str(path) in str(caught.value)
    return str(caught.value)


BOMB = b"""<?xml version="1.0"?><!DOCTYPE s [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;">]>
<svg xmlns:b="urn:x-batik-vector:provenance"><b:recipe>&b;</b:recipe></svg>"""


def test_entities_are_refused(tmp_path: Path) -> None:
    assert "DOCTYPE" in fault(tmp_path, BOMB)
    assert "DOCTYPE" in fault(tmp_path, b'<!DOCTYPE svg SYSTEM "file:///etc/passwd"><svg/>')


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"hello",
        b"<svg/>",
        b"<svg",
        b"%PDF-1.4",
        b"\x89PNG\r\n\x1a\n",
        b"\x89PNG\r\n\x1a\n" + b"\xff" * 40,
    ],
)
def test_other_files_are_told_from_ours(tmp_path: Path, data: bytes) -> None:
    fault(tmp_path, data)


@pytest.mark.parametrize("format", ["svg", "pdf", "dxf", "gcode", "png"])
def test_damage_is_reported(tmp_path: Path, format: str) -> None:
    data = render(sample(), format)
    for cut in (len(data) // 50, len(data) // 3):
        path = tmp_path / "cut"
        path.write_bytes(data[:cut])
        try:
            assert read_provenance(path) == sample().provenance
        except RecipeError as error:
            assert "cut" in str(error)  # noqa: PT017


def test_too_long_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    data = render(sample(provenance=Provenance("x" * 1000, 1, "")), "svg")
    monkeypatch.setattr(provenance, "MAX_RECIPE", 999)
    assert "too long" in fault(tmp_path, data)
    monkeypatch.setattr(provenance, "MAX_FILE", 10)
    assert "bytes" in fault(tmp_path, data)


def test_a_seed_that_is_no_number(tmp_path: Path) -> None:
    data = render(sample(), "svg").replace(b">7<", b">seven<")
    assert "seed" in fault(tmp_path, data)


def test_packed_metadata_is_read_but_does_not_explode(tmp_path: Path) -> None:
    path = tmp_path / "a.pdf"
    with pikepdf.new() as document:
        document.add_blank_page()
        document.Root.Metadata = pikepdf.Stream(document, b"")
        packed = zlib.compress(b" " * (2 * MAX_RECIPE + 10))
        document.Root.Metadata.write(packed, filter=pikepdf.Name.FlateDecode)
        document.save(path, fix_metadata_version=False, compress_streams=True)
    with pytest.raises(RecipeError, match="too long"):
        read_provenance(path)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(RecipeError, match=r"none\.svg: No such file"):
        read_provenance(tmp_path / "none.svg")
