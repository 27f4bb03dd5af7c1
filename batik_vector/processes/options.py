"""The catalogue of processes and what can be chosen of each, with bounds and help.

A process is a row here and a file beside this one, with ``apply(page, spec, machine) -> Prepared``. Importing
the catalogue costs nothing heavy.
"""

from __future__ import annotations

import enum
from dataclasses import field
from importlib import import_module
from typing import TYPE_CHECKING, Annotated, Self, TypeAlias

from batik_vector.errors import GeometryError, unknown_name
from batik_vector.fields import Between, Catalogue, Length, OneOf, Says, belongs, named
from batik_vector.processes.cutting.choices import Inks, Keep, LineBodies, Narrow, Start, Turns
from batik_vector.processes.handwork.options import CrackleProcess, HandProcess
from batik_vector.processes.hatching.options import AnyHatch
from batik_vector.processes.printing.options import MisregisterProcess, SeparateProcess
from batik_vector.processes.spec import ProcessSpec, StrokeProcess
from batik_vector.processes.stencilling.choices import Backing
from batik_vector.processes.trapping.choices import By, Covered
from batik_vector.processes.waxing.choices import CANTINGS, Plates, Removal
from batik_vector.units import format_mm
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.artwork import Artwork, Page
    from batik_vector.machines import Machine


class Once(enum.StrEnum):
    """Among which strokes what is drawn already is not drawn again."""

    INK = "ink"
    """Those of the same ink."""
    ALL = "all"
    """All: the ink that is drawn first keeps what several share."""


class Hidden(enum.StrEnum):
    """What becomes of strokes under areas of higher inks."""

    KEEP = "keep"
    """They are drawn."""
    REMOVE = "remove"
    """They are not, unless the higher ink overlays what lies beneath it."""


Pen = Annotated[int, Between(1, 98)]
"""A pen's number; 99 is the cloth's."""


