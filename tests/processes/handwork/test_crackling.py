"""Crackle on tiles: cracks lie in the wax alone, their edges are shared, and the seam holds."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Layer, violations
from batik_vector.certificate import certify
from batik_vector.command.cli import cli
from batik_vector.errors import GeometryError
from batik_vector.geometry.outlines import of_polygons
from batik_vector.machines import Machine
from batik_vector.processes.handwork.options import CrackleProcess
from batik_vector.processes.trapping.meeting import joined_pieces
from tests.calling import runner
from tests.processes.handwork.tiles import COTTON, SOGA, bare, on_grid, random_tile, rings, steps, tile
from tests.thorough import examples, long


def cracked(page: Artwork, **options: object) -> Artwork:
    done = CrackleProcess(**{"width": (0.1, 0.5), "density": 8.0} | options).apply(page, Machine())  # type: ignore[arg-type]
    assert isinstance(done, Artwork)
    assert not violations(done)
    return done


def area(layer: Layer) -> float:
    return float(shapely.area(layer.areas).sum())


def test_the_dye_of_the_ground_is_cut_out_of_what_was_waxed() -> None:
    before = rings()
    after = cracked(before)
    for one, other in zip(before.layers, after.layers, strict=True):
        left = shapely.union_all(other.areas)
        assert area(one) * 0.8 < area(other) < area(one)
        # Where edges cross they are rounded to the micrometre.
        assert shapely.covers(shapely.buffer(shapely.union_all(one.areas), 0.002), left)
    assert certify(after).passed
    facts = after.facts["crackle"]
    taken = sum(map(area, before.layers)) - sum(map(area, after.layers))
    assert taken / sum(map(area, before.layers)) == pytest.approx(facts["dyed"], abs=1e-4)
    assert (facts["dye"], facts["cracks"]) == ("cloth", 57)


def test_an_ink_that_is_the_dye_takes_the_place_of_the_wax_to_the_micrometre() -> None:
    dye = Layer(SOGA, on_grid([shapely.box(20, 20, 40, 40)]))
    page = tile(
        Layer(COTTON, on_grid([shapely.box(5, 5, 55, 55).difference(shapely.box(20, 20, 40, 40))])), dye
    )
    after = cracked(page, dye="soga", wax=("cotton",))
    cotton, soga = (shapely.union_all(layer.areas) for layer in after.layers)
    whole = shapely.union_all([cotton, soga])
    assert whole.equals(shapely.box(5, 5, 55, 55))
    assert shapely.intersection(cotton, soga).area == 0
    assert soga.contains(shapely.box(20, 20, 40, 40))
    assert soga.area > 440


def test_bare_cloth_can_be_waxed_too() -> None:
    page = Artwork("Light", Cell(60_000, 60_000), rings().layers[1:], "#f4efe2")
    after = cracked(page)
    (soga,) = after.layers
    assert after.facts["crackle"]["dye"] == "soga"
    assert len(soga.areas)
    assert area(soga) > area(page.layers[0]) + 50
    assert shapely.covers(
        shapely.union_all(soga.areas).buffer(0.002), shapely.union_all(page.layers[0].areas)
    )
    assert certify(after).passed


def test_cracks_go_on_across_the_seam() -> None:
    after = cracked(bare())
    told = certify(after)
    assert told.passed
    assert told.worst.crossings > 12
    assert told.worst.unpaired == 0
    assert told.worst.mismatch == 0
    marks = steps(after.layers[0].areas)
    edges = [
        {y for x, y in shapely.get_coordinates(marks).tolist() if x == side and 0 < y < 60_000}
        for side in (0.0, 60_000.0)
    ]
    assert edges[0] == edges[1]


def test_pieces_are_as_large_as_asked() -> None:
    # At the seam a piece is in two: those are few on a large tile.
    page = bare()
    after = cracked(page, density=5.0, width=(0.02, 0.02))
    marks = steps(after.layers[0].areas)
    whole = np.arange(len(marks))
    one, other = joined_pieces(of_polygons(marks), page.cell)
    for _ in range(8):
        np.minimum.at(whole, one, whole[other])
    area = np.bincount(np.unique(whole, return_inverse=True)[1], shapely.area(marks)) / 1e6
    assert len(area) == 144
    assert np.sqrt(area.mean()) == pytest.approx(5.0, rel=0.05)


@pytest.mark.parametrize(
    ("page", "options", "words"),
    [
        (
            bare(),
            {"density": 0.5, "width": (0.1, 0.2), "_side": 200},
            "density = 0.5 mm, expected at least 1",
        ),
        (bare(), {"density": 40.0}, "density = 40 mm, expected at most 30: the tile has no room for more"),
        (bare(), {"dye": "cotto"}, 'dye = unknown ink "cotto": did you mean "cotton"?'),
        (bare(), {"wax": ("clotj",)}, 'wax = unknown ink "clotj": did you mean "cloth"?'),
        (bare(), {"dye": "cloth", "wax": ("cloth",)}, 'wax, expected no "cloth": it is the dye'),
        (tile(), {}, "expected an ink beside the dye"),
    ],
)
def test_what_cannot_be_is_said(page: Artwork, options: dict[str, object], words: str) -> None:
    options = dict(options)
    if side := options.pop("_side", None):
        page = bare(int(str(side)) * 1000)
    with pytest.raises(GeometryError) as told:
        cracked(page, **options)
    assert words in str(told.value)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"width": (0.5, 0.2)}, "expected the least first"),
        ({"width": (0.5, 4.0)}, "expected at most 3 mm: half the density"),
        ({"along": 0.3}, "along"),
    ],
)
def test_options_that_do_not_go_together_are_refused(options: dict[str, object], words: str) -> None:
    with pytest.raises(GeometryError, match=words):
        CrackleProcess(density=6.0, **options)  # type: ignore[arg-type]


RECIPE = """
title = "Kites"
[cloth]
colour = "#1d2f5f"
[ink.wax]
colour = "#f4efe2"
[motif.kite]
kind = "rosette"
elements = [{ curve = { kind = "superellipse", a = 1, b = 1, length = 9, width = 5 }, count = 1 }]
[[place]]
motif = "kite"
scale = 1
at = [8, 5]
ink = "wax"
[tile]
size = [40, 40]
repeat = "p4g"
[[output]]
format = "svg"
process = [{ kind = "hand", seed = 3 }, { kind = "crackle", density = "8 mm", width = ["0.1 mm", "0.4 mm"] }]
"""


def test_from_a_recipe_to_a_file_that_passes(tmp_path: Path) -> None:
    place = tmp_path / "kites.toml"
    place.write_text(RECIPE)
    done = runner().invoke(cli, ["compile", str(place), "-o", str(tmp_path / "out"), "--json"])
    assert done.exit_code == 0, done.stderr
    assert "26 cracks, pieces of 8 mm on average; cloth takes" in done.stderr
    assert "drawn by hand: places are off by up to" in done.stderr
    (file,) = json.loads(done.stdout)["recipes"][0]["files"]
    assert file["process"]["crackle"]["cracks"] == 26
    checked = runner().invoke(cli, ["check", str(tmp_path / "out" / "kites.svg")])
    assert checked.exit_code == 0, checked.output
    told = checked.stdout + checked.stderr
    assert "p4g is not kept by hand and crackle, and is not asked of it any more" in told


NUMBERS = range(0, 6000, 6)


@long
@pytest.mark.parametrize("number", NUMBERS[: examples(1, 6)])
def test_any_tile_keeps_its_seam(number: int) -> None:
    page = random_tile(number)
    size = (page.cell.width * page.cell.height) ** 0.5
    done = cracked(page, density=size / 6, seed=number)
    assert certify(done).faults == ()
