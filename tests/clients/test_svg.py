"""SVG in Inkscape and in a browser, and the preview beside them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork
from batik_vector.export import PngOptions, SvgOptions, render
from tests.clients import programs
from tests.clients.drawings import per_mm
from tests.clients.pictures import differing, load, reference, shade_apart

CSS = 96 / 25.4
"""CSS pixels in a millimetre."""
ALIKE = 1e-3
SAME_SHADE = 4.0

VARIANTS = {
    "editable": SvgOptions(),
    "compact": SvgOptions(profile="compact"),  # type: ignore[arg-type]
    "bezier": SvgOptions(curves="bezier"),  # type: ignore[arg-type]
    "bare": SvgOptions(cloth=False),
}


def written(artwork: Artwork, folder: Path, options: SvgOptions = VARIANTS["editable"]) -> Path:
    path = folder / "drawing.svg"
    path.write_bytes(render(artwork, "svg", options))
    return path


@pytest.mark.clients
def test_inkscape_finds_page_and_layers_where_they_were_drawn(drawing: Artwork, tmp_path: Path) -> None:
    boxes, picture = programs.inkscape_boxes_and_page(written(drawing, tmp_path), 1.0)
    width, height = drawing.cell.width, drawing.cell.height
    assert boxes["cloth"] == pytest.approx((0, 0, width, height), abs=0.01)
    assert load(picture).size == pytest.approx((width, height), abs=1)
    for layer in drawing.layers:
        body = shapely.buffer(layer.lines, layer.ink.width / 2) if len(layer.lines) else layer.lines
        left, low, right, high = shapely.total_bounds(np.concatenate([layer.areas, body]))
        expected = (left, drawing.cell.height - high, right - left, high - low)
        found = [box for name, box in boxes.items() if np.allclose(box, expected, atol=0.05)]
        assert found, f"{layer.ink.name} at {expected}: {boxes}"


@pytest.mark.clients
@pytest.mark.parametrize("variant", VARIANTS)
def test_inkscape_and_cairosvg_draw_the_same(lopsided: Artwork, tmp_path: Path, variant: str) -> None:
    scale = per_mm(lopsided)
    svg = written(lopsided, tmp_path, VARIANTS[variant])
    picture = load(programs.inkscape(svg, scale))
    known = reference(svg.read_bytes(), scale)
    assert differing(picture, known) < ALIKE
    assert shade_apart(picture, known) < SAME_SHADE


@pytest.mark.clients
def test_a_browser_and_cairosvg_draw_the_same(drawing: Artwork, tmp_path: Path) -> None:
    agree_in_a_browser(drawing, tmp_path, VARIANTS["editable"])


@pytest.mark.clients
@pytest.mark.parametrize("variant", [name for name in VARIANTS if name != "editable"])
def test_variants_look_alike_in_a_browser(lopsided: Artwork, tmp_path: Path, variant: str) -> None:
    agree_in_a_browser(lopsided, tmp_path, VARIANTS[variant])


def agree_in_a_browser(drawing: Artwork, folder: Path, options: SvgOptions) -> None:
    svg = written(drawing, folder, options)
    width, height = (math.ceil(side * CSS) for side in (drawing.cell.width, drawing.cell.height))
    picture = load(programs.chromium(svg, width, height))
    known = reference(render(drawing, "svg", SvgOptions(cloth=options.cloth)), CSS)
    assert differing(picture, known) < ALIKE
    assert shade_apart(picture, known) < SAME_SHADE


@pytest.mark.clients
def test_the_preview_is_the_svg(drawing: Artwork) -> None:
    scale = per_mm(drawing) / 2
    picture = load(render(drawing, "png", PngOptions(dpi=scale * 25.4)))
    assert differing(picture, reference(render(drawing, "svg"), scale)) < ALIKE
