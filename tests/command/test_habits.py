"""What hands expect of a command: pipes, a trial that writes nothing, help, completion, a manual page."""

from __future__ import annotations

import io
import json
import os
import re
from pathlib import Path

import click
import pytest
from click.testing import Result

from batik_vector.command.cli import KINDS, cli
from batik_vector.command.manual import EXIT_CODES, manual
from batik_vector.machines.shipped import MACHINES
from batik_vector.making.destinations import nowhere
from tests.calling import runner

RECIPE = """title = "Dot"
[motif.dot]
kind = "rosette"
elements = [{ curve = { kind = "circle", radius = 4 } }]
[ink.wax]
[[place]]
motif = "dot"
width = 8
at = [6, 6]
[tile]
size = [20, 20]
"""


@pytest.fixture(autouse=True)
def recipe(desk: Path) -> Path:
    (desk / "dot.toml").write_text(RECIPE)
    return desk / "dot.toml"


def call(*words: str, stdin: str | bytes = "", code: int = 0) -> Result:
    done = runner().invoke(cli, list(words), input=stdin, catch_exceptions=False)
    assert done.exit_code == code, done.stderr
    return done


def names() -> list[str]:
    return sorted(os.listdir())


def test_a_recipe_comes_from_stdin_and_the_file_goes_to_stdout() -> None:
    call("compile", "dot.toml", "-f", "svg,dxf")
    for kind in ("svg", "dxf"):
        assert call("compile", "-", "-o", "-", "-f", kind, stdin=RECIPE).stdout_bytes == (
            Path(f"dot.{kind}").read_bytes()
        )
    assert "stdin: passed" in call("check", "-", stdin=RECIPE).stdout
    call("compile", "-", stdin=RECIPE)
    assert names() == ["dot.dxf", "dot.svg", "dot.toml", "recipe.svg"]


def test_a_compiled_file_comes_from_stdin() -> None:
    plain = call("compile", "-", "-o", "-", "-f", "svg", stdin=RECIPE).stdout_bytes
    for kind in ("svg", "pdf", "dxf", "png", "gcode"):
        made = call("compile", "-", "-o", "-", "-f", kind, stdin=RECIPE).stdout_bytes
        assert call("compile", "-", "-o", "-", "-f", "svg", stdin=made).stdout_bytes == plain
    assert "stdin: carries no recipe" in call("compile", "-", stdin="<svg/>", code=2).stderr
    cut = call("compile", "-", "-o", "-", "-f", "pdf", stdin=RECIPE).stdout_bytes[:200]
    assert "stdin: is no readable PDF" in call("compile", "-", stdin=cut, code=2).stderr


def test_faults_of_stdin_are_told_with_their_line() -> None:
    told = call("compile", "-", stdin=RECIPE.replace("radius = 4", "radius = -4"), code=2).stderr
    assert "stdin:4: motif.dot.elements[0].curve.radius: -4, expected" in told
    assert "stdin: is empty" in call("compile", "-", code=2).stderr
    assert "stdin:1: is no text in UTF-8" in call("compile", "-", stdin=b"\xff", code=2).stderr
    assert "can be read once" in call("compile", "-", "-", stdin=RECIPE, code=2).stderr
    assert names() == ["dot.toml"]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("dot.toml", "-f", "svg,dxf"), "holds one file, this makes 2"),
        (("dot.toml", "dot.toml", "-f", "svg"), "as dot.toml would"),
        (("dot.toml", "--json"), "leave out --json"),
        (("dot.toml", "-f", "png", "--set", "tolerance=0"), "tolerance: 0, expected"),
    ],
)
def test_what_stdout_cannot_hold_is_refused_with_nothing_on_it(words: tuple[str, ...], told: str) -> None:
    done = call("compile", *words, "-o", "-", code=2)
    assert told in done.stderr
    assert done.stdout_bytes == b"" or "--json" in words


def test_a_sheet_too_many_leaves_stdout_empty() -> None:
    done = call("compile", "dot.toml", "-f", "hpgl", "--machine", "hp7475a", "--pages", "tile", "-o", "-",
                "--set", "tile.size=[900,500]", code=2)  # fmt: skip
    assert "expected one: standard output holds no more" in done.stderr
    assert done.stdout_bytes == b""


def test_a_dry_run_tells_what_a_run_writes_and_writes_nothing() -> None:
    words = ("compile", "dot.toml", "-f", "svg,pdf,dxf,hpgl", "--json", "-o", "out/new")
    dry, dry_on_two = (
        json.loads(call(*words, "--dry-run", "-j", cores).stdout)["recipes"][0] for cores in ("1", "2")
    )
    assert names() == ["dot.toml"]
    real = json.loads(call(*words).stdout)["recipes"][0]
    assert [(each["path"], each["bytes"], each["size_mm"]) for each in dry["files"]] == [
        (each["path"], each["bytes"], each["size_mm"]) for each in real["files"]
    ]
    assert dry["written"] is dry_on_two["written"] is False
    assert "written" not in real
    assert all(os.path.getsize(each["path"]) == each["bytes"] for each in dry["files"])
    told = call("compile", "dot.toml", "--dry-run").stderr
    assert re.search(r"^dot\.svg .* not written$", told, re.MULTILINE)


