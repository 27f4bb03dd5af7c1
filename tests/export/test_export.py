from __future__ import annotations

import io
import os
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from typing import Any

import pytest
import shapely

from batik_vector.artwork import Artwork
from batik_vector.errors import ExportError, GeometryError, UnknownNameError
from batik_vector.export import (
    FORMATS,
    Curves,
    DxfOptions,
    DxfVersion,
    GcodeOptions,
    HpglOptions,
    PdfInks,
    PdfOptions,
    PngOptions,
    SvgOptions,
    format_of,
    render,
    write_artwork,
    write_page,
)
from batik_vector.fields import HIDDEN, Says
from tests.broken_artworks import BROKEN, raw

from .drawings import empty, sample

SETTINGS: list[tuple[str, Any]] = [
    ("svg", SvgOptions()),
    ("svg", SvgOptions(curves=Curves.BEZIER)),
    ("pdf", PdfOptions(inks=PdfInks.SPOT)),
    ("dxf", DxfOptions()),
    ("dxf", DxfOptions(DxfVersion.R12)),
    ("gcode", GcodeOptions(arcs=True)),
    ("hpgl", HpglOptions()),
    ("png", PngOptions()),
]


@pytest.mark.parametrize(("format", "options"), SETTINGS)
def test_the_same_artwork_is_the_same_bytes(format: str, options: object) -> None:
    assert render(sample(2.0), format, options) == render(sample(2.0), format, options)


def test_bytes_depend_on_no_hash_seed_zone_locale_or_folder(tmp_path: Path) -> None:
    code = (
        "import hashlib, sys; from batik_vector.export import *; from tests.export.drawings import sample\n"
        "for f in FORMATS: print(f, hashlib.sha256(render(sample(2.0), f)).hexdigest())"
    )
    root = str(Path(__file__).parents[2])
    seen = set()
    for seed, zone, folder in (("1", "Asia/Shanghai", root), ("2", "America/Lima", str(tmp_path))):
        env = {**os.environ, "PYTHONHASHSEED": seed, "TZ": zone, "LC_ALL": "C", "PYTHONPATH": root}
        seen.add(
            subprocess.run(
                [sys.executable, "-c", code], env=env, cwd=folder, capture_output=True, check=True
            ).stdout
        )
    assert len(seen) == 1
    assert seen.pop().count(b"\n") == len(FORMATS)


@pytest.mark.parametrize("format", sorted(FORMATS.keys() - {"swatch"}))
def test_files_are_written_by_suffix(tmp_path: Path, format: str) -> None:
    path = write_artwork(empty(), tmp_path / f"A{FORMATS[format].suffix.upper()}")
    assert path.read_bytes() == render(empty(), format)
    assert os.listdir(tmp_path) == [path.name]


def test_a_format_may_be_named(tmp_path: Path) -> None:
    path = write_artwork(empty(), tmp_path / "drawing", "dxf")
    assert path.read_bytes() == render(empty(), "dxf")


def test_unknown_formats_name_the_nearest() -> None:
    with pytest.raises(UnknownNameError, match='unknown format "svgz": did you mean "svg"'):
        format_of("a.svgz")
    with pytest.raises(UnknownNameError, match='"dxff": did you mean "dxf"'):
        render(empty(), "dxff")
    with pytest.raises(UnknownNameError, match="expected one of"):
        format_of("drawing")


def test_options_of_another_format_are_refused() -> None:
    with pytest.raises(ExportError, match="PngOptions are no options of svg"):
        render(empty(), "svg", PngOptions())


def test_options_are_checked() -> None:
    with pytest.raises(GeometryError, match="dpi = 0"):
        PngOptions(dpi=0)
    with pytest.raises(GeometryError, match="curve_tolerance"):
        SvgOptions(curve_tolerance=-1.0)
    with pytest.raises(GeometryError, match='unknown curves "beziers": did you mean "bezier"'):
        SvgOptions(curves="beziers")  # type: ignore[arg-type]
    assert SvgOptions(curves="bezier").curves is Curves.BEZIER  # type: ignore[arg-type]


def test_every_option_says_what_it_does() -> None:
    for format in FORMATS.values():
        assert format.says
        for field in fields(format.options):
            hidden = HIDDEN in field.metadata
            assert hidden or "Says(" in str(field.type), f"{format.options.__name__}.{field.name}"
    assert Says("x").text == "x"


def test_a_colour_that_is_none() -> None:
    from dataclasses import replace

    # Tools and plates have no colours.
    for format in FORMATS.keys() - {"gcode", "hpgl", "tiff"}:
        with pytest.raises(ExportError, match="no colour"):
            render(replace(sample(), layers=(replace(sample().layers[0], ink=bad_ink()),)), format)


def bad_ink() -> Any:
    from batik_vector.artwork import Ink

    return Ink("w", 'red" onload="alert(1)')


def test_importing_the_package_is_light() -> None:
    heavy = ["numpy", "shapely", "svgwrite", "cairosvg", "ezdxf", "pikepdf", "pydantic"]
    code = f"import sys, batik_vector.export; print([m for m in {heavy} if m in sys.modules])"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert out.strip() == "[]"


@pytest.mark.parametrize(
    ("format", "unneeded"),
    [
        ("svg", "cairosvg ezdxf pikepdf"),
        ("pdf", "svgwrite cairosvg ezdxf pikepdf"),
        ("dxf", "svgwrite cairosvg ezdxf pikepdf"),
        ("gcode", "svgwrite cairosvg ezdxf pikepdf"),
    ],
)
def test_a_format_imports_only_what_it_needs(format: str, unneeded: str) -> None:
    code = (
        "import sys; from batik_vector.artwork import *; from batik_vector.export import render\n"
        f"render(Artwork('', Cell(1, 1), ()), {format!r})\n"
        f"print([m for m in {unneeded.split()} if m in sys.modules])"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert out.strip() == "[]"


@pytest.mark.parametrize(("broken", "words"), BROKEN)
def test_an_artwork_that_breaks_the_normal_form_is_refused(
    broken: Artwork, words: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.svg"
    sink = io.BytesIO()
    for write in (
        lambda: write_artwork(broken, path),
        lambda: write_page(broken, sink, "dxf"),
        lambda: render(broken, "pdf"),
    ):
        with pytest.raises(ExportError, match=f'^"test" breaks the normal form: .*{words}.*check=False'):
            write()
    assert list(tmp_path.iterdir()) == []
    assert sink.getvalue() == b""


def test_an_artwork_is_written_as_it_is_where_that_is_asked_for(tmp_path: Path) -> None:
    bow_tie = raw(shapely.Polygon([(1, 1), (4, 4), (4, 1), (1, 4)]))
    for format in FORMATS:
        path = write_artwork(bow_tie, tmp_path / f"a.{format}", format, check=False)
        sink = io.BytesIO()
        write_page(bow_tie, sink, format, check=False)
        assert path.read_bytes() == sink.getvalue() == render(bow_tie, format, check=False)
