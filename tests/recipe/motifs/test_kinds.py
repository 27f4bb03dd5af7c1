"""What is true of every plant and animal: valid, named, in bounds, and as symmetric as it should be."""

from __future__ import annotations

import typing
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.errors import GeometryError
from batik_vector.fields import Between
from batik_vector.recipe.figures import Figure, draw
from batik_vector.recipe.look import Dress, Treatment
from batik_vector.recipe.motif import MOTIFS
from batik_vector.recipe.motifs.composing import Composed
from tests.thorough import examples, long, rarely

KINDS: dict[str, type[Composed]] = {name: kind for name, kind in MOTIFS.items() if issubclass(kind, Composed)}
TOLERANCE = 2e-3
NAMES = {
    "butterfly": "feeler, hind, cell, spot, fore, body, ring, head, eye",
    "polar-butterfly": "feeler, wing, cell, heart, spot, body, ring, head, eye",
    "fish": "tail, ray, fin, body, scale, gill, eye, pupil",
    "bird": "tail, rib, tail eye, crest, crest eye, body, spot, wing, covert, shoulder, whorl, beak, head, "
    "eye, pupil",
    "chrysanthemum": "petal, vein, core, stamen",
    "sunflower": "petal, vein, disc, seed",
    "lotus": "stalk, stamen, petal, vein, sepal",
    "peach": "stalk, leaf, vein, fruit, furrow, spot",
    "cockscomb": "stalk, leaf, vein, comb, inner, plume, spot",
    "leaf": "stalk, blade, vein",
    "vine": "tendril, leaf, vein, stem",
    "parang": "mlinjon, pip, rule, tongue, gareng, blade, spine",
    "lereng": "line, leaves, dots, blades, lozenges",
    "miao-band": "line, teeth, spirals, meander",
    "tumpal": "pendant, edge, body, frame, inner, tree",
    "pucuk-rebung": "bead, body, sheath, heart, seed",
    "kawung": "star, cecek, bean, ditch, flesh, seed, heart",
    "truntum": "spark, ray, petal, vein, core, small",
    "ceplok": "frame, cecek, corner, core, leaf, vein, petal, wreath",
    "jlamprang": "corner, cross, ray, block, petal, slit, core",
    "mega-mendung": "body, band 1, band 2, band 3, band 4, band 5",
    "buketan": "tendril, stem, leaf, vein, bud, sepal, petal, core, stamen",
    "nitik": "ground, frame, slant, petal, heart",
}
MIRRORED = dict.fromkeys(("butterfly", "polar-butterfly", "chrysanthemum", "lotus", "cockscomb"), 90.0)
"""Degrees to which the axis of those points that are their own mirror images."""
LOOK = {each.name for each in fields(Dress)}


def numbers(made: Any, at: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], Between, type]]:
    """Yield every number of a motif and of its tables, and its bounds."""
    hints = typing.get_type_hints(type(made), include_extras=True)
    for each in fields(made):
        held = getattr(made, each.name)
        if each.name == "curve":
            continue  # curves have tests of their own
        if is_dataclass(held):
            yield from numbers(held, (*at, each.name))
        elif each.name not in LOOK:
            marks = getattr(hints[each.name], "__metadata__", ())
            for mark in marks:
                if isinstance(mark, Between):
                    yield (*at, each.name), mark, type(held)


def changed(made: Any, at: tuple[str, ...], value: Any) -> Any:
    """Return a motif with one of its numbers changed."""
    inner = changed(getattr(made, at[0]), at[1:], value) if len(at) > 1 else value
    return replace(made, **{at[0]: inner})


def sound(figures: list[Figure]) -> None:
    """Hold figures to what everything after them relies on."""
    assert figures
    for figure in figures:
        assert figure.element.name
        assert len(figure.areas), figure.element.name
        assert shapely.is_valid(figure.areas).all(), figure.element.name
        assert (shapely.get_type_id(figure.areas) == shapely.GeometryType.POLYGON).all()
        assert np.isfinite(shapely.bounds(figure.areas)).all()


STRUCTURES = list(KINDS)[list(KINDS).index("parang") :]
"""Kinds of whole structures, of which the quick tests try every thirteenth bound."""


def extremes(name: str) -> list[Any]:
    """Return the least and the greatest value of every number of a kind, as parameters."""
    structure = name in STRUCTURES
    found = [
        pytest.param(name, at, kind(value), id=f"{name}-{'.'.join(at)}-{value:g}", marks=[long] * structure)
        for at, bounds, kind in numbers(KINDS[name]())
        for value in (bounds.low, bounds.high)
    ]
    return found[:: examples(13, 0) or 1] if structure else found


EXTREMES = [each for name in KINDS for each in extremes(name)]


@pytest.mark.parametrize("name", KINDS)
def test_a_kind_has_its_elements_by_name(name: str) -> None:
    motif = KINDS[name]()
    figures = draw(motif, TOLERANCE)
    sound(figures)
    assert list(dict.fromkeys(figure.element.name for figure in figures)) == NAMES[name].split(", ")
    assert len(motif.keys()) == len(motif.parts())


@pytest.mark.parametrize("name", KINDS)
def test_rings_of_its_elements_are_simple_by_themselves(name: str) -> None:
    for part in KINDS[name]().parts():
        for ring in draw_rings(part.curve):
            assert shapely.is_simple(shapely.LinearRing(ring)), part.name


def draw_rings(curve: Any) -> list[Any]:
    from batik_vector.geometry.curves import Butterfly, trace

    # The polar curve runs through its centre, where its wings meet.
    return [] if isinstance(curve, Butterfly) else trace(curve, TOLERANCE).rings


@pytest.mark.parametrize(("name", "at", "value"), rarely(EXTREMES, 3))
def test_least_and_greatest_values_draw_something_valid(name: str, at: tuple[str, ...], value: Any) -> None:
    sound(draw(changed(KINDS[name](), at, value), 5 * TOLERANCE))


@pytest.mark.parametrize("name", KINDS)
def test_what_is_out_of_bounds_is_refused_by_its_key(name: str) -> None:
    made = KINDS[name]()
    for at, bounds, kind in numbers(made):
        for value in (bounds.low - 1, bounds.high + 1):
            with pytest.raises(GeometryError, match=f"{at[-1]} = .*expected {bounds.low:g}"):
                changed(made, at, kind(value))


@pytest.mark.parametrize("name", MIRRORED)
def test_it_is_its_own_mirror_image(name: str) -> None:
    motif = KINDS[name]()
    double = np.radians(2 * MIRRORED[name])
    c, s = np.cos(double), np.sin(double)
    for figure in draw(motif, TOLERANCE):
        shape = shapely.union_all(figure.areas)
        other = shapely.transform(shape, lambda xy: xy @ np.array([[c, s], [s, -c]]))
        off = shapely.symmetric_difference(shape, other).area
        assert off < 2 * TOLERANCE * shape.length, figure.element.name


@pytest.mark.parametrize("name", KINDS)
def test_what_fills_it_is_bare_until_it_has_an_ink(name: str) -> None:
    motif: Any = KINDS[name]()
    plain = {part.name: part for part in motif.parts()}
    filling = [
        name for name in ("cell", "vein", "spot", "scale", "eye") if name in plain and hasattr(motif, name)
    ]
    for part in filling:
        inked = replace(motif, **{part: replace(getattr(motif, part), ink="red")})
        drawn = {each.name: each for each in inked.parts()}[part]
        assert (plain[part].treatment, plain[part].ink) == (Treatment.CUT, "")
        assert (drawn.treatment, drawn.ink, drawn.gap) == (Treatment.AREA, "red", 0.0)
