"""`batik-vector watch`: a recipe is compiled again on every save of its file and of what it names."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import click

from batik_vector.command.made_files import STDOUT, called, files_options, tell_files
from batik_vector.command.options import files_begun, set_option
from batik_vector.command.telling import collecting, faults_told


@click.command("watch", short_help="Compile again on every save.")
@click.argument("recipe", shell_complete=files_begun)
@files_options
@set_option
@click.option("--page", is_flag=True, help="Show it in the studio's page, too.")
@click.option("--json", "as_json", is_flag=True, help="Print a report for machines on stdout, a line a save.")
def watch_command(
    recipe: str,
    folder: str,
    formats: Sequence[str],
    processes: Sequence[str],
    machine: str | None,
    pages: str | None,
    margin: str | None,
    dpi: float | None,
    curves: str | None,
    overrides: Sequence[str],
    page: bool,
    as_json: bool,
) -> None:
    """Compile a recipe, and again on every save of its file and of the drawings and machines it names.

    What is wrong is told, and the files of the last good recipe stay; the next save is compiled all the same.
    Ctrl-C ends it.
    """
    from batik_vector.studio.watching import Watched

    collecting()
    if folder == STDOUT:
        raise click.BadParameter("a file that is written again and again needs a folder", param_hint="-o")
    watched = Watched(recipe)
    keys = called(processes, machine, pages, margin, dpi, curves)

    def work() -> None:
        _compiled(recipe, folder, formats, keys, overrides, as_json)
        click.echo(f"watching {', '.join(watched.files)}: Ctrl-C ends it", err=True)
        for changed in watched.changes():
            click.echo(f"{', '.join(changed)} saved", err=True)
            _compiled(recipe, folder, formats, keys, overrides, as_json)

    if page:
        _shown(recipe, work)
    else:
        work()


def _shown(recipe: str, work: Callable[[], None]) -> None:
    """Have the studio's page follow the recipe, and work beside it.

    Raises:
        BatikError: where the studio's libraries are missing.
    """
    import threading

    from batik_vector.command.studio import PORT
    from batik_vector.studio.server import opened_session, serve
    from batik_vector.studio.watching import Watched

    session = opened_session(recipe)
    try:
        threading.Thread(target=work, daemon=True).start()
        # Reports are alone on stdout.
        serve(session, None, PORT, True, lambda address: click.echo(address, err=True), Watched(recipe))
    finally:
        session.close()


def _compiled(
    recipe: str,
    folder: str,
    formats: Sequence[str],
    keys: dict[str, Any],
    overrides: Sequence[str],
    as_json: bool,
) -> None:
    """Compile a recipe as it is now, and tell of its files, or of its faults."""
    from pathlib import Path

    from batik_vector._version import __version__
    from batik_vector.making.jobs import planned, read_jobs, ready
    from batik_vector.making.running import run_quietly

    report: dict[str, Any] = {"version": __version__, "exit": 0, "recipes": [], "faults": []}
    with faults_told(report):
        work, lacking = ready(planned(read_jobs([recipe], overrides), Path(folder), formats, keys))
        for job in work:
            done = run_quietly(job)
            report["recipes"].append(done)
            tell_files(done)
        for error in lacking:
            raise error
    if as_json:
        import json

        # A line each, so that who reads them knows where one ends.
        click.echo(json.dumps(report))
