from __future__ import annotations

import json
from pathlib import Path

import pytest

from batik_vector.command.cli import cli
from batik_vector.command.process_reports import duration, metres
from tests.calling import runner

RECIPE = """
[motif.square]
kind = "flower"
petal = { count = 8, length = 1.0 }

[ink.wax]
[ink.blue]

[[place]]
motif = "square"
ink = "wax"
width = "60 mm"

[[place]]
motif = "square"
ink = "blue"
width = "60 mm"

[tile]
size = ["80 mm", "80 mm"]
"""


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.4, "0 s"), (59.6, "1 min 0 s"), (125, "2 min 5 s"), (7500, "2 h 5 min")]
)
def test_times_are_told_in_two_units(seconds: float, words: str) -> None:
    assert duration(seconds) == words


@pytest.mark.parametrize(("mm", "words"), [(12.34, "12.3 mm"), (999.0, "999 mm"), (2345.6, "2.35 m")])
def test_ways_are_told_in_metres_where_they_are_long(mm: float, words: str) -> None:
    assert metres(mm) == words


def test_a_plot_tells_what_it_takes_and_what_it_left_out(tmp_path: Path) -> None:
    recipe = tmp_path / "twice.toml"
    recipe.write_text(RECIPE, encoding="utf-8")
    call = ["compile", str(recipe), "-o", str(tmp_path), "--process", "plot once=all pens.blue=4", "--json"]
    done = runner().invoke(cli, call)
    assert done.exit_code == 0, done.stderr
    facts = json.loads(done.stdout)["recipes"][0]["files"][0]["process"]["plot"]
    assert [(each["pen"], each["ink"]) for each in facts["pens"]] == [(1, "wax"), (4, "blue")]
    doubled = facts["doubled"]
    assert doubled["saved_mm"] == pytest.approx(facts["drawn_mm"], rel=1e-3)
    assert f"{doubled['stretches']:,} stretch" in done.stderr
    assert "pen 4, blue: nothing is left to draw" in done.stderr
    assert "change of pen" not in done.stderr
    checked = runner().invoke(cli, ["check", str(tmp_path / "twice.svg")])
    assert "went through plot once=all pens={blue=4}" in checked.stdout
    assert "differs" not in checked.stdout


def test_a_plot_is_compared_with_its_recipe_gone_through_the_same(tmp_path: Path) -> None:
    recipe = tmp_path / "twice.toml"
    recipe.write_text(RECIPE, encoding="utf-8")
    runner().invoke(
        cli, ["compile", str(recipe), "-o", str(tmp_path), "--machine", "pen-plotter", "--process", "plot"]
    )
    plotted = tmp_path / "twice.svg"
    assert "differ" not in runner().invoke(cli, ["check", str(plotted)]).stdout.replace("mm² differ", "")
    drawn = plotted.read_text()
    first = drawn.index(' d="M') + 5
    end = drawn.index('"', first)
    # One stroke is moved a little to the right.
    plotted.write_text(drawn[:first] + "1 1L9 9" + drawn[end:])
    assert (
        "the lines of the file and of the recipe differ"
        in runner().invoke(cli, ["check", str(plotted)]).stdout
    )
