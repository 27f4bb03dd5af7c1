"""A toss or a packing from beginning to end: how many marks, where they come to lie, and its report."""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np
import shapely

from batik_vector.artwork import Geometries
from batik_vector.errors import GeometryError
from batik_vector.geometry import work
from batik_vector.geometry.maps.affine import IDENTITY, Affine
from batik_vector.geometry.maps.affines import Affines, turns
from batik_vector.tiling.layouts.grounds import Pack, Scattered, Toss
from batik_vector.tiling.torus import remembered
from batik_vector.tiling.torus.torus import as_steps, to_mm
from batik_vector.tiling.tossing.darts import Dice, Rules, Spacing, thrown
from batik_vector.tiling.tossing.falls import Falls, opened
from batik_vector.tiling.tossing.marks import Field, Kit, Poses
from batik_vector.tiling.tossing.outlines import outline
from batik_vector.tiling.tossing.packing import Asked, packed_on
from batik_vector.tiling.tossing.plan import Plan, rules_of
from batik_vector.tiling.tossing.refusals import refuse_crowded, refuse_impossible, refuse_too_many
from batik_vector.tiling.tossing.report import TossReport
from batik_vector.tiling.tossing.scatter import Scatter, Torus
from batik_vector.tiling.tossing.settling import settled
from batik_vector.units import STEPS_PER_MM, format_mm
from batik_vector.values import frozen

ROUNDS = 3
"""How often marks are settled and the holes that this opens thrown at again."""

CERTAIN = 100
"""Marks, images included, of which a throw says how many will fit: chance evens out."""

SHORT, CHANCE = 0.965, 0.65
"""Share of a count below which settling does not bring a full throw up to it, and what chance may take from
that, over the root of the number of marks: settling added up to 0.03."""

EARLY_TRIES = 150
"""Darts that must miss in a row before marks that are few are thrown closer together."""


@frozen
class Marks:
    """The motifs of a toss as they are at their least size, each in its own frame, in mm.

    ``bodies`` are all that is drawn, shape (k,); ``slack`` is how far a finished mark may stand beyond;
    ``reach`` how far beyond it a mark cuts what lies beneath, so that no other may come as near.
    """

    names: tuple[str, ...]
    bodies: Geometries
    slack: float
    reach: float = 0.0


Fallen: TypeAlias = tuple[Poses, Field, TossReport]
"""How the marks of a toss lie, one of each: their poses, the marks, and the report."""


@frozen
class Tossed:
    """A finished toss.

    Attributes:
        copies: for each motif the maps that carry it, at its least size in mm, to its places on cloth.
        field: all marks in grid steps, images under the symmetry included, translates not.
        report: how it went.
        over: the map, its own inverse, that carries the field to its place on cloth.
    """

    copies: tuple[Affines, ...]
    field: Field
    report: TossReport
    over: Affine = IDENTITY


def _whole(marks: Geometries) -> Geometries:
    """Return marks with every vertex in whole steps."""
    return np.asarray(shapely.transform(marks, np.rint), dtype=object)


def toss(spec: Scattered, marks: Marks, torus: Torus, taken: Field, seed: int) -> Tossed:
    """Scatter or pack marks over the torus.

    Args:
        spec: how many, how far apart and how turned.
        marks: the motifs.
        torus: the repeat, and the symmetry that multiplies every mark.
        taken: what the marks keep clear of, beside one another.
        seed: of the chances, where the spec has none of its own.

    Raises:
        GeometryError: where the marks asked for do not fit, with how many do.
        TooLargeError: with the estimate, before any is set down.
    """
    spec = replace(spec, distance=max(spec.distance, marks.reach))
    _check_distance(spec, torus)
    # Whole steps throughout: where two ways to simplify are as good, the last bit of a sine would choose, and
    # processors have different ones.
    bodies = to_mm(_whole(as_steps(marks.bodies)))
    packed = isinstance(spec, Pack)
    outlines = np.array([outline(body, spec.distance, marks.slack, packed) for body in bodies], dtype=object)
    kit = Kit.of(_whole(as_steps(outlines)))
    refuse_too_many(spec, kit, torus)
    refuse_impossible(spec, kit, torus)
    refuse_crowded(spec, kit, torus, taken)
    scatter = Scatter(torus, kit, spec.size[1] / spec.size[0], taken)
    seed = seed if spec.seed is None else spec.seed
    falls = opened()
    if falls is not None and falls.sketching:
        return _sketched(scatter, spec, marks, seed, falls)
    poses, field, report = _fallen(scatter, spec, marks, seed)
    scatter.set(poses, field, 0.0)
    if falls is not None:
        falls.note(_words(spec, marks, torus, seed), poses, report)
    return _tossed(scatter, report)


def _tossed(scatter: Scatter, report: TossReport) -> Tossed:
    field = Field.joined([scatter.field.moved(operation) for operation in scatter.torus.operations])
    motifs = range(len(scatter.kit.outlines))
    return Tossed(tuple(_copies(scatter, motif) for motif in motifs), field, report)


