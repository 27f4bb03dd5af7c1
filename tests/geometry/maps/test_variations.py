"""Variations against their formulas and differences, the catalogue against the folder."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import batik_vector.geometry.maps as catalogue
from batik_vector.errors import GeometryError
from batik_vector.geometry.maps import VARIATIONS, FlameMap, JuliaN, Variation
from batik_vector.geometry.maps.affine import Affine

rng = np.random.default_rng(5)
POINTS = rng.uniform(-2, 2, (300, 2))
X, Y = POINTS.T
R = np.hypot(X, Y)
THETA = np.arctan2(Y, X)

FORMULAS = {
    "linear": (X, Y),
    "spherical": (X / R**2, Y / R**2),
    "swirl": (X * np.sin(R**2) - Y * np.cos(R**2), X * np.cos(R**2) + Y * np.sin(R**2)),
    "sinusoidal": (np.sin(X), np.sin(Y)),
    "bent": (np.where(X < 0, 2 * X, X), np.where(Y < 0, Y / 2, Y)),
}

JULIANS = [
    JuliaN(4, 4.0),
    JuliaN(4, 4 * 0.618),
    JuliaN(3, 1.0, "root"),
    JuliaN(-3, 1.0, "root"),
    JuliaN(5, -2.0, "root"),
    JuliaN(2, -1.0, "rotate"),
    JuliaN(4, 3.0, "literal"),
]


@pytest.mark.parametrize("name", sorted(FORMULAS))
def test_variations_are_their_formulas(name: str) -> None:
    image = FlameMap(((1.0, VARIATIONS[name]()),)).at(POINTS)
    np.testing.assert_allclose(image, np.column_stack(FORMULAS[name]), rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("julian", JULIANS[:-1], ids=str)
def test_julian_is_its_formula_on_every_branch(julian: JuliaN) -> None:
    for k in range(julian.branches):
        radius = R ** (julian.dist / julian.power)
        turn = 2 * math.pi * k / julian.power
        angle = THETA / julian.power + turn if julian.reading == "root" else THETA + turn
        image = FlameMap(((1.0, julian),)).at(POINTS, k)
        np.testing.assert_allclose(
            image, np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]), atol=1e-11
        )


@pytest.mark.parametrize("julian", JULIANS, ids=str)
@pytest.mark.parametrize("weights", [(1.0,), (0.7,), (1.0, 0.3)])
def test_all_branches_together_are_each_of_them_to_the_bit(
    julian: JuliaN, weights: tuple[float, ...]
) -> None:
    flame = FlameMap(tuple((weight, julian) for weight in weights), Affine.turn(20.0), Affine.scale(1.5))
    found = flame.every(POINTS)
    assert len(found) == flame.branches
    for branch, image in enumerate(found):
        assert image.tobytes() == flame.at(POINTS, branch).tobytes()


def test_julian_as_printed() -> None:
    radius = R ** (4 / 3.0)
    x = radius * np.cos(np.arccos(X / R) + 2 * math.pi / 4)
    y = radius * np.sin(np.arcsin(Y / R) + 2 * math.pi / 3)
    image = FlameMap(((1.0, JuliaN(4, 3.0, "literal")),)).at(POINTS)
    np.testing.assert_allclose(image, np.column_stack([x, y]), atol=1e-7)


EVERY: list[Variation] = [*(cls() for cls in VARIATIONS.values()), *JULIANS]


@pytest.mark.parametrize("variation", EVERY, ids=str)
def test_stretch_is_the_largest_singular_value_of_the_jacobian(variation: Variation) -> None:
    flame = FlameMap(((0.7, variation),))
    h = 1e-6
    columns = [
        (flame.at(POINTS + d) - flame.at(POINTS - d)) / (2 * h) for d in (np.array([h, 0]), np.array([0, h]))
    ]
    truth = np.linalg.norm(np.stack(columns, axis=2), 2, axis=(1, 2))
    smooth = np.abs(POINTS).min(axis=1) > 1e-3
    np.testing.assert_allclose(flame.stretch(POINTS)[smooth], truth[smooth], rtol=2e-4)


def test_stretch_is_finite_where_the_map_is_not() -> None:
    for variation in EVERY:
        assert np.isfinite(FlameMap(((1.0, variation),)).stretch(np.zeros((1, 2)))).all()


def test_nothing_in_the_folder_is_unlisted() -> None:
    folder = Path(catalogue.__file__).parent
    listed = {
        Path(__import__(cls.__module__, fromlist=["x"]).__file__ or "").stem for cls in VARIATIONS.values()
    }
    machinery = {"__init__", "affine", "affines", "base", "flame"}
    assert {path.stem for path in folder.glob("*.py")} == listed | machinery
    for name, cls in VARIATIONS.items():
        assert cls.name == name
        assert cls.__doc__
        assert "Flame" in cls.__doc__


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((0, 1.0), "power = 0"),
        ((65, 1.0), "power = 65, expected -64 to 64"),
        ((4, 0.0), "unit circle"),
        ((4, math.nan), "dist = nan"),
        ((4, 1.0, "rooot"), 'did you mean "root"'),
    ],
)
def test_julian_refuses_by_name(arguments: tuple[int, float], words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        JuliaN(*arguments)


def test_maps_refuse_what_they_cannot_sum() -> None:
    with pytest.raises(GeometryError, match="at least one"):
        FlameMap(())
    with pytest.raises(GeometryError, match="weight of linear"):
        FlameMap(((0.0, VARIATIONS["linear"]()),))
    with pytest.raises(GeometryError, match="branches"):
        FlameMap(tuple((1.0, JuliaN(64, 1.0)) for _ in range(3)))
