"""Plug-ins: found when they are asked for, told by name, and passed over where they are broken."""

from __future__ import annotations

import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest

from batik_vector import RecipeError, UnknownNameError, compile_recipe, load_recipe
from batik_vector.command.installed_plugins import catalogues
from batik_vector.export import FORMATS, format_of, render
from batik_vector.export.provenance import read_provenance
from batik_vector.fields import catalogues as plugins
from batik_vector.geometry.curves import CURVES
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.reading import validator
from batik_vector.recipe.schema import schema
from batik_vector.studio.drafts import Draft
from batik_vector.studio.parameters import controls
from tests.calling import runner

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "plugin"
DECLARED = tomllib.loads((EXAMPLE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
RECIPE = """
motif.m.kind = "rosette"
motif.m.elements = [{ curve = { kind = "KIND" } }]
place = [{ motif = "m", scale = 20 }]
tile.size = [50, 50]
"""

SAMPLE = str(ROOT / "samples" / "kawung-isen.toml")

Install = Callable[..., Path]


def put(folder: Path, name: str, version: str, points: Mapping[str, Mapping[str, str]]) -> None:
    """Write down a package as installers do, with its entry points by their groups."""
    info = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
    lines = [
        f"[{group}]\n" + "".join(f"{a} = {b}\n" for a, b in rows.items()) for group, rows in points.items()
    ]
    (info / "entry_points.txt").write_text("\n".join(lines))


def forget(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the process find plug-ins anew, and afterwards what it had found before."""
    plugins._installed.cache_clear()
    for catalogue in [each for _, each in catalogues()] + [FORMATS]:
        monkeypatch.setattr(catalogue, "_brought", None)
        monkeypatch.setattr(catalogue, "_broken", {})


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Install]:
    """Install a package for the length of a test."""
    site = tmp_path / "site"

    def installed(name: str = "", points: Any = None, version: str = "1.0", code: str = "") -> Path:
        if name:
            put(site, name, version, points)
        else:
            put(site, DECLARED["name"], DECLARED["version"], DECLARED["entry-points"])
            monkeypatch.syspath_prepend(str(EXAMPLE))
        if code:
            (site / f"{name.replace('-', '_')}.py").write_text(code)
        monkeypatch.syspath_prepend(str(site))
        forget(monkeypatch)
        return site

    with monkeypatch.context():
        yield installed
    monkeypatch.undo()
    plugins._installed.cache_clear()


def test_nothing_is_looked_for_until_a_name_is_unknown(tmp_path: Path) -> None:
    script = (
        "import sys\n"
        "from batik_vector import load_recipe, compile_recipe, write_artwork\n"
        f"write_artwork(compile_recipe(load_recipe({SAMPLE!r})), 'k.svg')\n"
        "from batik_vector.fields import catalogues\n"
        "assert catalogues._installed.cache_info().currsize == 0\n"
        "from batik_vector.geometry.curves import CURVES\n"
        "assert 'nothing' not in CURVES and catalogues._installed.cache_info().currsize == 1\n"
    )
    subprocess.run([sys.executable, "-c", script], check=True, cwd=tmp_path)


def test_each_sort_of_plug_in_is_used_and_stands_in_the_file(install: Install, tmp_path: Path) -> None:
    install()
    recipe = load_recipe(EXAMPLE / "buttons.toml")
    assert recipe.plugins == ("batik-example 1.0",)
    for format in ("svg", "pdf", "dxf", "png", "gcode"):
        path = tmp_path / f"b.{format}"
        path.write_bytes(render(compile_recipe(recipe), format))
        assert read_provenance(path).plugins == ("batik-example 1.0",)
    assert format_of("a.csv") == "csv"
    assert render(compile_recipe(recipe), "csv").startswith(
        b"ink,colour,marks,area_mm2,line_mm\nlight,#7d9cc0,"
    )


def plugins_cli() -> Any:
    from batik_vector.command.cli import cli

    return cli


def test_a_process_and_a_format_of_the_call_stand_in_the_file_too(install: Install, tmp_path: Path) -> None:
    install()
    sample = str(ROOT / "samples" / "kawung.toml")
    call = ["compile", sample, "-o", str(tmp_path / "out"), "-f", "svg", "--process", "pounce spacing=3mm"]
    done = runner().invoke(plugins_cli(), call)
    assert done.exit_code == 0, done.stderr
    told = read_provenance(tmp_path / "out" / "kawung.svg")
    assert told.plugins == ("batik-example 1.0",)
    assert told.processes == ("pounce spacing=3",)
    assert compile_recipe(load_recipe(sample)).provenance.plugins == ()


def test_writers_of_recipes_are_told_of_plug_ins(install: Install) -> None:
    with pytest.raises(RecipeError) as before:
        read_recipe(RECIPE.replace("KIND", "scalop"))
    assert "scallop" not in str(before.value)
    install()
    validator._adapter.cache_clear()
    with pytest.raises(RecipeError, match=r'unknown kind of curve "scalop": did you mean "scallop"\?'):
        read_recipe(RECIPE.replace("KIND", "scalop"))
    with pytest.raises(RecipeError, match=r"lobes = |lobes: 2, expected 3 to 200"):
        read_recipe(RECIPE.replace('kind = "KIND"', 'kind = "scallop", lobes = 2'))
    known = schema()["$defs"]
    assert {"curve.scallop", "motif.button", "layout.quincunx", "fill.lozenges", "process.pounce"} <= set(
        known
    )
    assert known["curve.scallop"]["properties"]["lobes"]["maximum"] == 200
    listed = runner().invoke(plugins_cli(), ["plugins"])
    assert [line.split()[:2] for line in listed.stdout.splitlines()] == [
        ["motif", "button"],
        ["curve", "scallop"],
        ["layout", "quincunx"],
        ["fill", "lozenges"],
        ["process", "pounce"],
        ["format", "csv"],
    ]
    assert "ase, csv." in " ".join(runner().invoke(plugins_cli(), ["compile", "--help"]).stdout.split())
    with pytest.raises(UnknownNameError, match='did you mean "csv"'):
        format_of("a.csw")
    validator._adapter.cache_clear()


def test_the_studio_offers_them(install: Install) -> None:
    install()
    text = (ROOT / "samples" / "kawung.toml").read_text(encoding="utf-8")
    kind = next(each for path, each in controls(Draft.of_text(text)).items() if path.endswith("layout.kind"))
    assert "quincunx" in kind.choices


BAD = {
    "RuntimeError: no licence": 'raise RuntimeError("no licence")',
    "AttributeError: module 'bad_one' has no attribute 'thing'": "other = 1",
    "expected a frozen dataclass of batik_vector.geometry.curves.base.Curve": (
        "from batik_vector.geometry.curves import Curve\nclass thing(Curve): pass"
    ),
}


@pytest.mark.parametrize("why", BAD)
def test_a_broken_plug_in_is_named_and_passed_over(install: Install, why: str) -> None:
    install()
    install("bad-one", {"batik_vector.curves": {"wobble": "bad_one:thing"}}, "2.1", BAD[why])
    words = f"bad-one 2.1: {why}"
    with pytest.raises(RecipeError) as told:
        read_recipe(RECIPE.replace("KIND", "wobble"))
    assert f'kind of curve "wobble": its plug-in is passed over, {words}' in str(told.value)
    # The others go on.
    assert compile_recipe(read_recipe(RECIPE.replace("KIND", "scallop"))).vertex_count > 10
    listed = runner().invoke(plugins_cli(), ["plugins"])
    assert f"curve wobble is passed over: {words}" in listed.stderr
    assert "scallop" in listed.stdout
    sys.modules.pop("bad_one", None)


def test_names_that_are_taken_are_passed_over(install: Install) -> None:
    install()
    install("first-of-two", {"batik_vector.curves": {"rose": "batik_example.scallop:Scallop"}})
    install(
        "second-of-two",
        {
            "batik_vector.curves": {
                "scallop": "batik_example.scallop:Scallop",
                "Not A Name": "batik_example:no",
            }
        },
    )
    assert CURVES["rose"].__name__ == "Rose"
    assert dict(CURVES.broken) == {
        "Not A Name": "second-of-two 1.0: expected a name of small letters, digits and hyphens",
        "rose": "first-of-two 1.0: the program has this name already",
        "scallop": "batik-example 1.0 and second-of-two 1.0: both bring this name, and neither is taken",
    }


def test_the_examples_own_tests_pass(install: Install, tmp_path: Path) -> None:
    install()
    path = EXAMPLE / "tests" / "test_example.py"
    made: dict[str, Any] = {"__file__": str(path), "__name__": "test_example"}
    exec(compile(path.read_text(encoding="utf-8"), str(path), "exec"), made)
    made["test_a_scallop_keeps_within_its_radius_and_its_notches"](0.15)
    made["test_holes_that_would_run_together_are_refused"]()
    made["test_the_recipe_compiles_and_its_tile_is_sound"](tmp_path)
