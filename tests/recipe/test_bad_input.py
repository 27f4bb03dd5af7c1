"""Wrong recipes and wrong calls: exit 2, the words that help, and no file touched."""

from __future__ import annotations

import errno
import os
import time
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from click.testing import Result

from batik_vector.command.cli import cli
from batik_vector.errors import ExportError, SeamError
from tests.calling import runner
from tests.thorough import slow

BASE = """\
title = "Test"
tolerance = "0.1 mm"

[motif.flower]
kind = "flower"
leaf = { a = 0.2, b = 2, length = 1.2, width = 0.3, count = 8 }
petal = { length = 1.0, n = 4, count = 8 }
pistil = { length = 0.8, count = 16, cusp = 5 }

[ink.wax]
colour = "#f4efe2"

[[place]]
motif = "flower"
layout = { kind = "julian", power = 4, dist = 4, level = 1, shift = [1.3333, 1.3333] }
width = "280 mm"
ink = "wax"

[tile]
size = ["320 mm", "320 mm"]
repeat = "half-drop"

[[output]]
format = "svg"
"""

CASES = tomllib.loads((Path(__file__).parent / "bad_input.toml").read_text("utf-8"))


def recipe(lines: Mapping[int, str] = {}) -> str:
    """Return the base recipe with some of its lines, counted from 1, replaced."""
    text = BASE.split("\n")
    for number, line in lines.items():
        text[number - 1] = line
    return "\n".join(text)


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder with a good recipe, and an output folder with older files, which nothing may touch."""
    monkeypatch.chdir(tmp_path)
    out = tmp_path / "out"
    out.mkdir()
    for name in ("k.svg", "k.pdf", "k.dxf", "k.png"):
        (out / name).write_bytes(b"old")
    (tmp_path / "good.toml").write_text(BASE)
    yield tmp_path
    for path in out.iterdir():
        assert path.is_dir() or path.read_bytes() == b"old", f"{path} was touched"
    assert not list(tmp_path.glob("**/.batik-*")), "a temporary file was left behind"


def call(*args: str, folder: str = "out") -> Result:
    return runner().invoke(cli, ["compile", "-o", folder, *args])


def complaints(result: Result, code: int = 2) -> list[str]:
    """Return the lines of error, after making sure that they are all that was said."""
    assert result.exit_code == code, (result.output, result.exception)
    assert result.stdout == ""
    lines = result.stderr.splitlines()
    assert all(line.startswith("batik-vector: error: ") for line in lines)
    return [line.removeprefix("batik-vector: error: ") for line in lines]


LONGEST = ("bridges broader than an island", "a sheet that does not hold all")


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(case, marks=[slow] * (case["name"] in LONGEST), id=case["name"])
        for case in CASES["recipe"]
    ],
)
def test_a_wrong_recipe_is_told_in_one_clear_line(desk: Path, case: dict[str, Any]) -> None:
    (desk / "k.toml").write_text(recipe({int(number): line for number, line in case["lines"].items()}))
    found = complaints(call("k.toml"))
    if "parts" in case:
        assert len(found) == 1
        assert all(part in found[0] for part in case["parts"])
    else:
        assert found == case["expected"]


def test_all_faults_of_all_recipes_are_told_at_once(desk: Path) -> None:
    (desk / "k.toml").write_text(recipe({2: "tolerance = 0", 14: 'motif = "x"', 21: 'repeat = "x"', 24: ""}))
    (desk / "j.toml").write_text(recipe({1: "titel = 3"}))
    found = complaints(call("k.toml", "good.toml", "j.toml"))
    assert [line.split(": ")[0] for line in found] == [
        "k.toml:2",
        "k.toml:14",
        "k.toml:21",
        "k.toml:23",
        "j.toml:1",
    ]


def test_a_thousand_levels_are_refused_at_once_with_the_estimate(desk: Path) -> None:
    (desk / "k.toml").write_text(recipe({15: 'layout = { kind = "julian", level = 1000 }'}))
    begun = time.process_time()
    found = complaints(call("k.toml"))
    assert time.process_time() - begun < 2
    assert len(found) == 1
    assert found[0].startswith("k.toml:15: place[0].layout: level 1000 makes about 10^602 copies")


FILES: list[tuple[str, bytes, str]] = [
    ("empty", b"", 'k.toml: is empty, expected a recipe: "batik-vector new" writes one to begin with'),
    (
        "comment",
        b"# soon\n",
        'k.toml: is empty, expected a recipe: "batik-vector new" writes one to begin with',
    ),
    ("binary", b"title = 'x'\n\xff\xfe\x00\x01", "k.toml:2: is no text in UTF-8, expected a recipe in TOML"),
    ("nul", b"title = 'x'\n\x00", "k.toml:2: is no valid TOML: invalid statement (column 1)"),
    ("deep list", b"a = " + b"[" * 20000, "k.toml: nested deeper than 64 tables"),
    ("deep tables", b"a = " + b"{a = " * 100 + b"1" + b"}" * 100, "k.toml: nested deeper than 64 tables"),
    ("deep key", b"a." * 200_000 + b"a = 1", "k.toml:1: nested deeper than 64 tables"),
    ("long number", b"seed = " + b"9" * 5000, "k.toml: is no valid TOML: Exceeds the limit"),
    (
        "long hex",
        b"seed = 0x" + b"f" * 500_000,
        "k.toml:1: seed: a whole number of more than 60 digits, expected",
    ),
    ("wide", b"x = 1\n" * 200_000, "k.toml: 1,200,000 bytes, expected at most 1,048,576"),
    ("long key", b"x" * 500_000 + b" = 1\n" + BASE.encode(), 'k.toml:1: unknown key "' + "x" * 60),
]


@pytest.mark.parametrize(("data", "expected"), [case[1:] for case in FILES], ids=[case[0] for case in FILES])
def test_what_is_no_recipe_is_refused_quickly(desk: Path, data: bytes, expected: str) -> None:
    (desk / "k.toml").write_bytes(data)
    begun = time.process_time()
    found = complaints(call("k.toml"))
    assert time.process_time() - begun < 2
    assert len(found) == 1
    assert found[0].startswith(expected)
    assert len(found[0]) < 400


def test_a_hundred_megabytes_are_not_read(desk: Path) -> None:
    with open("k.toml", "wb") as file:
        file.truncate(100 << 20)
    assert complaints(call("k.toml")) == ["k.toml: 104,857,600 bytes, expected at most 1,048,576"]


def test_a_device_without_end_is_not_read_to_its_end(desk: Path) -> None:
    assert complaints(call("/dev/zero")) == ["/dev/zero: more than 1,048,576 bytes, expected a recipe"]


DEEP = [
    {
        "name": "--set deep",
        "args": ["good.toml", "--set", "a." * 3000 + "a=3"],
        "part": "nested deeper than 64",
    },
    {
        "name": "--set deep value",
        "args": ["good.toml", "--set", "a=" + "[" * 200 + "]" * 200],
        "part": "nested deeper than 64 tables",
    },
]


@pytest.mark.parametrize("case", CASES["call"] + DEEP, ids=lambda case: case["name"])
def test_a_wrong_call_is_told_in_one_clear_line(desk: Path, case: dict[str, Any]) -> None:
    (desk / "foreign.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    (desk / "bomb.svg").write_text(
        '<!DOCTYPE svg [<!ENTITY a "b">]><svg xmlns="http://www.w3.org/2000/svg"/>'
    )
    found = complaints(call(*case["args"]))
    assert len(found) == 1
    assert case["part"] in found[0]
    assert len(found[0]) < 400


USAGE: list[tuple[str, list[str], str]] = [
    ("no recipe", ["compile"], "Missing argument 'RECIPE…'"),
    ("unknown format", ["compile", "good.toml", "-f", "dfx"], 'unknown format "dfx": did you mean "dxf"?'),
    ("unknown option", ["compile", "good.toml", "--fromat", "svg"], "No such option"),
    ("unknown command", ["compil", "good.toml"], "No such command 'compil'"),
    ("unknown starter", ["new", "--kind", "flour"], 'unknown kind "flour": did you mean "flower"?'),
]


@pytest.mark.parametrize(("args", "expected"), [case[1:] for case in USAGE], ids=[case[0] for case in USAGE])
def test_a_call_that_makes_no_sense(desk: Path, args: list[str], expected: str) -> None:
    result = runner().invoke(cli, args)
    assert result.exit_code == 2
    assert expected in result.stderr


def test_two_recipes_of_one_name_are_refused(desk: Path) -> None:
    (desk / "other").mkdir()
    (desk / "other" / "k.toml").write_text(BASE)
    (desk / "k.toml").write_text(BASE)
    assert complaints(call("k.toml", "other/k.toml")) == [
        'other/k.toml: would be written to "out/k.svg", as k.toml would: '
        "rename one, or use another folder for it"
    ]


def test_two_outputs_of_one_name_are_refused(desk: Path) -> None:
    (desk / "k.toml").write_text(BASE + '\n[[output]]\nformat = "svg"\n')
    assert complaints(call("k.toml")) == [
        'k.toml:26: output[1]: would be written to "out/k.svg", as an output before it would: '
        "give it a name of its own"
    ]


def test_a_field_too_large_is_told_of_its_output(desk: Path) -> None:
    (desk / "k.toml").write_text(BASE + "repeat = [200, 200]")
    found = complaints(call("k.toml"))
    assert len(found) == 1
    assert found[0].startswith("k.toml:23: output[0]: the field would have about ")


def test_a_seam_that_does_not_hold_is_a_fault_of_the_work(
    desk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def gape(*_: Any, **__: Any) -> None:
        raise SeamError("opposite edges disagree")

    (desk / "k.toml").write_text(BASE)
    monkeypatch.setattr("batik_vector.making.running.compile_recipe", gape)
    assert complaints(call("k.toml"), 1) == ["k.toml: opposite edges disagree"]


def test_an_output_that_is_a_folder_is_refused(desk: Path) -> None:
    (desk / "out" / "good.svg").mkdir()
    assert complaints(call("good.toml")) == ["out/good.svg could not be written: it is a folder"]


def test_an_output_that_is_a_link_is_refused(desk: Path) -> None:
    (desk / "target").write_bytes(b"old")
    (desk / "out" / "good.svg").symlink_to(desk / "target")
    assert complaints(call("good.toml")) == ["out/good.svg could not be written: it is a symbolic link"]
    assert (desk / "target").read_bytes() == b"old"


def test_an_output_folder_that_is_a_file_is_refused(desk: Path) -> None:
    assert complaints(call("good.toml", folder="good.toml")) == ["good.toml is a file, expected a folder"]
    assert complaints(call("good.toml", folder="good.toml/x")) == ["good.toml is a file, expected a folder"]


def test_a_folder_that_may_not_be_written_to_is_refused(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    assert complaints(call("good.toml")) == ["out may not be written to"]


def test_a_changed_recipe_does_not_replace_the_file_it_is_read_from(desk: Path) -> None:
    assert call("good.toml", folder="made").exit_code == 0
    before = (desk / "made" / "good.svg").read_bytes()
    words = "made/good.svg would replace the file it is read from: choose another folder with -o"
    assert complaints(call("made/good.svg", "--set", "motif.flower.petal.count=4", folder="made")) == [words]
    assert (desk / "made" / "good.svg").read_bytes() == before


def _full(*_: Any) -> int:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_full_disk_leaves_the_old_files(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (desk / "k.toml").write_text(BASE)
    monkeypatch.setattr("batik_vector.export.files.os.write", _full)
    found = complaints(call("k.toml", "-f", "svg,dxf"))
    assert found == ["out/k.svg could not be written: No space left on device"]


def test_one_recipe_that_fails_late_does_not_keep_back_the_others(desk: Path) -> None:
    (desk / "k.toml").write_text(recipe({1: "limit = 1000"}))
    result = call("k.toml", "good.toml")
    assert result.exit_code == 2
    assert (desk / "out" / "good.svg").exists()
    (desk / "out" / "good.svg").unlink()


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (KeyboardInterrupt(), 130, "interrupted"),
        (MemoryError(), 2, "this needs more memory than there is"),
        (RecursionError(), 2, "this is nested too deeply"),
        (ExportError("the layer has no name"), 2, "the layer has no name"),
    ],
)
def test_a_run_that_stops_halfway_leaves_the_old_files(
    desk: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException, code: int, words: str
) -> None:
    (desk / "k.toml").write_text(BASE)
    calls = []

    def stop(*_: Any) -> bytes:
        calls.append(1)
        if len(calls) == 2:
            raise error
        return b"new"

    monkeypatch.setattr("batik_vector.making.running.render_output", stop)
    found = complaints(call("k.toml", "-f", "svg,pdf"), code)
    assert len(found) == 1
    assert found[0].startswith(words)


def test_a_defect_of_the_program_shows_its_traceback(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("batik_vector.making.running.render_output", lambda *_: 1 / 0)
    result = call("good.toml")
    assert isinstance(result.exception, ZeroDivisionError)
