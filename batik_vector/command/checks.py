"""What ``batik-vector check`` finds out: recipes and drawings are measured, and told of in plain values.

A recipe is compiled and its artwork measured. An SVG is measured as it is drawn, whoever wrote it; where
it carries a recipe of ours, this is compiled too, to learn what was promised: the cell, its drop and its
symmetry, and whether the drawing is still the recipe's. Of a PDF, DXF or PNG the recipe alone is looked at.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import Any

from batik_vector.artwork import Artwork
from batik_vector.audit import Audit, audit
from batik_vector.certificate import Asked, Certificate, Kind, Limits, certify, pointers
from batik_vector.certificate.pointers import COLOUR, NAME, pointer_lines
from batik_vector.command.carried_recipes import Promise, bled, differences, promised, promised_prepared
from batik_vector.command.drawing_files import is_drawing
from batik_vector.compiling.compiler import compile_recipe, described, inspect
from batik_vector.errors import BatikError, ExportError, Fault, GeometryError, RecipeError
from batik_vector.export import render, write_all_whole
from batik_vector.export.provenance import read_provenance
from batik_vector.geometry.paths.matrix import Matrix
from batik_vector.importing.document import load
from batik_vector.importing.overlay import laid_over
from batik_vector.importing.svg import Reading, read_svg
from batik_vector.machines import Machine
from batik_vector.making.facts import warnings
from batik_vector.making.jobs import Job, read_jobs
from batik_vector.making.promised import asked_group
from batik_vector.making.running import made
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.called_processes import read_processes
from batik_vector.recipe.reading.sources import is_compiled, stem_of
from batik_vector.tiling.symmetry.groups import group
from batik_vector.tiling.symmetry.machine_fit import per_cent
from batik_vector.tiling.symmetry.repeats import parse_repeat
from batik_vector.units import STEPS_PER_MM
from batik_vector.values import frozen

Tell = Callable[[str], None]


@frozen
class Wishes:
    """What a call asks of everything that it checks.

    ``repeat`` is how drawings without a recipe stand to one another, ``group`` the symmetry that is asked
    for; both are empty where the call does not say. ``limits`` are those that it gives, by name. ``lenient``
    lets pass what cannot be measured. ``machine`` is what drawings are held to besides, under the name that
    the call gives it.
    """

    repeat: str = ""
    group: str = ""
    limits: Mapping[str, float] = field(default_factory=dict)
    lenient: bool = False
    machine: Machine | None = None
    machine_name: str = ""

    def __post_init__(self) -> None:
        if self.group:
            group(self.group)
        if self.repeat:
            parse_repeat(self.repeat)
        Limits(**self.limits)

    def limits_for(self, foreign: bool) -> Limits:
        """Return the limits for a recipe's artwork, or for a drawing by a stranger."""
        return Limits(**((FOREIGN if foreign else {}) | dict(self.limits)))


FOREIGN = {"position": 0.04, "thin": 0.05}
"""Limits for drawings that no recipe made, where they differ. Files that keep one decimal of a pixel are off
by 0.026 mm at a seam, which does not show on cloth. A hair of ink or of bare cloth does."""

SAMPLED_MM = 0.02
"""How far (mm) the polylines of a stranger may stand from true curves: as far as ours do, unless asked."""


@frozen(eq=False)
class Found:
    """What was measured of one source; ``onto`` as in :class:`Reading`, of a drawing without a recipe.

    ``pattern`` is what a machine is asked of, where that is not what is drawn.
    """

    source: str
    artwork: Artwork
    certificate: Certificate
    facts: dict[str, Any]
    onto: Matrix | None = None
    audit: Audit | None = None
    pattern: Artwork | None = None

    @property
    def passed(self) -> bool:
        """Whether nothing is wrong."""
        return bool(self.facts["passed"])


