"""What a call asks for: which recipes are read, and which files each of them makes."""

from __future__ import annotations

import glob
import os
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from batik_vector.errors import (
    ExportError,
    Fault,
    MissingLibraryError,
    RecipeError,
)
from batik_vector.export import FORMATS
from batik_vector.fields import brought_by
from batik_vector.machines.profile import LANGUAGES
from batik_vector.making.destinations import check_folder
from batik_vector.making.pages import (
    drawings_of,
    piece_of,
)
from batik_vector.recipe.loading import load_recipe, located, read_recipe
from batik_vector.recipe.model import OutputSpec, Recipe
from batik_vector.recipe.outputs import OUTPUTS, Piece
from batik_vector.recipe.reading.sources import STDIN, is_compiled, read_stdin, stem_of
from batik_vector.values import frozen

if TYPE_CHECKING:
    pass


@frozen
class Job:
    """A recipe that has been read, and the files to make of it, called after its source or a stem."""

    source: str
    recipe: Recipe
    overrides: tuple[str, ...] = ()
    files: tuple[tuple[Path, OutputSpec], ...] = ()
    stem: str = ""


def read_jobs(sources: Sequence[str], overrides: Sequence[str] = ()) -> list[Job]:
    """Read recipes; ``-`` stands for what standard input holds.

    Raises:
        RecipeError: with everything that is wrong in any of them.
    """
    jobs: list[Job] = []
    faults: list[Fault] = []
    if list(sources).count(STDIN) > 1:
        raise RecipeError([Fault("is named twice, and can be read once", source=STDIN)])
    for source in sources:
        try:
            if source == STDIN:
                text = read_stdin()
                recipe = read_recipe(text, "stdin", overrides, folder=".")
                jobs.append(Job("stdin", recipe, tuple(overrides), stem="recipe"))
            else:
                jobs.append(Job(source, load_recipe(source, overrides), tuple(overrides)))
        except RecipeError as error:
            faults += error.faults
    if faults:
        raise RecipeError(faults)
    return jobs


def matching(sources: Sequence[str]) -> list[str]:
    """Return sources with the files that a pattern such as ``"samples/*.toml"`` stands for, in order.

    Shells do that themselves, but for the one of Windows, and for what stands in quotes.
    """
    found: list[str] = []
    for source in sources:
        pattern = any(sign in source for sign in "*?") and not os.path.lexists(source)
        found += sorted(glob.glob(source)) or [source] if pattern else [source]
    return found


def planned(
    jobs: Sequence[Job],
    folder: Path | None,
    formats: Sequence[str] = (),
    called: Mapping[str, Any] | None = None,
) -> list[Job]:
    """Return jobs with the files each of them makes.

    Args:
        jobs: as read.
        folder: where all files go; None where they are kept in none.
        formats: which formats are made; when left out those that the recipe asks for, or else SVG.
        called: keys of outputs that the call sets for all of them.

    Raises:
        RecipeError: where two files would have the same name, or an output asks for what the recipe has not.
        ExportError: where a file cannot be written.
    """
    if folder is not None:
        check_folder(folder)
    plans: list[Job] = []
    faults: list[Fault] = []
    taken: dict[str, Job] = {}
    unused = set(called or ())
    drawings = {each.path for job in jobs for _, each in drawings_of(job.recipe)}
    for job in jobs:
        files = []
        for key, asked in _outputs(job.recipe, formats):
            output = _called(asked, called or {}, unused)
            if fault := unmet(job, output, key):
                faults.append(fault)
                continue
            path = (folder or Path()) / _file_name(job, output)
            place = os.path.normcase(path)
            if place in taken:
                faults.append(_twice(path, taken[place], job, key))
                continue
            taken[place] = job
            if folder is not None:
                _check_place(path, job, drawings)
            files.append((path, output))
        if plugins := brought_by([job.recipe, *(output for _, output in files)]):
            job = replace(job, recipe=replace(job.recipe, plugins=plugins))
        plans.append(replace(job, files=tuple(files)))
    if jobs and not faults:
        faults = [Fault(f"--{key}: no file that is made has it") for key in sorted(unused)]
    if faults:
        raise RecipeError(faults)
    return plans


def _called(output: OutputSpec, called: Mapping[str, Any], unused: set[str]) -> OutputSpec:
    """Return an output with those keys that the call sets and it has; they are ``unused`` no more."""
    own = {each.name for each in fields(output)}
    known = {key: value for key, value in called.items() if key in own}
    unused.difference_update(known)
    return replace(output, **known) if known else output


