"""The commands between drawings and recipes.

``import`` drafts a recipe, ``batify`` makes a plain drawing batik, ``export-motif`` draws a motif.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from batik_vector.command.options import Finite, file_option, files_begun, json_option
from batik_vector.command.telling import collecting, counted, reported, stages
from batik_vector.errors import ExportError

if TYPE_CHECKING:
    from batik_vector.drafting.draft import Draft


STYLES = ("solo", "pesisir", "miao")
"""As in :class:`batik_vector.recipe.fills.isen.Style`."""


@click.command("import", short_help="Take a whole tile over as a recipe.")
@click.argument("tile", metavar="TILE.svg", shell_complete=files_begun)
@file_option("The recipe to write.  [default: NAME.toml]")
@click.option("--repeat", metavar="WORDS", default="grid", help="How the page repeats.  [default: grid]")
@click.option(
    "--tolerance",
    type=Finite(min=0.002, max=5),
    metavar="MM",
    default=0.02,
    help="How far the cloth may stand from the drawing.  [default: 0.02]",
)
@click.option("--force", is_flag=True, help="Replace a file that is there.")
@click.option("--json", "as_json", is_flag=True, help="Print one report for machines on stdout.")
def import_command(
    tile: str, path: str | None, repeat: str, tolerance: float, force: bool, as_json: bool
) -> None:
    """Take a whole tile over: write a recipe that draws the cloth of an SVG.

    The page is the tile. Its symmetry group is found, marks are taken whole, and copies become one motif.
    The recipe is compiled and compared with the drawing; exits with 1 where it draws anything else.
    """
    from pathlib import Path

    from batik_vector.command.new_files import new_file, write_new

    with reported(as_json) as report:
        if Path(tile).suffix.lower() == ".toml":
            raise ExportError(f"{tile} is a recipe, expected a tile as SVG")
        target = new_file(path, Path(tile).stem, ".toml", force)
        if target.suffix.lower() != ".toml":
            raise ExportError(f'"{target}" is no name of a recipe, expected one that ends with .toml')
        beside = target.with_name(f"{target.stem}-marks.svg")
        with stages(as_json) as tell:
            from batik_vector.compiling.compiler import compile_recipe
            from batik_vector.drafting.draft import drafted
            from batik_vector.recipe.loading import read_recipe

            collecting()
            draft = drafted(
                tile,
                lambda text: compile_recipe(read_recipe(text, str(target))),
                repeat,
                tolerance,
                beside.name,
                tell,
            )
        files = {target: draft.text} | ({beside: draft.drawing} if draft.drawing else {})
        write_new({path: text.encode("utf-8") for path, text in files.items()}, force)
        facts = _facts(draft, tile, [str(each) for each in files])
        report["recipes"].append(facts)
        report["exit"] = 0 if draft.proof.holds else 1
        _tell(draft, tile, [str(each) for each in files])


def _facts(draft: Draft, source: str, files: Sequence[str]) -> dict[str, Any]:
    """Return what was found as plain values."""
    inks = zip(draft.inks, draft.proof.apart, draft.proof.allowed, strict=True)
    return {
        "drawing": source,
        "recipe": files[0],
        "files": list(files),
        "group": draft.group.name,
        "repeat": draft.unit.name,
        "size_mm": list(draft.unit.tile.size),
        "marks": draft.marks,
        "motifs": draft.motifs,
        "placed": draft.placed,
        "inks": [
            {"ink": ink, "differs_mm2": round(apart, 6), "allowed_mm2": round(allowed, 6)}
            for ink, apart, allowed in inks
        ],
        "same": draft.proof.holds,
        "notes": list(draft.notes),
    }


def _tell(draft: Draft, source: str, files: Sequence[str]) -> None:
    """Tell people what was found."""
    for note in draft.notes:
        click.echo(f"{source}: {note}", err=True)
    size = " × ".join(f"{side:g}" for side in draft.unit.tile.size)
    marks, kinds = _several(draft.marks, "mark"), _several(draft.motifs, "kind")
    click.echo(
        f"{source}: symmetry group {draft.group.name}; {marks} of {kinds}, "
        f"{draft.placed:,} placed in a unit of {size} mm ({draft.unit.name})",
        err=True,
    )
    worst = max(
        range(len(draft.inks)), key=lambda i: draft.proof.apart[i] / max(draft.proof.allowed[i], 1e-9)
    )
    apart, allowed = draft.proof.apart[worst], draft.proof.allowed[worst]
    words = "the recipe draws the same" if draft.proof.holds else "error: the recipe draws something else"
    click.echo(
        f'{source}: {words}: ink "{draft.inks[worst]}" differs by {apart:.3g} mm², {allowed:.3g} are allowed',
        err=True,
    )
    click.echo(f"{' and '.join(files)} written. Next: batik-vector compile {files[0]}", err=True)


def _several(count: int, what: str) -> str:
    return f"{count:,} {what}" if count == 1 else f"{count:,} {what}s"


@click.command("batify", short_help="Make a plain drawing batik.")
@click.argument("drawing", metavar="DRAWING.svg", shell_complete=files_begun)
@file_option("The recipe to write.  [default: NAME-batik.toml]")
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


@click.command("export-motif", short_help="Draw one motif of a recipe as an SVG.")
@click.argument("recipe", metavar="RECIPE", shell_complete=files_begun)
@click.argument("motif", metavar="MOTIF")
@file_option("The SVG to write.  [default: MOTIF.svg]")
@click.option("--force", is_flag=True, help="Replace a file that is there.")
def export_motif_command(recipe: str, motif: str, path: str | None, force: bool) -> None:
    """Draw one motif of a recipe as an SVG, to be edited and read again as a motif of kind "svg"."""
    """Draw one motif of a recipe as an SVG, to be edited and read again as a motif of kind "svg".

    The tables by which a recipe reads it are printed on stdout.
    """
    from batik_vector.command.new_files import new_file, write_new
    from batik_vector.drafting.motif_drawing import motif_drawing
    from batik_vector.recipe.loading import load_recipe

    target = new_file(path, motif, ".svg", force)
    if target.suffix.lower() != ".svg":
        raise ExportError(f'"{target}" is no name of a drawing, expected one that ends with .svg')
    drawing = motif_drawing(load_recipe(recipe), motif)
    write_new({target: drawing.svg.encode("utf-8")}, force)
    click.echo(drawing.table(motif, target.name))
    click.echo(f"{target} written. To use it, write the tables above into the recipe", err=True)
