"""An SVG file as a tree, read as a stranger's file must be.

Bounded in bytes, elements and depth; a DOCTYPE is passed over, entities it declares are refused; nothing
outside the file is opened. Every element keeps the line it stands on, for the words of a fault.
"""

from __future__ import annotations

import os
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from batik_vector.errors import Fault, RecipeError

SVG = "http://www.w3.org/2000/svg"
XLINK = "http://www.w3.org/1999/xlink"
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
SERIF = "http://www.serif.com/"
SWITCHES = "requiredExtensions", "systemLanguage", "requiredFeatures"

MAX_FILE = 128 << 20
"""Bytes past which a file is refused: the compiled tiles of the samples have 0.1 to 20 MB."""
MAX_ELEMENTS = 1_000_000
MAX_DEPTH = 200
"""Groups within groups; Python's own stack would bear some four times as many."""
MOST_TOLD = 12

_KINDS = {
    b"\x89PNG": "a PNG picture: pixels have no outlines to follow",
    b"%PDF": "a PDF",
    b"\xff\xd8\xff": "a JPEG picture: pixels have no outlines to follow",
    b"GIF8": "a GIF picture: pixels have no outlines to follow",
    b"\x1f\x8b": "compressed (.svgz): save it as plain SVG",
    b"PK\x03\x04": "a ZIP archive",
    b"%!PS": "PostScript: save it as SVG",
}


class DrawingError(RecipeError):
    """A drawing that cannot be read as a tile; ``faults`` says what stands in the way, and where."""


@dataclass(eq=False)
class Document:
    """The tree of an SVG file, the line of each element, and what is to be told about it."""

    root: ET.Element
    source: str
    lines: dict[ET.Element, int]
    by_id: dict[str, ET.Element]
    generator: str = ""
    notes: list[str] = field(default_factory=list)
    faults: dict[str, Fault] = field(default_factory=dict)
    unmeasured: list[str] = field(default_factory=list)

    def leave_open(self, words: str) -> None:
        """Tell once what a certificate cannot answer for."""
        if words not in self.unmeasured:
            self.unmeasured.append(words)

    def note(self, words: str) -> None:
        """Tell something once."""
        if words not in self.notes:
            self.notes.append(words)

    def refuse(self, element: ET.Element, words: str) -> None:
        """Keep a fault; of faults in the same words the first is told."""
        self.faults.setdefault(
            words, Fault(f"{named(element)}: {words}", "", self.source, self.line(element))
        )

    def line(self, element: ET.Element) -> int | None:
        """Return the line on which an element begins."""
        return self.lines.get(element)

    def fault(self, words: str, element: ET.Element | None = None) -> DrawingError:
        """Return an error that ends the reading."""
        line = None if element is None else self.line(element)
        return DrawingError([Fault(words, "", self.source, line)])

    def settle(self) -> None:
        """Raise what was refused, if anything was."""
        faults = sorted(self.faults.values(), key=lambda fault: fault.line or 0)
        if len(faults) > MOST_TOLD:
            more = Fault(f"and {len(faults) - MOST_TOLD} more", "", self.source)
            faults = [*faults[:MOST_TOLD], more]
        if faults:
            raise DrawingError(faults)


def named(element: ET.Element) -> str:
    """Return how an element is called in words: ``<path id="leaf3">``."""
    name = element.get("id", "")
    tag = element.tag.rpartition("}")[2]
    return f'<{tag} id="{name[:60]}">' if name else f"<{tag}>"


def local(element: ET.Element) -> str:
    """Return the name of an SVG element, or nothing where it is of another language."""
    space, _, name = element.tag.rpartition("}")
    return name if space in ("", "{" + SVG) else ""


def load(source: str | os.PathLike[str] | bytes, called: str = "drawing") -> tuple[bytes, str]:
    """Return the bytes of a file and the name that faults give it.

    Raises:
        DrawingError: where it cannot be read or is too large.
    """
    if isinstance(source, bytes):
        name, data = called, source
        if len(data) > MAX_FILE:
            raise _fault(f"{len(data):,} bytes, expected at most {MAX_FILE:,}", name)
        return data, name
    path, name = Path(source), os.fspath(source)
    try:
        if path.is_dir():
            raise _fault("is a folder, expected an SVG file", name)
        with path.open("rb") as file:
            data = file.read(MAX_FILE + 1)
    except (OSError, ValueError) as error:
        if isinstance(error, DrawingError):
            raise
        raise _fault(_reason(path, error), name) from error
    if len(data) > MAX_FILE:
        raise _fault(f"{path.stat().st_size:,} bytes, expected at most {MAX_FILE:,}", name)
    return data, name


