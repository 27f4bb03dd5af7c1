"""A swatch shows nothing at the seams of its pattern, whichever program draws it, at any zoom."""

from __future__ import annotations

import functools
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

from batik_vector.export import SwatchOptions
from batik_vector.export.swatch import SHOWN, overscan, render, repeats, sheet
from batik_vector.tiling.cloth.field import field_page, repeated
from tests.clients import programs, seams
from tests.clients.pictures import Mask, load
from tests.clients.renderers import IN_PYTHON, PROGRAMS, Page, Renderer

ZOOMS = (1.0, 1.37, 1.73, 2.19, 3.0)
UNSEEN = 1
"""Levels of 255: what a renderer may round."""
FEW = 100
"""Pixels that must be looked at, or else nothing is shown."""


def librsvg(pages: Sequence[Page], folder: Path) -> list[Image.Image]:
    """Return what librsvg draws."""
    pictures = []
    for number, page in enumerate(pages):
        source, out = folder / f"{number}.svg", folder / f"{number}.png"
        source.write_bytes(page.svg)
        zoom = f"--zoom={page.dpi / 96:g}"
        programs.run("rsvg-convert", "--dpi-x=96", "--dpi-y=96", zoom, f"--output={out}", source, home=folder)
        pictures.append(load(out))
    return pictures


RENDERERS = [
    *(pytest.param(draw, id=name) for name, draw in IN_PYTHON.items()),
    *(
        pytest.param(draw, id=name, marks=pytest.mark.clients)
        for name, draw in {**PROGRAMS, "librsvg": librsvg}.items()
    ),
]


@functools.cache
def swatch(name: str, over: float | None = None) -> tuple[bytes, float, float, float]:
    """Return a swatch without ground, the size of its page, and how far it goes on beyond its cell (mm)."""
    tile = seams.tile(name)
    over = overscan(tile.cell) if over is None else over
    page = field_page(tile, *repeats(tile.cell), over)
    return render(page, SwatchOptions(cloth=False)), *sheet(page), over


@functools.cache
def inside(name: str, over: float, width: float, height: float, dpi: float) -> Mask:
    """Return which pixels lie near a seam of the filled rectangle, well inside a mark."""
    tile, step = seams.tile(name), 25.4 / dpi
    cell = tile.cell.rectangle
    columns, rows = int(width // step), int(height // step)
    left = width - over - SHOWN * cell.width
    x = np.broadcast_to((np.arange(columns) + 0.5) * step - left, (rows, columns))
    y = height - over - np.broadcast_to(((np.arange(rows) + 0.5) * step)[:, None], (rows, columns))
    inner = (x > 1) & (x < SHOWN * cell.width - 1) & (y > 1) & (y < SHOWN * cell.height - 1)
    found = inner & (seams.to_seam(x, y, cell) <= seams.NEAR * step)
    across, up = repeats(tile.cell)
    (layer,) = repeated(tile, SHOWN * across, SHOWN * up).layers
    core = shapely.buffer(shapely.union_all(layer.areas), -seams.NEAR * step)
    shapely.prepare(core)
    found[found] = shapely.contains_xy(core, x[found], y[found])
    return found


def bled(draw: Renderer, names: Sequence[str], folder: Path, over: float | None = None) -> dict[str, int]:
    """Return how much ground shows at the seams of swatches, by name and zoom."""
    asked, masks = {}, {}
    for name in names:
        svg, width, height, beyond = swatch(name, over)
        # Pages may be shown in one document, where an id names one element.
        (known,) = re.findall(rb'<pattern id="(\w+)"', svg)
        for sign in (b'"', b")"):
            svg = svg.replace(known + sign, name.encode() + sign)
        for zoom in ZOOMS:
            key = f"{name} {zoom:.0%}"
            asked[key] = Page(svg, width, height, 96 * zoom)
            masks[key] = inside(name, beyond, width, height, 96 * zoom)
            assert masks[key].sum() > FEW, key
    pictures = draw(list(asked.values()), folder)
    return {key: seams.bleeding(picture, masks[key]) for key, picture in zip(asked, pictures, strict=True)}


@pytest.mark.parametrize("draw", RENDERERS)
def test_nothing_shows_at_the_seams_of_a_swatch(draw: Renderer, tmp_path: Path) -> None:
    found = bled(draw, list(seams.RECIPES), tmp_path)
    assert {key: levels for key, levels in found.items() if levels > UNSEEN} == {}


def test_ground_shows_where_nothing_is_drawn_beyond_the_cell(tmp_path: Path) -> None:
    found = bled(IN_PYTHON["resvg"], ["black"], tmp_path, over=0)
    assert max(found.values()) > 25
