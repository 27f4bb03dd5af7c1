"""From a recipe to an artwork: the story, told once.

Every placement is drawn, set out by its layout and brought to millimetres as sheets; the sheets are
assembled on the torus; what leaves is an :class:`~batik_vector.artwork.Artwork` in the normal form.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, replace
from typing import TYPE_CHECKING, Annotated, Any

import shapely

from batik_vector._version import __version__
from batik_vector.artwork import Artwork, Cell, DropAxis, Provenance, violations
from batik_vector.compiling.placements import Placed, place
from batik_vector.errors import Fault, RecipeError, TooLargeError, blame
from batik_vector.fields import Instead, given
from batik_vector.geometry import work
from batik_vector.recipe.model import Placement, Recipe
from batik_vector.recipe.motif import most_contours
from batik_vector.recipe.recolouring import in_palette
from batik_vector.recipe.references import dotted
from batik_vector.tiling.torus import seams
from batik_vector.tiling.torus.torus import Lattice, to_step_grid
from batik_vector.tiling.welding.sheets import Sheet
from batik_vector.tiling.welding.stack import assemble
from batik_vector.units import STEPS_PER_MM, to_steps

if TYPE_CHECKING:
    from batik_vector.tiling.cloth.yardage import Yardage

Progress = Callable[[str], None]

READ = Instead("a Recipe: load_recipe(path) reads one from its file, read_recipe(text) from text")


def compile_recipe(recipe: Recipe, *, progress: Progress | None = None) -> Artwork:
    """Compile a recipe to the artwork of its tile.

    Args:
        recipe: as read by :func:`~batik_vector.recipe.loading.load_recipe`, or built in Python.
        progress: called with a word or two as each stage begins.

    Raises:
        RecipeError: naming the key at fault.
        SeamError: where no clean seam is found.
    """
    given(recipe, Annotated[Recipe, READ], "recipe")
    if recipe.palette:
        recipe = in_palette(recipe, recipe.palette)
    with work.account():
        return _compiled(recipe, progress or (lambda stage: None))


def _compiled(recipe: Recipe, tell: Progress) -> Artwork:
    inks = {name: spec.named(name) for name, spec in recipe.ink.items()}
    unit = recipe.tiling.unit()
    sheets: list[Sheet] = []
    spent = 0
    before: list[Placed] = []
    for number, placement in enumerate(recipe.place):
        tell(f"placing {', '.join(placement.motifs) or 'the ground'}")
        with blame(f"place[{number}]"), _dense(placement, recipe):
            orbit = recipe.tiling.orbit(placement.symmetry, placement.phase, placement.spread)
            placed = place(placement, recipe, unit, inks, recipe.limit - spent, orbit, before)
            if placement.counterchange:
                lattice = recipe.tiling.repeating().lattice
                sheets = _traded(sheets, placed.sheets, lattice, recipe.tolerance)
            else:
                sheets = sheets + placed.sheets
        before.append(placed)
        spent += placed.vertices
    tell("cutting the tile")
    cell = recipe.tiling.cell()
    lattice = recipe.tiling.repeating().lattice
    with blame("tile"), _laid_to(before, recipe):
        layers, borders = assemble(sheets, list(inks.values()), cell, lattice, recipe.tolerance)
    if not layers:
        raise RecipeError("nothing is left to draw: every mark is covered or cut away")
    return replace(_blank(recipe, cell), layers=layers, borders=borders, facts=_facts(recipe, before))


def _traded(below: list[Sheet], own: list[Sheet], lattice: Lattice, tolerance: float) -> list[Sheet]:
    # Most recipes have no counterchange.
    from batik_vector.compiling.counterchange import traded

    return traded(below, own, lattice, tolerance)


@contextmanager
def _dense(placement: Placement, recipe: Recipe) -> Iterator[None]:
    """Name the contours of a placement where its marks are too much."""
    try:
        yield
    except TooLargeError as error:
        raise TooLargeError(f"{error}{_contours(placement, recipe)}") from error


@contextmanager
def _laid_to(placed: Sequence[Placed], recipe: Recipe) -> Iterator[None]:
    """Name the placement that gives the most, and its contours, where the marks of all are too much."""
    try:
        yield
    except TooLargeError as error:
        most = max(range(len(placed)), key=lambda number: placed[number].vertices)
        share = f"{placed[most].vertices:,} of {sum(each.vertices for each in placed):,}"
        text = f"{error}; the most vertices, {share}, are those of place[{most}]"
        raise TooLargeError(text + _contours(recipe.place[most], recipe)) from error


def _contours(placement: Placement, recipe: Recipe) -> str:
    dense = [(name, *most_contours(recipe.motif[name])) for name in placement.motifs if name in recipe.motif]
    name, key, contours = max(dense, key=lambda each: each[2], default=("", "", 1))
    return f", with {dotted(('motif', name))}.{key} = {contours}" if contours > 1 else ""


def _facts(recipe: Recipe, placed: Sequence[Placed]) -> dict[str, Any]:
    """Return how the tile was stretched, in per cent, and how its tosses and fitted stripes came out."""
    stretch = [round(100 * (factor - 1), 6) for factor in recipe.tiling.stretch]
    tosses = [
        {"place": number, **asdict(each.tossed.report)}
        for number, each in enumerate(placed)
        if each.tossed is not None
    ]
    stripes = [
        {"place": number, **asdict(each.fitted)}
        for number, each in enumerate(placed)
        if each.fitted is not None
    ]
    facts = {"stretch_percent": stretch if any(stretch) else [], "tossed": tosses, "stripes": stripes}
    return {name: found for name, found in facts.items() if found}


def compile_cloth(
    recipe: Recipe, *, tile: Artwork | None = None, progress: Progress | None = None
) -> Yardage:
    """Compile a recipe to its yardage: the cloth that it fills from its tile, with its borders.

    Args:
        recipe: with a ``yardage``; one that has borders alone needs no tile.
        tile: the recipe's tile, where it has been compiled already.
        progress: called with a word or two as each stage begins, and while the cloth is drawn.

    Raises:
        RecipeError: naming the key at fault.
        SeamError: where no clean seam is found.
    """
    # Most recipes are of a tile alone, and do without all that lays out a cloth.
    from batik_vector.compiling.borders import compile_borders
    from batik_vector.tiling.cloth.yardage import compile_yardage

    given(recipe, Annotated[Recipe, READ], "recipe")
    given(tile, Artwork | None, "tile")
    spec = recipe.yardage
    if spec is None:
        raise RecipeError([Fault("missing: the recipe says of no cloth how large it is", "yardage")])
    if tile is None and recipe.tile is not None:
        tile = compile_recipe(recipe, progress=progress)
    if tile is None:
        tile = _blank(recipe, Cell(to_steps(spec.width), to_steps(spec.length or 0)))
    width, length = (steps / STEPS_PER_MM for steps in spec.size(tile.cell))
    frame = compile_borders(recipe.border, recipe, (0.0, 0.0, width, length)) if recipe.border else None
    with blame("yardage"):
        page = compile_yardage(tile, spec, frame=frame, inks=list(recipe.ink), progress=progress)
    return replace(page, facts={"borders": [asdict(fit) for fit in frame.fits]}) if frame else page


def _blank(recipe: Recipe, cell: Cell) -> Artwork:
    """Return the page of a recipe with nothing on it."""
    return Artwork(
        title=recipe.title,
        cell=cell,
        layers=(),
        cloth=recipe.cloth.colour,
        dyeing=recipe.dyeing,
        tolerance=recipe.tolerance,
        provenance=Provenance(recipe.source, recipe.seed, __version__, plugins=recipe.plugins),
    )


def inspect(artwork: Artwork) -> dict[str, Any]:
    """Return the facts of an artwork and whatever is wrong with it, as plain values.

    ``violations`` lists breaks of the normal form; ``seam`` the stretches, in mm, that one edge covers
    and its opposite does not. An artwork is sound when both are empty.
    """
    return {**described(artwork), "violations": violations(artwork), "seam": _breaks(artwork)}


def described(artwork: Artwork) -> dict[str, Any]:
    """Return the facts of an artwork as plain values, without a look at what may be wrong with it."""
    cell_area = artwork.cell.width * artwork.cell.height
    return {
        "title": artwork.title,
        "cell_mm": [artwork.cell.width, artwork.cell.height],
        "drop": str(artwork.cell.drop),
        "drop_axis": "height" if artwork.cell.axis == DropAxis.COLUMN else "width",
        "vertices": artwork.vertex_count,
        "layers": [
            {
                "ink": layer.ink.name,
                "colour": layer.ink.colour,
                "areas": len(layer.areas),
                "lines": len(layer.lines),
                "covers": round(float(shapely.area(layer.areas).sum()) / cell_area, 6),
            }
            for layer in artwork.layers
        ],
    }


def _breaks(artwork: Artwork) -> list[dict[str, Any]]:
    """Return the stretches, in mm, that one edge covers and its opposite does not."""
    breaks = []
    for layer in artwork.layers:
        for axis, low, high in seams.mismatch(to_step_grid(layer.areas), artwork.cell).tolist():
            if (layer.ink.name, axis, low, high) in artwork.borders:
                continue
            side = "left and right" if axis == 0 else "lower and upper"
            ends = {"from_mm": low / STEPS_PER_MM, "to_mm": high / STEPS_PER_MM}
            breaks.append({"ink": layer.ink.name, "edges": side, **ends})
    return breaks