def _reason(path: Path, error: Exception) -> str:
    if isinstance(error, FileNotFoundError):
        there = path.parent.is_dir()
        return "no such file" if there else f'no such file: there is no folder "{path.parent}"'
    return (error.strerror if isinstance(error, OSError) else None) or "is no usable path"


def _fault(words: str, source: str, line: int | None = None) -> DrawingError:
    return DrawingError([Fault(words, "", source, line)])


def parse(data: bytes, source: str = "drawing") -> Document:
    """Return the tree of an SVG file.

    Raises:
        DrawingError: where it is no SVG, no well-formed XML, or past a limit.
    """
    if not data.strip():
        raise _fault("is empty, expected an SVG", source)
    for mark, words in _KINDS.items():
        if data.startswith(mark):
            raise _fault(f"is {words}; expected an SVG", source)
    if b"\0" in data[:4] and not data.startswith((b"\xff\xfe", b"\xfe\xff", b"<\0", b"\0<")):
        raise _fault("is no text, expected an SVG", source)
    reader = _Reader(source)
    root = reader.read(data)
    if root.tag.rpartition("}")[2] != "svg" or not local(root):
        raise _fault(f"is XML, but no SVG: its root is {named(root)}", source, 1)
    head = data[:2000].decode("latin-1")
    found = re.search(r"<!--\s*(?:Generator|Created with):?\s*([^\n]{1,120}?)\s*-->", head, re.IGNORECASE)
    return Document(root, source, reader.lines, _ids(root), found[1] if found else "")


def _ids(root: ET.Element) -> dict[str, ET.Element]:
    by_id: dict[str, ET.Element] = {}
    for element in root.iter():
        name = element.get("id")
        if name:
            by_id.setdefault(name, element)
    return by_id


class _Reader:
    """Builds the tree, and stops at the first thing that a drawing has no need of."""

    def __init__(self, source: str) -> None:
        self.lines: dict[ET.Element, int] = {}
        self._source = source
        self._depth = 0
        self._tree = ET.TreeBuilder()
        self._parser = expat.ParserCreate(namespace_separator="}")
        self._parser.buffer_text = True
        self._parser.ordered_attributes = True
        self._parser.EntityDeclHandler = self._entity
        self._parser.SkippedEntityHandler = self._entity
        self._parser.ExternalEntityRefHandler = self._outside
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._tree.data

    def read(self, data: bytes) -> ET.Element:
        """Return the root."""
        try:
            self._parser.Parse(data, True)
            return self._tree.close()
        except expat.ExpatError as error:
            words = expat.ErrorString(error.code)
            what = "is no well-formed XML" if self.lines else "is no SVG"
            raise _fault(f"{what}: {words} (column {error.offset + 1})", self._source, error.lineno) from None
        except (ValueError, LookupError) as error:
            if isinstance(error, DrawingError):
                raise
            raise _fault(f"is no SVG: {error}", self._source) from None

    def _fault(self, words: str) -> DrawingError:
        return _fault(words, self._source, self._parser.CurrentLineNumber)

    def _entity(self, name: str, *_: object) -> None:
        raise self._fault(
            f'declares or uses the entity "{name[:60]}", which no drawing needs: save it as plain SVG'
        )

    def _outside(self, *_: object) -> int:
        raise self._fault("refers to another file, and no other file is opened")

    def _start(self, name: str, attributes: list[str]) -> None:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise self._fault(f"nested deeper than {MAX_DEPTH} elements")
        if len(self.lines) >= MAX_ELEMENTS:
            raise self._fault(f"more than {MAX_ELEMENTS:,} elements")
        pairs = {_full(attributes[i]): attributes[i + 1] for i in range(0, len(attributes), 2)}
        self.lines[self._tree.start(_full(name), pairs)] = self._parser.CurrentLineNumber

    def _end(self, name: str) -> None:
        self._depth -= 1
        self._tree.end(_full(name))


def _full(name: str) -> str:
    return "{" + name if "}" in name else name


def reference(element: ET.Element) -> str:
    """Return what an element refers to, in either spelling of the attribute."""
    return (element.get("href") or element.get(f"{{{XLINK}}}href") or "").strip()


def children(element: ET.Element) -> Iterator[ET.Element]:
    """Yield the SVG elements directly inside one."""
    return (child for child in element if local(child))
