"""What a plug-in's own tests look like: each kind by itself, then a recipe that has them all."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest
import shapely
from batik_example.pounce import Pounce
from batik_example.scallop import Scallop
from click.testing import CliRunner

from batik_vector import GeometryError, compile_recipe, load_recipe
from batik_vector.command.cli import cli
from batik_vector.geometry.curves import trace

RECIPE = Path(__file__).parents[1] / "buttons.toml"


@pytest.mark.parametrize("depth", [0.0, 0.15, 0.5])
def test_a_scallop_keeps_within_its_radius_and_its_notches(depth: float) -> None:
    (ring,) = trace(Scallop(8, depth, 2.0), 1e-3).rings
    reach = np.hypot(*np.asarray(ring).T)
    assert reach.max() == pytest.approx(2.0, abs=1e-3)
    assert reach.min() == pytest.approx(2.0 * (1 - depth), abs=1e-3)


def test_holes_that_would_run_together_are_refused() -> None:
    with pytest.raises(GeometryError, match=r"spacing = 0.4, expected more than a hole's 0.5 mm"):
        Pounce(spacing="0.4 mm", hole="0.5 mm")  # type: ignore[arg-type]


def test_the_recipe_compiles_and_its_tile_is_sound(tmp_path: Path) -> None:
    artwork = compile_recipe(load_recipe(RECIPE))
    assert artwork.provenance.plugins == ("batik-example 1.0",)
    done = CliRunner().invoke(cli, ["compile", str(RECIPE), "-o", str(tmp_path)])
    assert done.exit_code == 0, done.output
    assert CliRunner().invoke(cli, ["check", str(tmp_path / "buttons.svg")]).exit_code == 0
    rows = list(csv.DictReader((tmp_path / "buttons.csv").read_text(encoding="utf-8").splitlines()))
    for layer, row in zip(artwork.layers, rows, strict=True):
        assert float(row["area_mm2"]) == pytest.approx(shapely.area(layer.areas).sum(), abs=0.01)
