"""A design mirrored: in what a recipe can say, for there is no key that mirrors a placement.

A motif that is its own mirror image is set out by the mirrored layout; of any other each copy is mirrored, as
a spot of a free layout.
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

from batik_vector.errors import Fault, RecipeError
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.recipe.figures import draw, size_of
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motif import Motif
from batik_vector.recipe.placement import Placement
from batik_vector.recipe.references import Path, dotted
from batik_vector.studio.drafts import Draft, Where, parsed
from batik_vector.tiling.layouts import Bend, Lattice, Layout, Scattered, Stripes

MOST_SPOTS = 200
"""Copies that a mirrored placement may be written out as."""
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
        RecipeError: where the draft does not read, or a layout fills the repeat or bends its motif.
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
    place: Path = ("place", number)
    recipe = draft.recipe
    flip = Affine.mirror(90 if upright else 0)
    unit = recipe.tiling.unit()
    motifs = [recipe.motif[name] for name in placement.motifs]
    layout, aside = _layout(placement, motifs, flip, (unit.width, unit.height), dotted(place))
    if layout is not None:
        draft = draft.with_value((*place, "layout"), layout)
    if placement.turn:
        draft = draft.with_value((*place, "turn"), -placement.turn)
    axis = 0 if upright else 1
    orbit = recipe.tiling.orbit(placement.symmetry, placement.phase, placement.spread)
    before = placement.at or orbit.middle or (unit.width / 2, unit.height / 2)
    at = [before[0] + aside, before[1]]
    if whole:
        side = unit.width if upright else unit.height
        at[axis] = (side - at[axis]) % side
    if math.dist(at, before) > SAME:
        draft = draft.with_value((*place, "at"), at)
    if whole and placement.phase[axis]:
        draft = draft.with_value((*place, "phase", axis), -placement.phase[axis])
    return draft


def _layout(
    placement: Placement, motifs: list[Motif], flip: Affine, cell: tuple[float, float], key: str
) -> tuple[dict[str, Any] | None, float]:
    """Return the table of the mirrored layout, or None where the one that is there will do.

    Rows that stagger are mirrored by rows that stagger the other way: by how many mm the whole is moved along
    x for that comes second.
    """
    layout = placement.layout
    if isinstance(layout, Scattered | Stripes):
        raise RecipeError([Fault("fills the repeat, and has no mirror image that a recipe can say", key)])
    if not layout.spreads and placement.scale is None:
        words = "a lattice is mirrored where its motif has a scale: expected scale instead of width"
        raise RecipeError([Fault(words, key)])
    scale = placement.scale or 1.0
    cell = cell[0] / scale, cell[1] / scale
    images = layout.images(cell)
    if isinstance(images, Bend):
        raise RecipeError([Fault("bends its motif, and has no mirror image that a recipe can say", key)])
    turned = _turned_about(layout, flip)
    same = all(_is_own_image(motif, flip) for motif in motifs)
    whole = cell if not layout.spreads else (math.inf, math.inf)
    for aside in (0.0, cell[0] / layout.columns / 2) if isinstance(layout, Lattice) else (0.0,):
        moved = Affine.translation((-aside, 0.0)) @ flip @ images @ flip
        if same and _alike(moved, turned.images(cell), whole):
            return (None if turned == layout else _table(turned)), aside * scale
    if len(motifs) > 1:
        raise RecipeError([Fault("deals out several motifs that are not their own mirror images", key)])
    if len(images) > MOST_SPOTS:
        raise RecipeError([Fault(f"{len(images)} copies, expected at most {MOST_SPOTS} to be mirrored", key)])
    return {"kind": "free", "spots": [_spot(flip @ each) for each in images]}, 0.0


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


def _spot(image: Affine) -> dict[str, Any]:
    """Return the table of a copy: turned, scaled and mirrored where that says it, or else a matrix."""
    a, b, c, d, e, f = (float(f"{value:.9g}") + 0.0 for value in image.row)
    size = math.hypot(a, c)
    mirror = a * d - b * c < 0
    sign = -1 if mirror else 1
    if abs(b + sign * c) > SAME * size or abs(d - sign * a) > SAME * size:
        return {"matrix": [a, b, c, d, e, f]}
    spot: dict[str, Any] = {}
    if abs(e) > SAME or abs(f) > SAME:
        spot["shift"] = [_short(e), _short(f)]
    if turn := _short(math.degrees(math.atan2(c, a))):
        spot["turn"] = turn
    if abs(size - 1) > SAME:
        spot["scale"] = _short(size)
    return spot | ({"mirror": True} if mirror else {})


def _short(value: float) -> float | int:
    found = float(f"{value:.6f}") + 0.0
    return int(found) if found.is_integer() else found


def _table(layout: Layout) -> dict[str, Any]:
    from batik_vector.recipe.reading.field_types import Hint
    from batik_vector.studio.declared import plain
    from batik_vector.tiling.layouts import LAYOUTS

    kind = next(name for name, cls in LAYOUTS.items() if cls is type(layout))
    return {"kind": kind, **plain(Hint(type(layout)), layout)}
