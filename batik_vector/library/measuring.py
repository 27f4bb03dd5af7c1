"""What is kept of a recipe besides its text: measured features, and a small picture of its tile.

A recipe is compiled once, at its own tolerance, and what is measured is true. The picture is drawn of the
same marks, thinned to what a screen shows.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from batik_vector import (
    MissingLibraryError,
    PngOptions,
    Profile,
    SvgOptions,
    analyse,
    compile_cloth,
    compile_recipe,
    read_recipe,
    render,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from batik_vector import Artwork, Layer, Recipe

SIDE = 160
"""Pixels of the longer side of a small picture."""
DETAIL = 400
"""Steps in the longer side of a tile: what is finer is left out of its picture."""


@dataclass(frozen=True)
class Measured:
    """Features by name, as plain values, and pictures: our SVG, and a PNG where this system can draw one."""

    features: Mapping[str, Any] = field(default_factory=dict)
    svg: bytes = b""
    png: bytes = b""


def measured(recipe: Recipe, artwork: Artwork | None = None, pictures: bool = True) -> Measured:
    """Measure a recipe.

    Args:
        recipe: as read.
        artwork: its tile, where it has been compiled already.
        pictures: whether its picture is drawn, too.

    Raises:
        BatikError: where it does not compile.
    """
    features: dict[str, Any] = {"inks": len(recipe.ink), "motifs": _motifs(recipe)}
    if recipe.tile is None:
        page = compile_cloth(_coarse(recipe))
        features |= {"width": page.cell.width, "height": page.cell.height}
        # A cloth is drawn piece by piece, and cannot be thinned: it is drawn coarser from the beginning.
        svg = render(page, "svg", _PICTURE, check=False) if pictures else b""
        return Measured(features, svg, _png(page) if pictures else b"")
    tile = compile_recipe(recipe) if artwork is None else artwork
    features |= _of_tile(tile, recipe)
    if not pictures:
        return Measured(features)
    small = _thinned(tile)
    return Measured(features, render(small, "svg", _PICTURE, check=False), _png(small))


_PICTURE = SvgOptions(profile=Profile.COMPACT, order=False)


def _of_tile(tile: Artwork, recipe: Recipe) -> dict[str, Any]:
    found = analyse(tile)
    # Known it is by its largest flower, but for an ornament that stands among more flowers of another kind
    # which take more room: a whirl in the middle of a circle of them.
    many = [each for each in found.others if each.flowers > found.flowers]
    told = max((found, *many), key=lambda each: each.flowers * (each.reach or 0.0) ** 2)
    features: dict[str, Any] = {
        "width": tile.cell.width,
        "height": tile.cell.height,
        "inks": len(tile.layers),
        "coverage": round(100 * found.coverage, 2),
        "vertices": tile.vertex_count,
        "marks": found.marks,
        "repeat": recipe.tiling.repeat,
        "elements": told.elements,
        "relation": told.relation,
        "symmetry": told.symmetry.order,
        "kind": told.symmetry.kind,
        "nodes": found.nodes,
        "row": str(told),
    }
    if found.judged:
        features |= {
            "layers": len(told.layers),
            "shape": told.row["petal"],
            "petals": max(told.layers, key=lambda layer: layer.outer).petals if told.layers else 0,
            "pistils": round(max(told.pistils, default=0.0), 4),
            "flowers": told.flowers,
        }
    if found.dimension is not None:
        features["dimension"] = round(found.dimension.dimension, 4)
    if found.line_widths is not None:
        features |= dict(zip(("thinnest", "thickest"), (round(x, 4) for x in found.line_widths), strict=True))
    return features


def _motifs(recipe: Recipe) -> int:
    return len({name for _, placement in recipe.placements() for name in placement.motifs})


def _coarse(recipe: Recipe) -> Recipe:
    """Return a recipe of a cloth as finely as its picture shows it."""
    width = recipe.yardage.width if recipe.yardage is not None else 0.0
    return replace(recipe, tolerance=min(5.0, max(recipe.tolerance, width / DETAIL)), source="")


def _thinned(tile: Artwork) -> Artwork:
    """Return a tile with what a small picture shows of it."""
    tolerance = max(tile.tolerance, max(tile.cell.width, tile.cell.height) / DETAIL)
    layers = tuple(_thin_layer(layer, tolerance) for layer in tile.layers)
    bare = replace(tile.provenance, recipe="", seed=0)
    return replace(tile, layers=layers, provenance=bare, facts={}, borders=frozenset())


def _thin_layer(layer: Layer, tolerance: float) -> Layer:
    import shapely

    def thin(marks: NDArray[Any], dimension: int) -> NDArray[Any]:
        parts = shapely.get_parts(shapely.simplify(marks, tolerance, preserve_topology=False))
        # What collapses is smaller than a step of the picture.
        kept: NDArray[Any] = parts[(shapely.get_dimensions(parts) == dimension) & ~shapely.is_empty(parts)]
        return kept

    return replace(layer, areas=thin(layer.areas, 2), lines=thin(layer.lines, 1))


def measured_text(text: str, source: str) -> Measured:
    """Measure a recipe that carries its drawings; see :func:`measured`."""
    return measured(read_recipe(text, source))


def _png(page: Any) -> bytes:
    side = max(page.cell.width, page.cell.height)
    try:
        return render(page, "png", PngOptions(dpi=max(1.0, SIDE * 25.4 / side)), check=False)
    except MissingLibraryError:
        return b""
