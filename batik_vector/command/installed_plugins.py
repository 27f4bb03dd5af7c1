"""``batik-vector plugins``: what installed plug-ins bring, and which are passed over for being broken."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING

import click

from batik_vector.command.options import json_option
from batik_vector.command.telling import complain

if TYPE_CHECKING:
    from batik_vector.fields import Catalogue


def catalogues() -> Iterator[tuple[str, Catalogue[type]]]:
    """Yield the catalogues that plug-ins can add to, each with what one of its kinds is called."""
    from batik_vector.geometry.curves import CURVES
    from batik_vector.processes.options import PROCESSES
    from batik_vector.recipe.fills import FILLS
    from batik_vector.recipe.motif import MOTIFS
    from batik_vector.recipe.outputs import OUTPUTS
    from batik_vector.tiling.layouts import LAYOUTS

    yield from (("motif", MOTIFS), ("curve", CURVES), ("layout", LAYOUTS))
    yield from (("fill", FILLS), ("process", PROCESSES), ("format", OUTPUTS))


def broken() -> Iterator[str]:
    """Yield what is wrong with plug-ins, in words."""
    for what, catalogue in catalogues():
        for name, words in catalogue.broken.items():
            yield f"{what} {name} is passed over: {words}"


@click.command("plugins", short_help="List what installed plug-ins bring.")
@json_option
def plugins_command(as_json: bool) -> None:
    """List the kinds that installed plug-ins bring, and the package that each is from.

    A plug-in is a Python package that names its kinds as entry points: docs/plugins.md says how. What is
    broken is told, and passed over everywhere else.
    """
    rows = [
        {"what": what, "name": name, "package": origin.package, "version": origin.version}
        for what, catalogue in catalogues()
        for name, origin in catalogue.brought.items()
    ]
    faults = list(broken())
    if as_json:
        click.echo(json.dumps({"plugins": rows, "broken": faults}, indent=2, ensure_ascii=False))
        return
    for row in rows:
        click.echo(f"{row['what']:<8} {row['name']:<20} {row['package']} {row['version']}")
    for words in faults:
        complain(words)
    if not rows and not faults:
        click.echo("no plug-ins are installed", err=True)
