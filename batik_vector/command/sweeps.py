"""``batik-vector sweep`` and ``random``: many variants of one recipe, with a contact sheet."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import click

from batik_vector.command.options import (
    Finite,
    files_begun,
    folder_option,
    format_names,
    jobs_option,
    json_option,
    listed,
    set_option,
)
from batik_vector.command.telling import collecting, complain, counted, reported
from batik_vector.errors import unknown_name
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.making.manifest import Made
    from batik_vector.making.pool import Outcome
    from batik_vector.making.sheets import Plan
    from batik_vector.making.sweeping import Making, Sweep
    from batik_vector.making.variants import Variant

SHEET_FORMATS = ("svg", "pdf", "png")
"""As in :data:`batik_vector.making.sheets.FORMATS`, which a test compares."""
MOST_TOLD = 20
"""Variants without files that are named one by one."""
MOST_CAPTIONS = 6
"""Lines below a picture."""

Command = TypeVar("Command", bound=Callable[..., Any])


@frozen
class Wishes:
    """What both commands are asked for beside the variants."""

    recipe: str
    overrides: tuple[str, ...]
    folder: str | None
    formats: tuple[str, ...]
    sheet: tuple[str, ...]
    paper: str
    jobs: int
    scheduler: str
    into_library: bool
    as_json: bool

    def making(self, ending: str) -> Making:
        """Return what makes a variant's files."""
        import os

        from batik_vector.making.sheets import plan
        from batik_vector.making.sweeping import Making
        from batik_vector.recipe.reading.sources import read_text, stem_of

        # What is wrong with the sheet is told before anything is made.
        plan(1, 1.0, 1, self.paper)
        return Making(
            self.recipe,
            read_text(self.recipe),
            os.path.dirname(self.recipe) or ".",
            self.folder or f"{stem_of(self.recipe)}-{ending}",
            self.overrides,
            self.formats or ("svg",),
            bool(self.sheet),
        )


def _sheet_formats(_ctx: click.Context, _param: click.Parameter, text: str) -> tuple[str, ...]:
    names = [name.strip().lower() for name in text.split(",") if name.strip()]
    for name in names:
        if name not in SHEET_FORMATS:
            raise click.BadParameter(unknown_name(name, SHEET_FORMATS, "format"))
    return tuple(dict.fromkeys(names))


def _shared(folder: str) -> Callable[[Command], Command]:
    """Return what gives a command the options that both have."""
    sheet_formats = f"{', '.join(SHEET_FORMATS)}.  [default: svg,pdf]"
    options = [
        set_option,
        folder_option(f"Where files go.  [default: {folder}]"),
        click.option(
            "-f",
            "--format",
            "formats",
            multiple=True,
            callback=format_names,
            metavar="FORMAT,…",
            help="As for compile.  [default: svg]",
        ),
        click.option("--sheet", is_flag=True, help="Also draw all of them on a sheet."),
        click.option(
            "--sheet-format",
            "sheet_formats",
            default="svg,pdf",
            callback=_sheet_formats,
            metavar="FORMAT,…",
            help=sheet_formats,
        ),
        click.option("--paper", default="A4", metavar="SIZE", help="Of the sheet: A5 to A0.  [default: A4]"),
        jobs_option,
        click.option(
            "--scheduler",
            metavar="ADDRESS",
            help="Let the workers of a Dask cluster do it, as tcp://10.0.0.5:8786.",
        ),
        click.option("--into-library", is_flag=True, help="Also save each variant in the library."),
        json_option,
    ]

    def dressed(command: Command) -> Command:
        for option in reversed(options):
            command = option(command)
        return command

    return dressed


