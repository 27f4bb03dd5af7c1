"""What `batik-vector compile` and `watch` share: what a call sets for all files, and what is told of them."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import click

from batik_vector.command.options import (
    Finite,
    all_formats,
    folder_option,
    format_names,
    formats_begun,
    machines_begun,
)

if TYPE_CHECKING:
    from batik_vector.errors import BatikError
    from batik_vector.making.destinations import Destination
    from batik_vector.making.jobs import Job


class _Formats(click.Option):
    """The option for formats: its help names those of plug-ins, too, when it is read."""

    def get_help_record(self, ctx: click.Context) -> tuple[str, str] | None:
        """Return the option and its help."""
        self.help = f"{', '.join(all_formats())}.  [default: what the recipe asks for, or svg]"
        return super().get_help_record(ctx)


_OPTIONS = (
    folder_option("Where files go; made if missing.  [default: .]", "."),
    click.option(
        "-f",
        "--format",
        "formats",
        cls=_Formats,
        multiple=True,
        callback=format_names,
        shell_complete=formats_begun,
        metavar="FORMAT,…",
    ),
    click.option(
        "--process",
        "processes",
        multiple=True,
        metavar="WORDS",
        help='What a machine needs done first, as in "cut kerf=0.15mm"; several are done in turn.',
    ),
    click.option(
        "--machine",
        metavar="NAME",
        shell_complete=machines_begun,
        help="The machine it is for: a profile's name, or FILE.toml.",
    ),
    click.option("--dpi", type=Finite(min=1), metavar="N", help="Pixels per inch of cloth, of PNG and TIFF."),
    click.option(
        "--pages",
        type=click.Choice(["one", "tile"]),
        help="HPGL larger than the machine's page is refused (one), or divided over several (tile).",
    ),
    click.option(
        "--margin",
        metavar="LENGTH",
        help='Room around what HPGL draws, such as "4 mm": for what is cut beside it.',
    ),
    click.option(
        "--curves",
        type=click.Choice(["polyline", "bezier"]),
        help="SVG and PDF of vertices as they are, or of fitted Béziers with far fewer nodes.",
    ),
)


def files_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Give a command the options that say which files are made, and where."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def called(
    processes: Sequence[str],
    machine: str | None,
    pages: str | None = None,
    margin: str | None = None,
    dpi: float | None = None,
    curves: str | None = None,
) -> dict[str, Any]:
    """Return the keys of outputs that a call sets for all files."""
    keys: dict[str, Any] = {}
    if processes:
        from batik_vector.recipe.reading.called_processes import read_processes

        keys["process"] = read_processes(processes)
    if machine is not None:
        from batik_vector.recipe.reading.machines import read_machine

        keys |= {"machine": machine, "machine_profile": read_machine(machine)}
    if pages is not None:
        from batik_vector.export.options import Pages

        keys["pages"] = Pages(pages)
    if curves is not None:
        from batik_vector.export.options import Curves

        keys["curves"] = Curves(curves)
    if margin is not None:
        keys["margin"] = _length(margin)
    if dpi is not None:
        keys["dpi"] = dpi
    return keys


def _length(text: str) -> float:
    """Return a length of a call in mm; a bare number is one."""
    from batik_vector.errors import Fault, GeometryError, RecipeError
    from batik_vector.export.options import HpglOptions

    try:
        words: Any = float(text) if text.replace(".", "", 1).isdigit() else text
        return HpglOptions(margin=words).margin
    except GeometryError as error:
        raise RecipeError([Fault(str(error), source="--margin")]) from None


STDOUT = "-"
"""Names standard output where a command takes a folder."""
BINARY = ("pdf", "png", "tiff")


def destination(folder: str, formats: Sequence[str], dry_run: bool, as_json: bool) -> Destination:
    """Return where files go, by what a call says of it.

    Raises:
        RecipeError: where standard output is to hold what it cannot.
    """
    from batik_vector.making.destinations import into_folders, nowhere, onto

    if folder != STDOUT:
        return nowhere if dry_run else into_folders
    if as_json:
        raise _of_stdout("holds the file, and no report beside it: leave out --json")
    if dry_run:
        return nowhere
    if sys.stdout.isatty() and any(name in BINARY for name in formats):
        raise _of_stdout("is a terminal, which shows no pictures: send it on with > or |")
    return onto(sys.stdout.buffer)


def check_alone(jobs: Sequence[Job]) -> None:
    """Raise unless jobs make one file all together, which standard output holds.

    Raises:
        RecipeError: with how many there are.
    """
    count = sum(len(job.files) for job in jobs)
    if count != 1:
        raise _of_stdout(f"holds one file, this makes {count}: expected one recipe and one format (-f)")


def _of_stdout(words: str) -> BatikError:
    from batik_vector.errors import Fault, RecipeError

    return RecipeError([Fault(words, source="-o -")])


def tell_files(done: dict[str, Any]) -> None:
    """Tell people of the files of a recipe: their sizes, what processes did, warnings, and the time."""
    from batik_vector.command.process_reports import told_of
    from batik_vector.command.reports import made_of

    before: list[str] = []
    aside = "  not written" if done.get("written") is False else ""
    for file in done["files"]:
        width, height = (f"{side:g}" for side in file["size_mm"])
        size = _bytes(file["bytes"])
        click.echo(f"{file['path']}  {size}  {width} × {height} mm  {file['seconds']:.2f} s{aside}", err=True)
        # What went through the same takes the same: that is told once.
        lines = [f"  {words}" for words in told_of(file.get("process", {}))]
        for words in lines if lines != before else ():
            click.echo(words, err=True)
        before = lines or before
    for words in done["warnings"]:
        click.echo(f"{done['recipe']}: warning: {words}", err=True)
    for words in made_of(done):
        click.echo(f"{done['recipe']}: {words}", err=True)
    click.echo(f"{done['recipe']}: {done['vertices']:,} vertices in {done['seconds']:.2f} s", err=True)


def _bytes(count: int) -> str:
    return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{count / 1e3:.1f} kB"
