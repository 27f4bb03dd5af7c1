"""What is asked of the processes: how a draft is to be looked at, and what is to be exported.

Plain values, for a server that imports no geometry.
"""

from __future__ import annotations

from batik_vector.errors import GeometryError
from batik_vector.values import frozen

KINDS = ("tile", "three", "field", "yardage", "cushion", "shirt")
"""What can be looked at: the tile, 3 × 3 of it, a field as large as ``View.across`` and ``up`` say, the
recipe's cloth, and the cloth on forms."""
SCREEN = 0.15
"""mm that an edge may stand from the true curve on screen: half a pixel of a tile of 300 mm."""


@frozen
class View:
    """How a draft is looked at.

    Args:
        kind: one of ``KINDS``.
        look: ``cloth`` for cloth and wax, or ``lines`` for outlines alone.
        tolerance: mm that edges may stand from the true curves, where the recipe does not allow more.
        across, up: tiles of a field.
        certify: whether the tile is measured too, for the verdict.
        pointers: whether what the certificate finds wrong is marked in the picture, in a layer "check".
        floor: whether the tile is held to what ``batik-vector random`` asks of a variation.
        motif: name of a motif that is looked at alone, whatever the kind; nothing for the whole.
        colourway: name of the colourway, or palette, in whose colours it is; nothing for the recipe's own.
        rough: whether it is looked at for a moment alone, while a slider moves: edges may be some pixels off.
    """

    kind: str = "tile"
    look: str = "cloth"
    tolerance: float = SCREEN
    across: int = 4
    up: int = 4
    certify: bool = False
    pointers: bool = False
    rough: bool = False
    floor: bool = False
    motif: str = ""
    colourway: str = ""

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise GeometryError(f"a view of kind {self.kind}, expected one of {', '.join(KINDS)}")


@frozen
class Wishes:
    """What is to be exported.

    Args:
        formats: names of formats; those that the recipe's outputs ask for when left out, or else SVG.
        processes: words as ``--process`` takes them, for all files.
        machine: as ``--machine`` takes it.
        recipe: whether the recipe itself is among the files, with the drawings that it carries.
        colourways: as ``--colourway`` takes them: names, or "all"; each file once for each of them.
    """

    formats: tuple[str, ...] = ()
    processes: tuple[str, ...] = ()
    machine: str = ""
    recipe: bool = False
    colourways: tuple[str, ...] = ()
