"""A design mirrored, in the plainest words that a recipe has for it.

A motif that is its own mirror image is set out by the mirrored layout; any other placement, and what fills
the repeat, gets a ``mirror``.
"""

from __future__ import annotations

import itertools
import math
import re
from dataclasses import fields, replace
from fractions import Fraction
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import DropAxis
from batik_vector.errors import Fault, RecipeError
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.recipe.figures import draw, size_of
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motif import Motif
from batik_vector.recipe.placement import Mirror, Placement
from batik_vector.recipe.references import Path, dotted
from batik_vector.studio.drafts import Draft, Where, parsed
from batik_vector.tiling.layouts import Bend, FreeGround, Lattice, Layout, Scattered, Stripes

SAME = 1e-6
"""How far maps may differ, in motif units, and be the same."""
CLOSE = 1e-4
"""Share of a cell by which maps lie within it, so that none is at its edge by rounding."""
COARSE = 1e-3
"""Tolerance, as a share of its size, at which a motif is held against its mirror image."""
_DROP = re.compile(r"\s*drop\s+(\d+)/(\d+)\s*")


def mirrored(draft: Draft, path: Where = (), *, upright: bool = True) -> Draft:
    """Return a draft with a placement mirrored about its own place; without one, all about its unit's middle.

    Args:
        draft: that reads.
        path: of a placement of the tile.
        upright: whether left and right change places, or else above and below.

    Raises:
        RecipeError: where the draft does not read, or has no such placement.
    """
    where = parsed(path) if path else ()
    recipe = draft.recipe
    if where and (len(where) != 2 or where[0] != "place" or not _within(where[1], recipe.place)):
        raise RecipeError(
            [Fault("is no placement of the tile: expected one such as place[0]", dotted(where))]
        )
    for number, placement in enumerate(recipe.place):
        if not where or where[1] == number:
            draft = _mirrored(draft, number, placement, upright, whole=not where)
    repeat = draft.value("tile.repeat")
    if not where and isinstance(repeat, str) and (drop := _DROP.fullmatch(repeat)):
        rest = -Fraction(int(drop[1]), int(drop[2])) % 1
        draft = draft.with_value("tile.repeat", f"drop {rest.numerator}/{rest.denominator}")
    return draft


def _within(number: Any, places: tuple[Placement, ...]) -> bool:
    return isinstance(number, int) and number < len(places)


def _mirrored(draft: Draft, number: int, placement: Placement, upright: bool, *, whole: bool) -> Draft:
    if isinstance(placement.layout, FreeGround):
        # It fills what the others leave, and has no sides.
        return draft
    place: Path = ("place", number)
    recipe = draft.recipe
    unit = recipe.tiling.unit()
    motifs = [recipe.motif[name] for name in placement.motifs]
    found = _layout(placement, motifs, upright, (unit.width, unit.height))
    if found is None:
        draft = _set(draft, (*place, "mirror"), _changed(placement.mirror, upright))
    elif found[0] is not None:
        draft = draft.with_value((*place, "layout"), found[0])
    aside = 0.0 if found is None else found[1]
    if placement.turn:
        draft = draft.with_value((*place, "turn"), -placement.turn)
    if isinstance(placement.layout, Scattered):
        # It fills the repeat, and is mirrored about the middle of that.
        return _with_phase(draft, place, placement, upright) if whole else draft
    orbit = recipe.tiling.orbit(placement.symmetry, placement.phase, placement.spread)
    before = placement.at or orbit.middle or (unit.width / 2, unit.height / 2)
    at = [before[0] + aside, before[1]]
    axis = 0 if upright else 1
    if whole:
        side = unit.width if upright else unit.height
        at[axis] = side - at[axis]
        if not unit.drop or (unit.axis == DropAxis.COLUMN) != upright:
            # Where columns drop, one beside it would be higher.
            at[axis] %= side
    if math.dist(at, before) > SAME:
        draft = draft.with_value((*place, "at"), at)
    return _with_phase(draft, place, placement, upright) if whole else draft


def _with_phase(draft: Draft, place: Path, placement: Placement, upright: bool) -> Draft:
    axis = 0 if upright else 1
    moved = placement.phase[axis]
    return draft.with_value((*place, "phase", axis), -moved) if moved else draft


def _set(draft: Draft, path: Path, value: str | None) -> Draft:
    return draft.without(path) if value is None else draft.with_value(path, value)


