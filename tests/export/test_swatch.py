"""Swatches and palettes, read back: the pattern's cell, the artwork beside it, names and colours of inks."""

from __future__ import annotations

import io
import re
import struct
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from PIL.GimpPaletteFile import GimpPaletteFile

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.export import PaletteOptions, SwatchOptions, render
from batik_vector.export.swatch import SHOWN
from batik_vector.making.jobs import planned, read_jobs
from batik_vector.making.running import run_quietly
from tests.export.readers import SVG

SAMPLES = Path(__file__).resolve().parents[2] / "samples"
KAWUNG = (("cloth", "#151a2e"), ("soga", "#8f5a2c"), ("cotton", "#f4efe2"))


def made(name: str, folder: Path, formats: str, *overrides: str) -> list[dict[str, Any]]:
    (job,) = planned(read_jobs([str(SAMPLES / f"{name}.toml")], overrides), folder, formats.split(","))
    files: list[dict[str, Any]] = run_quietly(job)["files"]
    return files


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("swatches")
    made("kawung", folder, "svg,swatch,gpl,ase")
    made("four-square", folder, "swatch", "tile.size=[80,60]", "tile.repeat='drop 1/3'")
    return folder


def tree(path: Path) -> ET.Element:
    return ET.parse(path).getroot()


def numbers(text: str | None) -> list[float]:
    return [float(each) for each in re.findall(r"-?[\d.]+(?:e-?\d+)?", text or "")]


