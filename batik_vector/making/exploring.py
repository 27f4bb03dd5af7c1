"""Random variations of a recipe, of which only those are kept that hold on cloth.

The numbers of its motifs are moved, within what pleases (``Useful``) or not far from where they were. Numbers
of one name and value move together, for they were meant to be alike: two leaves stay one over the other.
Angles, layouts, sizes, inks and the tile stay, on which the repeat hangs. A variation is kept where its tile
passes the certificate and ``Floor`` holds.
"""

from __future__ import annotations

import fnmatch
import hashlib
import itertools
import math
import random
import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Geometries
from batik_vector.certificate import certify
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import GeometryError, RecipeError, SeamError, nearest
from batik_vector.fields import Between
from batik_vector.making.pool import outcomes
from batik_vector.making.promised import asked_group
from batik_vector.making.sweeping import Making
from batik_vector.making.variants import Variant
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.field_types import Hint, chosen, members, taken_apart
from batik_vector.recipe.reading.sources import stem_of
from batik_vector.recipe.references import Path, dotted
from batik_vector.values import frozen

MOVED = 0.6
"""The share of the keys that a variation moves, at random."""
ANGLE = 60.0
"""Degrees that an angle moves at the widest reach."""
TRIES = 12
"""Variations tried for each that is asked for."""


@frozen
class Floor:
    """What a variation must keep to be worth looking at.

    Args:
        least: mm; no more than a tenth of what an ink covers may be narrower.
        covers: the shares of the tile that all inks together may cover.
        scrap: mm²; no more than a tenth of the areas may be smaller.
    """

    least: float = 0.4
    covers: tuple[float, float] = (0.12, 0.85)
    scrap: float = 0.5
    share: float = 0.1

    def fault(self, artwork: Artwork) -> str:
        """Return in words what a tile lacks, or nothing."""
        areas = [layer.areas for layer in artwork.layers if len(layer.areas)]
        inked = shapely.area(shapely.union_all(np.concatenate(areas))) if areas else 0.0
        cover = inked / (artwork.cell.width * artwork.cell.height)
        if not any(len(layer.lines) for layer in artwork.layers):
            low, high = self.covers
            if not low <= cover <= high:
                return f"covers {cover:.0%} of the tile, expected {low:.0%} to {high:.0%}"
        for layer in artwork.layers:
            if not len(layer.areas):
                continue
            sizes = shapely.area(layer.areas)
            if np.mean(sizes < self.scrap) > self.share:
                return f"{layer.ink.name} has scraps: {np.mean(sizes < self.scrap):.0%} of its areas are tiny"
            lost = 1 - _opened(layer.areas, self.least / 2) / sizes.sum()
            if lost > self.share:
                return f"{lost:.0%} of {layer.ink.name} is narrower than {self.least:g} mm"
        return ""


def _opened(areas: Geometries, reach: float) -> float:
    """Return what is left of areas that are drawn in by so much and grown again, in mm².

    Drawn in by far more than half their breadth GEOS leaves crumbs of the corners' arcs, which lie nearer to
    the border than they may.
    """
    cores, owner = shapely.get_parts(shapely.buffer(areas, -reach, quad_segs=2), return_index=True)
    inside = shapely.distance(shapely.point_on_surface(cores), shapely.boundary(areas[owner]))
    return float(shapely.area(shapely.buffer(cores[inside >= 0.9 * reach], reach, quad_segs=2)).sum())


@frozen
class Knob:
    """A number that a recipe says, at one place or several: what it is and within what it may move."""

    paths: tuple[Path, ...]
    value: float
    whole: bool
    bounds: Between
    useful: tuple[float, float] | None
    angle: bool

    @property
    def keys(self) -> tuple[str, ...]:
        """As people write them."""
        return tuple(map(dotted, self.paths))

    def moved(self, chance: random.Random, reach: float) -> float:
        """Return another value, the farther away the greater the reach, in (0, 1]."""
        low, high = self.bounds.low, self.bounds.high
        if self.useful is not None and self.useful[0] <= self.value <= self.useful[1]:
            low, high = self.useful
        if self.angle:
            found = self.value + chance.uniform(-reach, reach) * ANGLE
        elif self.value == 0:
            return self.value
        else:
            found = self.value * math.exp(chance.uniform(-reach, reach))
        if self.whole:
            # A whole number that moves goes to another one.
            step = 1 if found >= self.value else -1
            found = round(found) if round(found) != self.value else self.value + step
        found = min(max(found, low), high)
        return found if self.whole else float(f"{found:.4g}")


def knobs(tables: dict[str, Any], locked: Sequence[str] = (), only: Sequence[str] = ()) -> list[Knob]:
    """Return the numbers of a recipe that variations move.

    Args:
        tables: the recipe.
        locked: patterns of keys that stay, such as ``motif.flower.*`` or ``count``.
        only: patterns of keys that move, angles and layouts too; all others stay.

    Raises:
        RecipeError: where a pattern fits none.
    """
    found = list(_knobs(taken_apart(Recipe), tables, ()))
    for what, patterns in (("--lock", locked), ("--only", only)):
        for pattern in patterns:
            if not any(_fits(knob, pattern) for knob in found):
                known = [knob.keys[0] for knob in found]
                near = nearest(pattern, known)
                hint = f"did you mean {near}?" if near else f"expected keys such as {', '.join(known[:4])}"
                raise RecipeError(f"{what} {pattern} fits no number of the recipe: {hint}")
    moving = [
        knob
        for knob in found
        if (
            any(_fits(knob, each) for each in only)
            if only
            else knob.paths[0][0] == "motif" and not knob.angle
        )
    ]
    return _joined([knob for knob in moving if not any(_fits(knob, each) for each in locked)])


