"""Paths: open ones, those drawn again, and those with too many nodes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from batik_vector.audit.doubles import Doubles, doubles
from batik_vector.audit.measured import MeasuredInk
from batik_vector.audit.nodes import dense
from batik_vector.audit.report import Finding, Kind, mm
from batik_vector.certificate import Limits as SeamLimits
from batik_vector.certificate import SeamFault
from batik_vector.certificate.duplicates import doubled_lines, shared_lines
from batik_vector.geometry.nets.components import components
from batik_vector.geometry.outlines import Index
from batik_vector.machines import Twice

LEAST_DOUBLE = 0.1
"""Shorter stretches (mm) that are drawn again harm nobody."""


def open_paths(ink: MeasuredInk) -> Iterator[Finding]:
    """Yield the paths that end somewhere on the page; those that end on its edge go on beyond."""
    contours, frame = ink.contours, ink.frame
    sides = np.array([frame.cell.columns, frame.cell.rows], float)
    for which in np.flatnonzero(~contours.closed & ~contours.outline).tolist():
        ends = contours.points[[contours.starts[which], contours.starts[which + 1] - 1]]
        inside = ((ends > 0) & (ends < sides)).all(axis=1)
        if inside.any():
            length = float(ink.length[which]) / frame.per_mm
            words = f"a path {mm(length)} mm long is open"
            yield ink.finding(Kind.OPEN, ends[np.argmax(inside)], length, None, words)


def crowded_nodes(ink: MeasuredInk, most: float) -> Iterator[Finding]:
    """Yield the paths that have more than so many nodes to a mm somewhere."""
    found = dense(ink.contours, ink.ends, most / ink.frame.per_mm)
    for density, at in zip((found.density * ink.frame.per_mm).tolist(), found.at, strict=True):
        words = f"{density:.1f} nodes to a mm, the most are {most:g}"
        yield ink.finding(Kind.NODES, at, density, most, words)


def drawn_again(inks: Sequence[MeasuredInk], twice: Twice) -> Iterator[Finding]:
    """Yield what is drawn again, by the same ink or by any."""
    if twice == Twice.NO or not inks:
        return
    for ink in inks:
        if ink.strokes is not None:
            yield from _told(doubled_lines(ink.strokes, ink.frame, NEARLY)[1])
    if twice == Twice.ALL:
        loose = [ink.strokes for ink in inks if ink.strokes is not None]
        yield from _told(shared_lines(loose, inks[0].frame, NEARLY))
    for together in [inks] if twice == Twice.ALL else [[ink] for ink in inks]:
        yield from _again(together)


NEARLY = SeamLimits()
"""How near lines off the grid are one line."""


def _told(faults: Sequence[SeamFault]) -> Iterator[Finding]:
    for fault in faults:
        yield Finding(Kind.DOUBLE, fault.ink, fault.where, fault.amount, None, fault.words)


def _again(inks: Sequence[MeasuredInk]) -> Iterator[Finding]:
    """Yield a finding for each stretch that two paths share to the grid step.

    Of lines off the grid, one beside the other, is told elsewhere.
    """
    counts = np.cumsum([0, *(len(ink.contours) for ink in inks)])
    path = np.concatenate(
        [ink.contours.of_point + first for ink, first in zip(inks, counts[:-1], strict=True)]
    )
    begin = np.concatenate([ink.contours.points for ink in inks])
    found = doubles(begin, np.concatenate([ink.ends for ink in inks]))
    loose = np.concatenate(
        [~ink.contours.outline if ink.strokes is not None else ink.contours.outline & False for ink in inks]
    )
    found = found.only(~(loose[path[found.again]] & loose[path[found.first]]))
    if not len(found.again):
        return
    length = np.hypot(*(found.end - found.begin).T) / inks[0].frame.per_mm
    for rows in _stretches(found, path):
        total = float(length[rows].sum())
        if total >= LEAST_DOUBLE:
            row = int(rows[np.argmax(length[rows])])
            again, first = (
                inks[int(np.searchsorted(counts, path[each[row]], side="right")) - 1]
                for each in (found.again, found.first)
            )
            by = f" by ink {first.name}" if first is not again else ""
            words = f"{mm(total)} mm of path that was drawn{by} is drawn again"
            at = (found.begin[row] + found.end[row]) / 2
            yield again.finding(Kind.DOUBLE, at, total, None, words)


def _stretches(found: Doubles, path: Index) -> list[Index]:
    """Return the rows of what is drawn again that two paths share, and that hang together."""
    count = len(found.again)
    pairs = np.column_stack([path[found.again], path[found.first]])
    _, node = np.unique(np.round(np.concatenate([found.begin, found.end])), axis=0, return_inverse=True)
    keys = np.column_stack([np.tile(pairs, (2, 1)), node.ravel()])
    order = np.lexsort(keys.T)
    row = order % count
    same = (np.diff(keys[order], axis=0) == 0).all(axis=1)
    group = components(count, np.column_stack([row[1:][same], row[:-1][same]]))
    rows = np.argsort(group, kind="stable")
    return np.split(rows, np.flatnonzero(np.diff(group[rows])) + 1)