def _words(spec: Scattered, marks: Marks, torus: Torus, seed: int) -> Hashable:
    """Return in what words a toss is asked for: all of it but the shapes of its marks."""
    stretch = None if torus.stretch is None else torus.stretch.tobytes()
    return spec, marks.names, torus.lattice, torus.operations, stretch, seed


def _sketched(scatter: Scatter, spec: Scattered, marks: Marks, seed: int, falls: Falls) -> Tossed:
    """Let marks stay where they fell, those left out that are in the way; see :mod:`falls`."""
    known = falls.known(_words(spec, marks, scatter.torus, seed))
    if known is None:
        poses, field, report = _fallen(scatter, _hasty(spec), marks, seed)
    else:
        poses, report = known
        field = scatter.marks(poses)
        scatter.set(Poses.none(), scatter.field, scatter.largest)
        free = scatter.clear(field, 0.0, 0.0)
        poses, field = poses.take(free), field.take(free).owned(np.arange(int(free.sum())))
    scatter.set(poses, field, 0.0)
    return _tossed(scatter, report)


def _hasty(spec: Scattered) -> Scattered:
    return replace(spec, settle=0) if isinstance(spec, Toss) else spec


def _fallen(scatter: Scatter, spec: Scattered, marks: Marks, seed: int) -> Fallen:
    """Throw until the scatter is as the spec asks. What was thrown at the very same before is remembered."""
    # The same words and shapes fall in the same way; discs hang on the kit, and not on the shapes alone.
    shapes = remembered.interned(np.concatenate([scatter.kit.outlines, marks.bodies, scatter.taken.shapes]))
    how = "toss", _words(spec, marks, scatter.torus, seed), scatter.taken.discs.tobytes()
    rows = remembered.identities(shapes)[:, None]
    asked = remembered.Asked[tuple[work.Share, Fallen]].together(_known_by(how), rows, (shapes,))
    if (known := asked.found[0]) is not None:
        work.spend_again(known[0])
        return known[1]
    before = work.counted() or (0.0,) * 4
    if isinstance(spec, Toss):
        darts = _filled(scatter, spec, marks, Dice(seed))
    else:
        rules = rules_of(spec, len(marks.names))
        plan = Plan.of(spec, marks.bodies, rules, scatter)
        packing = Asked(rules, spec.distance * STEPS_PER_MM, spec.tries, plan.wanted)
        darts = packed_on(scatter, packing, Dice(seed))
    _check_count(spec, scatter, marks)
    poses, field = scatter.poses, scatter.field
    fallen = poses, field, _report(scatter, spec, marks, darts)
    spent, vertices, crossings, pairs = np.subtract(work.counted() or before, before).tolist()
    size = int(shapely.get_num_coordinates(field.shapes).sum())
    if size <= remembered.KEPT_VERTICES:
        asked.keep([0], [((spent, vertices, crossings, pairs), fallen)], [size])
    return fallen


def _known_by(how: Hashable) -> Hashable:
    """Return what a fall is known by, or None: what is built in Python may hold lists."""
    try:
        hash(how)
    except TypeError:
        return None
    return how


def _check_distance(spec: Scattered, torus: Torus) -> None:
    shortest = torus.shortest / STEPS_PER_MM
    if spec.distance >= shortest:
        raise GeometryError(
            f"distance = {format_mm(spec.distance)} mm: the repeat is only {format_mm(shortest)} mm round, "
            "expected less than that"
        )


def _filled(scatter: Scatter, spec: Toss, marks: Marks, dice: Dice) -> int:
    """Throw and settle until the scatter is as the spec asks; return how many darts that took."""
    rules = rules_of(spec, len(marks.names))
    plan = Plan.of(spec, marks.bodies, rules, scatter)
    distance = spec.distance * STEPS_PER_MM
    darts = 0
    for spacing, kind in plan.early(distance):
        darts += thrown(scatter, rules, dice, spacing, EARLY_TRIES, partial(plan.of_kind, kind))
    darts += thrown(scatter, rules, dice, Spacing(distance, distance), spec.tries, plan.wanted)
    _check_hope(scatter, spec, rules, plan)
    darts += _settled(scatter, spec, rules, dice, plan)
    if spec.count is not None and len(scatter) < spec.count:
        # Marks that began far apart waste room that a count close to the most that fit cannot spare.
        poses, field = scatter.poses, scatter.field
        _clear(scatter)
        darts += thrown(scatter, rules, dice, Spacing(distance, distance), spec.tries, plan.wanted)
        darts += _settled(scatter, spec, rules, dice, plan)
        if len(poses) >= len(scatter):
            scatter.set(poses, field, 0.0)
    return darts


def _settled(scatter: Scatter, spec: Toss, rules: Rules, dice: Dice, plan: Plan) -> int:
    """Settle in rounds and throw at the holes that this opens; return how many darts that took."""
    distance = spec.distance * STEPS_PER_MM
    darts = 0
    for number in range(ROUNDS if spec.settle else 0):
        settled(scatter, rules, dice, distance, _part(spec.settle, ROUNDS, number))
        darts += thrown(scatter, rules, dice, Spacing(distance, distance), spec.tries, plan.wanted)
    return darts


