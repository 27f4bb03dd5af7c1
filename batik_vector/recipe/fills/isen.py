"""The fill that chooses: isen by the size and the depth of each region, by the rules of a style."""

from __future__ import annotations

import enum
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Length, Says, Useful
from batik_vector.recipe.fills.base import Fill, Marks, Room
from batik_vector.recipe.fills.lines import Contours, Follow, Galaran, Hatching, Sawut, Sisik, VeinLines
from batik_vector.recipe.fills.marks import CacahGori, Cecek, Herangan, Rows, Ukel
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.geometry.fills.insets import Parts
    from batik_vector.geometry.sampling import Indices


class Style(enum.StrEnum):
    """Whose hand fills it."""

    SOLO = "solo"
    """Inland Java: strokes, scales and dots in rows, close and even."""
    PESISIR = "pesisir"
    """The coast: dots and strokes along the contour, veins, splinters, airy."""
    MIAO = "miao"
    """Guizhou: bands, spirals, saw teeth and fish scales."""


@frozen
class Rule:
    """Regions at least so deep, and so long for their depth, are filled in one of several ways.

    ``depth`` is the radius in mm of the largest circle within, ``long`` the area over the square of that:
    3.1 for a disc, 4 for a square, from about 7 for a leaf.
    """

    depth: float
    fills: tuple[Fill, ...]
    long: float = 0.0


_FINE = Cecek(follow=Rows.CONTOUR, spacing=1.6, width=0.55)
"""What the least of regions get."""

RULES: Mapping[Style, tuple[Rule, ...]] = {
    Style.SOLO: (
        Rule(
            9.0,
            (
                Sisik(spacing=4.6, width=0.6, margin=0.8),
                Cecek(follow=Rows.CONTOUR, spacing=2.2, width=0.9),
                Hatching(angle=45, spacing=3.0, width=0.6),
                Ukel(spacing=5.4, width=0.65),
            ),
        ),
        Rule(
            2.4,
            (
                VeinLines(spacing=2.8, width=0.6),
                Sawut(length=3.2, spacing=1.5, width=0.55),
                Galaran(follow=Follow.CONTOUR, spacing=1.7, width=0.6),
            ),
            long=6.5,
        ),
        Rule(
            4.0,
            (
                Sawut(length=3.4, spacing=1.6, width=0.6),
                Sisik(spacing=3.8, width=0.55),
                Cecek(spacing=2.1, angle=45, width=0.85),
                Galaran(angle=60, spacing=1.8, width=0.65),
            ),
        ),
        Rule(
            2.4,
            (
                Cecek(follow=Rows.CONTOUR, spacing=1.9, width=0.75),
                Sawut(length=1.8, spacing=1.4, width=0.55),
                Galaran(angle=45, spacing=1.7, width=0.6),
            ),
        ),
        Rule(1.2, (_FINE,)),
    ),
    Style.PESISIR: (
        Rule(
            9.0,
            (
                Cecek(follow=Rows.SCATTER, spacing=2.4, width=0.8),
                Sisik(spacing=5.0, width=0.6, margin=0.8),
                CacahGori(spacing=3.2, width=0.6, angle=45),
                Cecek(follow=Rows.CONTOUR, spacing=2.4, width=0.9),
            ),
        ),
        Rule(
            2.2,
            (
                VeinLines(spacing=2.6, width=0.55),
                Sawut(length=3.6, spacing=1.3, width=0.5),
                Cecek(follow=Rows.CONTOUR, rows=1, spacing=1.8, width=0.8),
            ),
            long=6.0,
        ),
        Rule(
            4.0,
            (
                Sawut(length=2.6, spacing=1.3, width=0.5),
                Cecek(follow=Rows.CONTOUR, spacing=2.0, width=0.8, rows=2),
                Herangan(spacing=2.4, width=0.5),
                Sisik(spacing=3.6, width=0.5),
            ),
        ),
        Rule(
            2.2,
            (
                Sawut(length=1.6, spacing=1.2, width=0.5),
                Cecek(follow=Rows.CONTOUR, spacing=1.8, width=0.7, rows=1),
            ),
        ),
        Rule(1.2, (_FINE,)),
    ),
    Style.MIAO: (
        Rule(
            9.0,
            (
                Ukel(spacing=6.0, width=0.8, margin=0.9),
                Contours(spacing=2.6, width=0.9, margin=1.0),
                Sisik(spacing=5.0, width=0.75, margin=0.9),
                Hatching(angle=45, spacing=3.6, width=0.75),
            ),
        ),
        Rule(
            2.4,
            (
                Contours(spacing=2.0, width=0.8, margin=0.8),
                VeinLines(spacing=3.0, width=0.7),
                Sawut(length=3.0, spacing=1.7, width=0.75),
            ),
            long=6.5,
        ),
        Rule(
            4.0,
            (
                Contours(spacing=2.2, width=0.8, margin=0.9),
                Sawut(length=2.6, spacing=1.9, width=0.8),
                Ukel(spacing=4.6, width=0.7),
                Sisik(spacing=4.0, width=0.7),
            ),
        ),
        Rule(
            2.2,
            (
                Contours(spacing=1.9, width=0.75, margin=0.8),
                Cecek(follow=Rows.CONTOUR, spacing=2.0, width=0.9, margin=0.8),
            ),
        ),
        Rule(1.3, (Cecek(follow=Rows.CONTOUR, spacing=1.9, width=0.8),)),
    ),
}
"""The rules of each style, the first that fits a region holds; what fits none stays plain. Marks are those of
workshops' samplers, lengths those of isen cantings; a rule is a row to be changed."""


