"""``batik-vector sweep``: many variants of one recipe, with a contact sheet."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from batik_vector.command.options import format_names, jobs_option, json_option, set_option
from batik_vector.command.telling import collecting, reported

if TYPE_CHECKING:
    from pathlib import Path

    from batik_vector.making.pool import Outcome
    from batik_vector.making.sweeping import Made, Sweep
    from batik_vector.making.variants import Axis, Variant

SHEET_FORMATS = ("svg", "pdf", "png")
"""As in :data:`batik_vector.making.sheets.FORMATS`, which a test compares."""
MOST_TOLD = 20
"""Variants without files that are named one by one."""


@click.command("sweep", short_help="Make many variants of a recipe, with a contact sheet.")
@click.argument("recipe", metavar="RECIPE")
@click.option(
    "--vary",
    multiple=True,
    metavar="KEY=VALUES",
    help="A key and its values: a,b,c or START:STOP:COUNT, with :log behind it evenly in ratios. "
    "START:STOP, for --random, is any value between.",
)
@click.option("--random", "sample", type=click.IntRange(1), metavar="N", help="A sample of N, spread evenly.")
@click.option("--seed", type=click.IntRange(0), default=0, metavar="N", help="Which sample.  [default: 0]")
@set_option
@click.option("-o", "folder", metavar="DIR", help="Where files go.  [default: NAME-sweep]")
@click.option(
    "-f",
    "formats",
    multiple=True,
    callback=format_names,
    metavar="FORMAT,…",
    help="As for compile.  [default: svg]",
)
@click.option("--sheet", is_flag=True, help="Also draw all of them on a sheet.")
@click.option(
    "--sheet-format",
    "sheet_formats",
    default="svg,pdf",
    metavar="FORMAT,…",
    help=f"{', '.join(SHEET_FORMATS)}.  [default: svg,pdf]",
)
@click.option("--paper", default="A4", metavar="SIZE", help="Of the sheet: A5 to A0.  [default: A4]")
@jobs_option
@click.option("--limit", type=click.IntRange(1), metavar="N", help="Variants at most.  [default: 100,000]")
@click.option("--dry-run", is_flag=True, help="Say what would be made, and make nothing.")
@json_option
def sweep_command(
    recipe: str,
    vary: Sequence[str],
    sample: int | None,
    seed: int,
    overrides: Sequence[str],
    folder: str | None,
    formats: Sequence[str],
    sheet: bool,
    sheet_formats: str,
    paper: str,
    jobs: int,
    limit: int | None,
    dry_run: bool,
    as_json: bool,
) -> None:
    """Make many variants of a recipe.

    With several --vary all combinations are made. Each variant is written all or not at all, as
    DIR/NAME_KEY-VALUE.SUFFIX. A sweep that was stopped goes on where it was: DIR/NAME-sweep.jsonl says what
    has been made. What cannot be made is told at the end and keeps back nothing.
    """

    from batik_vector.making.sheets import plan

    asked = _sheet_formats(sheet_formats) if sheet else ()
    if asked:
        plan(1, 1.0, 1, paper)
    with reported(as_json) as report:
        planned, axes = _planned(
            recipe,
            vary,
            overrides,
            folder,
            formats,
            sample=sample or 0,
            seed=seed,
            most=limit,
            pictures=bool(asked),
        )
        report["variants"] = len(planned.variants)
        report["folder"] = planned.making.folder
        if dry_run:
            for variant in planned.variants[:MOST_TOLD]:
                click.echo(f"{variant.name}  {'  '.join(variant.changes)}", err=True)
            click.echo(f"{len(planned.variants):,} variants; nothing is written", err=True)
            return
        collecting()
        _run(planned, jobs, report, as_json)
        for path in _sheet(planned, axes, asked, paper) if asked else ():
            report.setdefault("sheet", []).append(str(path))
            click.echo(f"{path}  shows all variants", err=True)


def _sheet_formats(text: str) -> tuple[str, ...]:
    from batik_vector.errors import unknown_name

    names = [name.strip().lower() for name in text.split(",") if name.strip()]
    for name in names:
        if name not in SHEET_FORMATS:
            raise click.BadParameter(unknown_name(name, SHEET_FORMATS, "format"), param_hint="--sheet-format")
    return tuple(dict.fromkeys(names))


def _planned(
    recipe: str,
    vary: Sequence[str],
    overrides: Sequence[str],
    folder: str | None,
    formats: Sequence[str],
    *,
    sample: int,
    seed: int,
    most: int | None,
    pictures: bool,
) -> tuple[Sweep, list[Axis]]:
    import os

    from batik_vector.making.sweeping import Making, planned_sweep
    from batik_vector.making.variants import MOST, parse_axis, variants
    from batik_vector.recipe.reading.sources import read_text, stem_of

    stem = stem_of(recipe)
    making = Making(
        recipe,
        read_text(recipe),
        os.path.dirname(recipe) or ".",
        folder or f"{stem}-sweep",
        tuple(overrides),
        tuple(formats) or ("svg",),
        pictures,
    )
    axes = [parse_axis(text) for text in vary]
    found = variants(axes, stem, sample=sample, seed=seed, most=most or MOST)
    return planned_sweep(making, tuple(found)), axes


def _run(planned: Sweep, jobs: int, report: dict[str, Any], quiet: bool) -> None:
    """Make all variants, with a bar that tells rate and time left; tell at the end what could not be made."""
    from tqdm import tqdm

    failed: list[Outcome[Variant, Made]] = []
    there = made = 0
    report["made"], report["failed"] = [], []
    with tqdm(
        total=len(planned.variants), unit="variant", delay=1, disable=quiet or None, leave=False
    ) as bar:
        for outcome in planned.run(jobs):
            bar.update()
            if outcome.result is None:
                failed.append(outcome)
                bar.set_postfix_str(f"{len(failed)} failed", refresh=False)
                continue
            made += outcome.result.fresh
            there += not outcome.result.fresh
            if quiet:
                files = [name for name, _ in outcome.result.files]
                report["made"].append(
                    {"name": outcome.task.name, "changes": outcome.task.changes, "files": files}
                )
    _tell_failures(failed, report)
    kept = f", {there:,} were there" if there else ""
    missing = f", {len(failed):,} could not be made" if failed else ""
    click.echo(f"{planned.making.folder}: {made:,} variants made{kept}{missing}", err=True)


def _tell_failures(failed: Sequence[Outcome[Variant, Made]], report: dict[str, Any]) -> None:
    from batik_vector.command.telling import complain

    for number, outcome in enumerate(sorted(failed, key=lambda each: each.task.number)):
        failure = outcome.failure
        assert failure is not None
        report["exit"] = max(report["exit"], failure.exit_code)
        report["failed"].append(
            {
                "name": outcome.task.name,
                "changes": outcome.task.changes,
                "faults": [vars(f) for f in failure.faults],
            }
        )
        if number < MOST_TOLD:
            complain(f"{outcome.task.name}: {failure.words}")
    if len(failed) > MOST_TOLD:
        complain(f"and {len(failed) - MOST_TOLD:,} more; --json tells of each")


def _sheet(planned: Sweep, axes: Sequence[Axis], formats: Sequence[str], paper: str) -> list[Path]:
    from pathlib import Path

    from batik_vector.making.sheets import Entry, pages, plan, write_sheet
    from batik_vector.making.variants import short_names
    from batik_vector.recipe.reading.sources import stem_of

    stem = stem_of(planned.making.source)
    names = short_names([axis.key for axis in axes])

    def caption(variant: Variant) -> tuple[str, ...]:
        return tuple(
            f"{name} {change.partition('=')[2]}" for name, change in zip(names, variant.changes, strict=True)
        )

    shapes = [picture.height / picture.width for _, picture in planned.pictures() if picture is not None]
    shape = sorted(shapes)[len(shapes) // 2] if shapes else 1.0
    columns = (
        len(axes[-1].values)
        if len(axes) > 1 and len(planned.variants) % max(len(axes[-1].values), 1) == 0
        else 0
    )
    layout = plan(len(planned.variants), shape, len(axes), paper, columns)
    entries = (Entry(picture, caption(variant)) for variant, picture in planned.pictures())
    about = [f"{len(planned.variants):,} variants of {', '.join(axis.key for axis in axes)}"]
    sheet = pages(entries, len(planned.variants), layout, planned.title, about)
    return write_sheet(Path(planned.making.folder), f"{stem}-sheet", sheet, formats, layout)
