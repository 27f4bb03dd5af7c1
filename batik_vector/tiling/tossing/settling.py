"""Settling: marks shifted a little, again and again, until the gaps between them are even.

Every mark repels its neighbours the more the nearer they are, outline to outline; of a few places close by
it takes the one where it is pushed least, and where it keeps its distance. So holes are filled by those
around them, as Lloyd's relaxation evens out points.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from batik_vector.geometry.sampling import Array, Indices
from batik_vector.tiling.tossing.darts import Dice, Rules
from batik_vector.tiling.tossing.marks import Flags, Poses
from batik_vector.tiling.tossing.scatter import Scatter

CHOICES = 6
"""Places that a mark chooses among: where it is, and others by chance."""

MOVERS = 0.6
"""Share of the marks that move in one sweep: if all did, neighbours would run into one another."""

FIRST_STEP, COOLING = 0.24, 0.85
"""How far a mark looks at first, as a share of the spacing of marks; what each sweep leaves of it."""


KIN_PUSH = 1.5
"""How much harder marks of one motif push each other, so that kinds do not gather."""


def settled(scatter: Scatter, rules: Rules, dice: Dice, distance: float, sweeps: int) -> None:
    """Shift the marks of a scatter; they keep their motifs, sizes and sides, and the distance holds.

    Args:
        scatter: whose marks are shifted in place.
        rules: which turns are allowed.
        dice: the chances.
        distance: between marks, in grid steps.
        sweeps: how often.
    """
    count = len(scatter)
    images = count * len(scatter.torus.operations)
    if not count or images < 2:
        return
    spacing = math.sqrt(scatter.torus.area / images)
    reach = distance + 0.6 * spacing
    for sweep in range(sweeps):
        scatter.set(scatter.poses, scatter.field, reach)
        movers = np.flatnonzero(dice(count) < MOVERS)
        index = np.repeat(movers, CHOICES)
        tried = _tried(scatter, rules, dice, index, FIRST_STEP * spacing * COOLING**sweep, COOLING**sweep)
        push = _push(scatter, tried, index, distance, reach, spacing)
        best = push.reshape(-1, CHOICES).argmin(axis=1)
        goes = best > 0
        chosen = (np.arange(len(movers)) * CHOICES + best)[goes]
        _move(scatter, movers[goes], tried.take(chosen), distance)


def _tried(scatter: Scatter, rules: Rules, dice: Dice, index: Indices, step: float, heat: float) -> Poses:
    """Return the poses that each mark chooses among, the first of them its own."""
    poses = scatter.poses.take(index)
    count = len(index)
    stays = np.arange(count) % CHOICES == 0
    shift = (dice(count) * 2 - 1 + 1j * (dice(count) * 2 - 1)) * step
    place = np.where(stays, poses.place, scatter.torus.within(poses.place + shift))
    low, high = rules.turn
    if rules.turns:
        fresh, other = rules.turned(dice(count)), dice(count) < 0.5
        turn = np.where(other, fresh, poses.turn)
    else:
        turn = np.round(poses.turn + (dice(count) - 0.5) * min(60.0, high - low) * heat, 3)
        turn = turn if high - low >= 360 else np.clip(turn, low, high)
    return replace(poses, place=place, turn=np.where(stays, poses.turn, turn))


def _push(
    scatter: Scatter, poses: Poses, index: Indices, distance: float, reach: float, spacing: float
) -> Array:
    """Return how hard each mark is pushed by those around it; infinitely where it comes too near to one."""
    which, gap, there = scatter.rough_gaps(poses, reach, index)
    soft = 0.3 * distance + 0.02 * spacing
    alike = (there >= 0) & (scatter.field.kinds[there] == poses.motif[which])
    push = np.zeros(len(poses))
    np.add.at(push, which, np.where(alike, KIN_PUSH, 1.0) / (gap + soft) ** 2)
    push[which[_too_near(gap, distance)]] = np.inf
    return push


def _too_near(gap: Array, distance: float) -> Flags:
    return np.asarray(gap < distance if distance > 0 else gap <= 0)


def _move(scatter: Scatter, movers: Indices, poses: Poses, distance: float) -> None:
    """Move marks all at once; those that run into one another stay where they were."""
    before, field, marks = scatter.poses, scatter.field, scatter.marks(poses)
    going = np.ones(len(movers), bool)
    while True:
        goers = movers[going]
        scatter.set(before.shifted(goers, poses.take(going)), field.put(goers, marks.take(going)), distance)
        if not going.any():
            return
        which, gap, there = scatter.gaps(marks.take(going), distance, goers)
        hit = _too_near(gap, distance)
        if not hit.any():
            return
        going &= ~np.isin(movers, np.concatenate([goers[which[hit]], there[hit]]))
