"""Does what a call asks for: compiles recipes, and writes their files."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from batik_vector.artwork import Artwork, Page
from batik_vector.compiling.compiler import compile_cloth, compile_recipe
from batik_vector.errors import Fault, GeometryError, RecipeError, SeamError, UnsupportedByFormatError
from batik_vector.making.destinations import Destination, into_folders
from batik_vector.making.facts import facts_of, page_warnings, warnings
from batik_vector.making.jobs import Job, unmet
from batik_vector.making.pages import (
    Latest,
    Part,
    divided,
    done_to_tile,
    finished,
    piece_of,
    render_output,
    renumbered,
    size_of,
)
from batik_vector.recipe.loading import located
from batik_vector.recipe.model import OutputSpec, Recipe
from batik_vector.recipe.outputs import Piece

if TYPE_CHECKING:
    from batik_vector.tiling.cloth.yardage import Yardage


def _key_of(job: Job, output: OutputSpec) -> str:
    """Return the key of the table that asks for an output, or nothing where the call does."""
    return next((f"output[{i}]" for i, each in enumerate(job.recipe.output) if each is output), "")


@contextmanager
def _on_behalf(job: Job, key: str = "") -> Iterator[None]:
    """Give the errors of the work inside the job's file, and the line of the key at fault."""
    try:
        yield
    except SeamError as error:
        raise SeamError(f"{job.source}: {error}") from error
    except UnsupportedByFormatError as error:
        raise located(RecipeError([Fault(str(error), key)]), job.source, job.recipe.source) from error
    except GeometryError as error:
        raise located(RecipeError([Fault(str(error), key)]), job.source, job.recipe.source) from error
    except RecipeError as error:
        if key:
            error = RecipeError(
                [each if each.source else replace(each, key=f"{key}.{each.key}") for each in error.faults]
            )
        raise located(error, job.source, job.recipe.source, job.overrides) from error


def made(job: Job, tell: Callable[[str], None]) -> Artwork:
    """Compile a job's recipe.

    Raises:
        RecipeError: with the file and the lines.
        SeamError: where no clean seam is found.
    """
    with _on_behalf(job):
        return compile_recipe(job.recipe, progress=tell)


def run(
    job: Job,
    tell: Callable[[str], None],
    look: Callable[[Page], None] | None = None,
    destination: Destination = into_folders,
) -> dict[str, Any]:
    """Compile a job and write its files, all of them or none; return the report.

    ``look`` is called with the tile, or with the cloth where there is no tile.
    """
    start = time.perf_counter()
    recipe = job.recipe
    tile = made(job, tell) if recipe.tile is not None else None
    cloth: Yardage | None = None
    if any(piece_of(recipe, output) == Piece.YARDAGE for _, output in job.files):
        with _on_behalf(job):
            cloth = compile_cloth(recipe, tile=tile, progress=tell)
    shown: Page | None = tile or cloth
    if look is not None and shown is not None:
        look(shown)
    reports: list[dict[str, Any]] = []
    writers, latest = [], Latest()
    filled = _filling(recipe, tell)
    notes = [] if tile is None else warnings(recipe, tile)
    for path, output in job.files:
        page: Page | None = cloth if piece_of(recipe, output) == Piece.YARDAGE else tile
        if page is not None:
            with _on_behalf(job, key := _key_of(job, output)):
                total = len(output.process)
                page, output, before = done_to_tile(tile, page, output, latest, filled)
                with renumbered(first := total - len(output.process), total):
                    parts = divided(page, output, latest)
            for part in (part.after(before) for part in parts):
                place = path.with_name(f"{path.stem}{part.ending}{path.suffix}")
                size = size_of(page, output)
                writers.append(
                    (place, _writer(job, place, key, part, size, tell, reports, latest, (first, total)))
                )
            notes += page_warnings(path, output, page)
    _check_apart(job, writers)
    destination(writers)
    return {
        "recipe": job.source,
        **facts_of(tile, cloth),
        "files": reports,
        "seconds": round(time.perf_counter() - start, 3),
        "warnings": notes,
    }


def shown(job: Job, output: OutputSpec, tell: Callable[[str], None]) -> Page:
    """Return what a file of a job would hold, as its processes leave it, without writing it.

    Raises:
        RecipeError: with the file and the lines.
        SeamError: where no clean seam is found.
    """
    if fault := unmet(job, output, ""):
        raise RecipeError([fault])
    recipe = job.recipe
    tile = made(job, tell) if recipe.tile is not None else None
    with _on_behalf(job, _key_of(job, output)):
        of_cloth = piece_of(recipe, output) == Piece.YARDAGE
        page: Page | None = compile_cloth(recipe, tile=tile, progress=tell) if of_cloth else tile
        assert page is not None
        page, output, _ = done_to_tile(tile, page, output, latest := Latest(), _filling(recipe, tell))
        return finished(page, output, latest)[0]


def _filling(recipe: Recipe, tell: Callable[[str], None]) -> Callable[[Artwork], Page]:
    """Return what fills a recipe's cloth with its tile as processes have left this."""

    def filled(tile: Artwork) -> Page:
        if recipe.border:
            raise RecipeError([Fault("is done to the tile, and borders would stay as they are", "process")])
        return compile_cloth(recipe, tile=tile, progress=tell)

    return filled


def _check_apart(job: Job, files: Sequence[tuple[Path, Any]]) -> None:
    """Raise where a sheet of a divided drawing has the name of another file of the recipe."""
    taken: set[str] = set()
    for path, _ in files:
        if (place := os.path.normcase(path)) in taken:
            words = f'two outputs would be written to "{path}": give one of them another name'
            raise RecipeError([Fault(words, source=job.source)])
        taken.add(place)


def run_quietly(job: Job, destination: Destination = into_folders) -> dict[str, Any]:
    """Do :func:`run` without telling of its stages, as a worker does."""
    return run(job, lambda stage: None, destination=destination)


def _writer(
    job: Job,
    path: Path,
    key: str,
    part: Part,
    size: list[float],
    tell: Callable[[str], None],
    reports: list[dict[str, Any]],
    latest: Latest,
    among: tuple[int, int],
) -> Callable[[BinaryIO], None]:
    """Return what writes a file, and reports that it has; ``among`` tells which of all processes are left."""

    def write(sink: BinaryIO) -> None:
        begun = time.perf_counter()
        tell(f"writing {path.name}")
        with _on_behalf(job, key), renumbered(*among):
            facts = render_output(part.page, part.output, sink, latest)
        if part.facts is not None:
            facts = {**part.facts, **facts}
        reports.append(
            {
                "path": str(path),
                "format": part.output.format,
                "bytes": sink.tell(),
                "size_mm": size,
                "seconds": round(time.perf_counter() - begun, 3),
                **({"process": facts} if part.output.process or part.facts is not None else {}),
            }
        )

    return write
