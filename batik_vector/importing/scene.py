"""What a walk over a drawing finds: painted shapes, and what holds at one place of the tree."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace

from batik_vector.geometry.paths.matrix import Matrix
from batik_vector.geometry.paths.outline import Outline
from batik_vector.importing.clip_paths import Clip
from batik_vector.importing.gradients import Gradient
from batik_vector.importing.painting import Paint
from batik_vector.importing.patterns import Pattern
from batik_vector.importing.pens import Pen
from batik_vector.importing.styles import Style
from batik_vector.values import frozen


@frozen(eq=False)
class Shape:
    """Something painted: its outline in mm on the page, y down, and how it is filled and stroked.

    ``fill`` and ``stroke`` are ``#rrggbb``, or nothing. ``label`` is the name of the layer it lies in,
    ``name`` its own. ``width`` is the stroke's, in mm. ``looks`` are the paints of fill and stroke as they
    show on a screen, None where that cannot be told, and ``pen`` is how a stroke's body is drawn. Of all
    that, what lies in every one of ``clips`` shows. A ``tiling`` stands for a fill by a pattern. ``trail``
    are the elements that lead to it from the root. ``stroke_first`` says that the stroke lies under
    the fill, ``lean`` how its pen is distorted (:func:`~batik_vector.importing.pens.lean_of`).
    """

    outline: Outline
    label: str
    name: str
    fill: str
    rule: str
    stroke: str
    width: float
    looks: tuple[Paint | None, Paint | None]
    pen: Pen
    clips: tuple[Clip, ...] = ()
    tiling: Tiling | None = None
    trail: tuple[ET.Element, ...] = ()
    stroke_first: bool = False
    lean: Matrix | None = None

    def under(self, matrix: Matrix) -> Shape:
        """Return the shape with paints for a page that is moved by an affine map, its outline left alone."""
        if all(look is None or look.ramp is None for look in self.looks):
            return self
        one, other = (None if look is None else _under(look, matrix) for look in self.looks)
        return replace(self, looks=(one, other))


@frozen
class Here:
    """What holds at one place of the tree."""

    matrix: Matrix
    style: Style
    label: str = ""
    size: tuple[float, float] = (0.0, 0.0)
    used: tuple[ET.Element, ...] = ()
    depth: int = 0
    clips: tuple[Clip, ...] = ()
    opacity: float = 1.0
    trail: tuple[ET.Element, ...] = ()


@frozen(eq=False)
class Tiling:
    """A fill by a pattern whose cells are still to be drawn; ``here`` is where the filled mark stands."""

    element: ET.Element
    pattern: Pattern
    here: Here


def _under(look: Paint, matrix: Matrix) -> Paint:
    return replace(look, ramp=look.ramp.under(matrix)) if isinstance(look.ramp, Gradient) else look
