"""The commands of the library, as they are typed."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from batik_vector import read_recipe
from batik_vector.command.cli import cli
from batik_vector.command.library_changes import _Task
from batik_vector.errors import Fault
from batik_vector.library import Library
from batik_vector.making.pool import Failure, Outcome, outcomes
from tests.calling import runner
from tests.library.test_store import RECIPE

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(autouse=True)
def own_library(desk: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = desk / "my.library"
    monkeypatch.setenv("BATIK_LIBRARY", str(path))
    for number in (1, 2):
        (desk / f"dots{number}.toml").write_text(RECIPE.format(number=number * 5), encoding="utf-8")
    return path


def call(*words: str, exit_code: int = 0) -> tuple[str, str]:
    done = runner().invoke(cli, list(words), catch_exceptions=False)
    assert done.exit_code == exit_code, done.stderr
    return done.stdout, done.stderr


def told(*words: str, exit_code: int = 0) -> dict[str, Any]:
    report: dict[str, Any] = json.loads(call(*words, "--json", exit_code=exit_code)[0])
    assert report["exit"] == exit_code
    return report


def test_a_pattern_is_kept_found_changed_and_brought_back() -> None:
    assert "dots@1 saved" in call("library", "add", "dots1.toml", "--name", "dots", "--tag", "Round")[1]
    assert "dots@2 saved" in call("library", "add", "dots2.toml", "--name", "dots", "--note", "larger")[1]
    assert "says the same" in call("library", "add", "dots2.toml", "--name", "dots")[1]
    assert call("library", "search", "larg", "--own")[0] == "dots@2  Dots 10  [round]\n"
    assert call("library", "search", "--where", "width = 40, coverage < 6", "--own")[0].startswith("dots@2")
    assert call("library", "list", "--own")[0] == "dots@2  Dots 10  [round]\n"
    shown = call("library", "show", "dots")[0]
    for words in ("dots@2  Dots 10", "from dots2.toml", "tags: round", "coverage 4.89", "larger"):
        assert words in shown
    assert call("library", "show", "dots@1", "--recipe")[0] == RECIPE.format(number=5)
    diff = call("library", "diff", "dots")[0]
    assert "--- dots@1\n+++ dots@2\n" in diff
    assert "-width = 5\n+width = 10\n" in diff
    assert "say the same" in call("library", "diff", "dots@2")[1]
    assert "dots@3 is the newest" in call("library", "restore", "dots@1")[1]
    assert [line.split()[0] for line in call("library", "history", "dots")[0].splitlines()] == [
        "@1",
        "@2",
        "@3",
    ]
    assert call("library", "tag", "dots", "x", "y")[1] == "dots: round, x, y\n"
    assert call("library", "tag", "dots", "x", "--remove")[1] == "dots: round, y\n"
    assert call("library", "note", "dots", "and smaller")[0] == "larger\nand smaller\n"
    assert call("library", "note", "dots")[0] == "larger\nand smaller\n"
    assert "library restore dots brings it back" in call("library", "remove", "dots")[1]
    assert call("library", "list", "--own")[0] == ""
    assert call("library", "list", "--removed")[0].startswith("dots@3")
    call("library", "restore", "dots")
    assert "sound" in call("library", "check")[1]
    assert "1 pattern of your own" in call("library", "stats")[0]
    call("library", "remove", "dots", "--for-good")
    assert "no pattern" in call("library", "show", "dots", exit_code=2)[1]


def test_every_command_reports_to_machines(own_library: Path) -> None:
    assert told("library", "add", "dots1.toml", "--name", "dots")["patterns"] == [
        {"name": "dots", "version": 1, "saved": True, "origin": "dots1.toml"}
    ]
    (entry,) = told("library", "list", "--own")["patterns"]
    assert entry | {"saved": ""} == {
        "name": "dots", "version": 1, "title": "Dots 5", "saved": "", "included": False, "tags": []
    }  # fmt: skip
    (hit,) = told("library", "search", "dots", "--own", "--like", "dots")["patterns"]
    assert hit["distance"] == 0
    assert hit["features"]["inks"] == 1
    (shown,) = told("library", "show", "dots")["patterns"]
    assert shown["recipe"] == RECIPE.format(number=5)
    assert told("library", "tag", "dots", "x")["patterns"] == [{"name": "dots", "tags": ["x"]}]
    assert told("library", "note", "dots", "why")["notes"][0]["text"] == "why"
    assert told("library", "history", "dots")["versions"][0]["version"] == 1
    assert told("library", "diff", "dots")["differences"] == []
    assert told("library", "restore", "dots@1")["patterns"] == [
        {"name": "dots", "version": 1, "saved": False}
    ]
    assert told("library", "stats")["library"][0]["path"] == str(own_library)
    assert told("library", "check")["library"][0]["faults"] == []
    assert told("library", "export", "dots")["files"] == [{"path": "dots.toml", "format": "toml"}]
    assert told("library", "remove", "dots")["patterns"] == [{"name": "dots", "removed": True}]
    report = told("library", "show", "dots", exit_code=2)
    assert "restore brings it back" in report["faults"][0]["message"]
    report = told("library", "search", "--where", "inkz = 1", exit_code=2)
    assert 'did you mean "inks"' in report["faults"][0]["message"]


def test_a_pattern_of_the_library_is_a_recipe_wherever_one_is_taken(desk: Path) -> None:
    call("library", "add", "dots1.toml", "--name", "dots")
    call("library", "add", "dots2.toml", "--name", "dots")
    call("compile", "library:dots@1", "library:sample/kawung", "-o", "out", "--set", "tolerance=0.05")
    assert sorted(each.name for each in Path("out").iterdir()) == ["dots.svg", "kawung.svg"]
    assert "Dots 5" in Path("out/dots.svg").read_text(encoding="utf-8")
    # A file made of it says so by its recipe, as any other.
    call("compile", "out/dots.svg", "-f", "dxf", "-o", "out")
    assert "library:dots: passed" in call("check", "library:dots")[0]
    assert 'kind = "svg"' in call("export-motif", "library:dots", "dot")[0]
    call("sweep", "library:dots", "--vary", "place[0].width=4,8", "-o", "swept")
    assert len(list(Path("swept").glob("dots*.svg"))) == 2
    call("library", "add", "library:dots@1", "--name", "copy")
    assert call("library", "show", "copy", "--recipe")[0] == RECIPE.format(number=5)
    assert "library:dots@7" not in call("compile", "library:dots@7", exit_code=2)[0]
    assert '"dots" has no version 7: expected 1 to 2' in call("compile", "library:dots@7", exit_code=2)[1]
    assert "expected the name of a pattern" in call("check", "library:", exit_code=2)[1]


def test_faults_of_a_pattern_are_told_by_name_and_line() -> None:
    call("library", "add", "dots1.toml", "--name", "dots")
    words = call("compile", "library:dots", "--set", "tile.size=3", exit_code=2)[1]
    assert "tile.size" in words
    assert words.startswith("batik-vector: error: ")


def test_another_file_is_named_by_option_or_for_one_call(desk: Path) -> None:
    call("library", "add", "dots1.toml", "--library", "other.library")
    assert call("library", "list", "--own", "--library", "other.library")[0].startswith("dots1@1")
    assert "no such library" in call("library", "list", "--library", "typo", exit_code=2)[1]
    command = [sys.executable, "-m", "batik_vector", "--library", "other.library", "compile", "library:dots1"]
    subprocess.run(command, check=True, capture_output=True, cwd=desk)
    assert (desk / "dots1.svg").exists()


def test_files_go_out_in_every_format_and_come_back(desk: Path) -> None:
    call("library", "add", "dots1.toml", "dots2.toml")
    call("library", "export", "--all", "-o", "out", "-f", "toml,svg,pdf,dxf")
    assert len(list(Path("out").iterdir())) == 8
    assert (
        "is there already: --force replaces it"
        in call("library", "export", "dots1", "-o", "out", exit_code=2)[1]
    )
    call("library", "export", "dots1", "-o", "out", "--force")
    call("library", "export", "--all", "-o", "mine.zip")
    before = Path("mine.zip").read_bytes()
    call("library", "export", "--all", "-o", "mine.zip", "--force")
    for place in ("fresh/library.zip", "another/deep/mine.zip"):
        asked = ("-f", "zip", "-o", "fresh") if "fresh" in place else ("-o", place)
        assert f"{place}  1 pattern, 1 version" in call("library", "export", "dots1", *asked)[1]
    assert Path("mine.zip").read_bytes() == before
    words = call("library", "add", "mine.zip", "out/dots2.pdf", "--library", "other.library")[1]
    assert words == ("dots1@1 saved\ndots2@1 saved\ndots2@1 is there already, and says the same\n")
    assert 'did you mean "png"' in call("library", "export", "dots1", "-f", "jpg", exit_code=2)[1]
    assert "nothing to export" in call("library", "export", exit_code=2)[1]
    both = call("library", "export", "sample/kawung", "starter/kawung", "-o", "both", exit_code=2)[1]
    assert "would both be written to" in both
    assert not Path("both").exists()


def test_a_recipe_that_does_not_compile_keeps_back_no_other(desk: Path) -> None:
    (desk / "bad.toml").write_text(RECIPE.format(number=1).replace("circle", "cirle"), encoding="utf-8")
    report = told("library", "add", "bad.toml", "dots1.toml", exit_code=2)
    assert report["faults"][0]["source"] == "bad.toml"
    assert [each["name"] for each in report["patterns"]] == ["dots1"]


def test_no_library_is_begun_for_nothing(desk: Path, own_library: Path) -> None:
    assert "nofile.toml: no such file" in call("library", "add", "nofile.toml", exit_code=2)[1]
    assert not own_library.exists()


def test_many_recipes_are_measured_by_several_processes(desk: Path) -> None:
    folder = desk / "many"
    folder.mkdir()
    for number in range(1, 8):
        (folder / f"d{number}.toml").write_text(RECIPE.format(number=number), encoding="utf-8")
    (folder / "d8.toml").write_text(RECIPE.format(number=1) + "limit = 1000\n", encoding="utf-8")
    report = told("library", "add", "many", "-j", "2", exit_code=2)
    assert [each["name"] for each in report["patterns"]] == [f"d{number}" for number in range(1, 8)]
    with Library() as library:
        assert [library.features(f"d{number}")["marks"] for number in range(1, 8)] == [1] * 7


def test_a_process_that_dies_costs_its_recipe_alone(desk: Path) -> None:
    (desk / "many").mkdir()
    for number in range(1, 8):
        (desk / "many" / f"d{number}.toml").write_text(RECIPE.format(number=number), encoding="utf-8")
    died: Outcome[Any, Any] = Outcome(
        _Task(2, "", "many/d3.toml"), None, Failure((Fault("the process was ended"),))
    )

    def dying(work: Any, tasks: Any, workers: int) -> Iterator[Any]:
        assert workers == 2
        yield from (died if each.task.number == 2 else each for each in outcomes(work, tasks))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("batik_vector.making.pool.outcomes", dying)
        report = told("library", "add", "many", "-j", "2", exit_code=2)
    (fault,) = report["faults"]
    assert (fault["source"], fault["message"]) == ("many/d3.toml", "the process was ended")
    assert [each["name"] for each in report["patterns"]] == ["d1", "d2", "d4", "d5", "d6", "d7"]


def test_likeness_to_a_file_needs_no_saving(desk: Path) -> None:
    call("library", "add", "dots1.toml")
    assert call("library", "search", "--own", "--like", "dots1.toml")[0].startswith(" 0.000  dots1@1")
    assert call("library", "search", "--own")[0].startswith("dots1@1")


def test_a_picture_is_written(desk: Path) -> None:
    call("library", "show", "sample/group-pg", "--picture", "pg.svg")
    call("library", "show", "sample/group-pg", "--picture", "pg.png")
    assert Path("pg.svg").read_bytes().startswith(b"<?xml")
    assert Path("pg.png").read_bytes().startswith(b"\x89PNG")
    assert "is there already" in call("library", "show", "kawung", "--picture", "pg.svg", exit_code=2)[1]
    assert "no name of a picture" in call("library", "show", "kawung", "--picture", "pg.gif", exit_code=2)[1]


def test_what_lacks_features_is_measured_when_asked(own_library: Path) -> None:
    from batik_vector.library.measuring import Measured

    with Library(own_library) as library:
        library.add("dots", read_recipe(RECIPE.format(number=5)), measured=Measured())
    assert "dots" in told("library", "check")["library"][0]["unmeasured"]
    assert "never measured: library check --measure" in call("library", "check")[1]
    assert "sound" in call("library", "check", "--measure")[1]
    assert told("library", "check")["library"][0]["unmeasured"] == []


def test_damage_is_an_exit_code_and_a_report(own_library: Path) -> None:
    import sqlite3

    call("library", "add", "dots1.toml")
    connection = sqlite3.connect(own_library)
    connection.execute("UPDATE words SET text = 'x' WHERE text LIKE 'dots1%'")
    connection.commit()
    connection.close()
    assert "the index of words is out of date" in call("library", "check", exit_code=1)[1]
    assert told("library", "check", exit_code=1)["library"][0]["faults"]


def test_help_and_search_import_nothing_heavy(own_library: Path) -> None:
    call("library", "add", "dots1.toml")
    heavy = "('numpy', 'shapely', 'pydantic', 'svgwrite', 'cairosvg', 'tomllib', 'platformdirs')"
    for words in (
        ["library", "--help"],
        ["library", "search", "dots", "--like", "dots1", "--where", "inks=1"],
    ):
        script = (
            "import sys; from batik_vector.command.cli import cli; "
            f"cli({words!r}, standalone_mode=False); "
            f"print([name for name in {heavy} if name in sys.modules], file=sys.stderr)"
        )
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
        assert done.stderr.splitlines()[-1] == "[]"
