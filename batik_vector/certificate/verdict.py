"""Whether a tile passes: all checks, one after another, and the faults they found written down."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from batik_vector.artwork import Artwork, RawArtwork, breaches
from batik_vector.certificate.crossings import Crossings, area_crossings, break_faults
from batik_vector.certificate.density import profile, unevenness
from batik_vector.certificate.drawing import Drawing, InkDrawing, drawing, uncut
from batik_vector.certificate.duplicates import doubled_areas, doubled_lines, shared_lines
from batik_vector.certificate.expectations import Asked, has_more
from batik_vector.certificate.gaps import bare_gaps
from batik_vector.certificate.hints import hints
from batik_vector.certificate.identity import allowed, bleed_difference, rolled_difference
from batik_vector.certificate.line_ends import LineEnds, end_faults, line_ends
from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.picture.faults import joint_fault, stretches
from batik_vector.certificate.picture.joints import Joints, joints_of
from batik_vector.certificate.picture.rim import Rim
from batik_vector.certificate.recut import elsewhere
from batik_vector.certificate.report import (
    Certificate,
    EdgeStretch,
    Kind,
    Limits,
    Measures,
    SeamFault,
    together,
)
from batik_vector.certificate.seam import Seam, seams_of
from batik_vector.certificate.shifts import agreeing_shift, all_events, shift_fault
from batik_vector.certificate.slivers import sliver_fault, slivers
from batik_vector.certificate.symmetry.finder import PLAIN, STRETCH, found_group
from batik_vector.certificate.tangents import Turns, border_turns, line_turns, turn_faults
from batik_vector.fields import given
from batik_vector.tiling.symmetry.groups import group
from batik_vector.units import STEPS_PER_MM, format_mm

DEFAULT = Limits()


@dataclass
class _Ledger:
    """What has been found so far, of every ink."""

    limits: Limits
    noted: dict[str, list[Measures]]
    faults: list[SeamFault] = field(default_factory=list)
    along: list[EdgeStretch] = field(default_factory=list)

    def note(self, ink: InkDrawing, measures: Measures) -> None:
        self.noted[ink.ink.name].append(measures)

    def accuse(self, *faults: SeamFault) -> None:
        self.faults += faults


def certify(
    artwork: Artwork,
    *,
    asked: str | Asked | None = None,
    limits: Limits = DEFAULT,
    symmetry: bool = True,
    bodies: Bodies | None = None,
    unmeasured: Sequence[str] = (),
    remarked: Collection[Kind] = (),
) -> Certificate:
    """Measure the seams of a tile.

    Args:
        artwork: a tile. What breaks the normal form is a fault, but in a tile that was read from a foreign
            file (:class:`~batik_vector.artwork.RawArtwork`): there areas of one ink may overlap, rings be
            invalid, marks reach beyond the page. What lies beyond the page does not count as drawn, except
            in a bleed.
        asked: the symmetry group it ought to have, by any accepted name, that and no more; or what is
            asked of it in other words. None only reports the group.
        limits: how much is allowed.
        symmetry: whether to look for the symmetry group, which takes longest; it is done anyway where one
            was asked for.
        bodies: what a stranger's drawing paints along the edges of its page. With them it is the picture that
            has to meet at the seam, and not each ink for itself, and ink may end along it by design. Without
            them each ink is a plate of its own, and what may end at the seam stands in ``artwork.borders``.
        unmeasured: what is known to lie beyond all measures, in words.
        remarked: kinds of faults that are told, and let the tile pass.

    Raises:
        GeometryError: where a coordinate is not finite.
        UnknownNameError: where the group asked for is none.
    """
    given(artwork, Artwork, "artwork")
    given(asked, str | Asked | None, "asked")
    given(limits, Limits, "limits")
    wanted = Asked(group(asked).name) if isinstance(asked, str) else asked
    tile = drawing(artwork)
    ledger = _Ledger(limits, {ink.ink.name: [] for ink in tile})
    if not isinstance(artwork, RawArtwork):
        _check_form(artwork, ledger)
    joints = _check_crossings(tile, artwork, ledger, bodies)
    for ink in tile:
        _check_field(ink, tile, artwork, ledger)
        _check_doubles(ink, tile, ledger)
    if limits.between is not None:
        ledger.accuse(*shared_lines(tile.inks, tile.frame, limits), *bare_gaps(tile, limits.between))
    columns, rows = (_check_striping(tile, axis, ledger) for axis in (0, 1))
    found = _check_symmetry(artwork, wanted, ledger) if symmetry or wanted else None
    page = float(tile.frame.cell.columns) * tile.frame.cell.rows
    inks = {name: together(measures) for name, measures in ledger.noted.items()}
    apart = max((each.mismatch for each in joints), default=0.0)
    worst = together([*inks.values(), Measures(mismatch=apart)])
    return Certificate(
        title=artwork.title,
        cell=(artwork.cell.width, artwork.cell.height),
        drop=str(artwork.cell.drop),
        exact=tile.frame.exact,
        grid=1 / tile.frame.per_mm,
        limits=limits,
        worst=replace(worst, columns=columns, rows=rows),
        inks=inks,
        covers={ink.ink.name: float(shapely.area(ink.areas).sum()) / page for ink in tile},
        group=found,
        asked=wanted.name if wanted else None,
        faults=tuple(fault for fault in ledger.faults if fault.kind not in remarked),
        remarks=tuple(fault for fault in ledger.faults if fault.kind in remarked),
        along=stretches(joints, bodies) if bodies else tuple(ledger.along),
        hints=tuple(hints(ledger.faults, tile, bodies, joints, limits)),
        unmeasured=tuple(unmeasured),
    )


def _check_form(artwork: Artwork, ledger: _Ledger) -> None:
    """Accuse an artwork of what makes it none; what has no place is pointed at in the middle of the page."""
    middle = artwork.cell.width / 2, artwork.cell.height / 2
    for breach in breaches(artwork):
        ledger.accuse(SeamFault(Kind.FORM, breach.ink, breach.where or middle, breach.words, 0.0))


def _check_crossings(tile: Drawing, artwork: Artwork, ledger: _Ledger, bodies: Bodies | None) -> list[Joints]:
    """Measure what crosses the seams; return the joints of a drawing's bodies, seam by seam."""
    limits, finer = ledger.limits, tile.frame.per_mm // STEPS_PER_MM
    seams = seams_of(tile.frame)
    ends = [line_ends(ink, seams, artwork.borders, limits, finer) for ink in tile]
    rim = Rim(bodies, seams) if bodies else None
    joints = []
    for number, seam in enumerate(seams):
        borders = [area_crossings(ink, seam, artwork.borders, limits, finer) for ink in tile]
        lines = [each[number] for each in ends]
        for found in borders:
            ledger.along += found.along(limits.position)
            _note_turns(
                border_turns(found.ink, seam, found.paired, artwork.tolerance, limits),
                found.ink,
                seam,
                ledger,
            )
            _note_turns(line_turns(found.ink, seam, artwork.tolerance, limits), found.ink, seam, ledger)
        if bodies and rim:
            seen = joints_of(rim, seam, tile, limits)
            joints.append(seen)
            borders = [each.only(seen.touches) for each in borders]
            lines = [each.only(seen.touches) for each in lines]
        for crossed in borders:
            ledger.note(crossed.ink, crossed.measures)
        for ended in lines:
            ledger.note(ended.ink, ended.measures(limits.position))
        _accuse_breaks(borders, lines, seam, ledger)
        if bodies and rim:
            told = [
                place for kind in (borders, lines) for each in kind for place in each.broken(limits.position)
            ]
            ledger.accuse(*(joint_fault(each, seam, bodies) for each in seen.untold(told)))
    return joints


