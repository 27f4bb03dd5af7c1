"""What the check of a stranger's tile may cost, counted and not timed: steps of our code, points measured."""

from __future__ import annotations

from math import cos, pi, sin

import pytest

from batik_vector.certificate import certify
from batik_vector.certificate.symmetry.agreement import Matcher
from batik_vector.geometry.paths.data import parse_path
from batik_vector.importing.svg import Reading, read_svg
from tests.budgets import Budgets, steps_run

BUDGETS = Budgets(
    {
        # Path data with a letter before every point: steps for a hundred letters.
        "letters: steps of our code for a hundred": 1,
        # Elements of a drawing, each a path of its own.
        "elements: steps of our code for each": 237,
        # A tile of many marks that all are one: points measured, for each point of its outline.
        "translations: points measured in full per point": 1.03,
    }
)
COLUMNS, ROWS, CORNERS = 36, 30, 12
"""Marks of a tile that stand in staggered rows: their translations divide it by no small number."""


def mark(x: float, y: float) -> str:
    turns = [2 * pi * k / CORNERS for k in range(CORNERS)]
    ends = [(x + 3 * cos(t) + cos(3 * t), y + 3 * sin(t)) for t in turns]
    return "M" + "L".join(f"{x:.3f} {y:.3f}" for x, y in ends) + "Z"


def tile(columns: int, rows: int) -> Reading:
    places = [(10 * i + 5 * (j % 2) + 5, 10 * j + 5) for j in range(rows) for i in range(-1, columns)]
    paths = "".join(f'<path d="{mark(*place)}"/>' for place in places)
    size = f'width="{10 * columns}mm" height="{10 * rows}mm" viewBox="0 0 {10 * columns} {10 * rows}"'
    return read_svg(f'<svg xmlns="http://www.w3.org/2000/svg" {size}>{paths}</svg>'.encode())


def test_path_data_cost_nothing_per_letter() -> None:
    few, many = ("M0 0" + "L1.5 2.25" * count + "Z" for count in (500, 10_500))
    spent = steps_run(lambda: parse_path(many)) - steps_run(lambda: parse_path(few))
    BUDGETS.hold("letters: steps of our code for a hundred", max(spent / 100, 1))


def test_elements_cost_alike() -> None:
    few, many = (steps_run(lambda n=n: tile(2, n)) for n in (2, 22))  # type: ignore[misc]
    BUDGETS.hold("elements: steps of our code for each", (many - few) / 60)


def test_translations_are_looked_for_in_a_cell_of_those_that_are_known(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    measured: list[int] = []
    points: list[int] = []
    real = Matcher._distances_of_all

    def counted(self: Matcher, *given: object) -> object:
        measured.append(len(self.all.kind))
        points.append(len(self.whole.kind))
        return real(self, *given)  # type: ignore[arg-type]

    reading = tile(COLUMNS, ROWS)
    monkeypatch.setattr(Matcher, "_distances_of_all", counted)
    found = certify(reading.artwork, bodies=reading.bodies)
    assert found.group == "cmm"
    BUDGETS.hold("translations: points measured in full per point", sum(measured) / points[0])
