"""What a layout is: copies of a motif, or a bending of it."""

from __future__ import annotations

from typing import Annotated, ClassVar, TypeAlias

from batik_vector.fields import Between, check
from batik_vector.geometry.ifs import Ifs
from batik_vector.geometry.maps.affine import Affine
from batik_vector.geometry.maps.affines import Affines
from batik_vector.values import frozen

Pair: TypeAlias = tuple[Annotated[float, Between(-1e4, 1e4)], Annotated[float, Between(-1e4, 1e4)]]
"""A vector in motif units."""


@frozen
class Bend:
    """Images that are no affine copies: the motif is moved by ``first`` and carried through ``system``."""

    first: Affine
    system: Ifs


def carried(first: Affine, system: Ifs) -> Affines | Bend:
    """Return what a system makes of a motif that ``first`` has moved: copies where no map bends."""
    affine = system.affine_images()
    return Bend(first, system) if affine is None else affine @ first


class Layout:
    """What every layout offers.

    ``spreads`` says whether a placement's width measures all copies together, ``deals`` whether several
    motifs may take its places in turn.
    """

    spreads: ClassVar[bool] = True
    deals: ClassVar[bool] = False

    def __post_init__(self) -> None:
        check(self)

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """Return the images of the motif; ``cell`` is the repeat's width and height in motif units.

        Of a layout that ``spreads``, the cell changes nothing.
        """
        raise NotImplementedError


@frozen(kw_only=True)
class Share(Layout):
    """What one of several motifs has of a layout that deals: every ``among``-th place from ``first`` on."""

    layout: Layout
    first: int
    among: int

    def images(self, cell: tuple[float, float]) -> Affines | Bend:
        """Its images of the layout's."""
        images = self.layout.images(cell)
        return images if isinstance(images, Bend) else images[self.first :: self.among]
