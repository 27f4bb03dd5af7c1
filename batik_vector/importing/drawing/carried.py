"""The text by which a compiled file carries a drawing: an SVG with what is picked of it, and nothing else.

What a drawing keeps beside that (metadata, names of files and printers, pictures underneath, other layers)
is left out. Read again, it gives the same marks, to the bit, and the same text.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Container, Iterator

from batik_vector.importing.document import INKSCAPE, SERIF, SVG, XLINK, Document, local
from batik_vector.importing.elements import PASSED

_PREFIXES = {XLINK: "xlink", INKSCAPE: "inkscape", SERIF: "serif"}
_KEPT = frozenset(
    [
        f"{{{XLINK}}}href",
        f"{{{INKSCAPE}}}label",
        f"{{{INKSCAPE}}}groupmode",
        f"{{{SERIF}}}id",
    ]
)
"""Attributes of other namespaces that say what is drawn, and what it is called."""
_LEFT = frozenset(("metadata", "title", "desc", "script", "image", "text", "font", "foreignObject"))
_NAMES = ("id", "class")
_ESCAPED = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&apos;"}
_ESCAPED |= {"\n": "&#10;", "\t": "&#9;", "\r": "&#13;", "\x7f": "&#127;"}


def carried(document: Document, kept: Container[ET.Element] | None) -> str:
    """Return a document as the text that compiled files carry.

    Args:
        document: read.
        kept: the painted elements that matter, with all round them; None for all.
    """
    sheets = any(local(each) == "style" and each.text for each in document.root.iter())
    spaces = {
        name.partition("}")[0][1:] for each in document.root.iter() for name in each.attrib if name in _KEPT
    }
    root = {"xmlns": SVG} | {f"xmlns:{_PREFIXES[space]}": space for space in sorted(spaces)}
    return "".join(_Writer(kept, sheets).element(document.root, root))


class _Writer:
    """Writes elements; rules of a style sheet may count brothers, of whom a name then stays."""

    def __init__(self, kept: Container[ET.Element] | None, sheets: bool) -> None:
        self._kept = kept
        self._sheets = sheets

    def element(
        self, element: ET.Element, more: dict[str, str] | None = None, painted: bool = True
    ) -> Iterator[str]:
        """Yield an element as text.

        Args:
            element: of SVG.
            more: attributes that it has besides.
            painted: whether it is painted where it stands, and not only where something refers to it.
        """
        kind = local(element)
        painted = painted and kind not in PASSED
        bare = painted and self._kept is not None and element not in self._kept
        if kind in _LEFT or (bare and not self._sheets):
            if self._sheets and kind:
                yield f"<{kind}{_written(_names(element))}/>\n"
            return
        attributes = dict(more or {}) | (_names(element) if bare else _said(element))
        inside = [] if bare else [each for each in element if local(each)]
        text = _escaped(element.text or "") if kind == "style" else ""
        yield f"<{kind}{_written(attributes)}"
        if not inside and not text:
            yield "/>\n"
            return
        yield f">{text}" if text else ">\n"
        for child in inside:
            yield from self.element(child, None, painted)
        yield f"</{kind}>\n"


def _names(element: ET.Element) -> dict[str, str]:
    return {name: element.attrib[name] for name in _NAMES if name in element.attrib}


def _said(element: ET.Element) -> dict[str, str]:
    """Return the attributes that say what is drawn, and none that would be run."""
    said = {}
    for name, value in element.attrib.items():
        if name in _KEPT:
            space, _, own = name[1:].partition("}")
            said[f"{_PREFIXES[space]}:{own}"] = value
        elif "{" not in name and not name.lower().startswith("on"):
            said[name] = value
    return said


def _written(attributes: dict[str, str]) -> str:
    return "".join(f' {name}="{_escaped(value)}"' for name, value in attributes.items())


def _escaped(text: str) -> str:
    for mark, stands in _ESCAPED.items():
        if mark in text:
            text = text.replace(mark, stands)
    return text
