"""The command ``batik`` of vpype: a recipe's inks become layers, ready for linesort, occult and write.

    vpype batik four-square.toml linesort write out.svg

vpype loads this whenever it starts: what is heavy waits until the command runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click
import vpype
from vpype_cli import global_processor

if TYPE_CHECKING:
    from batik_vector.artwork import Page
    from batik_vector.processes.spec import ProcessSpec

HATCHES = ("parallel", "cross", "concentric", "spiral")
"""As in :data:`batik_vector.processes.hatching.options.HATCHES`, which a test compares."""
PIECES = ("tile", "yardage")
PX = vpype.convert_length("mm")
"""CSS pixels of a millimetre, in which vpype counts."""


def _batik(
    document: Any,
    recipe: str,
    overrides: Sequence[str],
    piece: str | None,
    repeat: tuple[int, int] | None,
    hatch: str | None,
    processes: Sequence[str],
    machine: str | None,
) -> Any:
    """Compile a batik RECIPE and add its inks as layers.

    A RECIPE is a TOML file, a file that was compiled from one, or library:NAME. Each ink is a layer with its
    name, its colour and the breadth of its pen, numbered as its pen is; the page is as large as the tile or
    the cloth. Areas are drawn as outlines, each stroke once; --hatch fills them.

    Examples:

        vpype batik four-square.toml linesort write out.svg

        vpype batik kawung.toml --set tolerance=0.1mm --hatch spiral show
    """
    from batik_vector.errors import BatikError

    try:
        page = _page(recipe, overrides, piece, repeat, _words(hatch, processes), machine)
        _add(document, page)
    except BatikError as error:
        raise click.ClickException(str(error)) from error
    document.add_to_sources(recipe)
    return document


def _words(hatch: str | None, processes: Sequence[str]) -> list[str]:
    """Return the processes that the page goes through, in words."""
    if hatch and processes:
        raise click.UsageError(
            f'--hatch beside --process: expected --process "plot hatch.kind={hatch}" alone'
        )
    return [f"plot hatch.kind={hatch}"] if hatch else list(processes)


def _page(
    recipe: str,
    overrides: Sequence[str],
    piece: str | None,
    repeat: tuple[int, int] | None,
    processes: Sequence[str],
    machine: str | None,
) -> Page:
    """Return the strokes of a recipe's page."""
    from batik_vector.making.jobs import read_jobs
    from batik_vector.making.running import shown
    from batik_vector.recipe.outputs import Piece, SvgOutput
    from batik_vector.recipe.reading.called_processes import read_processes
    from batik_vector.recipe.reading.machines import read_machine

    output = SvgOutput(
        piece=Piece(piece) if piece else None,
        repeat=repeat or (1, 1),
        process=_with_strokes(read_processes(processes)),
        machine=machine or "",
        machine_profile=read_machine(machine) if machine else None,
    )
    (job,) = read_jobs([recipe], overrides)
    return shown(job, output, lambda stage: None)


def _with_strokes(processes: tuple[ProcessSpec, ...]) -> tuple[ProcessSpec, ...]:
    """Return processes that leave strokes in the end, for vpype knows no areas."""
    from batik_vector.processes.options import PlotProcess
    from batik_vector.processes.spec import StrokeProcess

    if processes and isinstance(processes[-1], StrokeProcess):
        return processes
    return (*processes, PlotProcess())


def _add(document: Any, page: Page) -> None:
    """Add the strokes of a page to a document: to layers of the same ink, or to new ones."""
    from batik_vector.command.plugins.pens import pens_of
    from batik_vector.making.pages import page_size

    known = {_ink_of(layer): number for number, layer in document.layers.items()}
    last = max(document.layers, default=0)
    for pen in pens_of(page):
        number = known.get((pen.ink.name, vpype.Color(pen.ink.colour)), last + pen.number)
        lines = (line[:, 0] * PX + line[:, 1] * (PX * 1j) for line in pen.lines)
        document.add(vpype.LineCollection(lines), number)
        for key, value in (
            (vpype.METADATA_FIELD_NAME, pen.ink.name),
            (vpype.METADATA_FIELD_COLOR, pen.ink.colour),
            (vpype.METADATA_FIELD_PEN_WIDTH, pen.ink.width * PX),
        ):
            document.layers[number].set_property(key, value)
    width, height = page_size(page)
    document.extend_page_size((width * PX, height * PX))


def _ink_of(layer: Any) -> tuple[Any, Any]:
    return layer.property(vpype.METADATA_FIELD_NAME), layer.property(vpype.METADATA_FIELD_COLOR)


_OPTIONS = (
    click.argument("recipe", metavar="RECIPE"),
    click.option(
        "--set",
        "overrides",
        multiple=True,
        metavar="KEY=VALUE",
        help="Set a value of the recipe, as in motif.flower.petal.count=12.",
    ),
    click.option(
        "--piece", type=click.Choice(PIECES), help="The tile or the yardage.  [default: yardage, if any]"
    ),
    click.option(
        "--repeat", type=click.IntRange(1, 200), nargs=2, metavar="N M", help="How many tiles across and up."
    ),
    click.option("--hatch", type=click.Choice(HATCHES), help="Fill areas, a pen's width apart."),
    click.option(
        "--process",
        "processes",
        multiple=True,
        metavar="WORDS",
        help='What is done first, as in "plot hidden=remove"; several are done in turn.  [default: plot]',
    ),
    click.option("--machine", metavar="NAME", help="The machine it is for: a profile's name, or FILE.toml."),
)


class _OptionsAnywhere(click.Command):
    """A command whose options may stand behind its argument, as those of ``batik-vector compile`` do.

    In a chain of commands click takes for the next command what is behind the argument.
    """

    help_group = "Input"

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        options = [each for each in self.get_params(ctx) if isinstance(each, click.Option)]
        values = {name: 0 if each.is_flag else each.nargs for each in options for name in each.opts}

        def behind_options(at: int) -> int:
            while at < len(args) and (name := args[at].partition("=")[0]) in values:
                at += 1 if "=" in args[at] else 1 + values[name]
            return at

        first = behind_options(0)
        last = behind_options(first + 1)
        return super().parse_args(
            ctx, [*args[:first], *args[first + 1 : last], *args[first : first + 1], *args[last:]]
        )


def _command() -> click.Command:
    function = global_processor(_batik)
    for option in reversed(_OPTIONS):
        function = option(function)
    return click.command("batik", cls=_OptionsAnywhere)(function)


batik = _command()
"""The command, as vpype's entry point names it."""
