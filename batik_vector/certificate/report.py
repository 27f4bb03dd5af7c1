"""What a seam certificate says: limits, measures and faults, as plain values."""

from __future__ import annotations

import enum
import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, fields
from typing import Any

from batik_vector.errors import GeometryError
from batik_vector.fields import check
from batik_vector.values import frozen

Place = tuple[float, float]

DIGITS = 6
"""Decimals of every figure that leaves as plain values: nanometres, and far below every limit."""


class Kind(enum.StrEnum):
    """What may be wrong with a tile."""

    OFFSET = "offset"
    """A border crosses both edges, but not at the same place."""
    UNPAIRED = "unpaired"
    """One edge is covered, or met by a line, where its opposite is not."""
    SHIFT = "shift"
    """The edges as a whole stand shifted against one another: a wrong drop, a moved copy."""
    TANGENT = "tangent"
    """A border or a line turns where it crosses the seam."""
    IDENTITY = "identity"
    """The field cut elsewhere is not the tile, or the bleed does not repeat it."""
    ORDER = "order"
    """The same marks meet at the seam, and another of them lies on top."""
    TINT = "tint"
    """Two tints, or a colour that runs, meet at the seam."""
    SLIVER = "sliver"
    """A thin slit of ground, or strip of ink, runs along the seam."""
    DOUBLE = "double"
    """The same stretch of line, or the same area, is drawn twice."""
    BETWEEN = "between"
    """Two inks leave a bare gap between them that is thinner than was allowed, or draw the same line."""
    SYMMETRY = "symmetry"
    """The drawing has another symmetry group than was asked for."""
    STRIPING = "striping"
    """Ink is spread less evenly over columns or rows than was allowed."""
    FORM = "form"
    """The artwork breaks the normal form, and is no drawing that was only read."""


@frozen(kw_only=True)
class Limits:
    """How much is allowed before a measure becomes a fault."""

    position: float = 1e-4
    """How far (mm) a crossing and its twin may stand apart."""
    tangent: float = 0.1
    """How far (degrees) a border may turn on the seam beyond what its own sampling explains."""
    identity: float = 1e-6
    """Area (mm²) in which the tile and the field cut elsewhere may differ."""
    reach: float = 0.5
    """How far (mm) a displaced twin, or a mark that stops short of the seam, is looked for."""
    near: float = 0.5
    """How near (mm) to the seam slivers are looked for."""
    thin: float = 0.02
    """Slits and strips along the seam narrower than this (mm) are slivers."""
    double: float = 0.005
    """Lines this close (mm) along a stretch are one line drawn twice."""
    between: float | None = None
    """Bare gaps between two inks narrower than this (mm), and lines that two inks draw, are faults; None
    looks for none."""
    striping: float | None = None
    """Unevenness (percent) of columns or rows past which the tile fails; None only reports it."""

    @property
    def hair(self) -> float:
        """How far (mm) ink may stand from an edge and still be taken to end on it."""
        return self.position / 5

    def __post_init__(self) -> None:
        check(self)
        for name, value in vars(self).items():
            if value is not None and not 0 <= value < math.inf:
                raise GeometryError(f"{name} = {value}, expected a number from 0 on")


@frozen
class SeamFault:
    """One thing wrong with a tile.

    ``where`` is its place on the page in mm, y up; what lies on an edge lies on the opposite edge too.
    ``amount`` is in the unit of the measure that failed: mm, mm², degrees or percent.
    """

    kind: Kind
    ink: str
    where: Place
    words: str
    amount: float


@frozen
class EdgeStretch:
    """Ink that ends along an edge of the page by design: from ``low`` to ``high`` in mm along that edge.

    ``edge`` is "left", "right", "lower" or "upper".
    """

    edge: str
    ink: str
    low: float
    high: float


