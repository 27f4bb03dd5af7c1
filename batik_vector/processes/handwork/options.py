"""What can be chosen of cracks and of a hand that draws."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, Useful, belongs
from batik_vector.processes.spec import ProcessSpec
from batik_vector.units import format_mm
from batik_vector.values import frozen

CLOTH = "cloth"
"""The name of bare cloth beside those of inks."""

Breadth: TypeAlias = Annotated[Length, Between(0.01, 10)]
Seed: TypeAlias = Annotated[int, Between(0, 2**31 - 1)]


@frozen(kw_only=True)
class CrackleProcess(ProcessSpec):
    """Cracks of the wax, through which the last dye came: a network of fine lines, across the seam too."""

    kind = "crackle"
    module = "batik_vector.processes.handwork.crackling"
    of_tile = True
    keeps_group = False

    density: Annotated[
        Annotated[Length, Between(0.5, 1000), Useful(3, 30)],
        Says("mean size of the pieces between cracks: the side of a square as large"),
    ] = 8.0
    seed: Annotated[Seed, Says("which cracks")] = 0
    width: Annotated[
        tuple[Breadth, Breadth],
        Says("breadth of the youngest crack, and of the oldest; most are narrow", called="youngest, oldest"),
    ] = (0.12, 0.6)
    dye: Annotated[
        str, Says("ink that came in through the cracks, or the cloth's ground (cloth); the darkest if unset")
    ] = ""
    wax: Annotated[
        tuple[str, ...],
        Says("inks that were waxed and have cracked, bare ground too (cloth); all but the dye"),
    ] = ()
    direction: Annotated[
        Annotated[float, Between(-360, 360)] | None,
        Says(
            "degrees from the right, anticlockwise, along which cracks run rather than across; any if unset"
        ),
    ] = None
    along: Annotated[Annotated[float, Between(0, 1)], Says("how much rather")] = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        least, greatest = self.width
        if least > greatest:
            raise GeometryError(
                f"width = [{format_mm(least)}, {format_mm(greatest)}], expected the least first"
            )
        if 2 * greatest > self.density:
            raise GeometryError(
                f"width = [{format_mm(least)}, {format_mm(greatest)}], expected at most "
                f"{format_mm(self.density / 2)} mm: half the density"
            )
        if self.direction is None:
            belongs(self, ("along",), "direction")


@frozen(kw_only=True)
class HandProcess(ProcessSpec):
    """A hand's line: it wavers, swells and tapers, and no two dots are quite alike."""

    kind = "hand"
    module = "batik_vector.processes.handwork.drawing"
    of_tile = True
    keeps_group = False

    strength: Annotated[
        Annotated[float, Between(0, 1), Useful(0.2, 0.8)], Says("how unsteady it is; 0 draws as before")
    ] = 0.5
    seed: Annotated[Seed, Says("whose hand")] = 0
    reach: Annotated[
        Annotated[Length, Between(1, 200), Useful(5, 20)], Says("how far a stroke goes before it wavers")
    ] = 9.0
    least: Annotated[
        Annotated[Length, Between(0.01, 20)] | None,
        Says("lines as broad as that stay so everywhere; half of what they were if unset"),
    ] = None
