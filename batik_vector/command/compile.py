"""``batik-vector compile``: recipes become files, or a file on standard output."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from batik_vector.command.made_files import (
    STDOUT,
    called,
    check_alone,
    destination,
    files_options,
    tell_files,
)
from batik_vector.command.options import jobs_option, json_option, listed, recipes_argument, set_option
from batik_vector.command.telling import collecting, faults_told, reported

if TYPE_CHECKING:
    from batik_vector.making.destinations import Destination
    from batik_vector.making.jobs import Job


@click.command("compile", short_help="Compile recipes to files.")
@recipes_argument
@files_options
@click.option(
    "--colourway",
    metavar="NAME,…|all",
    help="Colourways of the recipe, or palettes: files for each, called after it.",
)
@set_option
@jobs_option
@click.option("--dry-run", is_flag=True, help="Make all files and write none: tell their sizes.")
@json_option
def compile_command(
    recipes: Sequence[str],
    folder: str,
    formats: Sequence[str],
    processes: Sequence[str],
    machine: str | None,
    pages: str | None,
    margin: str | None,
    dpi: float | None,
    curves: str | None,
    colourway: str | None,
    overrides: Sequence[str],
    jobs: int,
    dry_run: bool,
    as_json: bool,
) -> None:
    """Compile recipes to files.

    A RECIPE is a TOML file, an SVG, PDF, DXF, HPGL, G-code, PNG or TIFF compiled from one, or library:NAME;
    "*" stands for any name, and - for standard input. The files of a recipe are written all or not at all, as
    DIR/NAME.SUFFIX, but for PNGs where the system lacks what draws them; -o - writes the one file there is
    to standard output.
    """
    from batik_vector.making.jobs import matching, planned, read_jobs, ready

    collecting()
    with reported(as_json) as report:
        place = destination(folder, formats, dry_run, as_json)
        keys = called(processes, machine, pages, margin, dpi, curves)
        where = None if folder == STDOUT else Path(folder)
        asked = read_jobs(matching(recipes), overrides)
        if colourway is not None:
            from batik_vector.making.palettes import jobs_in_colourways

            asked = jobs_in_colourways(asked, listed(colourway))
        work, lacking = ready(planned(asked, where, formats, keys))
        if folder == STDOUT:
            check_alone(work)
        for done in _made(work, jobs, as_json, report, place):
            if dry_run:
                done["written"] = False
            elif folder == STDOUT:
                done["files"][0]["path"] = "stdout"
            report["recipes"].append(done)
            tell_files(done)
        for error in lacking:
            # What can be made is made, and this is the last that people read.
            with faults_told(report):
                raise error


def _made(
    work: Sequence[Job], workers: int, quiet: bool, report: dict[str, Any], place: Destination
) -> Iterator[dict[str, Any]]:
    """Make the files of all jobs, in their order or on several cores; yield reports as they are done."""
    from batik_vector.making.running import run, run_quietly

    if min(workers, len(work)) <= 1:
        for job, tell in _progress(work, quiet):
            with faults_told(report):
                yield run(job, tell, destination=place)
        return
    from tqdm import tqdm

    from batik_vector.making.pool import outcomes

    with tqdm(total=len(work), unit="recipe", delay=1, disable=quiet or None, leave=False) as bar:
        for outcome in outcomes(partial(run_quietly, destination=place), work, min(workers, len(work))):
            bar.update()
            if outcome.result is not None:
                yield outcome.result
            with faults_told(report):
                outcome.check()


def _progress(jobs: Sequence[Job], quiet: bool) -> Iterator[tuple[Job, Callable[[str], None]]]:
    """Yield each job with a function that moves the bar: one step for a stage."""
    if quiet or not sys.stderr.isatty():
        yield from ((job, lambda stage: None) for job in jobs)
        return
    from tqdm import tqdm

    steps = sum(len(job.recipe.place) + 1 + len(job.files) for job in jobs)
    with tqdm(total=steps, delay=1, file=sys.stderr, leave=False) as bar:
        for job in jobs:

            def tell(stage: str) -> None:
                bar.set_description(stage, refresh=False)
                # A cloth also tells how far each of its inks has come.
                if not stage.endswith("%"):
                    bar.update()

            yield job, tell