def _accuse_breaks(borders: list[Crossings], lines: list[LineEnds], seam: Seam, ledger: _Ledger) -> None:
    """Accuse a seam of each of its breaks; of one shift where that mends them all."""
    events = [found.events(number) for number, found in enumerate(borders)]
    events += [ended.events(number) for number, ended in enumerate(lines)]
    shift = agreeing_shift(
        all_events([near for near, _ in events]), all_events([far for _, far in events]), seam
    )
    if shift is None:
        for found in borders:
            ledger.accuse(*break_faults(found, ledger.limits))
        for ended in lines:
            ledger.accuse(*end_faults(ended, ledger.limits))
        return
    where = [
        place for kind in (borders, lines) for found in kind for place in found.broken(ledger.limits.position)
    ]
    if where:
        ledger.accuse(shift_fault(shift, seam, where[0], len(where)))


def _note_turns(turns: Turns, ink: InkDrawing, seam: Seam, ledger: _Ledger) -> None:
    worst = float(turns.kinks().max(initial=0.0))
    ledger.note(ink, Measures(turn=worst, corners=turns.corners(ledger.limits.tangent)))
    ledger.accuse(*turn_faults(turns, ink.ink.name, seam, ledger.limits))


def _check_field(ink: InkDrawing, tile: Drawing, artwork: Artwork, ledger: _Ledger) -> None:
    name, frame = ink.ink.name, tile.frame
    healed = elsewhere(ink.areas, frame)
    limit = allowed(ledger.limits.identity, ink.areas, frame)
    area, where = rolled_difference(ink.areas, healed, limit)
    if where is not None:
        words = f"the field cut elsewhere differs from the tile by {area:.3g} mm², {limit:.3g} are allowed"
        ledger.accuse(SeamFault(Kind.IDENTITY, name, where, words, area))
    if artwork.bleed > 0:
        bleed = round(artwork.bleed * frame.per_mm)
        beyond, where = bleed_difference(uncut(artwork, name, frame), ink.areas, frame, bleed, limit)
        if where is not None:
            words = f"the bleed differs from the tile it repeats by {beyond:.3g} mm², {limit:.3g} are allowed"
            ledger.accuse(SeamFault(Kind.IDENTITY, name, where, words, beyond))
        area = max(area, beyond)
    found = slivers(ink, healed, ledger.limits)
    length = sum(each.high - each.low for each in found) / frame.per_mm
    ledger.note(ink, Measures(identity=area, slivers=length))
    ledger.accuse(*(sliver_fault(each, name, frame) for each in found))


