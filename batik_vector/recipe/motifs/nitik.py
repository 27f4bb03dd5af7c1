"""The nitik: dots and dashes on a grid, as threads of warp and weft would draw them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, replace
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.fields import Between, Says, check
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.shapes import rectangle
from batik_vector.geometry.sampling import Points
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import Composed, Keyed, part
from batik_vector.values import frozen

DOT, DASH, BLOCK = 0.5, (0.84, 0.4), 0.78
"""Sides of marks, in steps of the grid: a dot, a dash along and across, a block."""


@frozen(kw_only=True)
class Nitik(Composed):
    """Nitik: a square of side 1 about the origin, all of marks on a grid of threads, one mark to a crossing.

    Of flowers in its middle and, smaller, on its corners petals along the threads are of dashes and petals
    aslant of dots; a lozenge of dots runs between. On what is left, dashes lie along warp and weft in turn,
    as in a plain weave. The spout of the canting is split, so that its dots come out square: the
    *patola* of India, double ikat of silk, drawn in wax.
    """

    steps: Annotated[int, Between(12, 64), Says("steps of the grid to a side; even")] = 32
    size: Annotated[float, Between(0.3, 1.6), Says("size of a mark, as a share of its usual one")] = 1.0
    reach: Annotated[
        float, Between(0.3, 0.95), Says("of the petals, as a share of the way to the lozenge")
    ] = 0.86
    least: Annotated[
        float, Between(0, 0.9), Says("reach of the corners' petals, likewise; 0 leaves them out")
    ] = 0.6
    broad: Annotated[
        float, Between(0, 0.6), Says("half the breadth of a petal, as a share of its length")
    ] = 0.3
    petal: Annotated[Dress, Says("look of the petals along the threads")] = field(default_factory=Dress)
    slant: Annotated[Dress, Says("look of the petals aslant")] = field(default_factory=Dress)
    heart: Annotated[Dress, Says("look of the hearts")] = field(default_factory=Dress)
    frame: Annotated[Dress, Says("look of the lozenge")] = field(default_factory=Dress)
    ground: Annotated[Dress, Says("look of the ground")] = field(default_factory=Dress)
    grounded: Annotated[bool, Says("whether the ground is filled")] = True

    def __post_init__(self) -> None:
        check(self)
        if self.steps % 2:
            raise GeometryError(f"steps = {self.steps}: a lozenge closes on even numbers alone")
        self.parts()

    def compose(self) -> Iterator[Keyed]:
        """Yield the ground, the lozenge, petals and hearts."""
        half = self.steps // 2
        x, y = (each.ravel() for each in np.meshgrid(*[np.arange(-half, half)] * 2))
        # Beyond the lozenge the flower of the corner is the nearer one.
        far = np.abs(x) + np.abs(y) > half
        u, v = (np.where(far, half - np.abs(each), np.abs(each)) for each in (x, y))
        reach = half * np.where(far, self.least, self.reach)
        long, wide = np.maximum(u, v), np.minimum(u, v)
        heart = (u + v <= 1) & (reach > 0)
        frame = np.abs(x) + np.abs(y) == half
        body = self.broad * reach * np.sin(np.pi * np.clip(long / np.maximum(reach, 1), 0, 1))
        petal = (wide <= body) & (long <= reach) & (long > 1) & ~frame & (wide < 0.62 * long)
        slant = (long - wide <= 1) & (u + v <= 1.15 * reach) & (u + v > 2) & ~frame & ~petal
        taken = heart | frame | petal | slant
        # Ground keeps a step off petals, so that their outlines show.
        near = _beside(taken, self.steps)
        ground = ~taken & ~near & self.grounded
        across = u >= v
        odd = (x + y) % 2 == 1
        marks = (
            ("ground", self.ground, ground, odd, DASH),
            ("frame", self.frame, frame, odd, (DOT, DOT)),
            ("slant", self.slant, slant, odd, (DOT, DOT)),
            ("petal", self.petal, petal, across, DASH),
            ("heart", self.heart, heart, odd, (BLOCK, BLOCK)),
        )
        for key, look, chosen, upright, (along, aside) in marks:
            if chosen.any():
                side = self.size / self.steps
                places = np.column_stack([x, y])[chosen] / self.steps
                turned = upright[chosen]
                shapes = [
                    tiled(_block(side * along, side * aside), places[~turned]),
                    tiled(_block(side * aside, side * along), places[turned]),
                ]
                yield part(key, look, [each for each in shapes if len(each.points)])


def _beside(taken: NDArray[np.bool_], steps: int) -> NDArray[np.bool_]:
    """Return which crossings of the grid have one that is taken beside them, round the repeat."""
    grid = taken.reshape(steps, steps)
    shifts = [np.roll(grid, by, axis) for by in (-1, 1) for axis in (0, 1)]
    return np.asarray(np.any(shifts, axis=0).ravel())


def _block(width: float, height: float) -> Outline:
    """Return a mark about the origin, its corners round."""
    radius = 0.28 * min(width, height)
    shape = rectangle(-width / 2, -height / 2, width, height, radius, radius)
    return replace(shape, closed=np.array([True])).shut()


def tiled(shape: Outline, places: Points) -> Outline:
    """Return copies of an outline at places, shape (n, 2), as one."""
    points = (places[:, None, :] + shape.points[None, :, :]).reshape(-1, 2)
    return Outline(points, np.tile(shape.kinds, len(places)), np.tile(shape.closed, len(places)))