def ready(jobs: Sequence[Job]) -> tuple[list[Job], list[MissingLibraryError]]:
    """Return jobs without the files that this system cannot make, and what it lacks, each told once."""
    lacking: dict[str, MissingLibraryError] = {}
    for name in dict.fromkeys(output.format for job in jobs for _, output in job.files):
        try:
            FORMATS[name].check_ready()
        except MissingLibraryError as error:
            lacking[name] = error
    left = [
        replace(job, files=tuple(each for each in job.files if each[1].format not in lacking)) for job in jobs
    ]
    return [job for job in left if job.files], list(lacking.values())


def _outputs(recipe: Recipe, formats: Sequence[str]) -> Iterator[tuple[str, OutputSpec]]:
    """Yield the outputs to make, each with the key of its table, or nothing where the call asks for it."""
    own = [(f"output[{i}]", each) for i, each in enumerate(recipe.output)]
    if not formats:
        yield from own or [("", OUTPUTS["svg"]())]
    for name in dict.fromkeys(formats):
        yield from [(key, each) for key, each in own if each.format == name] or [("", OUTPUTS[name]())]


def unmet(job: Job, output: OutputSpec, where: str) -> Fault | None:
    """Return what is wrong with an output that asks for what its recipe or its machine does not have."""
    recipe, piece = job.recipe, piece_of(job.recipe, output)
    spoken = output.machine_profile.languages if output.machine_profile else ()
    if piece == Piece.YARDAGE and recipe.yardage is None:
        key, words = "piece", 'asks for the yardage, and the recipe has none: expected a table "yardage"'
    elif piece == Piece.TILE and recipe.tile is None:
        key, words = "piece", "asks for the tile, and the recipe has borders alone: expected the yardage"
    elif piece == Piece.YARDAGE and getattr(output, "repeat", (1, 1)) != (1, 1):
        key, words = "repeat", 'repeats the tile, and the file shows the yardage: expected piece = "tile"'
    elif piece == Piece.YARDAGE and bool(getattr(output, "bleed", 0)):
        key, words = "bleed", 'is the tile\'s: expected yardage.bleed, or piece = "tile"'
    elif spoken and output.format in LANGUAGES and output.format not in spoken:
        key = "machine"
        words = (
            f'"{output.machine}" takes {" and ".join(spoken)}: expected another machine for {output.format}'
        )
    else:
        return None
    fault = Fault(words, f"{where}.{key}" if where else key)
    return located(RecipeError([fault]), job.source, recipe.source).faults[0]


def _file_name(job: Job, output: OutputSpec) -> str:
    stem = job.stem or stem_of(job.source)
    if not job.stem and is_compiled(job.source):
        # A compiled file is called after its recipe and its output: kawung-print.pdf, kawung-swatch.svg.
        stem = stem.removesuffix(Path(FORMATS["swatch"].suffix).stem)
        endings = sorted((_ending(job.recipe, each) for each in job.recipe.output), key=len)
        stem = stem.removesuffix(next((end for end in reversed(endings) if stem.endswith(end)), ""))
    return f"{stem}{_ending(job.recipe, output)}{FORMATS[output.format].suffix}"


def _ending(recipe: Recipe, output: OutputSpec) -> str:
    """Return what the name of an output's file has behind its recipe's: beside a cloth, the tile says so."""
    beside = recipe.yardage is not None and piece_of(recipe, output) == Piece.TILE
    name = f"-{output.name}" if output.name else ""
    return f"-tile{name}" if beside else name


def _twice(path: Path, first: Job, job: Job, key: str) -> Fault:
    if first is not job:
        words = (
            f'would be written to "{path}", as {first.source} would: rename one, or use another folder for it'
        )
        return Fault(words, source=job.source)
    words = f'would be written to "{path}", as an output before it would: give it a name of its own'
    return located(RecipeError([Fault(words, key)]), job.source, job.recipe.source).faults[0]


def _check_place(path: Path, job: Job, drawings: Container[str]) -> None:
    if os.path.realpath(path) in drawings:
        raise ExportError(f"{path} would replace the drawing that it is made of: choose a folder with -o")
    if path.is_symlink() or path.is_dir():
        what = "a folder" if path.is_dir() and not path.is_symlink() else "a symbolic link"
        raise ExportError(f"{path} could not be written: it is {what}")
    if job.overrides and path.exists() and os.path.exists(job.source) and path.samefile(job.source):
        raise ExportError(f"{path} would replace the file it is read from: choose another folder with -o")
