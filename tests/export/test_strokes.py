"""Strokes: curves that a tile's edge cuts stay in the tile, and go on smoothly at the opposite edge."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from batik_vector import compile_recipe, load_recipe
from batik_vector.artwork import Artwork
from batik_vector.export.strokes import CURVE, MOVE, Pen, Strokes

SAMPLES = Path(__file__).parents[2] / "samples"


def curves(artwork: Artwork, downwards: bool = False) -> np.ndarray:
    """All cubics of a tile, shape (m, 4, 2), in steps."""

    def of(strokes: Strokes) -> np.ndarray:
        last = np.flatnonzero(strokes.kinds == CURVE)
        return np.asarray(strokes.points[last[:, None] + np.arange(-3, 1)])

    pen = Pen(artwork, artwork.tolerance, downwards)
    found = [
        of(pen.strokes(outlines, number, "areas"))
        for number in range(len(artwork.plates))
        for outlines in artwork.areas(number)
    ]
    return np.concatenate(found).astype(float)


def handles(cubics: np.ndarray, axis: int, edge: int) -> dict[int, list[complex]]:
    """The handles of cubics that begin or end on an edge, by their place on it."""
    found: dict[int, list[complex]] = {}
    for node, handle in ((0, 1), (3, 2)):
        for cubic in cubics[cubics[:, node, axis] == edge]:
            x, y = cubic[handle] - cubic[node]
            found.setdefault(int(cubic[node, 1 - axis]), []).append(complex(x, y))
    return found


def turns(artwork: Artwork, downwards: bool = False) -> list[float]:
    """Degrees by which curves turn where they cross the seam, less what rounding their handles explains."""
    cubics = curves(artwork, downwards)
    found = []
    for axis, side in ((0, artwork.cell.columns), (1, artwork.cell.rows)):
        near, far = handles(cubics, axis, 0), handles(cubics, axis, side)
        for place in near.keys() & far.keys():
            for one in near[place]:
                angle, other = min((abs(np.angle(-one / other, deg=True)), other) for other in far[place])
                found.append(max(angle - np.degrees(0.71 / abs(one) + 0.71 / abs(other)), 0.0))
    return found


@pytest.fixture(scope="module", params=["mega-mendung", "group-p4", "cockscomb"])
def tile(request: pytest.FixtureRequest) -> Artwork:
    return compile_recipe(load_recipe(SAMPLES / f"{request.param}.toml"))


@pytest.mark.parametrize("downwards", [False, True])
def test_curves_go_on_beyond_the_seam(tile: Artwork, downwards: bool) -> None:
    found = turns(tile, downwards)
    assert len(found) >= 20
    assert max(found) < 0.05


def test_without_the_other_half_they_would_not(monkeypatch: pytest.MonkeyPatch, tile: Artwork) -> None:
    monkeypatch.setattr(Pen, "_known", lambda *_: None)
    assert max(turns(tile)) > 0.2


def test_curves_do_not_leave_the_tile() -> None:
    artwork = compile_recipe(load_recipe(SAMPLES / "four-square.toml"))
    cubics = curves(artwork)
    u = np.linspace(0, 1, 65)
    basis = np.stack([(1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u * u * (1 - u), u**3], axis=1)
    drawn = np.einsum("ij,mjk->mik", basis, cubics)
    side = [artwork.cell.columns, artwork.cell.rows]
    assert drawn.min() >= -1e-6
    assert (drawn.max(axis=(0, 1)) <= np.array(side) + 1e-6).all()
    at_edge = ((cubics[:, (0, 3)] == 0) | (cubics[:, (0, 3)] == side)).any(axis=(1, 2))
    assert at_edge.sum() > 20
    assert cubics[at_edge].min() >= 0
    assert (cubics[at_edge].max(axis=(0, 1)) <= side).all()


def test_pieces_of_a_page_know_of_one_another(monkeypatch: pytest.MonkeyPatch, tile: Artwork) -> None:
    from batik_vector.artwork import page

    whole = curves(tile)
    monkeypatch.setattr(page, "PIECE", 200)
    assert sum(1 for _ in tile.areas(0)) > 1
    assert np.abs(curves(tile) - whole).max() <= 1


def test_a_pen_without_a_tolerance_draws_lines(tile: Artwork) -> None:
    (outlines, *_) = tile.areas(0)
    kinds = Pen(tile, None).strokes(outlines, 0, "areas").kinds
    assert (kinds == MOVE).sum() == len(outlines.closed)
    assert not (kinds == CURVE).any()
