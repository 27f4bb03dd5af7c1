"""Welding: large groups, which are united as nets, come to what small ones do."""

from __future__ import annotations

from typing import Any

import pytest
import shapely

from batik_vector.artwork import Artwork, violations
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.geometry import nets
from batik_vector.geometry.nets import Net
from batik_vector.recipe.loading import read_recipe
from batik_vector.tiling.torus import remembered
from batik_vector.tiling.welding import weld

RECIPE = """\
title = "A net over the seam"
tolerance = "0.05 mm"

[motif.mark]
kind = "rosette"

[[motif.mark.elements]]
name = "mark"
curve = {{ kind = "polar", radius = 1.0, waves = [[5, 0.25, 0.0]] }}

[ink.wax]
colour = "#1a1a1a"

[[place]]
motif = "mark"
layout = {layout}
scale = "{scale} mm"

[tile]
size = ["60 mm", "60 mm"]
"""
LAYOUTS = {
    "lattice": ('{ kind = "lattice", columns = 6, rows = 6, stagger = true }', 5.4),
    "dense": ('{ kind = "lattice", columns = 6, rows = 6, turn = 31 }', 6.9),
    "julian": ('{ kind = "julian", power = 4, dist = 4, level = 2, shift = [1.1, 1.1] }', 11.0),
    "ring": ('{ kind = "julian", power = 7, dist = 7, level = 1, shift = [1.6, 0] }', 9.0),
}


def compiled(text: str) -> Artwork:
    remembered.clear()
    return compile_recipe(read_recipe(text))


@pytest.mark.parametrize("name", LAYOUTS)
def test_a_net_comes_to_what_geos_unites(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    layout, scale = LAYOUTS[name]
    text = RECIPE.format(layout=layout, scale=scale)
    wanted = compiled(text).layers[0].areas
    told = []
    united = nets.united

    def asked(*given: Any) -> Net | None:
        told.append(united(*given))
        return told[-1]

    monkeypatch.setattr(weld, "NET", 0)
    monkeypatch.setattr(weld, "united_net", asked)
    artwork = compiled(text)
    assert told
    assert None not in told
    assert not violations(artwork)
    made = artwork.layers[0].areas
    assert len(made) == len(wanted)
    assert shapely.area(made).sum() == pytest.approx(shapely.area(wanted).sum(), rel=1e-9)
    assert shapely.symmetric_difference(shapely.union_all(made), shapely.union_all(wanted)).area < 1e-6
    # What is known of a net is not worked out again, and comes to the same.
    count = len(told)
    again = compile_recipe(read_recipe(text)).layers[0].areas
    assert len(told) == count
    assert shapely.equals_exact(again, made).all()


def test_a_net_that_is_not_sure_is_left_to_geos(monkeypatch: pytest.MonkeyPatch) -> None:
    layout, scale = LAYOUTS["lattice"]
    text = RECIPE.format(layout=layout, scale=scale)
    wanted = compiled(text).layers[0].areas
    monkeypatch.setattr(weld, "NET", 0)
    monkeypatch.setattr(weld, "united_net", lambda *given: None)
    assert shapely.equals_exact(compiled(text).layers[0].areas, wanted).all()
