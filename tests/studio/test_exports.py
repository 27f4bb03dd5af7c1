from __future__ import annotations

import asyncio
import io
import zipfile
from dataclasses import replace
from pathlib import Path

import pytest

from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import FORMATS
from batik_vector.export.svg import svg_text
from batik_vector.making.jobs import planned, read_jobs
from batik_vector.making.palettes import in_colourway, jobs_in_colourways
from batik_vector.making.running import run_quietly
from batik_vector.recipe.loading import read_recipe
from batik_vector.studio.asking import View, Wishes
from batik_vector.studio.drafts import Draft
from batik_vector.studio.draping import SHOWN
from batik_vector.studio.exports import Exported, download, export, file_names, on_paper, with_output, zipped
from batik_vector.studio.pictures import EXPORT, Pictures
from batik_vector.studio.views import Looker
from tests.studio.test_drafts import FLOWER
from tests.thorough import slow

SAMPLES = Path(__file__).parents[2] / "samples"
ALL = tuple(FORMATS)


def commands(source: Path, folder: Path, formats: tuple[str, ...]) -> dict[str, bytes]:
    """Return the files that the command writes."""
    (job,) = planned(read_jobs([str(source)]), folder, formats)
    run_quietly(job)
    return {path.name: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize(
    ("name", "formats"),
    [
        ("own-boteh", ALL),
        ("machine-plotter", ("hpgl", "gcode")),
        pytest.param("border-p2", ("svg",), marks=slow),
        pytest.param("lasem-bird", ("dxf",), marks=slow),
        ("machine-laser", ()),
    ],
)
def test_files_are_the_commands_byte_for_byte(tmp_path: Path, name: str, formats: tuple[str, ...]) -> None:
    source = SAMPLES / f"{name}.toml"
    made = export(Draft.read(source), Wishes(formats))
    assert made.faults == ()
    assert made.files == commands(source, tmp_path, formats)
    assert [each["path"] for each in made.report["files"]] == list(made.files)


def test_a_draft_that_was_changed_is_what_the_command_makes_of_its_text(tmp_path: Path) -> None:
    draft = Draft.read(SAMPLES / "kawung.toml").with_value("seed", 5).with_value("title", "Mine")
    (tmp_path / "kawung.toml").write_text(draft.text, encoding="utf-8")
    assert export(draft, Wishes()).files == commands(tmp_path / "kawung.toml", tmp_path / "out", ())


@pytest.mark.parametrize("outputs", ["", '\n[[output]]\nformat = "pdf"\nname = "press"\nbleed = "3 mm"\n'])
def test_what_is_chosen_of_a_format_is_what_the_command_makes_of_a_recipe_that_says_so(
    tmp_path: Path, outputs: str
) -> None:
    draft = with_output(
        Draft(FLOWER + outputs, stem="mine"), "pdf", {"pages": "tile", "page": "210 x 297 mm"}
    )
    made = export(draft, Wishes(("pdf",)))
    (tmp_path / "mine.toml").write_text(draft.text, encoding="utf-8")
    assert made.files == commands(tmp_path / "mine.toml", tmp_path / "out", ("pdf",))
    (data,) = made.files.values()
    # 300 mm are two sheets of A4 across and two down.
    assert b"/Count 4" in data
    assert with_output(draft, "pdf", {}) is draft


def test_a_sheet_of_paper_is_full_of_the_pattern_and_other_files_are_as_they_were() -> None:
    draft = (
        Draft(FLOWER, stem="mine")
        .with_value("tile.size", ["40 mm", "40 mm"])
        .with_value("place[0].width", 36)
    )
    parts = on_paper(draft, Wishes(("svg", "pdf"), recipe=True), "full A4", "spot")
    made = {name: data for each in parts for name, data in export(*each).files.items()}
    plain = export(draft, Wishes(("svg",), recipe=True)).files
    assert {name: made[name] for name in plain} == plain
    assert b"/MediaBox [ 0 0 595.27" in made["mine.pdf"].replace(b"[0", b"[ 0")
    assert b"/Separation" in made["mine.pdf"]
    assert on_paper(draft, Wishes(("svg",)), "full A4") == [(draft, Wishes(("svg",)))]
    assert on_paper(draft, Wishes()) == [(draft, Wishes(("svg",)))]


def test_processes_and_machines_are_those_of_the_call() -> None:
    wishes = Wishes(("svg",), ("cut kerf=0.15mm",), "laser")
    made = export(Draft(FLOWER, stem="k"), wishes)
    assert made.faults == ()
    assert made.report["files"][0]["process"]
    assert made.files != export(Draft(FLOWER, stem="k"), Wishes(("svg",))).files


@pytest.mark.parametrize(
    ("name", "asked", "called"),
    [
        pytest.param("own-peacock", ("all",), 5, marks=slow),
        pytest.param("lasem-bird", ("solo",), 1, marks=slow),
        ("machine-rotary", ("all",), 1),
    ],
)
def test_colourways_are_those_of_the_call(
    tmp_path: Path, name: str, asked: tuple[str, ...], called: int
) -> None:
    source = SAMPLES / f"{name}.toml"
    draft, wishes = Draft.read(source).with_value("tolerance", 0.1), Wishes(("svg",), colourways=asked)
    made = export(draft, wishes)
    assert made.faults == ()
    (tmp_path / source.name).write_text(draft.text, encoding="utf-8")
    for drawn in SAMPLES.glob(f"{name}*.svg"):
        (tmp_path / drawn.name).write_bytes(drawn.read_bytes())
    jobs = jobs_in_colourways(read_jobs([str(tmp_path / source.name)]), asked)
    for job in planned(jobs, tmp_path / "out", ("svg",)):
        run_quietly(job)
    there = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    assert made.files == there
    assert file_names(draft, wishes) == tuple(made.files)
    assert len(made.report["files"]) == len(there) == called


def test_a_colourway_that_is_none_is_told_with_the_nearest_name() -> None:
    made = export(Draft.read(SAMPLES / "own-peacock.toml"), Wishes(("svg",), colourways=("solp",)))
    assert made.files == {}
    assert "solo" in made.faults[0].message


@pytest.mark.parametrize(
    ("name", "colourway"),
    [
        pytest.param("own-peacock", "coast", marks=slow),
        pytest.param("lasem-bird", "solo", marks=slow),
        ("machine-rotary", "dusk"),
        ("wax-javanese", "madura"),
    ],
)
def test_a_colourway_is_seen_as_it_is_compiled(name: str, colourway: str) -> None:
    draft = Draft.read(SAMPLES / f"{name}.toml").with_value("tolerance", 0.1)
    looker, view = Looker(), View(tolerance=0.1)
    before = looker.look(draft, view)
    seen = looker.look(draft, replace(view, colourway=colourway))
    assert seen.faults == before.faults == ()
    recipe = read_recipe(draft.text, folder=draft.folder, drawings=dict(draft.drawings))
    changes = in_colourway(recipe, colourway)
    other = read_recipe(draft.text, "", changes, draft.folder, drawings=dict(draft.drawings))
    assert seen.svg == svg_text(compile_recipe(other), SHOWN) != before.svg
    assert seen.facts["cloth"] == other.cloth.colour
    # And back.
    assert looker.look(draft, view).svg == before.svg


def test_what_files_will_be_called_is_known_before() -> None:
    draft = Draft.read(SAMPLES / "four-square.toml")
    names = file_names(draft, Wishes(("svg", "png"), recipe=True))
    assert names == ("four-square.svg", "four-square.png", "four-square.toml")
    made = export(draft, Wishes(("svg", "png"), recipe=True))
    assert tuple(made.files) == names
    assert Draft.of_text(made.files["four-square.toml"].decode()).text == draft.text


def test_faults_come_with_their_keys_and_no_files() -> None:
    made = export(Draft(FLOWER).with_value("motif.a.petal.count", 999), Wishes())
    assert (made.files, made.faults[0].key) == ({}, "motif.a.petal.count")
    made = export(Draft(FLOWER), Wishes(machine="lazer"))
    assert "laser" in made.faults[0].message
    made = export(Draft(FLOWER), Wishes(processes=("cut kerf=x",)))
    assert made.faults


def test_several_files_are_one_zip_and_always_the_same() -> None:
    files = {"a.svg": b"<svg/>", "b.pdf": b"%PDF" * 100}
    whole = zipped(files)
    assert whole == zipped(dict(files))
    with zipfile.ZipFile(io.BytesIO(whole)) as archive:
        assert archive.testzip() is None
        assert {name: archive.read(name) for name in archive.namelist()} == files
    assert download(Exported(files), "k") == ("k.zip", whole)
    assert download(Exported({"a.svg": b"<svg/>"}), "k") == ("a.svg", b"<svg/>")


def test_they_are_made_by_another_process_and_can_be_cancelled() -> None:
    slow = Draft.read(SAMPLES / "lotus-pond.toml").with_value("tolerance", 0.002)

    async def both() -> None:
        async with Pictures() as pictures:
            draft = Draft(FLOWER, stem="k")
            made = await pictures.export(draft, Wishes(("svg", "dxf")))
            assert made.files == export(draft, Wishes(("svg", "dxf"))).files
            asyncio.get_running_loop().call_later(0.2, lambda: pictures.cancel(EXPORT))
            stopped = await pictures.export(slow)
            assert (stopped.files, stopped.faults[0].message) == ({}, "cancelled")

    asyncio.run(both())
