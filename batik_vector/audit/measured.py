"""An ink as it is measured: its contours, what they enclose, and how findings about it are told."""

from __future__ import annotations

from batik_vector.audit.contours import Contours, Floats
from batik_vector.audit.drawn import DrawnInk
from batik_vector.audit.report import Finding, Kind
from batik_vector.audit.thin import enclosed
from batik_vector.certificate.drawing import Frame, InkDrawing
from batik_vector.values import frozen

STRAY = 0.1
"""Share of a limit that is let pass at most where edges stray from true curves."""


@frozen(eq=False)
class MeasuredInk:
    """An ink on the page: per contour the ``area`` that it encloses and its ``length``, in steps.

    ``ends`` is where the edge of each point ends, ``stray`` how far (mm) edges stray from true curves.
    ``strokes`` as in :class:`DrawnInk`.
    """

    name: str
    width: float
    contours: Contours
    ends: Floats
    area: Floats
    length: Floats
    frame: Frame
    stray: float
    strokes: InkDrawing | None

    def least(self, limit: float | None) -> float:
        """Return a limit (mm) in steps, less what is let pass because edges stray; 0 where there is none."""
        if limit is None:
            return 0.0
        return (limit - min(self.stray, STRAY * limit)) * self.frame.per_mm

    def finding(self, kind: Kind, at: Floats, value: float, limit: float | None, words: str) -> Finding:
        """Return what was found at a place (steps)."""
        return Finding(kind, self.name, self.frame.mm(float(at[0]), float(at[1])), value, limit, words)


def measured(ink: DrawnInk, frame: Frame, stray: float) -> MeasuredInk:
    """Return an ink with what its contours enclose."""
    ends = ink.contours.ends()
    area, length = enclosed(ink.contours, ends)
    return MeasuredInk(ink.name, ink.width, ink.contours, ends, area, length, frame, stray, ink.strokes)
