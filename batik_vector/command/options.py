"""Options that several commands have."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

import click

from batik_vector.errors import unknown_name

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem


class Finite(click.FloatRange):
    """A number within bounds; ``nan`` and ``inf``, which click lets through, are none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        """Return the number, or tell what was expected."""
        number = float(super().convert(value, param, ctx))
        if not math.isfinite(number):
            self.fail(f"{value} is no number that is finite.", param, ctx)
        return number


FORMATS = ("svg", "pdf", "dxf", "hpgl", "gcode", "png", "tiff", "swatch", "gpl", "ase")
"""As in :data:`batik_vector.export.FORMATS`, which a test compares."""


def all_formats() -> tuple[str, ...]:
    """Return the names of the formats, those of plug-ins too."""
    from batik_vector import export

    return tuple(export.FORMATS)


def format_names(_ctx: click.Context, _param: click.Parameter, texts: Sequence[str]) -> list[str]:
    """Return the names of formats, given one by one or parted by commas."""
    names = [name.strip().lower() for text in texts for name in text.split(",") if name.strip()]
    for name in names:
        if name not in FORMATS and name not in all_formats():
            raise click.BadParameter(unknown_name(name, all_formats(), "format"))
    return names


def formats_begun(_ctx: click.Context, _param: click.Parameter, text: str) -> list[str]:
    """Return what shells offer for the names of formats, the last of several included."""
    before, comma, begun = text.rpartition(",")
    return [f"{before}{comma}{name}" for name in all_formats() if name.startswith(begun.lower())]


def files_begun(_ctx: click.Context, _param: click.Parameter, text: str) -> list[CompletionItem]:
    """Return what tells a shell to offer files, as it does for other programs."""
    from click.shell_completion import CompletionItem

    return [CompletionItem(text, type="file")]


def folders_begun(_ctx: click.Context, _param: click.Parameter, text: str) -> list[CompletionItem]:
    """Return what tells a shell to offer folders."""
    from click.shell_completion import CompletionItem

    return [CompletionItem(text, type="dir")]


def machines_begun(ctx: click.Context, param: click.Parameter, text: str) -> list[CompletionItem]:
    """Return what shells offer for a machine: the profiles that come along, else files."""
    from click.shell_completion import CompletionItem

    from batik_vector.machines.shipped import MACHINES

    known = [CompletionItem(name) for name in MACHINES if name.startswith(text)]
    return known or files_begun(ctx, param, text)


def listed(text: str) -> list[str]:
    """Return names that commas part."""
    return [name.strip() for name in text.split(",") if name.strip()]


def workers_of(_ctx: click.Context, _param: click.Parameter, number: int) -> int:
    """Return how many processes work: 0 stands for one on each core."""
    if number:
        return number
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


Called = TypeVar("Called", bound=Callable[..., Any])


def file_option(help_text: str) -> Callable[[Called], Called]:
    """Return ``-o``: the one file that a command writes."""
    return click.option("-o", "--output", "path", metavar="FILE", shell_complete=files_begun, help=help_text)


def folder_option(
    help_text: str, default: str | None = None, metavar: str = "DIR"
) -> Callable[[Called], Called]:
    """Return ``-o``: the folder where a command's files go."""
    return click.option(
        "-o",
        "--output",
        "folder",
        default=default,
        metavar=metavar,
        shell_complete=folders_begun,
        help=help_text,
    )


recipes_argument = click.argument(
    "recipes", nargs=-1, required=True, metavar="RECIPE…", shell_complete=files_begun
)
set_option = click.option(
    "--set",
    "overrides",
    multiple=True,
    metavar="KEY=VALUE",
    help="Set a value, as in petal.count=12, place[0].width='200 mm' or place[*].layout.dist=3.",
)
json_option = click.option("--json", "as_json", is_flag=True, help="Print one report for machines on stdout.")
jobs_option = click.option(
    "-j",
    "--jobs",
    type=click.IntRange(0, 256),
    default=1,
    callback=workers_of,
    metavar="N",
    help="Processes that work at a time; 0 is one for each core.  [default: 1]",
)