def check_source(source: str, overrides: Sequence[str], wishes: Wishes, tell: Tell = lambda _: None) -> Found:
    """Measure a recipe or a drawing.

    Raises:
        RecipeError: where it cannot be read, or the call asks of it what it cannot give.
        SeamError: where a recipe has no clean seam.
    """
    if is_drawing(source):
        if overrides:
            words = f"is measured as it is drawn, which --set {overrides[0]} cannot change: give its recipe"
            raise _fault(source, words)
        return _audited(_check_drawing(source, wishes, tell), wishes, tell)
    return _check_recipe(source, overrides, wishes, tell)


def _fault(source: str, words: str) -> RecipeError:
    return RecipeError([Fault(words, source=source)])


def _check_recipe(source: str, overrides: Sequence[str], wishes: Wishes, tell: Tell) -> Found:
    try:
        (job,) = read_jobs([source], overrides)
    except RecipeError as error:
        if is_compiled(source) and any("no recipe" in str(f) for f in error.faults):
            raise _fault(source, "carries no recipe, and only an SVG can be checked without one") from error
        raise
    artwork = made(job, tell)
    tell("measuring")
    certificate = _certified(source, artwork, wishes, asked_group(job.recipe))
    facts = inspect(artwork)
    notes = _left_aside(wishes)
    if is_compiled(source):
        notes.append("the recipe that it carries was checked, not what the file draws")
    found = _found(job, artwork, certificate, facts, checked="recipe", notes=notes)
    return _audited(found, wishes, tell, _cloth_of(job.recipe, artwork, wishes))


def _audited(found: Found, wishes: Wishes, tell: Tell, page: tuple[float, float] | None = None) -> Found:
    """Hold what was measured to a machine, if the call names one."""
    if wishes.machine is None:
        return found
    tell("auditing")
    told = audit(found.pattern or found.artwork, wishes.machine, name=wishes.machine_name, page=page)
    facts = found.facts | {"audit": told.as_dict(), "passed": found.facts["passed"] and told.passed}
    return replace(found, facts=facts, audit=told)


def _cloth_of(recipe: Recipe, tile: Artwork, wishes: Wishes) -> tuple[float, float] | None:
    """Return the size (mm) of the cloth that a machine makes of a recipe; None where it makes the tile."""
    if recipe.yardage is None or wishes.machine is None or wishes.machine.limits.repeats:
        return None
    width, length = recipe.yardage.size(tile.cell)
    return width / STEPS_PER_MM, length / STEPS_PER_MM


def _check_drawing(source: str, wishes: Wishes, tell: Tell) -> Found:
    tell(f"reading {Path(source).name}")
    reading = read_svg(source, wishes.repeat or "grid")
    notes = list(reading.notes)
    recipe = _recipe_of(source, notes) if reading.ours else None
    if recipe is None:
        tell("measuring")
        return _drawing_found(source, reading, _foreign(source, reading, wishes), notes=notes)
    notes += _left_aside(wishes)
    if recipe.tile is None:
        raise _fault(source, "shows borders alone, and no tile that could be certified")
    processes = read_provenance(source).processes
    if processes:
        return _check_prepared(source, reading, recipe, processes, wishes, tell)
    try:
        tile = compile_recipe(recipe, progress=tell)
        promise, kept = promised(recipe, tile, reading)
    except BatikError as error:
        notes.append(f"its recipe does not compile, and was left aside: {error}")
        return _drawing_found(source, reading, _foreign(source, reading, wishes), notes=notes)
    tell("measuring")
    reading, promise = _as_promised(source, reading, promise)
    if promise.broken and recipe.yardage is not None:
        raise _fault(source, "shows the cloth, and not the tile that fills it: check its recipe instead")
    if not kept:
        notes.append("shows the tile within a printer's marks: the tile that it was made of was measured")
    certificate = _certified(source, reading.artwork if kept else tile, wishes, asked_group(recipe))
    return _drawing_found(source, reading, certificate, promise, notes, itself=kept)