@frozen
class Chosen:
    """Which rule and which of its fills a region gets; -1 and -1 for none."""

    rule: Indices
    fill: Indices


def measured(parts: Parts) -> tuple[Any, Any]:
    """Return how deep parts are (mm), and how long for their depth."""
    import numpy as np
    import shapely

    depth = shapely.length(shapely.maximum_inscribed_circle(parts.shapes))
    with np.errstate(divide="ignore"):
        return depth, shapely.area(parts.shapes) / depth**2


def chosen(style: Style, parts: Parts, coarse: float = 1.0) -> Chosen:
    """Return what the rules of a style choose for parts.

    Of the fills of a rule those that are alike in size get the same, and sizes get them in turn, so that
    petals are filled alike and their neighbours otherwise; mirror images are the same size.

    Args:
        style: whose rules.
        parts: to be filled, in mm.
        coarse: times as large as the rules say.
    """
    import numpy as np
    import shapely

    depth, long = measured(parts)
    rule = np.full(len(depth), -1, np.intp)
    for number, each in enumerate(RULES[style]):
        fits = (rule < 0) & (depth >= each.depth * coarse) & (long >= each.long)
        rule[fits] = number
    # Areas within a fifth of one another are of one size.
    size = np.round(np.log2(shapely.area(parts.shapes) / coarse**2) * 3).astype(np.intp)
    many = np.array([len(each.fills) for each in RULES[style]] + [1], np.intp)
    return Chosen(rule, np.where(rule < 0, -1, size % many[rule]))


@frozen(kw_only=True)
class Isen(Fill):
    """Whatever suits each region: chosen by its size and depth on cloth, by the rules of a style."""

    kind = "isen"
    whole = False
    may_be_none = True

    PLAIN: ClassVar[tuple[float, float, float]] = (2.0, 0.6, 0.7)
    """Spacing, width and margin at which the marks are as large as the rules say."""

    style: Annotated[Style, Says("whose rules choose")] = Style.SOLO
    spacing: Annotated[
        Annotated[Length, Between(0.05, 1000)],
        Useful(1.4, 4),
        Says("how coarse it is: 2 mm is as the rules say, and all lengths go with it"),
    ] = 2.0
    width: Annotated[
        Annotated[Length, Between(0.01, 100)],
        Useful(0.4, 1.2),
        Says("how bold it is: 0.6 mm is as the rules say"),
    ] = 0.6
    margin: Annotated[
        Annotated[Length, Between(0, 1000)],
        Useful(0.4, 2),
        Says("how much is bare at the edge: 0.7 mm is as the rules say"),
    ] = 0.7

    def __post_init__(self) -> None:
        super().__post_init__()
        for rule in RULES[self.style]:
            for fill in rule.fills:
                try:
                    self.scaled(fill)
                except GeometryError as error:
                    raise GeometryError(f"{fill.kind}, which it may choose: {error}") from None

    def scaled(self, fill: Fill) -> Fill:
        """Return a fill of the rules as coarse and as bold as this one is."""
        coarse, bold, bare = (
            own / plain
            for own, plain in zip((self.spacing, self.width, self.margin), self.PLAIN, strict=True)
        )
        more = {"length": fill.length * coarse} if isinstance(fill, Sawut) else {}
        return replace(
            fill,
            ink=self.ink,
            spacing=fill.spacing * coarse,
            width=fill.width * bold,
            margin=fill.margin * bare,
            **more,
        )

    def _laid(self, room: Room) -> Marks:
        import numpy as np

        found = chosen(self.style, room.parts, self.spacing / self.PLAIN[0])
        marks: list[Any] = [np.empty(0, dtype=object)]
        regions = [np.empty(0, np.intp)]
        for number, rule in enumerate(RULES[self.style]):
            for place, fill in enumerate(rule.fills):
                mine = np.flatnonzero((found.rule == number) & (found.fill == place))
                if len(mine):
                    own = room._replace(parts=room.parts.taken(mine))
                    laid, of = self.scaled(fill).lay(own)
                    marks.append(laid)
                    regions.append(of)
        return np.concatenate(marks), np.concatenate(regions)
