"""The command ``batik-vector``. What was asked for is on stdout; stderr tells people how it went.

What is heavy is imported where it is used, so that ``--help`` answers at once.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import click

from batik_vector._version import __version__
from batik_vector.command.compile import compile_command
from batik_vector.command.drawings import batify_command, export_motif_command, import_command
from batik_vector.command.installed_plugins import broken, plugins_command
from batik_vector.command.library import library_command
from batik_vector.command.made_files import called
from batik_vector.command.manual import exit_codes_told, man_command
from batik_vector.command.options import (
    Finite,
    file_option,
    files_begun,
    json_option,
    machines_begun,
    set_option,
)
from batik_vector.command.palettes import colourways_command, palettes_command
from batik_vector.command.stopping import EXITS, end_on_sigterm, listen
from batik_vector.command.studio import studio_command
from batik_vector.command.sweeps import random_command, sweep_command
from batik_vector.command.telling import collecting, complain, faults_told, reported, stages
from batik_vector.command.watch import watch_command
from batik_vector.command.worksheets import worksheet_command
from batik_vector.errors import BatikError, unknown_name

KINDS = (
    "bird",
    "border",
    "butterfly",
    "ceplok",
    "flower",
    "four-square",
    "half-drop",
    "kawung",
    "mega-mendung",
    "own-drawing",
    "parang",
    "rosette",
    "toss",
    "truntum",
    "vine",
    "wallpaper",
    "yardage",
)
"""As in :data:`batik_vector.command.starters.STARTERS`, likewise."""
DEFAULT_KIND = "flower"
SIGPIPE_EXIT = 141


def _interrupted(number: int) -> None:
    if number == signal.SIGINT:
        complain("interrupted")


class _Commands(click.Group):
    """The commands, with every way they may end told in words and an exit code."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that is meant; of a file or a starter in its place, what goes before it."""
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            if args[0] in KINDS:
                hint = f"A recipe of that kind: batik-vector new {args[0]}"
            elif os.path.isfile(args[0]) or args[0].endswith(".toml"):
                hint = f"To make files of a recipe: batik-vector compile {args[0]}"
            else:
                raise
            raise click.UsageError(f"{error.message} {hint}", ctx) from error

    def invoke(self, ctx: click.Context) -> Any:
        try:
            result = super().invoke(ctx)
            sys.stdout.flush()
            return result
        except BatikError as error:
            complain(str(error))
            ctx.exit(error.exit_code)
        except KeyboardInterrupt:
            _interrupted(signal.SIGINT)
            ctx.exit(EXITS[signal.SIGINT])
        except BrokenPipeError:
            # Whoever read has gone; what is left in the buffer must not be flushed into the pipe.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            ctx.exit(SIGPIPE_EXIT)
        except RecursionError:
            complain("this is nested too deeply")
            ctx.exit(2)
        except Exception as error:
            # GEOS tells by an error of its own that memory has run out.
            if not (isinstance(error, MemoryError) or str(error) == "std::bad_alloc"):
                raise
            complain(
                "this needs more memory than there is: lower the counts or levels, or allow more tolerance"
            )
            ctx.exit(2)


@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="batik-vector")
@click.option(
    "--library",
    "library",
    metavar="FILE",
    help="Where library:NAME is looked up.  [default: that of BATIK_LIBRARY, or your own]",
)
def cli(library: str | None) -> None:
    """Compile batik patterns: a recipe goes in, repeatable tiles in true millimetres come out."""
    if library:
        # Processes that this one begins look there, too.
        os.environ["BATIK_LIBRARY"] = library


def _limit(name: str, metavar: str, says: str, option: str = "") -> Callable[[Any], Any]:
    """Return an option that sets one of the certificate's limits."""
    return click.option(f"--{option or name}", name, type=Finite(min=0), metavar=metavar, help=says)


@cli.command("check", short_help="Certify tiles: seams, doubles, symmetry.")
@click.argument("sources", nargs=-1, required=True, metavar="RECIPE|SVG…", shell_complete=files_begun)
@set_option
@click.option("--repeat", metavar="WORDS", help="How a drawing without a recipe repeats.  [default: grid]")
@click.option("--group", metavar="NAME", help="The wallpaper group it ought to have, such as p4m.")
@_limit(
    "position", "MM", "How far a crossing and its twin may stand apart.  [default: 0.0001; drawings 0.04]"
)
@_limit("tangent", "DEG", "How far a border may turn on the seam.  [default: 0.1]")
@_limit("near", "MM", "How near to the seam slivers are looked for.  [default: 0.5]")
@_limit("thin", "MM", "What is thinner along the seam is a sliver.  [default: 0.02; drawings 0.05]")
@_limit("double", "MM", "Lines this close are drawn twice, a fault in drawings too.  [default: 0.005]")
@_limit(
    "between",
    "MM",
    "Bare gaps between inks narrower than this are faults; without it none is.",
    "between-inks",
)
@_limit("striping", "%", "Unevenness of columns or rows that is a fault; without it none is.")
@click.option("--lenient", is_flag=True, help="Let pass what cannot be measured, such as blended colours.")
@click.option("--pointers", metavar="DIR", help="Write NAME-check.svg with a mark at each fault.")
@click.option(
    "--machine",
    metavar="NAME",
    shell_complete=machines_begun,
    help="Hold them to a machine: a profile's name, or FILE.toml.",
)
@json_option
def check_command(
    sources: Sequence[str],
    overrides: Sequence[str],
    repeat: str | None,
    group: str | None,
    pointers: str | None,
    machine: str | None,
    lenient: bool,
    as_json: bool,
    **limits: float | None,
) -> None:
    """Certify tiles: do opposite edges meet, is anything drawn twice, which symmetry is there?

    A recipe is compiled and measured. An SVG, whoever drew it, is measured as it is drawn, its page being
    the tile. --machine also asks what a machine would fail at: lines and gaps too narrow, slivers, paths
    open or drawn again. Nothing is written but what --pointers asks for. Exits with 1 where a tile has
    faults.
    """
    from pathlib import Path

    from batik_vector.command.checks import Wishes, check_source, pointer_files, write_pointers
    from batik_vector.command.reports import table

    collecting()
    with reported(as_json) as report:
        given = {name: value for name, value in limits.items() if value is not None}
        profile = called((), machine).get("machine_profile")
        wishes = Wishes(repeat or "", group or "", given, lenient, profile, machine or "")
        places = pointer_files(sources, Path(pointers)) if pointers is not None else {}
        found = []
        with stages(as_json) as tell:
            for source in sources:
                with faults_told(report):
                    each = check_source(source, overrides, wishes, tell)
                    found.append(each)
                    report["recipes"].append(each.facts)
                    _tell_facts(each.facts, as_json)
                    report["exit"] = max(report["exit"], 0 if each.passed else 1)
        if len(sources) > 1:
            click.echo("\n".join(table(sources, report["recipes"])), err=as_json)
        for path in write_pointers(found, places) if places else ():
            click.echo(f'{path}  shows the faults in layer "check"', err=True)


