"""Sweeps: many variants of one recipe, each to files of its own, on all cores and taken up again where left.

A manifest beside the files says what has been made, a line for each variant as it is done; a variant stands
there with a key made of everything that its files hang on. So a sweep that was killed goes on where it
stopped, and one that is asked for again makes nothing twice.
"""

from __future__ import annotations

import hashlib
import json
import os
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from batik_vector._version import __version__
from batik_vector.artwork import Artwork, Page
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.errors import BatikError, Fault, RecipeError, shortened
from batik_vector.export.files import write_all_whole
from batik_vector.fields import installed
from batik_vector.making.destinations import check_folder, into_folders, make_folder
from batik_vector.making.jobs import Job, planned
from batik_vector.making.manifest import Made, Manifest, digest_of, picture_in
from batik_vector.making.pages import drawings_of
from batik_vector.making.pool import Outcome, outcomes
from batik_vector.making.running import run
from batik_vector.making.thumbnails import Thumbnail, thumbnail
from batik_vector.making.variants import Variant, parse_axis, variants
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.overrides import meant_by, parse_override
from batik_vector.recipe.reading.sources import read_text, stem_of
from batik_vector.values import frozen


@frozen
class Making:
    """What makes the files of a variant: called in a worker, with nothing but plain values.

    Args:
        source: what the recipe is called in faults.
        text: the recipe, read once, so that all variants are of one state of it.
        recipe_folder, folder: where the drawings stand that it names, and where files go.
        overrides: set in all variants.
        formats: as for :func:`~batik_vector.making.jobs.planned`.
        pictures: whether a picture of each is wanted.
    """

    source: str
    text: str
    recipe_folder: str | None
    folder: str
    overrides: tuple[str, ...] = ()
    formats: tuple[str, ...] = ()
    pictures: bool = False

    def __call__(self, variant: Variant) -> Made:
        """Make the files of a variant, all of them or none.

        Raises:
            BatikError: where the variant is none that can be made.
        """
        pictures: list[Thumbnail] = []

        def look(page: Page) -> None:
            if self.pictures and not pictures:
                pictures.append(thumbnail(page))

        with _varied(variant.changes):
            job = self._job(variant)
            # Going on with a sweep compares files with digests: what a failing system took is made again.
            report = run(job, lambda stage: None, look, partial(into_folders, forced=False))
        files = tuple((path.name, digest_of(path)) for path, _ in job.files)
        return Made(variant, files, report, pictures[0] if pictures else None)

    def base(self) -> Recipe:
        """Return the recipe without what is varied.

        Raises:
            RecipeError: where it is wrong.
        """
        return read_recipe(self.text, self.source, self.overrides, self.recipe_folder)

    def recipe(self, variant: Variant) -> Recipe:
        """Return the recipe of a variant.

        Raises:
            RecipeError: where it is wrong.
        """
        with _varied(variant.changes):
            changes = (*self.overrides, *variant.changes)
            return read_recipe(self.text, self.source, changes, self.recipe_folder)

    def _job(self, variant: Variant) -> Job:
        changes = (*self.overrides, *variant.changes)
        job = Job(self.source, self.recipe(variant), changes, stem=variant.name)
        return planned([job], Path(self.folder), self.formats)[0]

    def key(self, variant: Variant, drawings: str = "") -> str:
        """Return what the files of a variant hang on, as a digest."""
        told = json.dumps(
            [
                " with ".join([__version__, *installed()]),
                self.text,
                drawings,
                self.overrides,
                self.formats,
                variant.name,
                variant.changes,
            ]
        )
        return hashlib.sha256(told.encode()).hexdigest()[:32]


ASKED = "--vary"


@contextmanager
def _varied(changes: Sequence[str]) -> Iterator[None]:
    """Say of faults in what is varied that it was varied, and not set in all variants."""
    try:
        yield
    except RecipeError as error:
        set_by = {parse_override(each).source: f"{ASKED} {shortened(each)}" for each in changes}
        raise RecipeError(
            [replace(each, source=set_by.get(each.source, each.source)) for each in error.faults]
        ) from error


