"""What the elements of a drawing are called, and which of them are picked by name.

An element goes by its id and by the label that Inkscape, Affinity or Illustrator keep beside it; what lies in
a group is picked by the group's names too.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Sequence

from batik_vector.errors import Fault, RecipeError, nearest, shortened
from batik_vector.importing.document import INKSCAPE, MAX_DEPTH, SERIF, Document, children, local, reference
from batik_vector.importing.elements import PASSED
from batik_vector.importing.layer_names import decoded, layer_of
from batik_vector.values import frozen

MOST_NAMES = 12
"""Names that a message lists where none is near."""
MOST_MARKS = 30_000
"""Marks of a drawing; a walk takes some ten seconds for as many."""
_OWN = re.compile(r"(?:path|g|rect|circle|ellipse|layer|use|svg|polygon|polyline|line)[-_]?\d*+")
"""Names that programs give where nobody else did."""


@frozen
class Called:
    """How a mark is called: its names and those of all groups round it, innermost first, and its layers."""

    names: tuple[str, ...]
    layers: tuple[str, ...] = ()

    def meant(self, elements: Sequence[str], layers: Sequence[str]) -> bool:
        """Whether names with ``*`` for anything mean it; no names at all mean everything."""
        return (not elements or any(is_like(each, self.names) for each in elements)) and (
            not layers or any(is_like(each, self.layers) for each in layers)
        )


def is_like(pattern: str, names: Iterable[str]) -> bool:
    """Whether any of several names is one in which ``*`` may stand for anything."""
    first, *rest = pattern.split("*")
    return any(_fits(first, rest, name) for name in names)


def _fits(first: str, rest: Sequence[str], name: str) -> bool:
    if not rest:
        return name == first
    *middle, last = rest
    if not name.startswith(first):
        return False
    at = len(first)
    for part in middle:
        found = name.find(part, at)
        if found < 0:
            return False
        at = found + len(part)
    return len(name) - len(last) >= at and name.endswith(last)


def names_of(element: ET.Element) -> tuple[str, ...]:
    """Return what an element is called, the name that people gave it first."""
    written = element.get("id", "")
    kept = (
        element.get(f"{{{INKSCAPE}}}label"),
        element.get(f"{{{SERIF}}}id"),
        element.get("data-name"),
        decoded(written),
        written,
    )
    return tuple(dict.fromkeys(name for each in kept if each and (name := " ".join(each.split()))))


def called(trail: Sequence[ET.Element]) -> Called:
    """Return how the last element of a trail is called, which leads to it from the root."""
    names: dict[str, None] = {}
    for element in reversed(trail[1:]):
        names.update(dict.fromkeys(names_of(element)))
    layers = {layer_of(element, "", at == 0): None for at, element in enumerate(trail[1:-1])}
    return Called(tuple(names), tuple(each for each in layers if each))


def own_name(trail: Sequence[ET.Element]) -> str:
    """Return the name that a mark shows: its own, or the nearest that is no program's mere number."""
    first, inward = "", list(trail[1:])
    # A use stands for what it shows.
    for at, element in enumerate(inward):
        if local(element) == "use":
            inward = [*inward[:at], *inward[at + 1 :], element]
            break
    for element in reversed(inward):
        for name in names_of(element)[:1]:
            if not _OWN.fullmatch(name):
                return name
            first = first or name
    return first


def refuse_too_many(document: Document) -> None:
    """Raise where a drawing has too many marks for a motif, once every use is followed, or is too deep."""
    known: dict[ET.Element, int] = {}

    def marks(element: ET.Element, depth: int) -> int:
        if depth > MAX_DEPTH:
            raise document.fault(f"nested deeper than {MAX_DEPTH} elements", element)
        if element not in known:
            # What leads back to itself draws nothing, and is refused where it is drawn.
            known[element] = 0
            within = [child for child in children(element) if local(child) not in PASSED]
            if local(element) == "use":
                found = document.by_id.get(reference(element)[1:])
                within = [] if found is None else [found]
            known[element] = sum(marks(child, depth + 1) for child in within) or 1
        return known[element]

    total = sum(marks(child, 1) for child in children(document.root) if local(child) not in PASSED)
    if total > MOST_MARKS:
        raise document.fault(
            f"{total:,} marks, once every use in it is followed, expected at most {MOST_MARKS:,} in a motif"
        )


class Named:
    """The painted elements of a document, each with how it is called."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.trails: list[tuple[ET.Element, ...]] = []
        for child in children(document.root):
            if local(child) not in PASSED:
                self._visit(child, (document.root,))

    def _visit(self, element: ET.Element, trail: tuple[ET.Element, ...]) -> None:
        """Note the trail of an element that is painted, or those of all that lie in it or behind it."""
        trail = (*trail, element)
        within = [child for child in children(element) if local(child) not in PASSED]
        if local(element) == "use":
            target = reference(element)
            found = self.document.by_id.get(target[1:]) if target.startswith("#") else None
            within = [] if found is None or found in trail else [found]
        for child in within:
            self._visit(child, trail)
        if not within or local(element) == "text":
            self.trails.append(trail)

    def picked(self, elements: Sequence[str], layers: Sequence[str]) -> set[ET.Element]:
        """Return the elements that lead to what is picked, all round it and behind a use among them."""
        kept: set[ET.Element] = set()
        for trail in self.trails:
            if called(trail).meant(elements, layers):
                kept.update(trail)
        return kept

    def around(self, element: ET.Element) -> set[ET.Element]:
        """Return an element, all in it and all round it."""
        parents = {child: parent for parent in self.document.root.iter() for child in parent}
        found = set(element.iter())
        while element in parents:
            element = parents[element]
            found.add(element)
        return found

    def missed(self, key: str, patterns: Sequence[str]) -> Iterator[Fault]:
        """Yield a fault for each name of a key ("elements", "layer") that picks nothing."""
        layers = key == "layer"
        known = dict.fromkeys(
            name
            for trail in self.trails
            for name in (called(trail).layers if layers else called(trail).names)
        )
        for number, pattern in enumerate(patterns):
            if not is_like(pattern, known):
                what = "layer" if layers else "element"
                words = missing(pattern, list(known), what)
                yield Fault(words, f"{key}[{number}]")

    def one(self, name: str, key: str) -> ET.Element:
        """Return the first element of a name.

        Raises:
            RecipeError: where there is none.
        """
        known: dict[str, ET.Element] = {}
        for element in self.document.root.iter():
            for each in names_of(element):
                known.setdefault(each, element)
        if name not in known:
            raise RecipeError([Fault(missing(name, list(known), "element"), key)])
        return known[name]


def missing(name: str, known: Sequence[str], what: str) -> str:
    """Return in words that a drawing has nothing of a name, with the nearest that it has."""
    words = f'"{shortened(name)}", and the drawing has no {what} of that name'
    if not known:
        return f"{words}: none of its {what}s has a name"
    near = nearest(name.replace("*", ""), known)
    if near is not None:
        return f'{words}: did you mean "{shortened(near)}"?'
    more = f" and {len(known) - MOST_NAMES:,} more" if len(known) > MOST_NAMES else ""
    return f"{words}, but {', '.join(shortened(each) for each in known[:MOST_NAMES])}{more}"
