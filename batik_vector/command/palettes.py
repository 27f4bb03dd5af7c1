"""The commands about colours: ``palettes`` lists them, ``colourways`` draws a recipe in several."""

from __future__ import annotations

from typing import Any

import click

from batik_vector.command.options import files_begun, folder_option, json_option, listed, set_option
from batik_vector.command.telling import collecting, sheet_told
from batik_vector.command.worksheets import SHEET_FORMATS


@click.command("palettes", short_help="List the palettes, their colours and sources.")
@click.option("--json", "as_json", is_flag=True, help="Print them for machines.")
def palettes_command(as_json: bool) -> None:
    """List the palettes: what --colourway, --palettes, batify and palette = "solo" in a recipe know.

    Each has its colours, the lightest first, its baths where it is a dyer's, and a source.
    """
    from batik_vector.recipe.palettes import PALETTES

    if as_json:
        import json

        told = [
            {
                "name": each.name,
                "title": each.title,
                "home": each.home,
                "colours": dict(zip(each.words, each.colours, strict=True)),
                "baths": dict(each.baths),
                "source": each.source,
            }
            for each in PALETTES.values()
        ]
        click.echo(json.dumps(told, indent=2, ensure_ascii=False))
        return
    wide = max(map(len, PALETTES))
    for each in PALETTES.values():
        click.echo(f"{each.name:<{wide}}  {each.title} ({each.home})")
        colours = "  ".join(f"{word} {colour}" for word, colour in zip(each.words, each.colours, strict=True))
        click.echo(f"{'':<{wide}}  {colours}")
        if each.baths:
            baths = ", then ".join(f"{name} {colour}" for name, colour in each.baths)
            click.echo(f"{'':<{wide}}  baths: {baths}")
        click.echo(f"{'':<{wide}}  source: {each.source}")
    click.echo("Next: batik-vector compile mine.toml --colourway solo", err=True)


@click.command("colourways", short_help="Draw a recipe in its colourways on one page.")
@click.argument("recipe", metavar="RECIPE", shell_complete=files_begun)
@click.option(
    "--colourway",
    "names",
    default="all",
    metavar="NAME,…|all",
    help="Colourways of the recipe, or palettes.  [default: all of the recipe]",
)
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
@click.option("--paper", default="A4", metavar="SIZE", help="A5 to A0.  [default: A4]")
@set_option
@json_option
def colourways_command(recipe: str, as_json: bool, **asked: Any) -> None:
    """Draw a recipe's tile in its colourways side by side on one page, each with its name and colours.

    The first is the recipe as it is written.
    """
    collecting()
    sheet_told(as_json, lambda tell: _made(recipe, tell, **asked))


def _made(
    source: str,
    tell: Any,
    names: str,
    folder: str,
    formats: tuple[str, ...],
    paper: str,
    overrides: tuple[str, ...],
) -> dict[str, Any]:
    """Write the sheet of a recipe; return what is reported of it."""
    from pathlib import Path

    from batik_vector.making.colourway_sheets import colourway_sheet
    from batik_vector.making.destinations import check_folder, make_folder
    from batik_vector.making.jobs import read_jobs
    from batik_vector.making.sheets import write_sheet
    from batik_vector.recipe.reading.sources import stem_of

    check_folder(Path(folder))
    (job,) = read_jobs([source], overrides)
    tell("drawing")
    drawn, layout = colourway_sheet(job, listed(names), paper)
    make_folder(Path(folder))
    paths = write_sheet(Path(folder), f"{stem_of(source)}-colourways", drawn, formats, layout)
    return {"recipe": source, "title": job.recipe.title, "files": [str(path) for path in paths]}