def _changed(mirror: Mirror | None, upright: bool) -> Mirror | None:
    """Return which sides have changed places once two more do."""
    sides = {None: set(), Mirror.ACROSS: {0}, Mirror.DOWN: {1}, Mirror.BOTH: {0, 1}}
    wanted = sides[mirror] ^ {0 if upright else 1}
    return next(each for each, held in sides.items() if held == wanted)


def _layout(
    placement: Placement, motifs: list[Motif], upright: bool, cell: tuple[float, float]
) -> tuple[dict[str, Any] | None, float] | None:
    """Return the table of the mirrored layout; None in its place where the one that is there will do.

    Nothing where no layout says it. Rows that stagger are mirrored by rows that stagger the other way: by how
    many mm the whole is moved along x for that comes second.
    """
    layout, flip = placement.layout, Affine.mirror(90 if upright else 0)
    measured = layout.spreads or placement.scale is not None
    if placement.mirror is not None or isinstance(layout, Scattered | Stripes) or not measured:
        return None
    scale = placement.scale or 1.0
    cell = cell[0] / scale, cell[1] / scale
    images = layout.images(cell)
    if isinstance(images, Bend) or not all(_is_own_image(motif, flip) for motif in motifs):
        return None
    turned = _turned_about(layout, flip)
    whole = cell if not layout.spreads else (math.inf, math.inf)
    for aside in (0.0, cell[0] / layout.columns / 2) if isinstance(layout, Lattice) else (0.0,):
        moved = Affine.translation((-aside, 0.0)) @ flip @ images @ flip
        if _alike(moved, turned.images(cell), whole):
            return (None if turned == layout else _table(turned)), aside * scale
    return None


def _turned_about(layout: Layout, flip: Affine) -> Layout:
    """Return a layout with its directions mirrored, which of most kinds is its mirror image."""
    upright = flip.a < 0
    changed: dict[str, Any] = {}
    for each in fields(layout):  # type: ignore[arg-type]
        value = getattr(layout, each.name)
        if each.name == "turn":
            changed["turn"] = -value if value else value
        elif each.name == "shift":
            x, y = value
            changed["shift"] = (-x if upright and x else x, y if upright else -y)
        elif each.name == "axis":
            changed["axis"] = 180 - value if upright else -value
    return replace(layout, **changed)  # type: ignore[type-var]


def _alike(images: Affines, others: Affines | Bend, cell: tuple[float, float]) -> bool:
    """Return whether maps are the same, in whatever order, and whole cells apart."""
    if isinstance(others, Bend) or len(others) != len(images):
        return False
    mine, its = (np.array(each.rows) for each in (images, others))
    for rows in (mine, its):
        for side, length in enumerate(cell):
            if math.isfinite(length):
                rows[:, 4 + side] = np.mod(rows[:, 4 + side] + CLOSE * length, length)
    mine, its = (rows[np.lexsort(np.round(rows, 4).T)] for rows in (mine, its))
    return bool(np.allclose(mine, its, atol=10 * SAME * max(1.0, float(np.abs(mine).max()))))


def _is_own_image(motif: Motif, flip: Affine) -> bool:
    """Return whether all that a motif draws is its own mirror image."""
    fine = COARSE * size_of(motif)
    # What lies side by side and looks alike is one drawing: four quarters of a ring may be four elements.
    for _, alike in itertools.groupby(draw(motif, fine), lambda each: _dress(each.element)):
        figures = list(alike)
        areas = np.concatenate([each.areas for each in figures])
        lines = np.concatenate([each.lines for each in figures])
        for marks in (areas, shapely.buffer(lines, 4 * fine)):
            whole = shapely.union_all(marks)
            other = shapely.union_all(flip.apply(shapely.get_parts([whole])))
            if not shapely.buffer(shapely.symmetric_difference(whole, other), -2 * fine).is_empty:
                return False
    return True


def _dress(element: Dress) -> tuple[Any, ...]:
    return tuple(getattr(element, name) for name in Dress.__dataclass_fields__)


def _table(layout: Layout) -> dict[str, Any]:
    from batik_vector.recipe.reading.field_types import Hint
    from batik_vector.studio.declared import plain
    from batik_vector.tiling.layouts import LAYOUTS

    kind = next(name for name, cls in LAYOUTS.items() if cls is type(layout))
    return {"kind": kind, **plain(Hint(type(layout)), layout)}
