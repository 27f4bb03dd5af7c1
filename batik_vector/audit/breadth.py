"""Breadth: lines, necks, gaps, holes and slivers below the limits of a machine."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from batik_vector.audit.chords import Chords, Widths, chords
from batik_vector.audit.edges import Edges, edges_of
from batik_vector.audit.measured import MeasuredInk
from batik_vector.audit.narrow import Search, counting, places
from batik_vector.audit.report import Finding, Kind, mm
from batik_vector.audit.thin import Thin, thin
from batik_vector.machines import Limits

LOOSE = 1.5
"""What a narrow place leads to is wider if it is so by this many times what edges stray on either side."""


def too_narrow(ink: MeasuredInk, limits: Limits, cuts: bool) -> Iterator[Finding]:
    """Yield everything about an ink that is too narrow.

    Args:
        ink: as measured.
        limits: of the machine.
        cuts: whether its lines are cuts, which have no breadth.
    """
    if not cuts:
        yield from _of_lines(ink, limits)
    marks = list(_of_thin(ink, limits))
    yield from (finding for _, finding in marks)
    yield from _of_chords(ink, limits, {contour for contour, _ in marks})


def _of_lines(ink: MeasuredInk, limits: Limits) -> Iterator[Finding]:
    """Yield one finding for all centre lines of an ink, which are as broad as it draws them."""
    lines = np.flatnonzero(~ink.contours.outline)
    limit = limits.narrowest_line
    if limit is None or not len(lines) or ink.width >= limit:
        return
    longest = int(lines[np.argmax(ink.length[lines])])
    first, stop = ink.contours.starts[longest : longest + 2].tolist()
    many = f"{len(lines):,} lines are" if len(lines) > 1 else "a line is"
    words = f"{many} {mm(ink.width)} mm wide, the least is {mm(limit)} mm"
    yield ink.finding(Kind.LINE, ink.contours.points[(first + stop) // 2], ink.width, limit, words)


def _of_thin(ink: MeasuredInk, limits: Limits) -> Iterator[tuple[int, Finding]]:
    """Yield the contours of marks and holes that are too narrow all over, with what is wrong."""
    for hole, limit in ((False, limits.narrowest_line), (True, limits.smallest_hole)):
        most = max(ink.least(limit), ink.least(limits.sliver))
        if most <= 0:
            continue
        with np.errstate(invalid="ignore"):
            which = np.flatnonzero(ink.area < 0 if hole else ink.area > 0)
        found = thin(ink.contours, which, ink.area, ink.length, most)
        for row in range(len(found.contour)):
            finding = _thin_finding(ink, found, row, hole, limits)
            if finding is not None:
                yield int(found.contour[row]), finding


def _thin_finding(ink: MeasuredInk, found: Thin, row: int, hole: bool, limits: Limits) -> Finding | None:
    value, length = (float(each[row]) / ink.frame.per_mm for each in (found.breadth, found.length))
    limit = limits.smallest_hole if hole else limits.narrowest_line
    kind = Kind.HOLE if hole else Kind.LINE
    if limits.sliver is not None and value < limits.sliver:
        kind, limit = Kind.SLIVER, limits.sliver
    if limit is None or value >= limit:
        return None
    what = "a hole" if hole else "a mark"
    words = f"{what} {mm(value)} mm wide and {mm(max(length, value))} mm long, the least is {mm(limit)} mm"
    return ink.finding(kind, found.at[row], value, limit, words)


def _of_chords(ink: MeasuredInk, limits: Limits, known: set[int]) -> Iterator[Finding]:
    """Yield the narrow necks and gaps of an ink, but for those of contours already told of."""
    least = Widths(ink.least(limits.narrowest_line), ink.least(limits.narrowest_gap))
    reach = max(least.ink, least.ground)
    if reach <= 0 or not len(ink.contours):
        return
    edges = edges_of(ink.contours, ink.ends)
    search = Search(ink.contours, edges, reach, LOOSE * ink.stray * ink.frame.per_mm)
    found = counting(_unknown(chords(ink.contours, edges, least, ink.frame), edges, known), search)
    told = places(found, search)
    for row, length in zip(told.chord.tolist(), (told.length / ink.frame.per_mm).tolist(), strict=True):
        yield _chord_finding(ink, found, row, length, limits)


def _chord_finding(ink: MeasuredInk, found: Chords, row: int, length: float, limits: Limits) -> Finding:
    value = float(found.width[row]) / ink.frame.per_mm
    kind, limit, what = Kind.GAP, limits.narrowest_gap, "bare ground"
    if found.inked[row]:
        kind, limit, what = Kind.LINE, limits.narrowest_line, "ink"
    along = f" over {mm(length)} mm" if length >= 2 * value else ""
    words = f"{what} only {mm(value)} mm wide{along}, the least is {mm(limit or 0.0)} mm"
    return ink.finding(kind, found.middle[row], value, limit, words)


def _unknown(found: Chords, edges: Edges, known: set[int]) -> Chords:
    """Leave out chords within contours that are told of as narrow all over."""
    contour = edges.contour
    own = contour[found.one] == contour[found.other]
    return found.only(~(own & np.isin(contour[found.one], sorted(known))))
