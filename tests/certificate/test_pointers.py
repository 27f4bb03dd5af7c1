"""The faults are marked in the drawing, where they are, and the marks can be written to any file."""

from __future__ import annotations

import numpy as np
import shapely

from batik_vector.artwork import violations
from batik_vector.certificate import certify, pointers
from batik_vector.export import render
from tests.certificate.test_certify import foreign
from tests.certificate.tiles import WAX, added, tile, vertex_moved


def test_a_sound_tile_has_no_pointers() -> None:
    artwork = tile()
    assert pointers(artwork, certify(artwork)) is artwork


def test_each_fault_is_ringed_on_both_edges_and_the_marks_stay_on_the_page() -> None:
    broken = vertex_moved(
        added(tile(), WAX, areas=[[(40, 60), (40.004, 60), (50, 70)]]), "pen", (30, 80), (0.03, 0)
    )
    certificate = certify(broken)
    shown = pointers(broken, certificate)
    assert violations(shown) == []
    assert [layer.ink.name for layer in shown.layers] == ["wax", "pen", "check"]
    lines = shown.layers[-1].lines
    size = shapely.total_bounds(lines)
    assert (size[:2] >= 0).all()
    assert (size[2:] <= [100, 80]).all()
    for place in ((30, 0), (30, 80)):
        near = shapely.distance(lines, shapely.Point(place))
        # A ring of 2 mm round the place, which stays free itself.
        assert 0.3 < near.min() < 1
        assert np.count_nonzero(near < 2.1) >= 2


def test_a_foreign_artwork_is_brought_to_the_normal_form() -> None:
    broken = added(foreign(1 / 3), WAX, areas=[[(0, 70), (3, 70), (3, 72), (0, 72)]])
    shown = pointers(broken, certify(broken))
    assert violations(shown) == []
    assert shown.layers[-1].ink.name == "check"
    assert b"check" in render(shown, "svg")
