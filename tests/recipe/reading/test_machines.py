"""Machines that a recipe or a call names: profiles shipped and of one's own, and processes in words."""

from __future__ import annotations

from pathlib import Path

import pytest

from batik_vector.command.cli import cli
from batik_vector.errors import RecipeError
from batik_vector.machines import MACHINES
from batik_vector.processes.options import CutProcess
from batik_vector.recipe.loading import load_recipe
from batik_vector.recipe.reading.called_processes import read_process
from batik_vector.recipe.reading.machines import read_machine
from tests.calling import runner

RECIPE = """[motif.dot]
kind = "path"
d = "M-1 -1H1V1H-1Z"

[[place]]
motif = "dot"
layout = { kind = "single" }
width = "20 mm"

[tile]
size = ["40 mm", "40 mm"]

[[output]]
format = "svg"
machine = "mine.toml"
process = { kind = "plot", join = false }
"""
MINE = """base = "pen-plotter"
says = "Anna's"
tool = { width = "0.3 mm" }
"""


@pytest.fixture
def desk(tmp_path: Path) -> Path:
    """A folder with a recipe and a machine beside it."""
    (tmp_path / "dot.toml").write_text(RECIPE)
    (tmp_path / "mine.toml").write_text(MINE)
    return tmp_path


def _compile(source: Path, folder: Path) -> None:
    done = runner().invoke(cli, ["compile", str(source), "-o", str(folder)])
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize("name", MACHINES)
def test_every_machine_that_comes_along_is_right(name: str) -> None:
    assert read_machine(name).says


def test_a_profile_of_ones_own_begins_from_one_that_comes_along(desk: Path) -> None:
    (output,) = load_recipe(desk / "dot.toml").output
    assert output.machine_profile is not None
    assert output.machine_profile.says == "Anna's"
    assert output.machine_profile.tool.width == 0.3
    assert output.machine_profile.size == read_machine("pen-plotter").size


def test_a_compiled_file_carries_the_machine(desk: Path) -> None:
    _compile(desk / "dot.toml", desk / "out")
    (desk / "mine.toml").unlink()
    compiled = desk / "out" / "dot.svg"
    before = compiled.read_bytes()
    assert b"<batik:process" in before
    _compile(compiled, desk / "again")
    assert (desk / "again" / "dot.svg").read_bytes() == before


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("tool = { wdth = 1 }", 'mine.toml:1: tool: unknown key "wdth": did you mean "width"?'),
        ("[tool]\nwidth = 0", "mine.toml:2: tool.width: 0, expected 0.01 to 100 mm"),
        ('base = "pen"', 'mine.toml:1: base: unknown machine "pen"'),
        ('says = "x"\nbasis = "canting"', 'mine.toml:2: basis: unknown key "basis": did you mean "base"?'),
        ("", "mine.toml: is empty, expected a machine's profile"),
        ("says = ", "mine.toml:1: is no valid TOML"),
    ],
)
def test_what_is_wrong_in_a_profile_is_told_at_its_key(desk: Path, text: str, words: str) -> None:
    (desk / "mine.toml").write_text(text)
    with pytest.raises(RecipeError) as told:
        load_recipe(desk / "dot.toml")
    (fault,) = told.value.faults
    assert (fault.line, fault.key) == (15, "output[0].machine")
    assert words in fault.message


@pytest.mark.parametrize("name", ["../mine.toml", "/etc/mine.toml", "none.toml"])
def test_a_profile_stands_in_the_recipes_folder(desk: Path, name: str) -> None:
    (desk / "dot.toml").write_text(RECIPE.replace("mine.toml", name))
    with pytest.raises(RecipeError, match=r"expected a file in the recipe's folder|no such file"):
        load_recipe(desk / "dot.toml")


def test_processes_in_words_are_those_of_a_recipe() -> None:
    process = read_process("plot join=false")
    assert str(process) == "plot join=false"
    assert read_process(str(process)) == process


@pytest.mark.parametrize(
    "text",
    [
        'cut sheet=["300 mm", "200 mm"] kerf="0.15 mm"',
        "cut sheet=[300,200] 'kerf=0.15 mm'",
    ],
)
def test_values_are_written_as_in_a_recipe(text: str) -> None:
    process = read_process(text)
    assert isinstance(process, CutProcess)
    assert (process.sheet, process.kerf) == ((300.0, 200.0), 0.15)
    assert read_process(str(process)) == process


