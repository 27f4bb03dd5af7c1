"""Drawings that a recipe names: read from its folder once, or from the recipe that a compiled file carries.

A compiled file carries the recipe as it was written, and behind it the drawings as a last table, each by the
name of its file. So it compiles from itself alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from batik_vector.errors import Fault, RecipeError, shortened
from batik_vector.importing.document import MAX_FILE, Document, DrawingError, parse
from batik_vector.importing.drawing.carried import carried
from batik_vector.importing.drawing.marks import picked
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.beside import Kind, read_beside
from batik_vector.recipe.reading.sources import parted, with_carried
from batik_vector.recipe.references import dotted

SVG_FILE = Kind("an SVG file", ".svg", "bird.svg")


def with_drawings(recipe: Recipe, folder: str | None) -> Recipe:
    """Return a recipe with the drawings of its motifs read, and carried in its source.

    Args:
        recipe: read, its drawings not yet.
        folder: where it stands; None where it stands nowhere.

    Raises:
        RecipeError: with the keys of all that is wrong.
    """
    motifs = {name: motif for name, motif in recipe.motif.items() if isinstance(motif, Svg)}
    files: dict[str, list[str]] = {}
    for name, motif in motifs.items():
        files.setdefault(motif.file, []).append(name)
    faults: list[Fault] = []
    read: dict[str, Svg] = {}
    texts: dict[str, str] = {}
    for file, names in files.items():
        try:
            data, path = _data(recipe, file, folder)
            document = parse(data, file)
        except RecipeError as error:
            faults += [each for name in names for each in _blamed(error, name, file)]
            continue
        found, text = _read({name: motifs[name] for name in names}, document, path, faults)
        read |= found
        texts[file] = text
    if faults:
        raise RecipeError(faults)
    own, before = parted(recipe.source)
    fresh = {file: text for file, text in texts.items() if file not in recipe.drawing}
    source = with_carried(own, {file: text for file, text in before.items() if file in texts} | fresh)
    return replace(recipe, motif=recipe.motif | read, drawing=recipe.drawing | fresh, source=source)


def _read(
    motifs: Mapping[str, Svg], document: Document, path: str, faults: list[Fault]
) -> tuple[dict[str, Svg], str]:
    """Return motifs of one drawing with it read, and the text that carries it; what is wrong joins faults."""
    kept, read = {}, {}
    for name, motif in motifs.items():
        try:
            kept[name] = picked(document, motif.wanted)
        except RecipeError as error:
            faults += _blamed(error, name, motif.file, motif)
    everything = any(each is None for each in kept.values())
    text = carried(document, None if everything else set().union(*(each or () for each in kept.values())))
    for name, elements in kept.items():
        try:
            read[name] = motifs[name].read_from(document, elements, text, path)
        except RecipeError as error:
            faults += _blamed(error, name, motifs[name].file, motifs[name])
    return read, text


def _blamed(error: RecipeError, name: str, file: str, motif: Svg | None = None) -> Iterator[Fault]:
    """Yield the faults of a drawing by the keys of the motif that asks for it."""
    for fault in error.faults:
        place = ":".join(str(part) for part in (fault.source, fault.line) if part not in ("", None))
        words = f"{place}: {fault.message}" if place else fault.message
        if isinstance(error, DrawingError) and not place:
            words = f"{shortened(file)}: {words}"
        key = fault.key or "file"
        what, bracket, _ = key.partition("[")
        if bracket and motif is not None and isinstance(getattr(motif, what, None), str):
            # One name, which stands in no list.
            key = what
        yield Fault(words, f"{dotted(('motif', name))}.{key}")


def _data(recipe: Recipe, file: str, folder: str | None) -> tuple[bytes, str]:
    """Return the bytes of a drawing and where they were read, once and for all."""
    if file in recipe.drawing:
        return recipe.drawing[file].encode("utf-8", "replace"), ""
    return read_beside(file, folder, SVG_FILE, MAX_FILE)