def _tell_facts(facts: dict[str, Any], aside: bool) -> None:
    """Print a report for people, beside the one for machines where there is one."""
    from batik_vector.command.reports import told

    click.echo("\n".join(told(facts)), err=aside)


@cli.command("analyse", short_help="Measure patterns: petals, symmetry, dimension.")
@click.argument("sources", nargs=-1, required=True, metavar="RECIPE|SVG…", shell_complete=files_begun)
@set_option
@json_option
def analyse_command(sources: Sequence[str], overrides: Sequence[str], as_json: bool) -> None:
    """Measure patterns: elements, symmetry, layers of petals, their shape, petals and pistils.

    These are the features by which Tian et al. (2019, Tables 1 and 2) judge patterns; besides, coverage,
    breadth of lines, nodes and box dimension. All comes from geometry alone. A recipe is compiled and
    measured, an SVG, whoever drew it, measured as it is drawn. Several make a table. Exits with 1 where a
    drawing holds no flower to be judged.
    """
    from batik_vector.command.analyses import analyse_source, table, told

    collecting()
    with reported(as_json) as report, stages(as_json) as tell:
        for source in sources:
            with faults_told(report):
                facts = analyse_source(source, overrides, tell)
                report["recipes"].append(facts)
                click.echo("\n".join(told(facts)), err=as_json)
                report["exit"] = max(report["exit"], 0 if facts["judged"] else 1)
        if len(sources) > 1:
            click.echo("\n".join(table(sources, report["recipes"])), err=as_json)


def _kind_name(_ctx: click.Context, _param: click.Parameter, name: str | None) -> str | None:
    if name is not None and name not in KINDS:
        raise click.BadParameter(unknown_name(name, KINDS, "kind"))
    return name


@cli.command("new", short_help="Write a recipe to begin with.")
@click.argument("name", required=False)
@click.option(
    "--kind",
    callback=_kind_name,
    shell_complete=lambda _ctx, _param, text: [name for name in KINDS if name.startswith(text)],
    metavar="KIND",
    help=f"What it begins as: {', '.join(KINDS)}.  [default: NAME where it is one, or {DEFAULT_KIND}]",
)
@file_option("The file to write.  [default: NAME.toml]")
@click.option("--force", is_flag=True, help="Replace a file that is there.")
@click.option("--list", "as_list", is_flag=True, help="Say what kinds there are, each in a line.")
def new_command(name: str | None, kind: str | None, path: str | None, force: bool, as_list: bool) -> None:
    """Write a recipe to begin with: short, commented, ready to compile.

    Without a NAME, a KIND or a FILE it says what kinds there are.
    """
    from batik_vector.command.starters import STARTERS, summary, write_starter

    if as_list or (name is None and kind is None and path is None and not force):
        for each in KINDS:
            click.echo(f"{each:<{max(map(len, KINDS))}}  {summary(STARTERS / f'{each}.toml')}")
        click.echo(f"Next: batik-vector new mine --kind {DEFAULT_KIND}", err=True)
        return
    named = (name or "").removesuffix(".toml").lower()
    kind = kind or (named if named in KINDS else DEFAULT_KIND)
    written = write_starter(STARTERS / f"{kind}.toml", name, path, force)
    click.echo(f"{written} written. Next: batik-vector compile {written}", err=True)


for _command in (
    compile_command,
    watch_command,
    worksheet_command,
    palettes_command,
    colourways_command,
    sweep_command,
    random_command,
    batify_command,
    import_command,
    export_motif_command,
    library_command,
    studio_command,
    man_command,
    plugins_command,
):
    cli.add_command(_command)


@cli.command("schema")
def schema_command() -> None:
    """Print the JSON Schema of recipes, for editors."""
    import json

    from batik_vector.recipe.schema import schema

    click.echo(json.dumps(schema(), indent=2))
    for words in broken():
        complain(words)


exit_codes_told(cli)


@contextmanager
def _brief() -> Iterator[None]:
    """Spare a run of the command what only long ones profit from.

    What is imported lives to the end: to look through it for garbage as it comes in, and once more at the
    end, took a sixth of a short run. And each thread of OpenBLAS, whose work here is matrices of two rows,
    takes milliseconds to start.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.enable()


def main() -> None:
    """Run the command."""
    # Maps of points are products with matrices of two rows: threads for them cost more than they bring.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    end_on_sigterm()
    listen(_interrupted)
    with _brief():
        cli(prog_name="batik-vector")


if __name__ == "__main__":
    main()