@frozen(kw_only=True)
class PlotProcess(StrokeProcess):
    """Outlines and lines as strokes for a pen: each drawn once, joined, with short ways between."""

    kind = "plot"
    module = "batik_vector.processes.plot"

    once: Annotated[Once, Says("draw shared stretches once: within an ink (ink), or of all inks (all)")] = (
        Once.INK
    )
    join: Annotated[bool, Says("join strokes that meet to longest paths")] = True
    hidden: Annotated[
        Hidden, Says("what lies under areas of higher inks: keep it, or remove it unless they overlay")
    ] = Hidden.KEEP
    margin: Annotated[
        Annotated[Length, Between(0, 100)], Says("how far what is hidden ends before the area that hides it")
    ] = 0.0
    hatch: Annotated[AnyHatch | None, Says("how areas are filled; their outlines alone if unset")] = None
    edges: Annotated[bool, Says("draw outlines along the page's edges, where these cut marks off")] = False
    pens: Annotated[dict[str, Pen], Says("pens by inks; other inks have the next numbers that are free")] = (
        field(default_factory=dict)
    )
    width: Annotated[
        Annotated[Length, Between(0.01, 100)] | None,
        Says("breadth of the pens' lines; the machine's, or else each ink's"),
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.margin and self.hidden is Hidden.KEEP:
            raise GeometryError(f'margin = {format_mm(self.margin)}, expected hidden = "remove" beside it')


@frozen(kw_only=True)
class CutProcess(StrokeProcess):
    """Closed contours for a knife or a laser, the inner before the outer."""

    kind = "cut"
    module = "batik_vector.processes.cut"
    keeps_tile = False

    inks: Annotated[Inks, Says("out of one sheet all inks (together), or each out of its own (apart)")] = (
        Inks.TOGETHER
    )
    lines: Annotated[LineBodies, Says("lines are cut round as areas (body), left out (skip) or refused")] = (
        LineBodies.BODY
    )
    keep: Annotated[
        Keep, Says("what keeps its measure: what is drawn (ink), or what is around it (ground)")
    ] = Keep.INK
    kerf: Annotated[
        Annotated[Length, Between(0, 20)] | None,
        Says("breadth of what the cut takes away; the machine's if unset, or 0"),
    ] = None
    narrow: Annotated[
        Narrow, Says("places narrower than the kerf are refused, or accepted as they come out")
    ] = Narrow.REFUSE
    blade_offset: Annotated[
        Annotated[Length, Between(0, 10)] | None,
        Says("how far a drag knife's tip trails behind its axis; the machine's if unset, or 0"),
    ] = None
    corner: Annotated[float, Between(1, 180), Says("degrees of turn from which a bend is a corner")] = 20.0
    swivel: Annotated[
        float, Between(-360, 360), Says("degrees, the direction in which a drag knife is turned first")
    ] = 0.0
    precut: Annotated[
        Annotated[Length, Between(0, 100)] | None,
        Says("length of the cut beside the drawing that turns it so; 2 mm for a drag knife, or none"),
    ] = None
    overcut: Annotated[
        Annotated[Length, Between(0, 100)] | None,
        Says("how far a contour is cut on past its start; 1 mm for a drag knife, or none"),
    ] = None
    start: Annotated[
        Start | None,
        Says("where contours begin: on a corner, in a straight side (a drag knife), or nearest (all else)"),
    ] = None
    tabs: Annotated[int, Between(0, 100), Says("gaps that hold each part by its outer contour")] = 0
    tab_length: Annotated[Annotated[Length, Between(0.01, 100)], Says("breadth of a tab")] = 0.5
    tab_spacing: Annotated[
        Annotated[Length, Between(1, 100_000)] | None, Says("a tab for each so many mm, where that is more")
    ] = None
    weed_box: Annotated[
        Annotated[Length, Between(0, 1000)] | None, Says("cut a box so far around all; none if unset")
    ] = None
    weed_lines: Annotated[
        Annotated[Length, Between(1, 10_000)] | None,
        Says("cut what is around into strips so high at most; none if unset"),
    ] = None
    weed_margin: Annotated[Annotated[Length, Between(0, 100)], Says("how clear of the drawing they keep")] = (
        1.0
    )
    registration: Annotated[
        Annotated[Length, Between(1, 100)] | None,
        Says("size of crosses at the page's corners, in a layer of their own; none if unset"),
    ] = None
    sheet: Annotated[
        tuple[Annotated[Length, Between(1, 100_000)], Annotated[Length, Between(1, 100_000)]] | None,
        Says(
            "nest the pieces on a sheet of this breadth and height; they stay where they are if unset",
            called="sheet's breadth, sheet's height",
        ),
    ] = None
    gap: Annotated[Annotated[Length, Between(0, 1000)], Says("how far nested pieces keep apart")] = 3.0
    turns: Annotated[Turns, Says("how nested pieces may be turned")] = Turns.QUARTER
    sheet_number: Annotated[
        Annotated[int, Between(1, 1000)] | None, Says("which sheet the file holds, where there are several")
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.sheet_number is not None and self.sheet is None:
            raise GeometryError(f"sheet_number = {self.sheet_number}, expected the size of a sheet beside it")
        if self.sheet is None:
            belongs(self, ("gap", "turns"), "sheet, on which pieces are nested,")
        if not self.tabs and self.tab_spacing is None:
            belongs(self, ("tab_length",), "tabs or tab_spacing")
        if self.weed_lines is None:
            belongs(self, ("weed_margin",), "weed_lines")


Spout = Annotated[Length, Between(0.1, 50)]
"""The breadth of a line that a canting draws."""


@frozen(kw_only=True)
class StencilProcess(ProcessSpec):
    """Areas as openings of a sheet that is one piece, held by bridges, on the endless cloth."""

    kind = "stencil"
    module = "batik_vector.processes.stencil"
    of_tile = True

    bridge: Annotated[
        Annotated[Length, Between(0.1, 100)], Says("breadth of the bridges that hold islands")
    ] = 1.27
    inks: Annotated[Inks, Says("a stencil for each ink (apart), or one of all as they show (together)")] = (
        Inks.APART
    )
    lines: Annotated[
        LineBodies, Says("lines are open as broad as their ink (body), left out (skip) or refused")
    ] = LineBodies.BODY
    symmetric: Annotated[bool, Says("bridges follow the symmetry of what is open")] = True
    drop: Annotated[
        Annotated[Length, Between(0.01, 1000)] | None,
        Says("islands less across than that are left to fall out; none if unset"),
    ] = None
    neck: Annotated[
        Annotated[Length, Between(0.01, 100)] | None,
        Says("sheet narrower than that holds nothing; any neck holds if unset"),
    ] = None
    large: Annotated[
        Annotated[Length, Between(0.1, 100_000)] | None,
        Says("islands so much across or more are large, and held by more bridges; none if unset"),
    ] = None
    large_bridges: Annotated[int, Between(2, 8), Says("bridges that hold a large island, at least")] = 2
    backing: Annotated[
        Backing, Says("what holds the sheet: bridges alone (none), or a net, on which islands are legal")
    ] = Backing.NONE

    def apply(self, page: Page, machine: Machine) -> Artwork:
        """Return the tile of openings, a layer for each stencil; see :meth:`ProcessSpec.apply`."""
        done: Artwork = self._applied(page, machine)
        return done


@frozen(kw_only=True)
class WaxProcess(ProcessSpec):
    """Wax plates of a dyeing: what is waxed, and what scraped off again, before each bath."""

    kind = "wax"
    module = "batik_vector.processes.wax"

    removal: Annotated[
        Removal, Says("scrape wax off between baths (javanese), or add to it alone (add-only)")
    ] = Removal.JAVANESE
    plates: Annotated[
        Plates, Says("one for each step of the work (steps), or all wax in each bath (baths)")
    ] = Plates.STEPS
    plate: Annotated[
        str,
        Says("the one in the file, all as its layers (all), or what comes out (cloth); a file each if unset"),
    ] = ""
    mirror: Annotated[bool, Says("left and right changed, for the back of the cloth")] = False
    cantings: Annotated[
        dict[str, Spout], Says("breadths of the spouts that there are: the broadest that fits draws")
    ] = field(default_factory=lambda: dict(CANTINGS))
    multi_spouts: Annotated[
        dict[str, tuple[Spout, Annotated[int, Between(2, 12)]]],
        Says("by cantings that there are with several spouts in a row: from spout to spout, and how many"),
    ] = field(default_factory=dict)
    cap: Annotated[
        tuple[Annotated[Length, Between(5, 5000)], Annotated[Length, Between(5, 5000)]] | None,
        Says(
            "breadth and height of a stamp at most: a file for each that the repeat takes; none if unset",
            called="stamp's breadth, stamp's height",
        ),
    ] = None
    pins: Annotated[
        Annotated[Length, Between(0.2, 20)], Says("diameter of the pins at the corners of a stamp")
    ] = 2.0
    cap_number: Annotated[
        Annotated[int, Between(1, 10_000)] | None, Says("which stamp the file holds, where there are several")
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.cap_number is not None and self.cap is None:
            raise GeometryError(f"cap_number = {self.cap_number}, expected the size of a cap beside it")
        for name, (pitch, _) in self.multi_spouts.items():
            if name not in self.cantings:
                raise GeometryError(f"multi_spouts = {unknown_name(name, list(self.cantings), 'canting')}")
            if pitch <= self.cantings[name]:
                raise GeometryError(
                    f"multi_spouts = {format_mm(pitch)} mm of {name}, from spout to spout, expected more "
                    f"than the {format_mm(self.cantings[name])} mm that one draws"
                )

    def apply(self, page: Page, machine: Machine) -> Artwork:
        """Return a plate, all as layers, or the cloth; see :meth:`ProcessSpec.apply`."""
        done: Artwork = self._applied(page, machine)
        return done

    def parts(self, page: Page) -> list[tuple[str, Self]]:
        """Return a file for each plate, where none is named."""
        found: list[tuple[str, Self]] = import_module(self.module).parts(page, self)
        return found


@frozen(kw_only=True)
class TrapProcess(ProcessSpec):
    """Inks that meet side by side overlap a little: the one spreads under the other, across the seam too."""

    kind = "trap"
    module = "batik_vector.processes.trap"
    of_tile = True

    width: Annotated[
        Annotated[Length, Between(0.01, 2)], Says("how far one ink spreads under the other where they meet")
    ] = 0.3
    by: Annotated[
        By, Says("what spreads: the lighter of two inks (lightness), or the one printed first (order)")
    ] = By.LIGHTNESS
    covered: Annotated[
        Covered, Says("marks so narrow that a trap would cover them whole are refused, or accepted")
    ] = Covered.REFUSE


PROCESSES: Catalogue[type[ProcessSpec]] = Catalogue(
    "processes",
    {
        each.kind: each
        for each in (
            PlotProcess,
            CutProcess,
            StencilProcess,
            WaxProcess,
            TrapProcess,
            SeparateProcess,
            MisregisterProcess,
            CrackleProcess,
            HandProcess,
        )
    },
    lambda: ProcessSpec,
    named("kind", ProcessSpec),
)
"""The catalogue of processes."""

AnyProcess: TypeAlias = Annotated[ProcessSpec, OneOf(lambda: PROCESSES, "process")]
