"""What programs are shown: samples of every kind, and two drawings that differ from their mirror images."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterable
from pathlib import Path
from typing import TypeVar

import numpy as np
import shapely

from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_cloth, compile_recipe
from batik_vector.recipe.loading import load_recipe
from batik_vector.tiling.cloth.field import collected

Choice = TypeVar("Choice")
HERE = Path(__file__).parent
ENOUGH = {
    *("group-p4g", "group-p6m", "toss-fish", "ground-waves", "figure-05", "figure-14a"),
    *("border-p1", "border-p11m", "border-p2mm"),
}
"""Of series of samples that are written alike, those that programs are shown."""
SERIES = ("group-", "toss-", "ground-", "figure-", "border-")
RECIPES = {
    path.stem: path
    for folder in (HERE / "recipes", HERE.parents[1] / "samples")
    for path in sorted(folder.glob("*.toml"))
    if path.stem in ENOUGH or not path.stem.startswith(SERIES)
}
MOST_PIXELS = 2600


def shared_out(choices: Iterable[Choice]) -> list[tuple[str, Choice]]:
    """Return each drawing's name with one of the choices: these take turns, so that none sees too few."""
    return list(zip(sorted(RECIPES), itertools.cycle(choices), strict=False))


@functools.cache
def artwork(name: str) -> Artwork:
    """Return a drawing: a tile, or a cloth that has borders in one piece."""
    recipe = load_recipe(RECIPES[name])
    return collected(compile_cloth(recipe)) if recipe.border else compile_recipe(recipe)


def per_mm(drawing: Artwork) -> float:
    """Return how many pixels to the millimetre make a picture of it that is fine, but not huge."""
    longest = max(drawing.cell.width, drawing.cell.height)
    return next((scale for scale in (4.0, 2.0, 1.0) if longest * scale <= MOST_PIXELS), 0.5)


def outlines(drawing: Artwork, breadth: float) -> bytes:
    """Return a drawing's rings and lines as an SVG of thin black lines, made without any of our writers."""
    width, height = drawing.cell.width, drawing.cell.height
    data = []
    for layer in drawing.layers:
        for line in np.concatenate([shapely.get_rings(layer.areas), layer.lines]):
            data.append("M" + " ".join(f"{x},{height - y}" for x, y in shapely.get_coordinates(line)))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" '
        f'viewBox="0 0 {width} {height}"><rect width="100%" height="100%" fill="white"/>'
        f'<path fill="none" stroke="black" stroke-width="{breadth}" stroke-linecap="round" '
        f'stroke-linejoin="round" d="{" ".join(data)}"/></svg>'
    ).encode()