def _check_prepared(
    source: str, reading: Reading, recipe: Recipe, processes: Sequence[str], wishes: Wishes, tell: Tell
) -> Found:
    """Measure a drawing that went through processes, and compare it with its recipe gone through the same."""
    tile = compile_recipe(recipe, progress=tell)
    tell("measuring")
    specs = read_processes(processes)
    promise, kept = promised_prepared(recipe, tile, reading, specs)
    reading, promise = _as_promised(source, reading, promise)
    asked = asked_group(recipe)
    notes = [*reading.notes, *_left_aside(wishes), f"went through {', then '.join(processes)}"]
    if not kept:
        notes[-1] += ": the tile that it was made of was measured"
    elif asked is not None and (free := [each.kind for each in specs if not each.keeps_group]):
        notes.append(f"{asked.name} is not kept by {' and '.join(free)}, and is not asked of it any more")
        asked = None
    certificate = _certified(source, reading.artwork if kept else tile, wishes, asked)
    found = _drawing_found(source, reading, certificate, promise, notes, itself=kept)
    # Overcuts, pre-cuts and tabs are open and drawn again on purpose: a machine is asked of the pattern.
    return found if kept else replace(found, pattern=tile)


def _as_promised(source: str, reading: Reading, promise: Promise) -> tuple[Reading, Promise]:
    """Read a drawing once more, with the drop and the bleed that its recipe knows of."""
    larger = bled(promise, reading.page) if promise.broken else None
    if larger is not None:
        again = read_svg(source, larger.repeat, bleed=larger.artwork.bleed)
        artwork = larger.known(again)
        if not differences(artwork, larger.artwork):
            return replace(again, artwork=artwork), larger
    if promise.repeat != "grid" or reading.curved:
        # Curves are true to the recipe's tolerance and no more: read finer, their joints would be kinks.
        fine = promise.artwork.tolerance if reading.curved else reading.artwork.tolerance
        reading = read_svg(source, promise.repeat, fine)
    return replace(reading, artwork=promise.known(reading)), promise


def _left_aside(wishes: Wishes) -> list[str]:
    return ["its recipe says how it repeats, and --repeat is left aside"] if wishes.repeat else []


def _recipe_of(source: str, notes: list[str]) -> Recipe | None:
    """Return the recipe that a drawing carries, if this program can read it."""
    try:
        text = read_provenance(source).recipe
        return read_recipe(text, f"the recipe in {source}") if text else None
    except RecipeError as error:
        notes.append(f"its recipe cannot be read, and was left aside: {error.faults[0].message}")
        return None


def _certified(source: str, artwork: Artwork, wishes: Wishes, asked: Asked | None) -> Certificate:
    if wishes.group:
        asked = Asked(wishes.group, stretch=asked.stretch if asked else 0.0)
    try:
        return certify(artwork, asked=asked, limits=wishes.limits_for(foreign=False))
    except GeometryError as error:
        raise _fault(source, str(error)) from error


def _foreign(source: str, reading: Reading, wishes: Wishes) -> Certificate:
    """Measure a drawing that no recipe of ours made."""
    asked = Asked(wishes.group) if wishes.group else None
    open_ = () if wishes.lenient else reading.unmeasured
    # Of polylines nobody knows how closely they follow the curves that they were made from.
    tolerance = reading.artwork.tolerance if reading.curved else max(reading.artwork.tolerance, SAMPLED_MM)
    try:
        return certify(
            replace(reading.artwork, tolerance=tolerance),
            asked=asked,
            limits=wishes.limits_for(foreign=True),
            bodies=reading.bodies,
            unmeasured=open_,
            remarked=() if "double" in wishes.limits else (Kind.DOUBLE,),
        )
    except GeometryError as error:
        raise _fault(source, str(error)) from error


def _drawing_found(
    source: str,
    reading: Reading,
    certificate: Certificate,
    promise: Promise | None = None,
    notes: Sequence[str] = (),
    itself: bool = True,
) -> Found:
    """Return what was found of a drawing; ``itself``: it was measured, and not the tile behind it."""
    artwork = reading.artwork
    broken = list(promise.broken) if promise else []
    apart = differences(artwork, promise.artwork) if promise and not broken else []
    if apart and not itself:
        broken.append("what it draws is not what its recipe makes, and only the recipe's tile was measured")
    # The normal form and equal bits on the seam are for what this program compiles.
    facts = {**described(artwork), "violations": [], "seam": []}
    for told, layer in zip(facts["layers"], artwork.layers, strict=True):
        told["covers"] = round(certificate.covers.get(layer.ink.name, 0.0), 6)
    facts["page_mm"] = [round(side, 6) for side in reading.page]
    facts["broken"], facts["differences"] = broken, apart
    recipe = promise.recipe if promise else None
    found = _found(source, artwork, certificate, facts, checked="geometry", notes=notes, recipe=recipe)
    return found if promise else replace(found, onto=reading.onto)