@frozen(kw_only=True)
class Measures:
    """What was measured of one ink, or of the whole tile: sums of counts and lengths, the worst of others.

    ``crossings`` counts borders and lines that leave by the left or lower edge and come in again by the
    opposite one; ``unpaired`` those (and gaps between them) that one edge alone has. ``mismatch`` is the
    worst displacement in mm, ``turn`` the worst turn on the seam in degrees beyond what sampling and
    rounding explain, ``corners`` how many crossings were taken for corners of the drawing. ``identity``
    is in mm², ``slivers`` the total length in mm of slivers along the seam, ``doubled_length`` in mm,
    ``doubled_area`` in mm². ``columns`` and ``rows`` are the striping in percent of the ink's mean; for the
    whole tile those of all inks laid together.
    """

    crossings: int = 0
    unpaired: int = 0
    mismatch: float = 0.0
    turn: float = 0.0
    corners: int = 0
    identity: float = 0.0
    slivers: float = 0.0
    doubled_length: float = 0.0
    doubled_area: float = 0.0
    columns: float = 0.0
    rows: float = 0.0


ADDED = ("crossings", "unpaired", "corners", "slivers", "doubled_length", "doubled_area")
"""Measures that are summed over inks and checks; of the others the worst counts."""


def together(parts: Iterable[Measures]) -> Measures:
    """Return measures of several inks, or by several checks, as one."""
    parts = list(parts)
    values: dict[str, Any] = {}
    for field in fields(Measures):
        each = [getattr(measures, field.name) for measures in parts]
        values[field.name] = sum(each) if field.name in ADDED else max(each, default=0.0)
    return Measures(**values)


@frozen(kw_only=True)
class Certificate:
    """The seam certificate of a tile: it passed if no fault was found.

    ``cell`` is its width and height in mm, ``drop`` as text ("0", "1/2"), ``group`` the symmetry group found
    in the geometry and ``asked`` the one expected, None where nobody looked or asked. ``exact`` says that all
    coordinates lie on the 1 µm grid; others are measured on a grid of ``grid`` mm. ``covers`` is the share of
    the page that the areas of each ink cover. ``remarks`` are told as faults are, and let the tile pass.
    ``along`` is the ink that ends along the page's edges by design, ``hints`` say what would mend a fault,
    and ``unmeasured`` what no verdict is given about.
    """

    title: str
    cell: tuple[float, float]
    drop: str
    exact: bool
    grid: float
    limits: Limits
    worst: Measures
    inks: Mapping[str, Measures]
    covers: Mapping[str, float]
    group: str | None
    asked: str | None
    faults: tuple[SeamFault, ...]
    remarks: tuple[SeamFault, ...] = ()
    along: tuple[EdgeStretch, ...] = ()
    hints: tuple[str, ...] = ()
    unmeasured: tuple[str, ...] = ()

    @property
    def passed(self) -> bool:
        """Whether nothing is wrong."""
        return not self.faults

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain values for JSON, in a fixed order and rounded to 1e-6."""
        return {
            "passed": self.passed,
            "title": self.title,
            "cell_mm": [_rounded(side) for side in self.cell],
            "drop": self.drop,
            "exact": self.exact,
            "grid_mm": self.grid,
            "symmetry": {"found": self.group, "asked": self.asked},
            "measures": _plain(asdict(self.worst)),
            "inks": {name: _plain(asdict(measures)) for name, measures in self.inks.items()},
            "limits": asdict(self.limits),
            "faults": [_fault(fault) for fault in self.faults],
            "remarks": [_fault(fault) for fault in self.remarks],
            "ends_along_edges": [
                {
                    "edge": each.edge,
                    "ink": each.ink,
                    "from_mm": _rounded(each.low),
                    "to_mm": _rounded(each.high),
                }
                for each in self.along
            ],
            "hints": list(self.hints),
            "unmeasured": list(self.unmeasured),
        }


def _fault(fault: SeamFault) -> dict[str, Any]:
    return {
        "kind": str(fault.kind),
        "ink": fault.ink,
        "where_mm": [_rounded(fault.where[0]), _rounded(fault.where[1])],
        "amount": _rounded(fault.amount),
        "words": fault.words,
    }


def _plain(values: dict[str, Any]) -> dict[str, Any]:
    return {name: value if isinstance(value, int) else _rounded(value) for name, value in values.items()}


def _rounded(value: float) -> float:
    """Round to what is written; never minus zero."""
    return round(float(value), DIGITS) + 0.0