def test_nowhere_knows_how_far_a_file_would_reach() -> None:
    seen: list[int] = []

    def write(sink: io.BufferedIOBase) -> None:
        sink.write(b"12345678")
        sink.seek(2)
        sink.write(b"ab")
        seen.append(sink.tell())
        seen.append(sink.seek(0, os.SEEK_END))

    nowhere([(Path("x"), write)])  # type: ignore[list-item]
    assert seen == [4, 8]


def test_curves_are_fitted_on_a_flag() -> None:
    plain = call("compile", "dot.toml", "-o", "-").stdout
    fitted = call("compile", "dot.toml", "-o", "-", "--curves", "bezier").stdout
    assert re.search(r' d="M[^"]*C', fitted)
    assert not re.search(r' d="M[^"]*C', plain)
    assert len(fitted) < len(plain)
    told = call("compile", "dot.toml", "-f", "dxf", "--curves", "bezier", code=2).stderr
    assert "--curves: no file that is made has it" in told


Words = tuple[str, ...]


def commands(command: click.Command = cli, path: Words = ()) -> list[tuple[Words, click.Command]]:
    found = [(path, command)]
    if isinstance(command, click.Group):
        for name, each in command.commands.items():
            found += commands(each, (*path, name))
    return found


def test_every_help_says_what_the_command_exits_with() -> None:
    for path, _ in commands():
        told = " ".join(call(*path, "--help").stdout.split())
        for code, words in EXIT_CODES:
            assert f"{code}: {words}" in told, path


def test_the_manual_page_is_made_of_the_declarations() -> None:
    page = call("man").stdout
    assert page == manual(cli) == call("man").stdout
    for path, command in commands():
        if path:
            assert f".SS {' '.join(path)}\n".replace("-", "\\-") in page
        for each in command.params:
            if isinstance(each, click.Option):
                assert max(each.opts, key=len).replace("-", "\\-") in page
    for name in ("NAME", "SYNOPSIS", "OPTIONS", "COMMANDS", "EXIT STATUS", "ENVIRONMENT"):
        assert f"\n.SH {name}\n" in page
    known = {"TH", "SH", "SS", "B", "PP", "TP"}
    assert {line[1:].split()[0] for line in page.splitlines() if line[:1] in (".", "'")} == known


def test_a_word_that_roff_would_read_is_not_read() -> None:
    odd = click.Command("odd", help=".so /etc/passwd \\n\n\n'br", params=[click.Option(["--x"], help=".rm")])
    lines = manual(click.Group("all", commands={"odd": odd})).splitlines()
    assert "\\&.so /etc/passwd \\en" in lines
    assert "\\&'br" in lines
    assert "\\&.rm" in lines


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_shells_complete_commands_and_options(shell: str) -> None:
    words = {
        "bash": {"COMP_WORDS": "batik-vector compile --dr", "COMP_CWORD": "2"},
        "zsh": {"COMP_WORDS": "batik-vector compile --dr", "COMP_CWORD": "2"},
        "fish": {"COMP_WORDS": "batik-vector compile --dr", "COMP_CWORD": "--dr"},
    }[shell]
    done = runner().invoke(
        cli, prog_name="batik-vector", env={"_BATIK_VECTOR_COMPLETE": f"{shell}_complete", **words},
        complete_var="_BATIK_VECTOR_COMPLETE",
    )  # fmt: skip
    assert "--dry-run" in done.stdout


@pytest.mark.parametrize(
    ("words", "last", "found"),
    [
        (("compile", "-f"), "h", ["hpgl"]),
        (("compile", "-f"), "svg,p", ["svg,pdf", "svg,png"]),
        (("new", "--kind"), "ka", ["kawung"]),
        (("compile", "--machine"), "vi", ["vinyl-cutter"]),
        (("check", "--machine"), "wax", ["wax-pen"]),
    ],
)
def test_values_are_completed(words: tuple[str, ...], last: str, found: list[str]) -> None:
    from click.shell_completion import ShellComplete

    offered = ShellComplete(cli, {}, "batik-vector", "_X").get_completions(list(words), last)
    assert [each.value for each in offered] == found
    assert set(found) <= {*KINDS, *MACHINES, "hpgl", "svg,pdf", "svg,png"}


def test_files_and_folders_are_completed() -> None:
    from click.shell_completion import ShellComplete

    shell = ShellComplete(cli, {}, "batik-vector", "_X")
    for path, command in commands():
        for param in command.params:
            words = param.metavar or ""
            if isinstance(param, click.Argument) and any(each in words for each in ("RECIPE", ".svg")):
                (offered,) = shell.get_completions(list(path), "mi")
                assert (offered.value, offered.type) == ("mi", "file"), path
            elif "-o" in param.opts:
                (offered,) = shell.get_completions([*path, "--output"], "ou")
                assert offered.type == ("dir" if "DIR" in words else "file"), path


@pytest.mark.parametrize(
    ("word", "hint"),
    [("mine.toml", "batik-vector compile mine.toml"), ("kawung", "batik-vector new kawung"), ("compil", "")],
)
def test_what_is_no_command_is_told_what_to_write(word: str, hint: str) -> None:
    done = runner().invoke(cli, [word])
    assert done.exit_code == 2
    assert f"No such command '{word}'" in done.stderr
    assert hint in done.stderr
    assert ("batik-vector compile" in done.stderr) == (word == "mine.toml")


def test_nothing_is_coloured() -> None:
    for words in (("--help",), ("compile", "no.toml"), ("check", "dot.toml")):
        done = runner().invoke(cli, list(words), color=True)
        assert "\x1b" not in done.stdout + done.stderr
