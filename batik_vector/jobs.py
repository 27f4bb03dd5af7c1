"""What a call asks for: which recipes are read, and which files each of them makes."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import shapely

from batik_vector.artwork import Artwork
from batik_vector.compiler import compile_recipe
from batik_vector.errors import ExportError, Fault, GeometryError, RecipeError, SeamError
from batik_vector.export import FORMATS, render, write_all_whole
from batik_vector.model import OutputSpec, Recipe
from batik_vector.outputs import OUTPUTS
from batik_vector.reading.files import COMPILED
from batik_vector.recipe import load_recipe, located
from batik_vector.tiling.field import repeated, with_bleed


@dataclass(frozen=True)
class Job:
    """A recipe that has been read, and the files to make of it."""

    source: str
    recipe: Recipe
    overrides: tuple[str, ...] = ()
    files: tuple[tuple[Path, OutputSpec], ...] = ()


def read_jobs(sources: Sequence[str], overrides: Sequence[str] = ()) -> list[Job]:
    """Read recipes.

    Raises:
        RecipeError: with everything that is wrong in any of them.
    """
    jobs: list[Job] = []
    faults: list[Fault] = []
    for source in sources:
        try:
            jobs.append(Job(source, load_recipe(source, overrides), tuple(overrides)))
        except RecipeError as error:
            faults += error.faults
    if faults:
        raise RecipeError(faults)
    return jobs


def planned(jobs: Sequence[Job], folder: Path, formats: Sequence[str] = ()) -> list[Job]:
    """Return jobs with the files each of them makes.

    Args:
        jobs: as read.
        folder: where all files go.
        formats: which formats are made; when left out those that the recipe asks for, or else SVG.

    Raises:
        RecipeError: where two files would have the same name.
        ExportError: where a file cannot be written.
    """
    _check_folder(folder)
    plans: list[Job] = []
    faults: list[Fault] = []
    taken: dict[str, Job] = {}
    for job in jobs:
        files = []
        for output in _outputs(job.recipe, formats):
            path = folder / _file_name(job, output)
            place = os.path.normcase(path)
            if place in taken:
                faults.append(_twice(path, taken[place], job, output))
                continue
            taken[place] = job
            _check_place(path, job)
            files.append((path, output))
        plans.append(Job(job.source, job.recipe, job.overrides, tuple(files)))
    if faults:
        raise RecipeError(faults)
    return plans


def _outputs(recipe: Recipe, formats: Sequence[str]) -> Iterator[OutputSpec]:
    if not formats:
        yield from recipe.output or (OUTPUTS["svg"](),)
    for name in dict.fromkeys(formats):
        yield from [each for each in recipe.output if each.format == name] or [OUTPUTS[name]()]


def _file_name(job: Job, output: OutputSpec) -> str:
    stem = Path(job.source).stem
    if Path(job.source).suffix.lower() in COMPILED:
        # A compiled file is called after its recipe and its output: kawung-print.pdf.
        endings = sorted((f"-{each.name}" for each in job.recipe.output if each.name), key=len)
        stem = stem.removesuffix(next((end for end in reversed(endings) if stem.endswith(end)), ""))
    name = f"-{output.name}" if output.name else ""
    return f"{stem}{name}{FORMATS[output.format].suffix}"


def _twice(path: Path, first: Job, job: Job, output: OutputSpec) -> Fault:
    if first is not job:
        words = (
            f'would be written to "{path}", as {first.source} would: rename one, or use another folder for it'
        )
        return Fault(words, source=job.source)
    words = f'would be written to "{path}", as an output before it would: give it a name of its own'
    return located(RecipeError([Fault(words, _key_of(job, output))]), job.source, job.recipe.source).faults[0]


def _key_of(job: Job, output: OutputSpec) -> str:
    """Return the key of the table that asks for an output, or nothing where the call does."""
    return next((f"output[{i}]" for i, each in enumerate(job.recipe.output) if each is output), "")


def _check_folder(folder: Path) -> None:
    there = next(each for each in (folder, *folder.parents, Path()) if os.path.lexists(each))
    if not there.is_dir():
        raise ExportError(f"{there} is a file, expected a folder")
    if not os.access(there, os.W_OK | os.X_OK):
        raise ExportError(f"{there} may not be written to")


def _check_place(path: Path, job: Job) -> None:
    if path.is_symlink() or path.is_dir():
        what = "a folder" if path.is_dir() and not path.is_symlink() else "a symbolic link"
        raise ExportError(f"{path} could not be written: it is {what}")
    if job.overrides and path.exists() and os.path.samefile(path, job.source):
        raise ExportError(f"{path} would replace the file it is read from: choose another folder with -o")


@contextmanager
def _on_behalf(job: Job, key: str = "") -> Iterator[None]:
    """Give the errors of the work inside the job's file, and the line of the key at fault."""
    try:
        yield
    except SeamError as error:
        raise SeamError(f"{job.source}: {error}") from error
    except GeometryError as error:
        raise located(RecipeError([Fault(str(error), key)]), job.source, job.recipe.source) from error
    except RecipeError as error:
        raise located(error, job.source, job.recipe.source, job.overrides) from error


