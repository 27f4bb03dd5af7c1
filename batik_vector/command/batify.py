"""``batik-vector batify``: a plain drawing becomes batik, as a recipe to be edited."""

from __future__ import annotations

from typing import Any

import click

from batik_vector.command.options import Finite, json_option
from batik_vector.command.telling import collecting, counted, reported, stages
from batik_vector.errors import ExportError

STYLES = ("solo", "pesisir", "miao")
"""As in :class:`batik_vector.recipe.fills.isen.Style`."""


@click.command("batify", short_help="Make a plain drawing batik.")
@click.argument("drawing", metavar="DRAWING.svg")
@click.option("-o", "path", metavar="FILE", help="The recipe to write.  [default: NAME-batik.toml]")
@click.option(
    "--style", type=click.Choice(STYLES), default="solo", help="Whose hand fills it.  [default: solo]"
)
@click.option("--palette", default="", metavar="NAME", help="Whose colours.  [default: the style's]")
@click.option(
    "--width", type=Finite(min=1, max=10_000), metavar="MM", help="Its breadth.  [default: 120 at most]"
)
@click.option("--force", is_flag=True, help="Replace files that are there.")
@json_option
def batify_command(
    drawing: str,
    path: str | None,
    style: str,
    palette: str,
    width: float | None,
    force: bool,
    as_json: bool,
) -> None:
    """Make a plain drawing batik: write a recipe, and beside it the drawing in cells.

    Outlines become lines of a canting's width, regions are filled by isen chosen by their size and depth,
    colours go to the nearest of the palette, and the ground is filled round it. All of it can be edited: the
    recipe names what fills what, and the drawing has a path for each cell.
    """
    from pathlib import Path

    from batik_vector.command.new_files import new_file, write_new

    with reported(as_json) as report:
        if Path(drawing).suffix.lower() == ".toml":
            raise ExportError(f"{drawing} is a recipe, expected a drawing as SVG")
        stem = Path(drawing).stem
        target = new_file(path, f"{stem}-batik", ".toml", force)
        if target.suffix.lower() != ".toml":
            raise ExportError(f'"{target}" is no name of a recipe, expected one that ends with .toml')
        beside = target.with_name(f"{target.stem}-cells.svg")
        with stages(as_json) as tell:
            from batik_vector.drafting.batik.batify import batified

            collecting()
            tell("making cells")
            made = batified(drawing, style, palette, width, stem, beside.name)
        write_new({target: made.text.encode("utf-8"), beside: made.drawing.encode("utf-8")}, force)
        facts: dict[str, Any] = {
            "drawing": drawing,
            "recipe": str(target),
            "files": [str(target), str(beside)],
            "style": style,
            "cells": made.cells,
            "filled": made.filled,
            "lines": made.lines,
            "colours": list(made.colours),
            "notes": list(made.notes),
        }
        report["recipes"].append(facts)
        for note in made.notes:
            click.echo(f"{drawing}: {note}", err=True)
        cells, lines = counted(made.cells, "cell"), counted(made.lines, "line")
        click.echo(f"{drawing}: {cells}, {made.filled:,} filled with isen, {lines}", err=True)
        click.echo(f"{target} and {beside} written. Next: batik-vector compile {target}", err=True)