@frozen
class Sent:
    """A variant made elsewhere, with the bytes of its files."""

    made: Made
    files: tuple[tuple[str, bytes], ...]


@frozen
class Elsewhere:
    """What makes a variant on another machine, where neither recipe nor drawings lie."""

    making: Making

    def __call__(self, variant: Variant) -> Sent:
        """Make a variant's files in a folder that goes again, and return their bytes."""
        with TemporaryDirectory(prefix="batik-vector-") as folder:
            made = replace(self.making, folder=folder)(variant)
            return Sent(made, tuple((name, (Path(folder) / name).read_bytes()) for name, _ in made.files))


def _written(making: Making, sent: Sent) -> Made:
    """Write the files of a variant that came back, all of them or none."""
    write_all_whole([(Path(making.folder) / name, data) for name, data in sent.files])
    return sent.made


@frozen
class Sweep:
    """A sweep that is planned: its variants, what makes them, and the manifest beside their files."""

    making: Making
    variants: tuple[Variant, ...]
    title: str = ""
    drawings: str = ""

    @property
    def manifest(self) -> Path:
        """Where it is noted what has been made."""
        return Path(self.making.folder) / f"{stem_of(self.making.source)}-sweep.jsonl"

    def run(self, workers: int = 1, scheduler: str = "") -> Iterator[Outcome[Variant, Made]]:
        """Make what is not there yet; yield each variant as it is done, those that were there first.

        Args:
            workers: processes on this machine.
            scheduler: the address of a Dask scheduler, whose workers do it instead.

        Raises:
            ExportError: where the manifest cannot be written, or the cluster cannot be used.
        """
        manifest = Manifest(self.manifest)
        keys = [self.making.key(variant, self.drawings) for variant in self.variants]
        todo = []
        for variant, key in zip(self.variants, keys, strict=True):
            found = manifest.made(variant, key, self.making.pictures)
            if found is None:
                todo.append(variant)
            else:
                yield Outcome(variant, found)
        for outcome in self._outcomes(todo, workers, scheduler):
            if outcome.result is not None:
                manifest.add(outcome.result, keys[outcome.task.number])
            yield outcome
        manifest.settle(keys)

    def _outcomes(
        self, todo: Sequence[Variant], workers: int, scheduler: str
    ) -> Iterator[Outcome[Variant, Made]]:
        if not todo:
            return
        if not scheduler:
            make_folder(self.manifest.parent)
            yield from outcomes(self.making, todo, min(workers, len(todo)))
            return
        from batik_vector.making.cluster import outcomes_on

        # There the recipe carries the drawings that it names, for its folder is here.
        recipe = read_recipe(self.making.text, self.making.source, folder=self.making.recipe_folder)
        elsewhere = Elsewhere(replace(self.making, text=recipe.source, recipe_folder=None))
        for outcome in outcomes_on(scheduler, elsewhere, todo):
            # Not before a cluster has answered: a wrong address leaves no folder behind.
            make_folder(self.manifest.parent)
            sent = outcome.result
            made = None if sent is None else _written(self.making, sent)
            yield Outcome(outcome.task, made, outcome.failure)

    def pictures(self) -> Iterator[tuple[Variant, Thumbnail | None]]:
        """Yield all variants with their pictures, once they are made; None for those that could not be."""
        manifest = Manifest(self.manifest)
        for variant in self.variants:
            line = manifest.line(self.making.key(variant, self.drawings))
            yield variant, None if line is None else picture_in(line)


