"""Bands of rows: *lereng*, whose rows run aslant, and the bands of Miao cloth."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from batik_vector.errors import GeometryError
from batik_vector.fields import Says, check
from batik_vector.recipe.motifs.composing import Banded, Keyed, part
from batik_vector.recipe.motifs.rows import Row
from batik_vector.values import frozen

LERENG = (
    Row(kind="line", height=0.07),
    Row(kind="leaves", height=0.44, count=3, full=0.86),
    Row(kind="line", height=0.07),
    Row(kind="dots", height=0.16, count=8, full=0.62),
    Row(kind="line", height=0.07),
    Row(kind="blades", height=0.5, count=4, full=0.9),
    Row(kind="line", height=0.07),
    Row(kind="lozenges", height=0.22, count=4, full=0.8),
)
MIAO = (
    Row(kind="line", height=0.07),
    Row(kind="teeth", height=0.22, count=6, full=0.94),
    Row(kind="space", height=0.05),
    Row(kind="line", height=0.06),
    Row(kind="spirals", height=0.62, count=2, full=0.94),
    Row(kind="line", height=0.06),
    Row(kind="meander", height=0.3, count=2, full=0.8),
    Row(kind="line", height=0.06),
    Row(kind="space", height=0.05),
    Row(kind="teeth", height=0.22, count=6, full=0.94, flip=True),
    Row(kind="line", height=0.07),
)


@frozen(kw_only=True)
class Lereng(Banded):
    """Lereng: rows of marks one above the other, one link from x = 0 to 1, which ``stripes`` lays aslant.

    Unlike *parang*, its bands hold rows of small motifs, of one kind or several in turn (*udan liris*, light
    rain, has many), between plain rules.
    """

    rows: Annotated[tuple[Row, ...], Says("its rows, the lowest first")] = LERENG

    def __post_init__(self) -> None:
        check(self)
        if not any(row.kind != "space" for row in self.rows):
            raise GeometryError("the band is empty: expected rows that draw something")
        self.parts()

    @property
    def across(self) -> float:
        """How broad the band is, in links."""
        return sum(row.height for row in self.rows)

    def keys(self) -> tuple[str, ...]:
        """Return the keys of their tables, as ``parts`` has them."""
        return tuple(key for key, _ in self._composed)

    def compose(self) -> Iterator[Keyed]:
        """Yield the rows, the lowest first, about the middle of them all."""
        foot = -self.across / 2
        for number, row in enumerate(self.rows):
            shapes = row.outlines(foot + row.height / 2)
            if shapes:
                yield part(f"rows[{number}]", row, shapes, name=row.kind)
            foot += row.height


@frozen(kw_only=True)
class MiaoBand(Lereng):
    """Band of Miao cloth: saw teeth, rows of spirals (*wotuo*) and the thunder meander (*leigong*).

    As ``lereng``, with other rows: along the edges of quilt covers and sleeves, the patterns of bronze drums.
    """

    rows: Annotated[tuple[Row, ...], Says("its rows, the lowest first")] = MIAO
