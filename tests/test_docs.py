"""The pages are made from the program, and the README's claims can be typed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from batik_vector import InkSpec, Placement, Recipe, TileSpec, compile_recipe
from batik_vector.geometry.curves import trace
from batik_vector.making.jobs import planned, read_jobs
from batik_vector.making.running import run_quietly
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.motif import Element, Rosette
from tools import house, reference

ROOT = Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def test_the_page_on_recipes_is_up_to_date() -> None:
    assert reference.PAGE.read_text(encoding="utf-8") == reference.page(), "run make docs"


def test_the_features_on_the_librarys_page_are_those_that_are_measured() -> None:
    assert reference.LIBRARY.read_text(encoding="utf-8") == reference.library_page(), "run make docs"


def test_the_machines_on_the_audits_page_are_those_that_come_along() -> None:
    assert reference.AUDIT.read_text(encoding="utf-8") == reference.audit_page(), "run make docs"


def test_the_page_on_the_house_is_up_to_date() -> None:
    assert house.PAGE.read_text(encoding="utf-8") == house.page(), "run make docs"
    assert house.PICTURE.read_text(encoding="utf-8") == house.picture(), "run make docs"


def test_pictures_and_pages_that_the_readme_names_exist() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    named = re.findall(r"\]\(([^)#:]+)\)|src=\"([^\"]+)\"", text)
    assert named
    for link in (a or b for a, b in named):
        assert (ROOT / link).exists(), link


def test_the_readme_shows_its_two_commands_in_the_first_screen() -> None:
    first = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()[:40]
    assert "make demo" in "\n".join(first)
    assert "make test" in "\n".join(first)


def blocks(kind: str, word: str) -> list[str]:
    return [text for written, text in BLOCK.findall(README) if written == kind and word in text]


def drawn(motif: Any) -> float:
    """Put a motif on a cloth, and tell what it covers."""
    tile = TileSpec(size=(60.0, 60.0), repeat="half-drop")
    place = (Placement(motif="m", width=40.0),)
    recipe = Recipe(motif={"m": motif}, place=place, ink={"wax": InkSpec()}, tile=tile)
    return float(sum(area.area for area in compile_recipe(recipe).layers[0].areas))


def test_what_the_readme_says_in_python_can_be_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "samples").symlink_to(ROOT / "samples")
    monkeypatch.chdir(tmp_path)
    texts = blocks("python", "import")
    assert len(texts) >= 5
    made: dict[str, Any] = {}
    for text in texts:
        exec(compile(text, "README.md", "exec"), made)
    assert (tmp_path / "four-square.dxf").exists()
    for name in ("curve", "leaf", "drop"):
        assert len(trace(made[name], 0.01).rings) == 1
        assert drawn(Rosette(elements=(Element(curve=made[name]),))) > 100
    assert drawn(made["motif"]) == pytest.approx(2 * (np.pi * 9 - 4) * (40 / 6) ** 2, rel=0.01)


def test_what_the_readme_draws_of_ones_own_is_drawn() -> None:
    (text,) = blocks("toml", 'kind = "path"')
    for name in ("leaf", "flower"):
        rest = f'[ink.wax]\n[[place]]\nmotif = "{name}"\nwidth = 20\n[tile]\nsize = [40, 40]\n'
        (layer,) = compile_recipe(read_recipe(text + rest)).layers
        assert len(layer.areas) == (1 if name == "leaf" else 8)


def test_the_readme_says_over_what_t_runs() -> None:
    assert "t, which runs over [0, 1]" in README


def test_what_the_page_on_pens_asks_for_can_be_made(tmp_path: Path) -> None:
    page = (ROOT / "docs" / "pens.md").read_text(encoding="utf-8")
    (text,) = [text for kind, text in BLOCK.findall(page) if kind == "toml"]
    recipe = tmp_path / "kawung.toml"
    recipe.write_text((ROOT / "samples" / "kawung.toml").read_text(encoding="utf-8") + text, encoding="utf-8")
    (job,) = planned(read_jobs([str(recipe)]), tmp_path)
    plot = run_quietly(job)["files"][0]["process"]["plot"]
    assert [(each["pen"], each["ink"]) for each in plot["pens"]] == [(1, "cotton"), (2, "soga")]
    assert len(plot["doubled"]["places"]) == min(plot["doubled"]["stretches"], 10) > 0
