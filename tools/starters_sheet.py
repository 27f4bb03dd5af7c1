"""The contact sheet of the starters, all that ``batik-vector new`` begins with, for the README.

``make golden`` draws it beside the samples' pictures.
"""

from __future__ import annotations

import io
import math
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from batik_vector import Artwork, compile_cloth, compile_recipe, load_recipe
from batik_vector.command.starters import STARTERS
from batik_vector.export import PngOptions, render
from batik_vector.tiling.cloth.field import repeated
from batik_vector.tiling.cloth.yardage import Yardage

SHEET = Path(__file__).resolve().parents[1] / "docs" / "starters.png"
COLUMNS = 4
FRAME = (212, 158)
"""Pixels of a picture."""
LABEL = 22
GUTTER = 4
FINER = 2
"""Drawn so much larger first: cairo's edges are coarse."""
SHOWN = 230.0
"""Millimetres of cloth across a picture, or two repeats where those are more."""
COLOURS = 36


def sheet() -> bytes:
    """Return the sheet as a PNG file: every starter with its name, at one scale but for large repeats."""
    starters = sorted(STARTERS.glob("*.toml"))
    rows = math.ceil(len(starters) / COLUMNS)
    across, up = FRAME[0] + GUTTER, FRAME[1] + LABEL + GUTTER
    page = Image.new("RGB", (COLUMNS * across - GUTTER, rows * up - GUTTER), "#ffffff")
    pen = ImageDraw.Draw(page)
    font = ImageFont.load_default(size=14)
    for number, path in enumerate(starters):
        x, y = number % COLUMNS * across, number // COLUMNS * up
        page.paste(_picture(path), (x, y))
        pen.text((x + 1, y + FRAME[1] + 2), path.stem, fill="#1a1a1a", font=font)
    out = io.BytesIO()
    few = page.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    few.save(out, "PNG", optimize=True)
    return out.getvalue()


def _picture(path: Path) -> Image.Image:
    """Return a piece of a starter's cloth: its upper left corner."""
    recipe = load_recipe(path)
    page: Artwork | Yardage
    if recipe.yardage:
        page, shown = compile_cloth(recipe), SHOWN
    else:
        tile = compile_recipe(recipe)
        shown = max(SHOWN, 1.5 * tile.cell.width)
        high = shown * FRAME[1] / FRAME[0]
        page = repeated(tile, math.ceil(shown / tile.cell.width), math.ceil(high / tile.cell.height))
    per_mm = FINER * FRAME[0] / shown
    drawn = Image.open(io.BytesIO(render(page, "png", PngOptions(dpi=per_mm * 25.4)))).convert("RGB")
    piece = drawn.crop((0, 0, FINER * FRAME[0], FINER * FRAME[1]))
    return piece.resize(FRAME, Image.Resampling.BOX)
