"""``batik-vector studio``: a page in the browser where a recipe is worked at by looking."""

from __future__ import annotations

import os

import click

from batik_vector.command.options import files_begun
from batik_vector.command.telling import collecting

PORT = 8642
"""Where the page is, unless another port is asked for or this one is taken."""


@click.command("studio", short_help="Design by looking, in the browser.")
@click.argument("recipe", required=False, metavar="[RECIPE]", shell_complete=files_begun)
@click.option(
    "--port",
    type=click.IntRange(0, 65535),
    metavar="N",
    help=f"Of this machine, 0 for any that is free.  [default: {PORT}, or any where that is taken]",
)
@click.option(
    "--library",
    "library",
    metavar="FILE",
    help="The library to work with.  [default: that of BATIK_LIBRARY, or your own]",
)
@click.option("--no-browser", is_flag=True, help="Print the address, and open nothing.")
@click.option("--watch", "follow", is_flag=True, help="Show what is saved to the recipe's file elsewhere.")
def studio_command(
    recipe: str | None, port: int | None, library: str | None, no_browser: bool, follow: bool
) -> None:
    """Open the studio: a page with sliders, the library, and the pattern as it will be cut.

    A RECIPE is a TOML file, a file compiled from one, or library:NAME. Without it the studio goes on where it
    was left. It is served to this machine alone, to whoever has the address that is printed; Ctrl-C ends it.
    """
    if library:
        # Processes that this one begins look there, too.
        os.environ["BATIK_LIBRARY"] = library
    from batik_vector.studio.server import opened_session, serve
    from batik_vector.studio.watching import Watched

    if follow and recipe is None:
        raise click.UsageError("--watch needs a RECIPE to watch")
    collecting()
    watched = Watched(recipe) if follow and recipe is not None else None
    session = opened_session(recipe)
    try:
        serve(session, port, PORT, not no_browser, _say, watched)
    finally:
        session.close()


def _say(address: str) -> None:
    click.echo(f"{address}\nCtrl-C ends it.")
