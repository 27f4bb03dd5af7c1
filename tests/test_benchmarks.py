"""The benchmark measures what it says, without its peers: fits, tables, verdicts, and our own part."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
import shapely

from batik_vector import compile_recipe, read_recipe, write_artwork
from batik_vector.library import Library
from benchmarks import cutting, library, limits, own, plotting, readback, stages, trailing, trapping
from benchmarks.acceptance import Row, rows
from benchmarks.contests import SECTIONS, facts
from benchmarks.contests.designing import SEARCHES
from benchmarks.contests.entrants import BATIK, Contest, Entrant
from benchmarks.contests.plans import FULL, QUICK
from benchmarks.drawing import RING, evaluated, recipe
from benchmarks.peers.drawn import often
from benchmarks.results import Results, exponent, over_log, spread
from benchmarks.run import BEGIN, END, README, put_into
from benchmarks.running import folders, run
from benchmarks.tables import SHOWN, TITLES, page
from benchmarks.timing import FailedError, Sample, process

SIZES = (10_000, 100_000, 1_000_000)


def quiet(_: str) -> None:
    pass


def by_words(found: list[Row], words: str) -> Row:
    (row,) = (row for row in found if words in row.asked)
    return row


def results(**runs: list[float]) -> Results:
    made = Results(facts={"about": {"date": "", "processor": "", "cores": 2, "load": 0, "system": "",
                                    "own": {}, "peers": {}}})  # fmt: skip
    for name, values in runs.items():
        for value in values:
            made.add(name, Sample(value, value))
    return made


def test_exponents_of_known_growth() -> None:
    assert exponent(SIZES, [3e-9 * n for n in SIZES]) == pytest.approx(1)
    assert exponent(SIZES, [3e-9 * n**2 for n in SIZES]) == pytest.approx(2)
    sorted_ = [n * math.log(n) for n in SIZES]
    assert exponent(SIZES, sorted_) > 1.05
    assert exponent(SIZES, over_log(SIZES, sorted_)) == pytest.approx(1)
    with pytest.raises(ValueError, match="two sizes"):
        exponent([5, 5], [1, 2])


def test_ratios_are_taken_within_a_round() -> None:
    # The machine slows down by ten in the second round: the ratio does not change.
    found = results(**{"svg alone/a": [2.0, 20.0], "svg alone/b": [1.0, 10.0]})
    ratio = found.ratio("svg alone/a", "svg alone/b")
    assert ratio == spread([2.0, 2.0])
    assert found.ratio("svg alone/a", "svg alone/nobody") is None
    assert Results.from_json(found.to_json()) == found


@pytest.mark.parametrize(("peer", "passed"), [(10.1, True), (9.9, False)])
def test_a_verdict_follows_from_what_was_measured(peer: float, passed: bool) -> None:
    found = results(**{f"svg alone/{BATIK}": [0.1] * 5, "svg alone/vpype_svg": [peer] * 5})
    row = by_words(rows(found, FULL), "SVG writer ≥ 100×")
    assert row.passed is passed
    assert ("not" in row.verdict) is not passed


def test_a_slow_start_a_steep_stage_and_a_bad_file_fail_their_rows() -> None:
    found = results(**{"start/batik compile": [0.3], "start/vpype --version": [0.2]})
    for rings in FULL.growth:
        found.add(f"growth/{rings}/tiling", Sample(rings**1.5, 1))
        found.add(f"growth/{rings}/generation", Sample(float(rings), 1))
    found.facts["dxf audit"] = {"errors": 1, "fixes": 0}
    verdicts = rows(found, FULL)
    for words in ("250 ms of CPU", "less time than `vpype --version`", "tiling grows", "ezdxf's audit"):
        assert by_words(verdicts, words).passed is False, words
    assert by_words(verdicts, "generation grows").passed is True


def test_what_is_far_from_its_least_has_to_be_explained() -> None:
    found = results(**{f"limits/{BATIK}/svg": [5.0], "limits/limit/svg": [2.0]})
    assert by_words(rows(found, FULL, "* **svg** is dear"), "the page says why").passed is True
    row = by_words(rows(found, FULL, "* nothing to say"), "the page says why")
    assert row.passed is False
    assert "svg" in row.measured


def test_what_was_not_measured_says_why() -> None:
    found = results()
    found.missing["svg alone/vpype_svg"] = "vpype could not be installed: no wheel"
    verdicts = rows(found, FULL)
    assert {row.passed for row in verdicts} == {None}
    assert {row.line for row in verdicts} == set(range(1, 15))
    assert by_words(verdicts, "SVG writer ≥ 100×").measured == "vpype could not be installed: no wheel"


def test_a_contest_goes_on_without_who_fails() -> None:
    python = sys.executable
    entrants = (
        Entrant(BATIK, "", (python, "-c", 'print(\'{"": {"cpu": 0.5, "wall": 0.5}}\')'), inside=True),
        Entrant("absent", "", ("/nowhere/at/all",)),
        Entrant("broken", "", (python, "-c", "raise SystemExit('no such thing')")),
        Entrant("whole", "", (python, "-c", "pass")),
    )
    found = results()
    with folders() as places:
        run(Contest("svg alone", entrants, 2), found, places, quiet)
    assert found.values(f"svg alone/{BATIK}") == [0.5, 0.5]
    assert len(found.values("svg alone/whole")) == 2
    assert min(found.values("svg alone/whole")) > 0
    assert found.missing["svg alone/broken"] == "no such thing"
    assert "absent" not in found.missing["svg alone/absent"]
    assert "nowhere" not in found.missing["svg alone/absent"]


def test_who_takes_minutes_takes_part_once() -> None:
    word = (sys.executable, "-c", 'print(\'{"": {"cpu": 0.5, "wall": 0.5}}\')')
    entrants = (Entrant(BATIK, "", word, True), Entrant("slow", "", word, True, rounds=1))
    found = results()
    with folders() as places:
        run(Contest("order 9", entrants, 3), found, places, quiet)
    assert [len(found.values(f"order 9/{name}")) for name in (BATIK, "slow")] == [3, 1]
    assert found.ratio("order 9/slow", f"order 9/{BATIK}") == spread([1.0])


def test_what_is_over_soon_is_done_again_on_a_fresh_copy() -> None:
    given: list[list[int]] = []

    def work(numbers: list[int]) -> int:
        numbers.append(sum(range(50_000)))
        return len(numbers)

    def fresh() -> list[int]:
        given.append([])
        return given[-1]

    part, done = often(fresh, work, least=0.02)
    assert done == 1
    assert len(given) > 1
    assert 0 < part["cpu"] < 0.02


def test_a_knife_is_held_to_the_corners_that_it_was_to_cut() -> None:
    led = cutting.cut(cutting.outlines(4))
    ways = np.split(led.points / 1000, led.rings[1:-1])
    found = trailing.off(ways, cutting.ASKED.swivel)
    assert found["corners"] < 0.01
    assert found["astray"] < 0.01
    assert found["area"] < 0.001
    # Who leads the holder along the outline itself cuts every corner off.
    blunt = [np.concatenate([star, star[:2]]) for star in trailing.stars(4)]
    assert trailing.off(blunt, 0.0)["corners"] > 0.1


def test_a_figure_beside_another_has_its_verdict() -> None:
    found = results()
    found.facts |= {f"cut/{BATIK} off": {"corners": 0.06, "area": 0.0001}, "cut/plottool off": {"area": 0.1}}
    assert by_words(rows(found, FULL), "corners of stars").passed is False
    assert by_words(rows(found, FULL), "their area").measured == "area: 0.0001 against 0.1"


def test_the_last_words_of_a_failure_are_kept() -> None:
    with pytest.raises(FailedError, match="ValueError: seven"):
        process([sys.executable, "-c", "raise ValueError('seven')"])


@pytest.mark.parametrize("plan", [FULL, QUICK])
def test_every_section_has_a_table(plan: object) -> None:
    assert plan in (FULL, QUICK)
    chosen = FULL if plan is FULL else QUICK
    assert set(SECTIONS) == set(TITLES) == set(SHOWN)
    text = page(results(), chosen, list(SECTIONS))
    for title in TITLES.values():
        assert f"### {title}\n" in text
    names = [contest.name for section in SECTIONS for contest in SECTIONS[section](chosen)]
    assert len(set(names)) == len(names)
    assert [fact.name for section in SECTIONS for fact in facts(section, chosen)]


def test_tables_go_between_the_marks_of_the_page() -> None:
    text = README.read_text(encoding="utf-8")
    changed = put_into(text, "| new |\n")
    assert f"{BEGIN}\n\n| new |\n\n{END}" in changed
    assert changed.startswith(text[: text.index(BEGIN)])
    assert changed.endswith(text[text.index(END) :])
    with pytest.raises(ValueError, match="lacks"):
        put_into("nothing", "")


def test_everyone_draws_the_same() -> None:
    (layer,) = compile_recipe(read_recipe(recipe(6))).layers
    theirs = shapely.polygons(evaluated(6))
    assert (shapely.get_num_coordinates(layer.areas) == RING + 1).all()
    over = shapely.area(
        shapely.symmetric_difference(shapely.union_all(theirs), shapely.union_all(layer.areas))
    )
    assert over < 0.004 * shapely.area(theirs).sum()


@pytest.mark.parametrize("format_", ["svg", "pdf", "dxf", "hpgl", "gcode"])
def test_files_are_read_back(tmp_path: Path, format_: str) -> None:
    path = write_artwork(compile_recipe(read_recipe(recipe(6))), tmp_path / f"six.{format_}")
    found = readback.drawing(str(path))
    assert found["vertices"] == 6 * RING
    # HP-GL counts in units of 25 µm, of which the box round the marks is up to two smaller or larger.
    assert found["share"] == pytest.approx(0.478, abs=0.003 if format_ == "hpgl" else 0.001)


def test_our_own_part_tells_every_stage(tmp_path: Path) -> None:
    mine, least = stages.stages(4, "plain"), limits.stages(4)
    assert set(mine) == set(least) == {"generation", "tiling", "svg", "pdf", "dxf"}
    assert all(part["cpu"] >= 0 and part["wall"] > 0 for part in (*mine.values(), *least.values()))
    assert mine["tiling"]["vertices"] == 4 * (RING + 1)
    assert set(stages.weld(4) | stages.join(4)) == set(limits.overlays(4)) == {"welding", "joining"}
    assert stages.once(4)["once"]["wall"] > 0
    assert set(plotting.passes(4)) == {"once", "joined", "ordered"}
    own.prepare(4, tmp_path)
    for name in ("drawing.toml", "tiny.toml", "drawing.npy", "drawing.svg", "warm.svg"):
        assert (tmp_path / name).stat().st_size > 0


def test_every_way_of_searching_a_library_is_timed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    library.search(30, tmp_path)
    told = json.loads(capsys.readouterr().out.splitlines()[-1])
    assert set(told) == set(SEARCHES) == set(library.WAYS)
    with Library(tmp_path / library.FILE) as opened:
        assert len(opened.entries(own=True)) == 30
        assert opened.check() == []


def test_the_design_of_traps_has_two_inks_that_meet_all_along() -> None:
    artwork = trapping.design(196 * 12)
    spots, ground = artwork.layers
    assert artwork.vertex_count == 2 * 196 * 13 + 5
    assert all(ground.areas[0].touches(spot) for spot in spots.areas)
    assert trapping.trapped(artwork) > 0