def _clear(scatter: Scatter) -> None:
    scatter.set(Poses.none(), scatter.field.take(np.empty(0, np.intp)), 0.0)


def _check_hope(scatter: Scatter, spec: Toss, rules: Rules, plan: Plan) -> None:
    """Refuse a count that a throw at the least distance on the empty repeat falls far short of.

    It has chances of its own: what is not refused comes out as if it had not been thrown.
    """
    first = len(scatter)
    images = (spec.count or 0) * len(scatter.torus.operations)
    if spec.count is None or images < CERTAIN:
        return
    short = (SHORT - CHANCE / math.sqrt(images)) * spec.count
    if not 0 < first < short:
        return
    poses, field = scatter.poses, scatter.field
    _clear(scatter)
    distance = spec.distance * STEPS_PER_MM
    thrown(scatter, rules, Dice(0), Spacing(distance, distance), spec.tries, plan.wanted)
    most = max(first, len(scatter))
    if most < short:
        raise GeometryError(
            f"count = {spec.count}: about {most} fit at a distance of {format_mm(spec.distance)} mm, "
            "expected that many, or smaller marks"
        )
    scatter.set(poses, field, 0.0)


def _part(total: int, parts: int, number: int) -> int:
    """Return the share of a whole number that one of several parts has."""
    return total * (number + 1) // parts - total * number // parts


def _check_count(spec: Scattered, scatter: Scatter, marks: Marks) -> None:
    fit = len(scatter)
    if not fit:
        breadth = 2 * float(scatter.kit.reach.min()) / STEPS_PER_MM
        if len(scatter.taken):
            raise GeometryError(
                f"no mark of {format_mm(round(breadth, 1))} mm fits between what lies there already at a "
                f"distance of {format_mm(spec.distance)} mm: expected smaller marks, or another clear"
            )
        raise GeometryError(
            f"a mark of {format_mm(round(breadth, 1))} mm keeps no distance of {format_mm(spec.distance)} mm "
            f"from its own images, the nearest {format_mm(scatter.torus.shortest / STEPS_PER_MM)} mm away: "
            "expected a smaller width or a larger tile"
        )
    if spec.count is not None and fit < spec.count:
        raise GeometryError(
            f"count = {spec.count}: only {fit} fit at a distance of {format_mm(spec.distance)} mm, "
            f"expected at most {fit}, or smaller marks"
        )


def _copies(scatter: Scatter, motif: int) -> Affines:
    """Return the maps of one motif, from its own frame in mm to its places."""
    poses = scatter.poses.take(scatter.poses.motif == motif)
    middle = scatter.kit.middles[motif] / STEPS_PER_MM
    to_middle = Affine.translation((-middle.real, -middle.imag))
    stretch = IDENTITY
    if scatter.torus.stretch is not None:
        (a, b), (c, d) = scatter.torus.stretch.tolist()
        stretch = Affine(a, b, c, d)
    places = np.column_stack([poses.place.real, poses.place.imag]) / STEPS_PER_MM
    sized = Affines.scales(np.where(poses.flip, -poses.size, poses.size), poses.size)
    return Affines.translations(places) @ stretch @ turns(poses.turn.tolist()) @ sized @ to_middle


def _report(scatter: Scatter, spec: Scattered, marks: Marks, darts: int) -> TossReport:
    images = len(scatter.torus.operations)
    poses = scatter.poses
    bodies = as_steps(marks.bodies)
    stretch = 1.0 if scatter.torus.stretch is None else abs(float(np.linalg.det(scatter.torus.stretch)))
    covered = float((shapely.area(bodies)[poses.motif] * poses.size**2).sum()) * images * stretch
    counts = np.bincount(poses.motif, minlength=len(bodies)) * images
    square_metres = scatter.torus.area / (STEPS_PER_MM * 1000) ** 2
    return TossReport(
        marks.names,
        tuple(int(count) for count in counts),
        round(covered / scatter.torus.area, 6),
        round(float(counts.sum()) / square_metres, 1),
        round(_least_gap(scatter, bodies, spec.distance) / STEPS_PER_MM, 3),
        darts,
    )


def _least_gap(scatter: Scatter, bodies: Geometries, distance: float) -> float:
    """Measure the least gap between marks as they are drawn, and to what they keep clear of."""
    middles = np.stack([scatter.kit.middles.real, scatter.kit.middles.imag], axis=1)
    coords, owner = shapely.get_coordinates(bodies, return_index=True)
    bodies = np.asarray(shapely.set_coordinates(bodies.copy(), coords - middles[owner]), dtype=object)
    drawn = replace(scatter.kit, outlines=bodies).marks(scatter.poses, scatter.torus.stretch)
    own = np.arange(len(drawn))
    reach = 1.2 * distance * STEPS_PER_MM + 0.1 * scatter.largest
    while True:
        scatter.set(scatter.poses, drawn, reach)
        _, gap, _ = scatter.gaps(drawn, reach, own)
        if len(gap):
            return float(gap.min())
        reach *= 2