def planned_sweep(making: Making, variants: Sequence[Variant]) -> Sweep:
    """Return a sweep whose recipe has been read, and whose keys lead somewhere.

    Raises:
        RecipeError: where the recipe is wrong, or the first variant or the last.
        ExportError: where the folder cannot be written to.
    """
    check_folder(Path(making.folder))
    recipe = making.base()
    _refuse_twice(making, variants[0])
    ends = dict.fromkeys((variants[0], variants[-1]))
    faults = [fault for variant in ends for fault in _faults(making, variant)]
    if faults:
        raise RecipeError(_told_once(faults))
    drawings = json.dumps([(name, each.text) for name, each in drawings_of(recipe)])
    return Sweep(making, tuple(variants), recipe.title, hashlib.sha256(drawings.encode()).hexdigest())


def _refuse_twice(making: Making, variant: Variant) -> None:
    """Raise where two keys that are varied are one, spelt in two ways, or lead nowhere."""
    text = making.base().source
    keys = list(dict.fromkeys(change.partition("=")[0].strip() for change in variant.changes))
    first: dict[tuple[Any, ...], str] = {}
    for key, paths in zip(keys, meant_by(tomllib.loads(text), keys, ASKED), strict=True):
        for path in paths:
            if path in first:
                words = f"is varied twice, as {first[path]} too"
                raise RecipeError([Fault(words, source=f"{ASKED} {shortened(key)}")])
            first[path] = key


def _told_once(faults: Sequence[Fault]) -> list[Fault]:
    """Return faults without repeats; what is wrong with a key, whatever its value, is told of the key."""
    found: dict[tuple[str, str], Fault] = {}
    for each in faults:
        what = each.key, each.message
        if what in found and found[what] != each and each.source.startswith(ASKED):
            each = replace(each, source=each.source.partition("=")[0])
        found[what] = each
    return list(found.values())


def _faults(making: Making, variant: Variant) -> Sequence[Any]:
    try:
        making.recipe(variant)
    except RecipeError as error:
        return error.faults
    return ()


@frozen
class Variation:
    """A variant in Python: what was set, the recipe and its tile, or the error where there is none."""

    name: str
    changes: tuple[str, ...]
    recipe: Recipe | None
    artwork: Artwork | None
    error: BatikError | None = None


def sweep(
    recipe: str | os.PathLike[str] | Recipe,
    vary: Mapping[str, str | Sequence[Any]],
    *,
    sample: int = 0,
    seed: int = 0,
) -> Iterator[Variation]:
    """Yield the variants of a recipe as they are compiled, every combination or a sample of them.

    Args:
        recipe: its file, or a recipe that was read from text.
        vary: values for each key, as a list or as the command takes them: ``{"pistil.count": [8, 16],
            "petal.length": "0.6:1.2:5"}``.
        sample: how many; 0 takes all combinations.
        seed: which sample.

    Raises:
        RecipeError: where the recipe or what is varied is wrong; a single variant yields its error instead.
    """
    if isinstance(recipe, Recipe):
        text, source, folder = recipe.source, "recipe", None
        if not text:
            raise RecipeError("this recipe was made in Python: expected one that was read from text")
    else:
        source = os.fspath(recipe)
        text, folder = read_text(source), os.path.dirname(source) or "."
        read_recipe(text, source, folder=folder)
    axes = [parse_axis(f"{key}={_as_written(values)}") for key, values in vary.items()]
    found = variants(axes, stem_of(source), sample=sample, seed=seed)
    return _compiled(found, text, source, folder)


def _as_written(values: str | Sequence[Any]) -> str:
    if isinstance(values, str):
        return values
    import tomlkit

    return ",".join(tomlkit.item(value).as_string() for value in values)


def _compiled(found: Iterator[Variant], text: str, source: str, folder: str | None) -> Iterator[Variation]:
    for variant in found:
        made: Recipe | None = None
        try:
            made = read_recipe(text, source, variant.changes, folder)
            yield Variation(variant.name, variant.changes, made, compile_recipe(made))
        except BatikError as error:
            yield Variation(variant.name, variant.changes, made, None, error)