def _joined(found: Sequence[Knob]) -> list[Knob]:
    """Return numbers with those of one name and value as one."""
    alike: dict[tuple[Any, ...], list[Knob]] = {}
    for knob in found:
        last = next(part for part in reversed(knob.paths[0]) if isinstance(part, str))
        alike.setdefault((last, knob.value, knob.whole, knob.bounds, knob.useful), []).append(knob)
    return [
        replace(some[0], paths=tuple(path for each in some for path in each.paths)) for some in alike.values()
    ]


def _fits(knob: Knob, pattern: str) -> bool:
    return any(
        fnmatch.fnmatchcase(key, pattern) or fnmatch.fnmatchcase(key, f"*.{pattern}") for key in knob.keys
    )


def _knobs(hint: Hint, value: Any, path: Path) -> Iterator[Knob]:
    cls = chosen(hint, value)
    if cls is not None and isinstance(value, dict):
        known = members(cls)
        for name, inner in value.items():
            if name in known:
                yield from _knobs(known[name].hint, inner, (*path, name))
    elif hint.item is not None and isinstance(value, dict | list):
        for name, inner in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _knobs(hint.item, inner, (*path, name))
    elif hint.base in (int, float) and isinstance(value, int | float) and not isinstance(value, bool):
        if hint.length or hint.bounds is None:
            return
        says = hint.says.text if hint.says else ""
        useful = (hint.useful.low, hint.useful.high) if hint.useful else None
        yield Knob((path,), value, hint.base is int, hint.bounds, useful, says.startswith("degrees"))


@frozen
class Trial:
    """What tries a variation in a worker: it comes back where it is worth keeping."""

    making: Making
    floor: Floor

    def __call__(self, variant: Variant) -> Variant:
        """Return the variation.

        Raises:
            RecipeError, GeometryError, SeamError: with what it lacks.
        """
        recipe = self.making.recipe(variant)
        artwork = compile_recipe(recipe)
        if lack := self.floor.fault(artwork):
            raise GeometryError(lack)
        certificate = certify(artwork, asked=asked_group(recipe))
        if not certificate.passed:
            raise SeamError(certificate.faults[0].words)
        return variant


def candidates(moving: Sequence[Knob], stem: str, *, seed: int = 0, reach: float = 0.5) -> Iterator[Variant]:
    """Yield variations without end, always the same for a seed."""
    for number in itertools.count():
        figures = hashlib.sha256(repr((seed, number)).encode()).digest()
        chance = random.Random(figures)
        moved = [knob for knob in moving if chance.random() < MOVED] or [chance.choice(moving)]
        values = [(knob, knob.moved(chance, reach)) for knob in moved]
        changes = tuple(f"{key}={value!r}" for knob, value in values for key in knob.keys)
        yield Variant(number, f"{stem}_{number:04}", changes)


def explored(
    making: Making,
    moving: Sequence[Knob],
    count: int,
    *,
    seed: int = 0,
    reach: float = 0.5,
    floor: Floor | None = None,
    workers: int = 1,
) -> Iterator[Variant]:
    """Yield the first variations that hold, numbered from 0, whatever the number of workers.

    Raises:
        RecipeError: where there is nothing to move, or too few hold.
    """
    if not moving:
        raise RecipeError("there is no number to vary: expected motifs or layouts that say some")
    stem = stem_of(making.source)
    tries = itertools.islice(candidates(moving, stem, seed=seed, reach=reach), TRIES * count)
    known: dict[int, Variant | None] = {}
    lacks: dict[str, int] = {}
    looked = kept = 0
    for outcome in outcomes(Trial(making, floor or Floor()), tries, workers):
        known[outcome.task.number] = outcome.result
        if outcome.failure is not None:
            lacks[outcome.failure.words] = lacks.get(outcome.failure.words, 0) + 1
        # The first that hold, in the order of their numbers, however fast each was tried.
        while looked in known:
            variant = known.pop(looked)
            looked += 1
            if variant is not None:
                yield Variant(kept, f"{stem}_random-{seed}-{kept:0{len(str(count - 1))}}", variant.changes)
                kept += 1
            if kept == count:
                return
    most = max(lacks, key=lambda words: lacks[words])
    raise RecipeError(
        f"of {looked} variations {kept} hold, expected {count}: most often {most}; expected a smaller reach, "
        "or a lower floor"
    )


def numbers_of(making: Making, locked: Sequence[str] = (), only: Sequence[str] = ()) -> list[Knob]:
    """Return the numbers of the recipe that a making is of; see :func:`knobs`."""
    return knobs(tomllib.loads(making.base().source), locked, only)