@click.command("sweep", short_help="Make many variants of a recipe, with a contact sheet.")
@click.argument("recipe", metavar="RECIPE", shell_complete=files_begun)
@click.option(
    "--vary",
    multiple=True,
    metavar="KEY=VALUES",
    help="A key and its values: a,b,c or START:STOP:COUNT, with :log behind it evenly in ratios. "
    "START:STOP, for --random, is any value between.",
)
@click.option(
    "--palettes", metavar="NAME,…|all", help="Also vary the colours: kelengan, sogan, tiga-negeri, …"
)
@click.option(
    "--colourways",
    metavar="NAME,…|all",
    help="Also vary the colours by the recipe's own colourways.",
)
@click.option("--random", "sample", type=click.IntRange(1), metavar="N", help="A sample of N, spread evenly.")
@click.option("--seed", type=click.IntRange(0), default=0, metavar="N", help="Which sample.  [default: 0]")
@_shared("NAME-sweep")
@click.option("--limit", type=click.IntRange(1), metavar="N", help="Variants at most.  [default: 100,000]")
@click.option("--dry-run", is_flag=True, help="Say what would be made, and make nothing.")
def sweep_command(
    vary: Sequence[str],
    palettes: str | None,
    colourways: str | None,
    sample: int | None,
    seed: int,
    limit: int | None,
    dry_run: bool,
    **given: Any,
) -> None:
    """Make many variants of a recipe.

    With several --vary all combinations are made. Each variant is written all or not at all, as
    DIR/NAME_KEY-VALUE.SUFFIX. A sweep that was stopped goes on where it was: DIR/NAME-sweep.jsonl says what
    has been made. What cannot be made is told at the end and keeps back nothing.
    """
    wishes = _wishes(**given)
    with reported(wishes.as_json) as report:
        from batik_vector.making.sweeping import planned_sweep
        from batik_vector.making.variants import MOST, parse_axis, short_names, variants
        from batik_vector.recipe.reading.sources import stem_of

        making = wishes.making("sweep")
        axes = [parse_axis(text) for text in vary]
        if palettes:
            from batik_vector.making.palettes import palette_axis

            axes.append(palette_axis(making.base(), listed(palettes)))
        if colourways:
            from batik_vector.making.palettes import colourway_axis

            axes.append(colourway_axis(making.base(), listed(colourways)))
        found = variants(axes, stem_of(wishes.recipe), sample=sample or 0, seed=seed, most=limit or MOST)
        planned = planned_sweep(making, tuple(found))
        if dry_run:
            _tell_plan(planned)
            return
        columns = len(axes[-1].values) if len(axes) > 1 and not sample else 0
        names = short_names([axis.key for axis in axes])
        about = f"{len(planned.variants):,} variants of {', '.join(axis.key for axis in axes)}"

        def caption(variant: Variant) -> tuple[str, ...]:
            told = zip(names, variant.values, strict=True)
            return tuple(f"{name} {value}" for name, value in told)[:MOST_CAPTIONS]

        _make(planned, wishes, report, caption, about, columns)


@click.command("random", short_help="Make random variations of a recipe that hold on cloth.")
@click.argument("recipe", metavar="RECIPE", shell_complete=files_begun)
@click.option("-n", "count", type=click.IntRange(1, 10_000), default=24, metavar="N", help="[default: 24]")
@click.option(
    "--seed", type=click.IntRange(0), default=0, metavar="N", help="Which variations.  [default: 0]"
)
@click.option(
    "--lock", multiple=True, metavar="KEY", help='Keys that stay, such as petal.count or "motif.bud.*".'
)
@click.option("--only", multiple=True, metavar="KEY", help="Keys that move; all others stay.")
@click.option(
    "--reach",
    type=Finite(0, 1, min_open=True),
    default=0.4,
    metavar="SHARE",
    help="How far numbers move, up to 1.  [default: 0.4]",
)
@click.option("--least", type=Finite(0), default=0.4, metavar="MM", help="Least width.  [default: 0.4]")
@_shared("NAME-random")
def random_command(
    count: int,
    seed: int,
    lock: Sequence[str],
    only: Sequence[str],
    reach: float,
    least: float,
    **given: Any,
) -> None:
    """Make random variations of a recipe that hold on cloth.

    The numbers of motifs and layouts move; sizes, inks and the repeat stay. Kept are such as pass check,
    cover 12 to 85 % of the tile, and of whose inks no more than a tenth is narrower than --least or in
    scraps. The same seed gives the same variations.
    """
    wishes = _wishes(**given)
    with reported(wishes.as_json) as report:
        from batik_vector.making.exploring import Floor, explored, numbers_of
        from batik_vector.making.sweeping import planned_sweep

        making = wishes.making("random")
        moving = numbers_of(making, lock, only)
        collecting()
        kept = list(
            explored(
                making, moving, count, seed=seed, reach=reach, floor=Floor(least=least), workers=wishes.jobs
            )
        )
        planned = planned_sweep(making, kept)
        about = f"{count} variations, seed {seed}"
        _make(planned, wishes, report, lambda variant: (variant.name.rpartition("-")[2],), about)


def _wishes(**given: Any) -> Wishes:
    sheet = given["sheet_formats"] if given["sheet"] else ()
    return Wishes(
        given["recipe"],
        tuple(given["overrides"]),
        given["folder"],
        tuple(given["formats"]),
        sheet,
        given["paper"],
        given["jobs"],
        given["scheduler"] or "",
        given["into_library"],
        given["as_json"],
    )


