"""The one shift, if there is one, after which two opposite edges would agree.

A wrong drop, or a half of the drawing moved along the seam, breaks every crossing; said one by one this
hides what happened. Crossings are events on a circle, each of a sort (the ink; where ink begins, where it
ends, a line). The shift is looked for among the differences of events of one sort, by votes.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from batik_vector.certificate.report import Kind, SeamFault
from batik_vector.certificate.seam import EDGE_NAMES, Seam
from batik_vector.geometry.congruence import distinct
from batik_vector.units import format_mm
from batik_vector.values import frozen

AGREE_MM = 0.002
"""How near (mm) events must come to agree."""

SHARE = 0.9
"""The share of all events that must agree after a shift; half of it must not agree before."""

FEWEST = 3
"""Fewer events on either edge agree by accident."""

VOTERS = 60
"""Events of the near edge that vote; all those of the far edge are candidates for each."""

BEST = 8
"""Candidates that are looked at closely."""

LARGEST_DENOMINATOR = 60
"""Of the drops p/q that a recipe may ask for."""


@frozen(eq=False)
class Events:
    """What meets an edge: where (steps, on the near edge's circle), and of which sort."""

    along: NDArray[np.int64]
    sort: NDArray[np.int64]


def all_events(parts: list[Events]) -> Events:
    """Return the events of several inks as one."""
    none = [np.empty(0, np.int64)]
    return Events(
        np.concatenate([part.along for part in parts] or none),
        np.concatenate([part.sort for part in parts] or none),
    )


def agreeing_shift(near: Events, far: Events, seam: Seam) -> int | None:
    """Return by how many steps the far edge would have to move along the seam to agree with the near one.

    None where the edges agree as they stand, or no shift brings nearly all of their crossings together.
    The smallest of several is returned, in (-length/2, length/2].
    """
    if min(len(near.along), len(far.along)) < FEWEST:
        return None
    reach = max(int(AGREE_MM * seam.frame.per_mm), 1)
    before = _agreeing(near, far, 0, seam.length, reach)
    if before >= SHARE / 2:
        return None
    voters = distinct(np.linspace(0, len(near.along) - 1, VOTERS).astype(int))
    shifts = near.along[voters][:, None] - far.along[None, :]
    shifts = shifts[near.sort[voters][:, None] == far.sort[None, :]] % seam.length
    if not len(shifts):
        return None
    rounded, votes = np.unique(shifts // reach, return_counts=True)
    found: list[tuple[float, int, int]] = []
    for candidate in rounded[np.argsort(-votes, kind="stable")[:BEST]].tolist():
        shift = int(np.median(shifts[shifts // reach == candidate]))
        share = _agreeing(near, far, shift, seam.length, reach)
        signed = shift - seam.length if 2 * shift > seam.length else shift
        found.append((-round(share, 3), abs(signed), signed))
    share, _, signed = min(found)
    return signed if -share >= SHARE else None


def _agreeing(near: Events, far: Events, shift: int, length: int, reach: int) -> float:
    """Return which share of all events has one of its sort on the other edge after a shift."""
    moved = (far.along + shift) % length
    hits = _met(near.along, near.sort, moved, far.sort, length, reach)
    hits += _met(moved, far.sort, near.along, near.sort, length, reach)
    return hits / (len(near.along) + len(far.along))


def _met(
    along: NDArray[np.int64],
    sort: NDArray[np.int64],
    others: NDArray[np.int64],
    other_sort: NDArray[np.int64],
    length: int,
    reach: int,
) -> int:
    """Count the events that have another of their sort within reach on the circle."""
    # Each sort lies on a stretch of its own; what is near the circle's end stands at its beginning too.
    span = length + 8 * reach
    last, first = others >= length - 2 * reach, others <= 2 * reach
    line = np.concatenate(
        [
            others + other_sort * span,
            others[last] - length + other_sort[last] * span,
            others[first] + length + other_sort[first] * span,
        ]
    )
    line.sort()
    place = along + sort * span
    return int((np.searchsorted(line, place + reach, "right") > np.searchsorted(line, place - reach)).sum())


def shift_fault(shift: int, seam: Seam, along: float, broken: int) -> SeamFault:
    """Say in words what shift would mend a seam.

    Args:
        shift: as :func:`agreeing_shift` returns it.
        seam: the seam.
        along: where on it, in steps, it shows.
        broken: how many crossings do not meet.
    """
    mm = shift / seam.frame.per_mm
    way = (("up", "down"), ("right", "left"))[seam.axis][mm < 0]
    words = (
        f"{broken} crossings of the {seam.names} edges do not meet; they would if the "
        f"{EDGE_NAMES[seam.axis][1]} edge were moved {format_mm(abs(mm))} mm {way}"
    )
    drop = (seam.slip - shift) % seam.length
    fraction = Fraction(drop, seam.length).limit_denominator(LARGEST_DENOMINATOR)
    if abs(fraction * seam.length - drop) <= AGREE_MM * seam.frame.per_mm:
        words += f": the drawing repeats as {repeat_words(fraction % 1, seam.axis)}"
    return SeamFault(Kind.SHIFT, "", seam.place(along, False), words, abs(mm))


def repeat_words(drop: Fraction, axis: int) -> str:
    """Name a drop as a recipe writes it."""
    if not drop:
        return '"grid"'
    if drop == Fraction(1, 2):
        return ('"half-drop"', '"brick"')[axis]
    return f'"{("drop", "brick")[axis]} {drop}"'
