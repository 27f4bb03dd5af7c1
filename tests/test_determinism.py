"""Same recipe, same version: same bytes, whatever the machine is set to and wherever one stands."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from batik_vector.export import FORMATS

ROOT = Path(__file__).parents[1]
RECIPE = next(
    path
    for folder in ("samples", "batik_vector/starters")
    if (path := ROOT / folder / "four-square.toml").exists()
)

SURROUNDINGS = [
    {"PYTHONHASHSEED": "0", "TZ": "UTC", "LC_ALL": "C"},
    {"PYTHONHASHSEED": "4711", "TZ": "Asia/Kathmandu", "LC_ALL": "C.UTF-8", "SOURCE_DATE_EPOCH": "1"},
    # The order in which the libraries' threads end must not show either.
    {"PYTHONHASHSEED": "1", "TZ": "America/St_Johns", "LANG": "de_DE.UTF-8", "OMP_NUM_THREADS": "1"},
]


NAMES = {"swatch": ["-swatch.svg"], "tiff": ["-light.tiff", "-wax.tiff"]}
"""How the files of a format are named behind the recipe's own name, where not by it."""


def compiled(recipe: str, cwd: Path, out: str, surroundings: dict[str, str]) -> dict[str, bytes]:
    """Compile in a process of its own and return the files by name."""
    subprocess.run(
        [sys.executable, "-m", "batik_vector", "compile", recipe, "-o", out, "-f", ",".join(FORMATS)],
        cwd=cwd,
        env={"PATH": os.environ["PATH"], "PYTHONPATH": str(ROOT), **surroundings},
        check=True,
        capture_output=True,
        timeout=120,
    )
    return {path.name: path.read_bytes() for path in (cwd / out).iterdir()}


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    folder = tmp_path_factory.mktemp("first")
    shutil.copy(RECIPE, folder)
    return compiled(RECIPE.name, folder, "out", SURROUNDINGS[0])


@pytest.mark.parametrize("surroundings", SURROUNDINGS[1:], ids=lambda each: each["TZ"])
def test_the_same_bytes_everywhere(
    first: dict[str, bytes], tmp_path: Path, surroundings: dict[str, str]
) -> None:
    place = tmp_path / "a folder" / "färberei"
    place.mkdir(parents=True)
    again = compiled(str(RECIPE), place, "deep/er", surroundings)
    assert sorted(again) == sorted(
        f"four-square{end}" for each in FORMATS for end in NAMES.get(each, [f".{each}"])
    )
    assert {name: again[name] == first[name] for name in first} == dict.fromkeys(first, True)


def test_another_recipe_gives_other_bytes(first: dict[str, bytes], tmp_path: Path) -> None:
    changed = RECIPE.read_text(encoding="utf-8") + "\n# one word more\n"
    (tmp_path / RECIPE.name).write_text(changed, encoding="utf-8")
    other = compiled(RECIPE.name, tmp_path, "out", SURROUNDINGS[0])
    # Plotters choke on comments: HP-GL carries no recipe unless it is told to. Palettes have colours alone.
    same = {name for name in first if other[name] == first[name]}
    assert same == {"four-square.hpgl", "four-square.gpl", "four-square.ase"}


def test_random_tests_are_the_same_each_time_where_changes_are_judged() -> None:
    # What a test asks of its own is said beside the profile, not instead of it.
    script = "import tests.conftest, hypothesis; print(hypothesis.settings(max_examples=3).derandomize)"
    judged = os.environ | {"CI": "true", "BATIK_LONG": "1"}
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, env=judged, capture_output=True, text=True
    )
    assert done.stdout.split() == ["True"], done.stderr
