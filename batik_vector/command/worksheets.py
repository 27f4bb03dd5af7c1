"""``batik-vector worksheet``: the steps of waxing and dyeing a design on pages for the workshop."""

from __future__ import annotations

from typing import Any

import click

from batik_vector.command.options import files_begun, folder_option, json_option, set_option
from batik_vector.command.telling import collecting, sheet_told

SHEET_FORMATS = ("svg", "pdf", "png")
"""As in :data:`batik_vector.making.sheets.FORMATS`."""


@click.command("worksheet", short_help="Draw the steps of waxing and dyeing for the workshop.")
@click.argument("recipe", metavar="RECIPE", shell_complete=files_begun)
@folder_option("Where it goes.  [default: out]", "out")
@click.option(
    "-f",
    "--format",
    "formats",
    type=click.Choice(SHEET_FORMATS),
    multiple=True,
    default=("pdf",),
    help="[default: pdf]",
)
@click.option(
    "--process",
    default="wax",
    metavar="PROCESS",
    help="How it is waxed, as in 'wax removal=add-only' or 'wax cantings.isen=0.6mm'.  [default: wax]",
)
@click.option("--paper", default="A4", metavar="SIZE", help="A5 to A0.  [default: A4]")
@set_option
@json_option
def worksheet_command(recipe: str, as_json: bool, **asked: Any) -> None:
    """Draw a work sheet of a recipe with baths: plates, what is scraped off, and the cloth after each bath.

    Each step has its picture, the area of wax, and the metres of line for each canting.
    """
    collecting()
    sheet_told(as_json, lambda tell: _made(recipe, tell, **asked))


def _made(
    source: str,
    tell: Any,
    folder: str,
    formats: tuple[str, ...],
    process: str,
    paper: str,
    overrides: tuple[str, ...],
) -> dict[str, Any]:
    """Write the sheet of a recipe; return what is reported of it."""
    from pathlib import Path

    from batik_vector.errors import Fault, GeometryError, RecipeError
    from batik_vector.making.destinations import check_folder, make_folder
    from batik_vector.making.jobs import read_jobs
    from batik_vector.making.running import made
    from batik_vector.making.sheets import write_sheet
    from batik_vector.making.worksheets import worksheet
    from batik_vector.processes.options import WaxProcess
    from batik_vector.recipe.reading.called_processes import read_process
    from batik_vector.recipe.reading.sources import stem_of

    spec = read_process(process)
    if not isinstance(spec, WaxProcess):
        raise RecipeError([Fault(f'"{spec.kind}", expected wax', source=f"--process {process}")])
    check_folder(Path(folder))
    (job,) = read_jobs([source], overrides)
    tile = made(job, tell)
    tell("drawing")
    try:
        drawn, layout = worksheet(tile, spec, paper)
    except GeometryError as error:
        raise RecipeError([Fault(str(error), source=source)]) from error
    make_folder(Path(folder))
    paths = write_sheet(Path(folder), f"{stem_of(source)}-worksheet", drawn, formats, layout)
    return {"recipe": source, "title": tile.title, "files": [str(path) for path in paths]}
