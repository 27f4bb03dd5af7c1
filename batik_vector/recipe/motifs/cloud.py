"""The cloud of Cirebon, *mega mendung*: curls, and bands within them from wide to narrow."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace
from typing import Annotated, TypeAlias

import numpy as np
import shapely

from batik_vector.fields import Between, Says
from batik_vector.geometry.curves import Blade, OutlineCurve
from batik_vector.geometry.paths.geometries import outline_of
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.sampling import Array, Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import Composed, Isen, Keyed, Plate, part, stroke
from batik_vector.values import frozen

Inks: TypeAlias = tuple[str, ...]


@frozen(kw_only=True)
class CloudBands(Dress):
    """The bands of a cloud, within one another."""

    count: Annotated[int, Between(1, 12), Says("bands")] = 5
    width: Annotated[float, Between(0.01, 0.3), Says("breadth of the outmost, of a cloud 2 long")] = 0.085
    shrink: Annotated[float, Between(0.4, 1), Says("breadth of each, as a share of the one without")] = 0.84
    inks: Annotated[
        Inks, Says("inks of the bands, the outmost first, over and over; its own when left out")
    ] = ()


@frozen(kw_only=True)
class MegaMendung(Composed):
    """Mega mendung: a rain cloud 2 long, its back in swelling curls, its ends drawn out, band within band.

    Each band is the one without drawn in by an even breadth, wide at the rim and narrower inwards, so that
    dips of indigo deepen to the heart (https://en.wikipedia.org/wiki/Mega_mendung).
    """

    lobes: Annotated[int, Between(2, 9), Says("curls along its back")] = 5
    height: Annotated[float, Between(0.3, 1.4), Says("height of its back above its foot")] = 0.66
    lean: Annotated[float, Between(-0.6, 0.6), Says("where its highest curl stands: 0 in the middle")] = -0.16
    under: Annotated[int, Between(0, 6), Says("curls along its foot; 0 leaves it flat")] = 3
    body: Annotated[Plate, Says("look of the cloud beneath its bands")] = field(default_factory=Plate)
    band: Annotated[CloudBands, Says("the bands")] = field(default_factory=CloudBands)
    swirl: Annotated[Isen, Says("look of the lines that curl in from the clefts")] = field(
        default_factory=Isen
    )
    swirl_size: Annotated[
        float, Between(0, 0.06), Says("half the breadth of these lines; 0 leaves them out")
    ] = 0.0

    def compose(self) -> Iterator[Keyed]:
        """Yield the cloud, and its bands from the outmost inwards."""
        cloud = self._cloud()
        yield part("body", self.body, OutlineCurve(outline_of(cloud)))
        look, inks = replace(self.band, gap=0.0 if self.band.gap is None else self.band.gap), self.band.inks
        deep, width = 0.0, look.width
        for number in range(look.count):
            deep += width
            width *= look.shrink
            inner = shapely.buffer(cloud, -deep, quad_segs=ROUND)
            inner = shapely.simplify(shapely.buffer(inner, 0.0), FINE)
            if shapely.is_empty(inner) or inner.area < LEAST:
                break
            each = replace(look, ink=inks[number % len(inks)]) if inks else look
            yield part("band", each, OutlineCurve(outline_of(inner)), name=f"band {number + 1}")
        if self.swirl_size:
            yield part("swirl", self.swirl, self._swirls())

    def _lobes(self) -> tuple[Points, Array]:
        """Return middles and radii of the curls, those of the back and then those of the foot."""
        place = (np.arange(self.lobes) + 0.5) / self.lobes * 2 - 1
        rise = 1 - 0.62 * np.abs((place - self.lean) / (1 + abs(self.lean))) ** 1.6
        radius = 0.86 / self.lobes * (0.62 + 0.55 * rise) * min(1.0, 0.4 + self.height)
        top = np.column_stack([0.66 * place, np.maximum(self.height * rise - radius, 0.02)])
        if not self.under:
            return top, radius
        low = (np.arange(self.under) + 0.5) / self.under * 2 - 1
        small = 0.34 / self.under * (1 - 0.3 * np.abs(low)) * min(1.0, 0.4 + self.height)
        foot = np.column_stack([0.52 * low, np.full(self.under, -0.02)])
        return np.vstack([top, foot]), np.concatenate([radius, small])

    def _cloud(self) -> shapely.Geometry:
        """Return the outline: discs along the back and the foot, what is between them, and two tails."""
        at, radius = self._lobes()
        discs = shapely.buffer(shapely.points(at), radius, quad_segs=ROUND)
        back = at[: self.lobes]
        body = shapely.polygons(np.vstack([[[-0.7, 0.0]], back, [[0.7, 0.0]], [[0.4, -0.05], [-0.4, -0.05]]]))
        share = (np.arange(2 * ROUND) + 0.0) / (2 * ROUND)
        tail = Blade(0.72, 0.13 * min(1.0, 0.4 + self.height), 0.7, 1.5, 16.0)
        right = shapely.polygons(tail.at(share) * [1.0, -1.0] + [0.28, 0.07])
        left = shapely.polygons(tail.at(share) * [-1.0, -1.0] + [-0.28, 0.07])
        whole = shapely.union_all([*discs, shapely.buffer(body, 0.0), right, left])
        # Clefts are closed where nothing could be drawn in them.
        whole = shapely.buffer(shapely.buffer(whole, CLEFT, quad_segs=ROUND), -CLEFT, quad_segs=ROUND)
        whole = max(shapely.get_parts(whole), key=lambda each: float(each.area))
        cloud: shapely.Geometry = shapely.simplify(shapely.Polygon(whole.exterior), FINE)
        return cloud

    def _swirls(self) -> list[Outline]:
        """Return a spiral in each curl of the back."""
        at, radius = self._lobes()
        turn = np.linspace(0, 1.25, 16)
        coil = (0.12 + 0.5 * turn / 1.25) * np.exp(2j * np.pi * (turn - 0.5))
        found = []
        for (x, y), size in zip(at[: self.lobes].tolist(), radius[: self.lobes].tolist(), strict=True):
            line = size * coil + complex(x, y)
            half = min(self.swirl_size, 0.1 * size)
            found.append(stroke(np.column_stack([line.real, line.imag]), 0.7 * half, half))
        return found


ROUND = 24
"""Segments of a quarter of a circle."""
FINE = 2e-4
"""Tolerance of outlines: a hundredth of a millimetre on a cloud of 100 mm."""
CLEFT, LEAST = 0.012, 0.004
"""Radius of the narrowest cleft, and area of the smallest band."""
