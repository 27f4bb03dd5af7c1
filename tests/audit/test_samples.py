"""Samples that keep a machine's limits have no findings for it; what it is told of others is true."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork
from batik_vector.audit import Kind, audit
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.machines import MACHINES, Limits, Machine, Twice
from batik_vector.recipe.loading import load_recipe
from batik_vector.recipe.reading.machines import read_machine
from tests.audit.tiles import tile
from tests.thorough import rarely

SAMPLES = Path(__file__).resolve().parents[2] / "samples"

CLEAN = [
    ("canting", "mega-mendung"),
    ("canting", "tumbling-leaves"),
    ("canting-isen", "kawung"),
    ("canting-isen", "four-square"),
    ("canting-isen", "truntum-night"),
    ("laser", "cecek-sun"),
    ("laser", "whirl"),
    ("vinyl-cutter", "lsystem-kolam"),
    ("flat-screen", "mega-mendung"),
    ("rotary-screen", "fractal-julia"),
    ("pen-plotter", "chrysanthemum-line"),
    ("canting", "machine-wax-pen"),
    ("laser", "machine-laser"),
    ("vinyl-cutter", "machine-vinyl"),
    ("stencil-film", "machine-stencil"),
    ("rotary-screen", "machine-rotary"),
    ("cap", "cap-grompol"),
]


def _sample(name: str) -> Artwork:
    return compile_recipe(load_recipe(SAMPLES / f"{name}.toml"))


@pytest.mark.parametrize(("machine", "sample"), rarely(CLEAN, 3))
def test_a_sample_made_for_a_machine_has_no_findings(machine: str, sample: str) -> None:
    found = audit(_sample(sample), read_machine(machine))
    assert found.measured
    assert found.findings == ()


def test_leaves_that_two_layers_share_are_cut_twice_and_told_of() -> None:
    found = audit(_sample("kawung"), read_machine("laser"))
    assert {each.kind for each in found.findings} == {Kind.DOUBLE}
    alone = dataclasses.replace(read_machine("laser").limits, twice=Twice.INK)
    assert audit(_sample("kawung"), Machine(limits=alone)).findings == ()


@pytest.mark.parametrize("name", MACHINES)
def test_every_limit_that_a_machine_sets_has_a_source(name: str) -> None:
    profile = read_machine(name)
    # That screens repeat the tile is no figure.
    limits = {field.name for field in dataclasses.fields(Limits)} - {"repeats"}
    plain = Limits()
    own = {each for each in limits if getattr(profile.limits, each) != getattr(plain, each)}
    assert {f"limits.{each}" for each in own} <= profile.sources.keys()


discs = st.lists(st.tuples(st.floats(0, 40), st.floats(0, 40), st.floats(1.5, 6)), min_size=2, max_size=7)

LEAST = 1.5


@settings(max_examples=20)
@given(discs, st.floats(0, 120), st.floats(0, 100))
def test_what_falls_apart_when_the_knife_goes_round_has_a_neck(
    drawn: list[tuple[float, float, float]], x: float, y: float
) -> None:
    """A knife that takes a little less than half the least breadth all round must not part a mark unseen."""
    blob = shapely.union_all([shapely.Point(x + a, y + b).buffer(r, 24) for a, b, r in drawn])
    for part in shapely.get_parts(blob):
        left = shapely.get_parts(shapely.buffer(part, -0.9 * LEAST / 2, quad_segs=16))
        broad = [each for each in left if not shapely.buffer(each, -0.5 * LEAST).is_empty]
        found = audit(tile([part]), Machine(limits=Limits(narrowest_line=LEAST))).findings
        assert len(found) >= len(broad) - 1
        # And what is told is there: so narrow a way through the ink, with bare ground on either side.
        for each in found:
            assert each.value < LEAST
            around = shapely.Point(each.where).buffer(each.value / 2 + 0.05)
            bare = sum(around.difference(moved).area for moved in [_nearest(part, each.where)])
            assert bare > 0
            assert len(shapely.get_parts(around.difference(_nearest(part, each.where)))) >= 2


def _nearest(part: shapely.Polygon, where: tuple[float, float]) -> shapely.Polygon:
    """Return the translate of a mark over the torus that lies at a place."""
    moves = [(i * 120.0, j * 100.0) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    moved = [shapely.affinity.translate(part, *move) for move in moves]
    return moved[int(np.argmin([shapely.Point(where).distance(each) for each in moved]))]
