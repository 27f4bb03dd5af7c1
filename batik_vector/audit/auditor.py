"""The auditor: a drawing is held to what a machine can do, one limit after another."""

from __future__ import annotations

from batik_vector.artwork import Artwork
from batik_vector.audit.breadth import too_narrow
from batik_vector.audit.drawn import drawn
from batik_vector.audit.measured import measured
from batik_vector.audit.paths import crowded_nodes, drawn_again, open_paths
from batik_vector.audit.report import Audit, Finding, Kind, mm, sorted_findings
from batik_vector.fields import given
from batik_vector.machines import Limits, Machine, Twice


def audit(
    artwork: Artwork, machine: Machine, *, name: str = "", page: tuple[float, float] | None = None
) -> Audit:
    """Hold a tile to what a machine can do.

    Args:
        artwork: a tile, this program's or a stranger's: marks go on over its edges as it repeats.
        machine: what its profile leaves unset is not measured.
        name: what the machine is called in the report.
        page: width and height (mm) of what the machine is to make; the tile's when left out.

    Raises:
        GeometryError: where a coordinate is not finite.
    """
    given(artwork, Artwork, "artwork")
    given(machine, Machine, "machine")
    limits = machine.limits
    # What a cutter follows is a cut: its breadth is the kerf's, and no ink's.
    cuts = machine.tool.kerf is not None
    frame, inks = drawn(artwork, cuts)
    found = list(_too_large(page or (artwork.cell.width, artwork.cell.height), machine))
    known = [measured(ink, frame, artwork.tolerance) for ink in inks]
    for ink in known:
        found += too_narrow(ink, limits, cuts)
        if limits.closed:
            found += open_paths(ink)
        if limits.most_nodes is not None:
            found += crowded_nodes(ink, limits.most_nodes)
    found += drawn_again(known, limits.twice)
    return Audit(machine=name, findings=sorted_findings(found), measured=_measured(machine))


def _measured(machine: Machine) -> tuple[Kind, ...]:
    limits: Limits = machine.limits
    asked = {
        Kind.SIZE: machine.size is not None,
        Kind.OPEN: limits.closed,
        Kind.DOUBLE: limits.twice != Twice.NO,
        Kind.SLIVER: limits.sliver is not None,
        Kind.LINE: limits.narrowest_line is not None,
        Kind.GAP: limits.narrowest_gap is not None,
        Kind.HOLE: limits.smallest_hole is not None,
        Kind.NODES: limits.most_nodes is not None,
    }
    return tuple(kind for kind, is_asked in asked.items() if is_asked)


def _too_large(page: tuple[float, float], machine: Machine) -> list[Finding]:
    """Return what reaches beyond the machine, the drawing turned by a quarter if it fits better so."""
    if machine.size is None:
        return []
    ways = [_beyond(page, machine.size), _beyond((page[1], page[0]), machine.size)]
    # Only what may lie either way on a bed can be turned: a cloth that repeats runs one way.
    best = ways[0] if machine.limits.repeats else min(ways, key=len)
    width, height = machine.size
    found = []
    for side, limit in best:
        words = (
            f"{mm(page[0])} × {mm(page[1])} mm are drawn, and the machine reaches {mm(width)} × "
            f"{mm(height)} mm"
        )
        found.append(Finding(Kind.SIZE, "", (page[0], page[1]), side, limit, words))
    return found


def _beyond(page: tuple[float, float], size: tuple[float, float]) -> list[tuple[float, float]]:
    return [(side, limit) for side, limit in zip(page, size, strict=True) if side > limit]
