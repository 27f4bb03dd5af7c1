"""The auditor: a drawing is held to the limits of a machine, one after another."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from batik_vector.artwork import Artwork
from batik_vector.audit.chords import Chords, Widths, chords
from batik_vector.audit.contours import Contours, Floats
from batik_vector.audit.doubles import Doubles, doubles
from batik_vector.audit.drawn import DrawnInk, drawn
from batik_vector.audit.edges import Edges, edges_of
from batik_vector.audit.narrow import Search, counting, places
from batik_vector.audit.nodes import dense
from batik_vector.audit.report import Audit, Finding, Kind, mm, sorted_findings
from batik_vector.audit.thin import Thin, enclosed, thin
from batik_vector.certificate.drawing import Frame
from batik_vector.machines.limits import Limits, Twice
from batik_vector.tiling.welding.weld import components
from batik_vector.values import frozen

LEAST_DOUBLE = 0.1
"""Shorter stretches (mm) that are drawn again harm nobody."""

STRAY = 0.1
"""Share of a limit that edges may stray from true curves and still be measured to it; else the share is
allowed for."""


@frozen(eq=False)
class _Ink:
    """An ink as it is measured: its contours, their edges, what they enclose, and how far edges stray (mm)."""

    name: str
    width: float
    contours: Contours
    ends: Floats
    area: Floats
    length: Floats
    frame: Frame
    stray: float

    def slack(self, limit: float) -> float:
        """How much less than a limit (mm) is still let pass: as far as edges stray from true curves."""
        return min(self.stray, STRAY * limit)

    def finding(self, kind: Kind, at: Floats, value: float, limit: float | None, words: str) -> Finding:
        """Return what was found at a place (steps)."""
        return Finding(kind, self.name, self.frame.mm(float(at[0]), float(at[1])), value, limit, words)


def audit(
    artwork: Artwork, limits: Limits, machine: str = "", size: tuple[float, float] | None = None
) -> Audit:
    """Hold a tile to the limits of a machine.

    Args:
        artwork: a tile; marks go on over its edges as it repeats.
        limits: of the machine; what is None is not measured.
        machine: what it is called.
        size: the width and height (mm) that the machine can take, if that is to be looked at.

    Raises:
        GeometryError: where a coordinate is not finite.
    """
    frame, inks = drawn(artwork)
    measured = [_measured(ink, frame, artwork.tolerance) for ink in inks]
    found = [finding for ink in measured for finding in _of_ink(ink, limits)]
    found += _of_doubles(measured, limits)
    return Audit(machine=machine, findings=sorted_findings(found), measured=_kinds(limits, size))


def _kinds(limits: Limits, size: tuple[float, float] | None) -> tuple[Kind, ...]:
    asked = {
        Kind.SIZE: size is not None,
        Kind.OPEN: limits.closed,
        Kind.DOUBLE: limits.twice != Twice.NO,
        Kind.SLIVER: limits.sliver is not None,
        Kind.LINE: limits.narrowest_line is not None,
        Kind.GAP: limits.narrowest_gap is not None,
        Kind.HOLE: limits.smallest_hole is not None,
        Kind.NODES: limits.most_nodes is not None,
    }
    return tuple(kind for kind, is_asked in asked.items() if is_asked)


def _measured(ink: DrawnInk, frame: Frame, tolerance: float) -> _Ink:
    ends = ink.contours.ends()
    area, length = enclosed(ink.contours, ends)
    return _Ink(ink.name, ink.width, ink.contours, ends, area, length, frame, tolerance)


def _of_ink(ink: _Ink, limits: Limits) -> Iterator[Finding]:
    yield from _of_bodies(ink, limits)
    marks = list(_of_thin(ink, limits))
    yield from (finding for _, finding in marks)
    yield from _of_chords(ink, limits, {contour for contour, _ in marks})
    if limits.closed:
        yield from _of_open(ink)
    if limits.most_nodes is not None:
        found = dense(ink.contours, ink.ends, limits.most_nodes / ink.frame.per_mm)
        for density, at in zip((found.density * ink.frame.per_mm).tolist(), found.at, strict=True):
            words = f"{density:.1f} nodes to a mm, the most are {limits.most_nodes:g}"
            yield ink.finding(Kind.NODES, at, density, limits.most_nodes, words)


def _of_bodies(ink: _Ink, limits: Limits) -> Iterator[Finding]:
    """Yield one finding for all centre lines of an ink, which are as broad as it draws them."""
    lines = np.flatnonzero(~ink.contours.outline)
    if limits.narrowest_line is None or not len(lines) or ink.width >= limits.narrowest_line:
        return
    longest = int(lines[np.argmax(ink.length[lines])])
    first, stop = ink.contours.starts[longest : longest + 2].tolist()
    many = f"{len(lines):,} lines are" if len(lines) > 1 else "a line is"
    words = f"{many} {mm(ink.width)} mm wide, the least is {mm(limits.narrowest_line)} mm"
    yield ink.finding(
        Kind.LINE, ink.contours.points[(first + stop) // 2], ink.width, limits.narrowest_line, words
    )


def _of_thin(ink: _Ink, limits: Limits) -> Iterator[tuple[int, Finding]]:
    """Yield the contours of marks and holes that are too narrow all over, with what is wrong."""
    for is_hole, limit in ((False, limits.narrowest_line), (True, limits.smallest_hole)):
        most = max(limit or 0.0, limits.sliver or 0.0)
        if most <= 0:
            continue
        with np.errstate(invalid="ignore"):
            which = np.flatnonzero(ink.area < 0 if is_hole else ink.area > 0)
        breadth = (most - ink.slack(most)) * ink.frame.per_mm
        found = thin(ink.contours, which, ink.area, ink.length, breadth)
        for row in range(len(found.contour)):
            finding = _thin_finding(ink, found, row, is_hole, limits)
            if finding is not None:
                yield int(found.contour[row]), finding


def _thin_finding(ink: _Ink, found: Thin, row: int, is_hole: bool, limits: Limits) -> Finding | None:
    value, length = (float(each[row]) / ink.frame.per_mm for each in (found.breadth, found.length))
    what = "a hole" if is_hole else "a mark"
    if limits.sliver is not None and value < limits.sliver:
        kind, limit = Kind.SLIVER, limits.sliver
    else:
        kind, limit = (Kind.HOLE, limits.smallest_hole) if is_hole else (Kind.LINE, limits.narrowest_line)
        if limit is None:
            return None
    words = f"{what} {mm(value)} mm wide and {mm(max(length, value))} mm long, the least is {mm(limit)} mm"
    return ink.finding(kind, found.at[row], value, limit, words)


def _of_chords(ink: _Ink, limits: Limits, known: set[int]) -> Iterator[Finding]:
    """Yield the narrow necks and gaps of an ink, but for those of contours already told of."""
    per_mm = ink.frame.per_mm
    ink_least, ground = (
        0.0 if limit is None else (limit - ink.slack(limit)) * per_mm
        for limit in (limits.narrowest_line, limits.narrowest_gap)
    )
    if max(ink_least, ground) <= 0 or not len(ink.contours):
        return
    edges = edges_of(ink.contours, ink.ends)
    search = Search(ink.contours, edges, max(ink_least, ground), 1.5 * ink.stray * per_mm)
    found = chords(ink.contours, edges, Widths(ink_least, ground), ink.frame)
    found = counting(_unknown(found, edges, known), search)
    told = places(found, search)
    for row, length in zip(told.chord.tolist(), (told.length / per_mm).tolist(), strict=True):
        kind, limit = (
            (Kind.LINE, limits.narrowest_line) if found.inked[row] else (Kind.GAP, limits.narrowest_gap)
        )
        value = float(found.width[row]) / per_mm
        what = "ink" if kind == Kind.LINE else "bare ground"
        along = f" over {mm(length)} mm" if length >= 2 * value else ""
        words = f"{what} only {mm(value)} mm wide{along}, the least is {mm(limit or 0.0)} mm"
        yield ink.finding(kind, found.middle[row], value, limit, words)


def _unknown(found: Chords, edges: Edges, known: set[int]) -> Chords:
    """Leave out chords within contours that are told of as narrow all over."""
    contour = edges.contour
    own = contour[found.one] == contour[found.other]
    return found.only(~(own & np.isin(contour[found.one], sorted(known))))


def _of_open(ink: _Ink) -> Iterator[Finding]:
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


def _of_doubles(inks: Sequence[_Ink], limits: Limits) -> list[Finding]:
    if limits.twice == Twice.ALL and len(inks) > 1:
        return _doubles_of(inks)
    if limits.twice == Twice.NO:
        return []
    return [finding for ink in inks for finding in _doubles_of([ink])]


def _doubles_of(inks: Sequence[_Ink]) -> list[Finding]:
    """Return what is drawn again, a finding for each stretch that two paths share."""
    counts = np.cumsum([0, *(len(ink.contours) for ink in inks)])
    path = np.concatenate(
        [ink.contours.of_point + first for ink, first in zip(inks, counts[:-1], strict=True)]
    )
    begin = np.concatenate([ink.contours.points for ink in inks])
    end = np.concatenate([ink.ends for ink in inks])
    found = doubles(begin, end)
    if not len(found.again):
        return []
    per_mm = inks[0].frame.per_mm
    length = np.hypot(*(found.end - found.begin).T) / per_mm
    findings = []
    for rows in _stretches(found, path):
        total = float(length[rows].sum())
        if total < LEAST_DOUBLE:
            continue
        row = int(rows[np.argmax(length[rows])])
        again, first = (
            inks[int(np.searchsorted(counts, path[each[row]], side="right")) - 1]
            for each in (found.again, found.first)
        )
        by = f" by ink {first.name}" if first is not again else ""
        words = f"{mm(total)} mm of path that was drawn{by} is drawn again"
        at = (found.begin[row] + found.end[row]) / 2
        findings.append(again.finding(Kind.DOUBLE, at, total, None, words))
    return findings


def _stretches(found: Doubles, path: Floats) -> list[Floats]:
    """Return the rows of what is drawn again that two paths share, and that hang together."""
    pairs = np.column_stack([path[found.again], path[found.first]])
    ends = np.concatenate([found.begin, found.end])
    _, node = np.unique(np.round(ends), axis=0, return_inverse=True)
    node = node.ravel()
    count = len(pairs)
    order = np.lexsort((node, np.tile(pairs[:, 1], 2), np.tile(pairs[:, 0], 2)))
    row = order % count
    keys = np.column_stack([pairs[row], node[order]])
    same = (np.diff(keys, axis=0) == 0).all(axis=1)
    group = components(count, np.column_stack([row[1:][same], row[:-1][same]]))
    rows = np.argsort(group, kind="stable")
    return np.split(rows, np.flatnonzero(np.diff(group[rows])) + 1)