def _tell_plan(planned: Sweep) -> None:
    for variant in planned.variants[:MOST_TOLD]:
        click.echo(f"{variant.name}  {'  '.join(variant.changes)}", err=True)
    click.echo(f"{counted(len(planned.variants), 'variant')}; nothing is written", err=True)


def _make(
    planned: Sweep,
    wishes: Wishes,
    report: dict[str, Any],
    caption: Callable[[Variant], tuple[str, ...]],
    about: str,
    columns: int = 0,
) -> None:
    """Make all variants, with a bar that tells rate and time left, and their sheet."""
    from tqdm import tqdm

    collecting()
    failed: list[Outcome[Variant, Made]] = []
    made = 0
    report |= {"folder": planned.making.folder, "variants": len(planned.variants), "made": [], "failed": []}
    quiet = wishes.as_json or None
    with tqdm(total=len(planned.variants), unit="variant", delay=1, disable=quiet, leave=False) as bar:
        for outcome in planned.run(wishes.jobs, wishes.scheduler):
            bar.update()
            if outcome.result is None:
                failed.append(outcome)
                bar.set_postfix_str(f"{len(failed)} failed", refresh=False)
            else:
                made += outcome.result.fresh
                if wishes.as_json:
                    report["made"].append(_told(outcome, files=[name for name, _ in outcome.result.files]))
    _tell_failures(failed, report)
    there = len(planned.variants) - made - len(failed)
    kept = f", {there:,} were there" if there else ""
    missing = f", {len(failed):,} could not be made" if failed else ""
    click.echo(f"{planned.making.folder}: {counted(made, 'variant')} made{kept}{missing}", err=True)
    if wishes.into_library:
        _save(planned, wishes, report, {outcome.task.number for outcome in failed})
    if wishes.sheet:
        _draw_sheet(planned, wishes, report, caption, about, columns)


def _save(planned: Sweep, wishes: Wishes, report: dict[str, Any], failed: set[int]) -> None:
    """Save the variants that could be made in the library, under their names."""
    from batik_vector.command.library_changes import save_all
    from batik_vector.library import Library
    from batik_vector.library.exchange import Incoming

    made = [variant for variant in planned.variants if variant.number not in failed]
    patterns = [
        Incoming(variant.name, planned.making.recipe(variant), f"a sweep of {wishes.recipe}", ("sweep",))
        for variant in made
    ]
    with Library(None) as library:
        save_all(library, patterns, wishes.jobs, report, quiet=wishes.as_json)


def _told(outcome: Outcome[Variant, Made], **more: Any) -> dict[str, Any]:
    return {"name": outcome.task.name, "changes": list(outcome.task.changes), **more}


def _tell_failures(failed: Sequence[Outcome[Variant, Made]], report: dict[str, Any]) -> None:
    for number, outcome in enumerate(sorted(failed, key=lambda each: each.task.number)):
        failure = outcome.failure
        assert failure is not None
        report["exit"] = max(report["exit"], failure.exit_code)
        report["failed"].append(_told(outcome, faults=[vars(fault) for fault in failure.faults]))
        if number < MOST_TOLD:
            complain(f"{outcome.task.name}: {failure.words}")
    if len(failed) > MOST_TOLD:
        complain(f"and {len(failed) - MOST_TOLD:,} more; --json tells of each")


def _draw_sheet(
    planned: Sweep,
    wishes: Wishes,
    report: dict[str, Any],
    caption: Callable[[Variant], tuple[str, ...]],
    about: str,
    columns: int,
) -> None:
    from pathlib import Path

    from batik_vector.making.sheets import Entry, pages, write_sheet
    from batik_vector.recipe.reading.sources import stem_of

    count = len(planned.variants)
    layout = _layout(planned, len(caption(planned.variants[0])), wishes.paper, columns)
    entries = (Entry(picture, caption(variant)) for variant, picture in planned.pictures())
    sheet = pages(entries, count, layout, planned.title, [about])
    stem = stem_of(planned.making.source)
    report["sheet"] = []
    for path in write_sheet(Path(planned.making.folder), f"{stem}-sheet", sheet, wishes.sheet, layout):
        report["sheet"].append(str(path))
        click.echo(f"{path}  shows all variants", err=True)


def _layout(planned: Sweep, lines: int, paper: str, columns: int) -> Plan:
    from batik_vector.making.sheets import plan

    shapes = sorted(each.height / each.width for _, each in planned.pictures() if each is not None)
    shape = shapes[len(shapes) // 2] if shapes else 1.0
    return plan(len(planned.variants), shape, lines, paper, columns)