def test_tables_stand_in_braces_or_have_dots() -> None:
    braces = read_process('plot hatch={kind="spiral", spacing="0.5 mm"} pens={"old wax"=2, ash = 1}')
    assert braces == read_process("plot hatch.kind=spiral hatch.spacing=0.5mm pens={'old wax'=2,ash=1}")
    assert read_process(str(braces)) == braces


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("plto", 'unknown kind of process "plto": did you mean "plot"?'),
        ("plot jion=true", 'unknown key "jion": did you mean "join"?'),
        ("plot join=3", "join: 3, expected true or false"),
        ("plot join", '"join", expected KEY=VALUE'),
        ("", "expected a process"),
        ('plot "', "expected a process"),
        ("cut sheet=[300,200", "expected a process"),
        ("cut kerf = 1", '"kerf", expected KEY=VALUE'),
        ("cut kerf=1 kerf=2", "kerf: has a value already"),
        ("plot hatch=spiral", "expected a table with a kind, as hatch.kind=spiral makes it"),
        ("plot hatch=spirall", 'hatch: "spirall", expected a table with a kind'),
        ("cut gap=2", "gap: 2, expected sheet, on which pieces are nested, beside it: it does nothing"),
        ("cut turns=none", "turns: none, expected sheet"),
        ("cut tab_length=1mm", "tab_length: 1, expected tabs or tab_spacing beside it"),
        ("cut weed_margin=2mm", "weed_margin: 2, expected weed_lines beside it"),
        ("cut sheet_number=2", "sheet_number: 2, expected the size of a sheet beside it"),
    ],
)
def test_wrong_words_are_told_with_the_nearest_right_ones(text: str, words: str) -> None:
    with pytest.raises(RecipeError, match=r"^--process") as told:
        read_process(text)
    assert words in str(told.value)


@pytest.mark.parametrize(
    ("format_", "machine", "words"),
    [
        ("gcode", "hp7475a", '"hp7475a" takes hpgl: expected another machine for gcode'),
        ("hpgl", "grbl-laser", '"grbl-laser" takes gcode: expected another machine for hpgl'),
    ],
)
def test_a_machine_is_not_spoken_to_in_anothers_language(
    desk: Path, format_: str, machine: str, words: str
) -> None:
    def told(*options: str) -> str:
        done = runner().invoke(cli, ["compile", str(desk / "dot.toml"), "-o", str(desk / "out"), *options])
        assert done.exit_code == 2
        assert not (desk / "out").exists()
        return done.stderr

    assert f"machine: {words}" in told("-f", format_, "--machine", machine)
    (desk / "dot.toml").write_text(RECIPE.replace("mine.toml", machine).replace('"svg"', f'"{format_}"'))
    assert f"dot.toml:15: output[0].machine: {words}" in told()


def test_what_a_format_refuses_is_told_with_the_recipes_name(desk: Path) -> None:
    (desk / "mine.toml").write_text('[hpgl]\npage = [{ name = "a7", low = [0, 0], high = [900, 900] }]\n')
    call = ["compile", str(desk / "dot.toml"), "-f", "hpgl", "--machine", str(desk / "mine.toml")]
    done = runner().invoke(cli, [*call, "-o", str(desk / "out")])
    assert done.exit_code == 2
    assert "dot.toml: the drawing is 40 x 40 mm" in done.stderr


def test_a_sheet_of_a_divided_drawing_does_not_take_anothers_name(desk: Path) -> None:
    named = '[[output]]\nformat = "hpgl"\n'
    text = (
        RECIPE.split("[[output]]")[0] + f'{named}name = "p1x1"\n{named}page = "30 x 30 mm"\npages = "tile"\n'
    )
    (desk / "dot.toml").write_text(text)
    done = runner().invoke(cli, ["compile", str(desk / "dot.toml"), "-o", str(desk / "out")])
    assert done.exit_code == 2
    assert "dot.toml: two outputs would be written to" in done.stderr
    assert "dot-p1x1.hpgl" in done.stderr
    assert not (desk / "out").exists()