def _found(
    origin: Job | str,
    artwork: Artwork,
    certificate: Certificate,
    facts: dict[str, Any],
    *,
    checked: str,
    notes: Sequence[str] = (),
    recipe: Recipe | None = None,
) -> Found:
    """Bring together what is told of a source."""
    source = origin if isinstance(origin, str) else origin.source
    recipe = recipe if isinstance(origin, str) else origin.recipe
    told = {"recipe": source, "checked": checked, **facts}
    told["warnings"] = [] if isinstance(origin, str) else warnings(origin.recipe, artwork)
    told["notes"] = [*notes, *(_recipe_notes(recipe) if recipe else [])]
    told.setdefault("broken", [])
    told.setdefault("differences", [])
    told["certificate"] = certificate.as_dict()
    wrong = told["violations"] or told["seam"] or told["broken"] or not certificate.passed
    told["passed"] = not (wrong or certificate.unmeasured)
    return Found(source, artwork, certificate, told)


def _recipe_notes(recipe: Recipe) -> list[str]:
    across, along = recipe.tiling.stretch
    notes = []
    if (across, along) != (1.0, 1.0):
        notes.append(f"stretched to fit: {per_cent(across)} across, {per_cent(along)} along the cloth")
    if recipe.yardage is not None:
        notes.append("the tile was measured, not the cloth that is filled from it")
    return notes


def pointer_files(sources: Sequence[str], folder: Path) -> dict[str, Path]:
    """Return where the pictures of faults of each source go.

    Raises:
        RecipeError: where two of them would have the same name.
        ExportError: where there can be no such folder.
    """
    there = next(each for each in (folder, *folder.parents, Path()) if each.exists())
    if not there.is_dir():
        raise ExportError(f"{there} is a file, expected a folder")
    places: dict[str, Path] = {}
    given = {os.path.realpath(source) for source in sources}
    for source in sources:
        place = folder / f"{stem_of(source)}-check.svg"
        if os.path.realpath(place) in given:
            raise _fault(source, f'its faults would be shown in "{place}", which is to be checked itself')
        if place in places.values():
            raise _fault(
                source, f'its faults would be shown in "{place}", as another\'s would: check it alone'
            )
        places[source] = place
    return places


MOST_POINTED = 12
"""Findings of one kind and ink, the worst ones, that are pointed at: more would hide the drawing."""


def _places(found: Found) -> list[tuple[float, float]]:
    """Return the places of the worst findings of an audit."""
    if found.audit is None:
        return []
    return [each.where for group in found.audit.groups for each in group.findings[:MOST_POINTED]]


def _pointed_at(found: Found) -> bytes:
    """Return a drawing with marks at its faults: the file itself, as far as it can be left as it is."""
    also = _places(found)
    if found.onto is not None:
        lines, breadth = pointer_lines(found.artwork.cell, found.certificate, also)
        shown = laid_over(load(found.source)[0], found.onto, lines, breadth, COLOUR, NAME)
        if shown is not None:
            return shown
    return render(pointers(found.artwork, found.certificate, also), "svg", check=False)


def write_pointers(found: Sequence[Found], places: dict[str, Path]) -> list[Path]:
    """Write, all or none, a drawing for each source that has faults, with a mark at each of them.

    Returns:
        The files.

    Raises:
        ExportError: where they cannot be written.
    """
    files = []
    for each in found:
        if each.certificate.faults or each.certificate.remarks or _places(each):
            files.append((places[each.source], _pointed_at(each)))
    try:
        for path, _ in files:
            path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ExportError(f"{error.filename} could not be made: {error.strerror}") from error
    write_all_whole(files)
    return [path for path, _ in files]