def made(job: Job, tell: Callable[[str], None]) -> Artwork:
    """Compile a job's recipe.

    Raises:
        RecipeError: with the file and the lines.
        SeamError: where no clean seam is found.
    """
    with _on_behalf(job):
        return compile_recipe(job.recipe, progress=tell)


def render_output(artwork: Artwork, output: OutputSpec) -> bytes:
    """Return the bytes of a file: the tile repeated or carried beyond its edges as the output asks."""
    across, up = getattr(output, "repeat", (1, 1))
    if (across, up) != (1, 1):
        artwork = repeated(artwork, across, up)
    if getattr(output, "bleed", 0.0):
        artwork = with_bleed(artwork, getattr(output, "bleed", 0.0))
    return render(artwork, output.format, output.options)


def run(job: Job, tell: Callable[[str], None]) -> dict[str, Any]:
    """Compile a job and write its files, all of them or none; return the report."""
    start = time.perf_counter()
    artwork = made(job, tell)
    rendered, reports = [], []
    for path, output in job.files:
        begun = time.perf_counter()
        tell(f"writing {path.name}")
        with _on_behalf(job, _key_of(job, output)):
            data = render_output(artwork, output)
        rendered.append((path, data))
        reports.append(
            {
                "path": str(path),
                "format": output.format,
                "bytes": len(data),
                "size_mm": _page(artwork, output),
                "seconds": round(time.perf_counter() - begun, 3),
            }
        )
    _write(rendered)
    return {
        "recipe": job.source,
        "title": artwork.title,
        "cell_mm": [artwork.cell.width, artwork.cell.height],
        "vertices": artwork.vertex_count,
        "layers": [_layer(layer) for layer in artwork.layers],
        "files": reports,
        "seconds": round(time.perf_counter() - start, 3),
        "warnings": warnings(job.recipe, artwork),
    }


def _write(rendered: Sequence[tuple[Path, bytes]]) -> None:
    try:
        for path, _ in rendered:
            path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(f"{error.filename} could not be made: {error.strerror}") from error
    write_all_whole(rendered)


def _layer(layer: Any) -> dict[str, Any]:
    vertices = sum(int(shapely.get_num_coordinates(marks).sum()) for marks in (layer.areas, layer.lines))
    return {
        "ink": layer.ink.name,
        "colour": layer.ink.colour,
        "areas": len(layer.areas),
        "lines": len(layer.lines),
        "vertices": vertices,
    }


def _page(artwork: Artwork, output: OutputSpec) -> list[float]:
    across, up = getattr(output, "repeat", (1, 1))
    margin = 2 * getattr(output, "bleed", 0.0)
    return [round(artwork.cell.width * across + margin, 3), round(artwork.cell.height * up + margin, 3)]


def warnings(recipe: Recipe, artwork: Artwork) -> list[str]:
    """Return what the recipe names and the artwork does not show."""
    used = {placement.motif for placement in recipe.place}
    drawn = {layer.ink.name for layer in artwork.layers}
    return [f'motif "{name}" is placed nowhere' for name in recipe.motif if name not in used] + [
        f'ink "{name}" draws nothing' for name in recipe.ink if name not in drawn
    ]