def _check_doubles(ink: InkDrawing, tile: Drawing, ledger: _Ledger) -> None:
    length, line_faults = doubled_lines(ink, tile.frame, ledger.limits)
    area, area_faults = doubled_areas(ink, tile.frame, ledger.limits)
    ledger.note(ink, Measures(doubled_length=length, doubled_area=area))
    ledger.accuse(*line_faults, *area_faults)


def _check_striping(tile: Drawing, axis: int, ledger: _Ledger) -> float:
    """Note how uneven each ink's columns (axis 0) or rows are; return it for all inks laid together."""
    sides = ("columns", "rows")
    total = np.zeros(1)
    for ink in tile:
        covered = profile(ink, tile.frame, axis)
        total = total + covered
        figure = unevenness(covered, tile.frame, axis)
        ledger.note(ink, Measures(columns=figure) if axis == 0 else Measures(rows=figure))
    figure = unevenness(total, tile.frame, axis)
    limit = ledger.limits.striping
    if limit is not None and figure > limit:
        x, y = tile.frame.cell.columns / 2, tile.frame.cell.rows / 2
        words = f"ink varies by {figure:.1f} % over the {sides[axis]}, {limit:.1f} % are allowed"
        ledger.accuse(SeamFault(Kind.STRIPING, "", tile.frame.mm(x, y), words, figure))
    return figure


def _check_symmetry(artwork: Artwork, asked: Asked | None, ledger: _Ledger) -> str:
    """Return the group found; accuse it of being another than the one asked for."""
    stretch = max(STRETCH, asked.stretch if asked else 0.0)
    found = found_group(
        artwork.layers, artwork.cell, artwork.tolerance, stretch=stretch, misses=asked is not None
    )
    # A page that is plain has every symmetry.
    if asked is None or asked.allows(found.name) or (found.note == PLAIN and not asked.exactly):
        return found.name
    words = f"the drawing has the symmetry group {found.name}, and {asked.name} was asked for"
    where, ink, amount = (artwork.cell.width / 2, artwork.cell.height / 2), "", 0.0
    if has_more(found.name, asked.name):
        words += ": it has more symmetry than that"
    elif found.misses:
        miss = found.misses[0]
        where, ink, amount = miss.place, miss.ink, miss.deviation
        words += f"; it misses the nearest other operation by {format_mm(amount)} mm here"
    ledger.accuse(SeamFault(Kind.SYMMETRY, ink, where, words, amount))
    return found.name
