"""The command and the package's front door."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
import shapely
from click.testing import Result

import batik_vector
from batik_vector import export
from batik_vector.command.cli import KINDS, cli
from batik_vector.command.options import FORMATS
from batik_vector.command.starters import STARTERS
from batik_vector.compiling.compiler import inspect
from batik_vector.recipe.outputs import OUTPUTS
from tests.calling import runner
from tests.recipe.test_bad_input import BASE
from tests.thorough import rarely


def call(*args: str) -> Result:
    return runner().invoke(cli, args)


def good(*args: str) -> Result:
    result = call(*args)
    assert result.exit_code == 0, (result.stderr, result.exception)
    return result


@pytest.fixture(autouse=True)
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "k.toml").write_text(BASE)
    return tmp_path


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_without_formats_the_recipe_decides(desk: Path) -> None:
    (desk / "k.toml").write_text(BASE + '[[output]]\nformat = "dxf"\nname = "cut"\n')
    result = good("compile", "k.toml", "-o", "made/here")
    assert names(desk / "made" / "here") == ["k-cut.dxf", "k.svg"]
    assert result.stdout == ""
    assert "made/here/k-cut.dxf" in result.stderr
    assert "640 × 320 mm" in result.stderr


def test_formats_asked_for_take_the_options_of_the_recipe(desk: Path) -> None:
    (desk / "k.toml").write_text(BASE.replace('"svg"', '"png"\ndpi = 20\nname = "small"'))
    good("compile", "k.toml", "-f", "png,PDF", "-f", "dxf")
    assert names(desk) == ["k-small.png", "k.dxf", "k.pdf", "k.toml"]
    assert int.from_bytes((desk / "k-small.png").read_bytes()[16:20], "big") == round(640 / 25.4 * 20)


def test_a_recipe_without_outputs_becomes_svg(desk: Path) -> None:
    (desk / "k.toml").write_text(BASE[: BASE.index("[[output]]")])
    good("compile", "k.toml")
    assert names(desk) == ["k.svg", "k.toml"]


def test_the_report_for_machines(desk: Path) -> None:
    (desk / "j.toml").write_text(
        BASE.replace("[ink.wax]", "[ink.dye]\n[motif.spare]\nkind = 'flower'\n[ink.wax]")
    )
    report = json.loads(good("compile", "k.toml", "j.toml", "-f", "svg,pdf", "--json").stdout)
    assert report["faults"] == []
    first, second = report["recipes"]
    assert [file["path"] for file in first["files"]] == ["k.svg", "k.pdf"]
    for file in first["files"]:
        assert file["bytes"] == (desk / file["path"]).stat().st_size
        assert file["size_mm"] == [640.0, 320.0]
        assert file["seconds"] >= 0
    assert first["cell_mm"] == [640.0, 320.0]
    assert [layer["ink"] for layer in first["layers"]] == ["wax"]
    assert first["layers"][0]["vertices"] == first["vertices"] > 100
    assert first["warnings"] == []
    assert second["warnings"] == ['motif "spare" is placed nowhere', 'ink "dye" draws nothing']


def test_the_report_tells_faults_apart() -> None:
    result = call("compile", "k.toml", "--set", "tolerance=0", "--json")
    assert result.exit_code == 2
    report = json.loads(result.stdout)
    assert report["exit"] == 2
    assert report["faults"] == [
        {
            "message": "0, expected 0.002 to 5 mm",
            "key": "tolerance",
            "source": "--set tolerance=0",
            "line": None,
        }
    ]


def test_repeats_and_bleed_make_larger_pages(desk: Path) -> None:
    outputs = '[[output]]\nformat = "svg"\nrepeat = [2, 3]\n[[output]]\nformat = "pdf"\nbleed = "5 mm"\n'
    (desk / "k.toml").write_text(BASE[: BASE.index("[[output]]")] + outputs)
    report = json.loads(good("compile", "k.toml", "--json").stdout)
    assert [file["size_mm"] for file in report["recipes"][0]["files"]] == [[1280.0, 960.0], [650.0, 330.0]]
    assert b'viewBox="0 0 1280 960"' in (desk / "k.svg").read_bytes()[:2000]


def test_a_compiled_file_compiles_to_itself(desk: Path) -> None:
    (desk / "k.toml").write_text(BASE.replace('"svg"', '"svg"\nname = "wax"'))
    good("compile", "k.toml", "-o", "a", "-f", "svg,pdf", "--set", "motif.flower.petal.count=12")
    for name in ("k-wax.svg", "k.pdf"):
        good("compile", f"a/{name}", "-o", "b", "-f", "svg,pdf")
        assert names(desk / "b") == ["k-wax.svg", "k.pdf"]
        for file in (desk / "b").iterdir():
            assert file.read_bytes() == (desk / "a" / file.name).read_bytes()


def test_the_same_recipe_gives_the_same_bytes_from_anywhere(desk: Path) -> None:
    good("compile", "k.toml", "-f", ",".join(FORMATS), "-o", "a")
    (desk / "far").mkdir()
    (desk / "far" / "k.toml").write_bytes(BASE.replace("\n", "\r\n").encode())
    good("compile", str(desk / "far" / "k.toml"), "-f", ",".join(FORMATS), "-o", "b")
    for file in (desk / "a").iterdir():
        assert file.read_bytes() == (desk / "b" / file.name).read_bytes()


def test_check_tells_the_facts_and_writes_nothing(desk: Path) -> None:
    result = good("check", "k.toml")
    assert result.stderr == ""
    assert "tile 640 × 320 mm, repeats straight" in result.stdout
    assert "wax (#f4efe2): " in result.stdout
    assert result.stdout.endswith("k.toml: passed: opposite edges agree, nothing is drawn twice\n")
    assert names(desk) == ["k.toml"]
    facts = json.loads(good("check", "k.toml", "--json").stdout)["recipes"][0]
    assert (facts["violations"], facts["seam"]) == ([], [])


def test_check_exits_with_1_where_the_work_has_faults(monkeypatch: pytest.MonkeyPatch) -> None:
    gap = {"ink": "wax", "edges": "left and right", "from_mm": 1.5, "to_mm": 2.0}
    faults: dict[str, list[Any]] = {"violations": ["wax: 2 pairs of areas overlap"], "seam": [gap]}
    monkeypatch.setattr("batik_vector.command.checks.inspect", lambda artwork: {**inspect(artwork), **faults})
    result = call("check", "k.toml")
    assert result.exit_code == 1
    assert "fault: wax: 2 pairs of areas overlap" in result.stdout
    assert "fault: wax: left and right edges disagree from 1.5 to 2 mm" in result.stdout
    assert result.stdout.endswith("k.toml: FAILED: 2 faults\n")
    assert call("check", "k.toml", "--set", "seed=x").exit_code == 2


class _NoCairo:
    """What importing cairocffi comes to where the system lacks cairo."""

    @staticmethod
    def find_spec(name: str, *_: object) -> None:
        if name == "cairocffi":
            raise OSError('no library called "cairo-2" was found')


def test_without_cairo_all_but_the_png_is_written(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("cairosvg", "cairocffi"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setattr(sys, "meta_path", [_NoCairo, *sys.meta_path])
    result = call("compile", "k.toml", "-f", "svg,png", "--json")
    assert result.exit_code == 2
    assert names(desk) == ["k.svg", "k.toml"]
    for words in ("libcairo2 (Debian", "cairo (macOS: brew)", "tschoonj.GTKForWindows"):
        assert words in result.stderr
    report = json.loads(result.stdout)
    assert [file["path"] for file in report["recipes"][0]["files"]] == ["k.svg"]
    assert len(report["faults"]) == 1
    with pytest.raises(batik_vector.MissingLibraryError):
        export.render(batik_vector.compile_recipe(batik_vector.load_recipe("k.toml")), "png")
    assert call("compile", "k.toml", "-f", "png").exit_code == 2


def test_a_stretch_is_told_alike_everywhere(desk: Path) -> None:
    settings = ("size=['107 mm', '107 mm']", "repeat='grid'", "fit={width='640 mm'}")
    fit = [word for each in settings for word in ("--set", f"tile.{each}")]
    refused = call("compile", "k.toml", *fit, "--set", "tile.fit.limit=0.1").stderr
    assert "stretched by -0.311 %, past the limit of 0.1 %" in refused
    assert "stretched by -0.311 % across" in good("compile", "k.toml", *fit).stderr
    assert "stretched to fit: -0.311 % across" in good("check", "k.toml", *fit).stdout


@pytest.mark.parametrize("kind", rarely(KINDS, 3))
def test_every_starter_is_sound(desk: Path, kind: str) -> None:
    good("new", "--kind", kind)
    assert (desk / f"{kind}.toml").read_bytes() == (STARTERS / f"{kind}.toml").read_bytes()
    facts = json.loads(good("check", f"{kind}.toml", "--json").stdout)["recipes"][0]
    assert (facts["violations"], facts["seam"], facts["warnings"]) == ([], [], [])


@pytest.mark.parametrize(
    ("name", "file", "title"),
    [
        ("My Kawung", "my-kawung.toml", "My Kawung"),
        ("kawung.toml", "kawung.toml", "kawung"),
        ('a "b" \\ \n\x7f', "a-b.toml", 'a "b" \\ \n\x7f'),
        ("蜡染", "蜡染.toml", "蜡染"),
    ],
)
def test_new_names_the_recipe(desk: Path, name: str, file: str, title: str) -> None:
    good("new", name)
    assert names(desk) == sorted([file, "k.toml"])
    assert tomllib.loads((desk / file).read_text("utf-8"))["title"] == title
    assert batik_vector.load_recipe(desk / file).title == title


@pytest.mark.parametrize("name", ["../../etc/x", "/etc/x", "sub/x.toml", "..", ".", "~"])
def test_new_takes_no_path_for_a_name(desk: Path, name: str) -> None:
    result = call("new", name)
    assert result.exit_code == 2
    assert f'"{name}" is a path, expected a name: -o FILE says where the file goes' in result.stderr
    assert names(desk) == ["k.toml"]
    # As a title it will do where the file is named.
    good("new", name, "-o", "there.toml")
    assert tomllib.loads((desk / "there.toml").read_text("utf-8"))["title"] == name.removesuffix(".toml")


def test_new_replaces_nothing_unless_forced(desk: Path) -> None:
    result = call("new", "-o", "k.toml")
    assert result.exit_code == 2
    assert result.stderr == "batik-vector: error: k.toml is there already: --force replaces it\n"
    assert (desk / "k.toml").read_text() == BASE
    good("new", "-o", "k.toml", "--force")
    assert (desk / "k.toml").read_text() != BASE
    assert call("new", "-o", "no/k.toml").stderr.endswith("could not be written: No such file or directory\n")


def test_schema_prints_json() -> None:
    assert json.loads(good("schema").stdout)["title"] == "batik_vector recipe"


def test_the_formats_and_kinds_of_the_command_are_those_of_the_package() -> None:
    assert FORMATS == tuple(export.FORMATS) == tuple(OUTPUTS)
    assert list(KINDS) == sorted(path.stem for path in STARTERS.glob("*.toml"))
    for name, output in OUTPUTS.items():
        assert output.writer is export.FORMATS[name].options
        assert output().options == export.FORMATS[name].options()


@pytest.mark.parametrize("command", [[], ["compile"], ["check"], ["new"], ["schema"]])
def test_help_is_there_for_every_command(command: Sequence[str]) -> None:
    assert "Usage:" in good(*command, "--help").stdout


def python(*args: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, *args], capture_output=True, text=True, check=False, timeout=60)


def test_help_and_version_import_nothing_heavy() -> None:
    for option in ("--help", "--version"):
        run = python("-X", "importtime", "-m", "batik_vector", option)
        assert run.returncode == 0
        imported = {line.rpartition("|")[2].strip() for line in run.stderr.splitlines()}
        assert "click" in imported
        assert not imported & {
            "numpy",
            "shapely",
            "pydantic",
            "tomlkit",
            "tqdm",
            "batik_vector.recipe.model",
            "tomllib",
        }
    assert run.stdout == f"batik-vector, version {batik_vector.__version__}\n"


@pytest.mark.parametrize(("asked", "threads"), [(None, "1"), ("2", "2")])
def test_the_command_asks_for_one_thread_of_linear_algebra_unless_told_otherwise(
    monkeypatch: pytest.MonkeyPatch, asked: str | None, threads: str
) -> None:
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    if asked:
        monkeypatch.setenv("OPENBLAS_NUM_THREADS", asked)
    code = "import atexit, os; atexit.register(lambda: print(os.environ['OPENBLAS_NUM_THREADS']))\n"
    run = python(
        "-c", code + "import sys; sys.argv[1:] = ['compile', 'k.toml']; import batik_vector.__main__"
    )
    assert (run.returncode, run.stdout) == (0, f"{threads}\n"), run.stderr
    run = python(
        "-c", "import os, batik_vector; batik_vector.load_recipe; print('OPENBLAS_NUM_THREADS' in os.environ)"
    )
    assert run.stdout == f"{asked is not None}\n"


def test_garbage_is_collected_while_the_command_works_and_after_it() -> None:
    code = (
        "import gc, sys, batik_vector.making.running as running\n"
        "work, seen = running.run, []\n"
        "running.run = lambda *args, **keys: (seen.append(gc.isenabled()), work(*args, **keys))[1]\n"
        "sys.argv[1:] = ['compile', 'k.toml']\n"
        "try: import batik_vector.__main__\n"
        "except SystemExit: print(seen, gc.isenabled())"
    )
    assert python("-c", code).stdout == "[True] True\n"


def test_a_reader_that_goes_away_is_no_error() -> None:
    code = (
        "import os, sys, subprocess\n"
        "child = subprocess.Popen([sys.executable, '-m', 'batik_vector', 'schema'],"
        " stdout=subprocess.PIPE, stderr=subprocess.PIPE)\n"
        "child.stdout.read(1); child.stdout.close()\n"
        "print(child.stderr.read().decode(), child.wait())"
    )
    run = python("-c", code)
    assert run.stdout.split() in ([str(128 + signal.SIGPIPE)], ["0"])


def test_the_front_door() -> None:
    for name in batik_vector.__all__:
        assert getattr(batik_vector, name) is not None
        assert name in dir(batik_vector)
    with pytest.raises(AttributeError, match="no attribute 'compile_recipee'"):
        _ = batik_vector.compile_recipee
    run = python("-c", "import sys, batik_vector; print('numpy' in sys.modules, batik_vector.__version__)")
    assert run.stdout == f"False {batik_vector.__version__}\n"


@pytest.mark.parametrize("error", [MemoryError(), shapely.errors.GEOSException("std::bad_alloc")])
def test_where_memory_runs_out_it_is_said(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    def starved(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("batik_vector.command.checks.check_source", starved)
    result = runner().invoke(cli, ["check", "any.toml"])
    assert result.exit_code == 2
    assert "more memory than there is" in result.stderr