def shown(root: ET.Element) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return where the pattern begins, and how broad and high its cell comes to lie, in mm."""
    pattern = root.find(f".//{SVG}pattern")
    assert pattern is not None
    a, b, c, d, e, f = numbers(pattern.get("patternTransform"))
    assert (b, c) == (0, 0)
    columns, rows = pattern.get("width", ""), pattern.get("height", "")
    assert columns.isdecimal()
    assert rows.isdecimal()
    return (e, f), (int(columns) * a, int(rows) * d)


def test_the_cell_of_the_pattern_is_the_tile(folder: Path) -> None:
    root = tree(folder / "kawung-swatch.svg")
    begin, size = shown(root)
    assert size == pytest.approx((100, 100))
    layers = root.findall(f"{SVG}g")
    assert [each.get("id") for each in layers] == ["bounds", "soga", "cotton", "swatch"]
    (filled,) = layers[-1]
    assert filled.get("fill") == "url(#Kawung)"
    assert [float(filled.get(name, "")) for name in ("x", "y")] == pytest.approx(begin)
    assert [float(filled.get(name, "")) for name in ("width", "height")] == [SHOWN * 100] * 2
    assert root.get("width", "") == f"{numbers(root.get('viewBox'))[2]:g}mm"


def test_a_drop_repeats_by_its_rectangle(folder: Path) -> None:
    assert shown(tree(folder / "four-square-swatch.svg"))[1] == pytest.approx((240, 60))


def test_what_illustrator_asks_of_a_swatch_lies_at_the_back(folder: Path) -> None:
    bounds = tree(folder / "kawung-swatch.svg").find(f"{SVG}g[@id='bounds']")
    assert bounds is not None
    first = bounds[0]
    assert (first.get("fill"), first.get("stroke")) == ("none", "none")
    assert [first.get(name) for name in ("width", "height")] == ["100", "100"]


def test_no_id_is_given_twice_and_all_are_plain() -> None:
    inks = ("swatch", "bounds", "bounds2", "A & <B>")
    square = shapely.box(1, 1, 2, 2)
    layers = tuple(Layer(Ink(name, "#000000"), areas=np.array([square], dtype=object)) for name in inks)
    artwork = Artwork("swatch", Cell(9000, 9000), layers)
    root = ET.fromstring(render(artwork, "swatch"))
    ids = [each.get("id") for each in root.iter() if each.get("id")]
    assert len(ids) == len(set(ids))
    assert all(re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", each or "") for each in ids)
    odd = replace(artwork, title='A "b" & <c>')
    pattern = ET.fromstring(render(odd, "swatch")).find(f".//{SVG}pattern")
    assert pattern is not None
    assert pattern.get("{http://www.inkscape.org/namespaces/inkscape}label") == odd.title


def test_a_swatch_without_cloth_fills_nothing() -> None:
    empty = Artwork("none", Cell(9000, 9000), ())
    root = ET.fromstring(render(empty, "swatch", SwatchOptions(cloth=False)))
    pattern = root.find(f".//{SVG}pattern/{SVG}g")
    assert pattern is not None
    assert len(pattern) == 0


def test_a_swatch_is_a_recipe_too(folder: Path, tmp_path: Path) -> None:
    (job,) = planned(read_jobs([str(folder / "kawung-swatch.svg")]), tmp_path, ["svg", "swatch"])
    run_quietly(job)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["kawung-swatch.svg", "kawung.svg"]
    for name in ("kawung.svg", "kawung-swatch.svg"):
        assert (tmp_path / name).read_bytes() == (folder / name).read_bytes()


def hexed(parts: Iterator[float] | tuple[float, ...]) -> str:
    return "#" + "".join(f"{round(part * 255):02x}" for part in parts)


def read_ase(data: bytes) -> tuple[str, list[tuple[str, str]]]:
    """Return the name of the one group of an ASE file, and its colours."""
    sign, major, minor, count = struct.unpack_from(">4sHHI", data)
    assert (sign, major, minor) == (b"ASEF", 1, 0)
    at, found, group = 12, [], ""
    for number in range(count):
        kind, size = struct.unpack_from(">HI", data, at)
        body = data[at + 6 : at + 6 + size]
        at += 6 + size
        if kind == 0xC002:
            assert (number, size) == (count - 1, 0)
            continue
        (units,) = struct.unpack_from(">H", body)
        name = body[2 : 2 + 2 * units].decode("utf-16-be")
        assert name.endswith("\0")
        rest = body[2 + 2 * units :]
        if kind == 0xC001:
            group = name[:-1]
            assert rest == b""
        else:
            model, red, green, blue, _ = struct.unpack(">4s3fH", rest)
            assert (kind, model) == (1, b"RGB ")
            found.append((name[:-1], hexed((red, green, blue))))
    assert at == len(data)
    return group, found


def test_palettes_hold_cloth_and_inks(folder: Path) -> None:
    assert read_ase((folder / "kawung.ase").read_bytes()) == ("Kawung", list(KAWUNG))
    data = (folder / "kawung.gpl").read_bytes()
    palette, mode = GimpPaletteFile(io.BytesIO(data)).getpalette()
    assert mode == "RGB"
    # Pillow before 11.2 counts the lines of the head as entries.
    found = [hexed(tuple(part / 255 for part in palette[k : k + 3])) for k in range(0, len(palette), 3)]
    begin = found.index(KAWUNG[0][1])
    assert found[begin : begin + len(KAWUNG)] == [colour for _, colour in KAWUNG]
    rows = data.decode("utf-8").splitlines()
    assert rows[:2] == ["GIMP Palette", "Name: Kawung"]
    assert [row.partition("\t")[2] for row in rows[4:]] == [name for name, _ in KAWUNG]


def test_odd_names_stay_on_their_line() -> None:
    ink = Ink("Ä\tb\n𝄞" + "x" * 300, "#102030")
    artwork = Artwork("t\nt", Cell(9000, 9000), (Layer(ink),))
    options = PaletteOptions(cloth=False)
    group, ((name, colour),) = read_ase(render(artwork, "ase", options))
    assert (group, name[:5], colour) == ("t t", "Ä b 𝄞", "#102030")
    *_, row = render(artwork, "gpl", options).decode("utf-8").splitlines()
    assert row == f" 16  32  48\t{name}"


def test_a_cloth_is_no_swatch(tmp_path: Path) -> None:
    (file,) = made("kawung", tmp_path, "swatch", "yardage={width='500 mm',length='1 m'}")
    assert Path(file["path"]).name == "kawung-tile-swatch.svg"
    assert file["size_mm"] == [100, 100]
