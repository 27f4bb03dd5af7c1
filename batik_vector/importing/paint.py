"""What a shape is painted with: the one colour that stands for an ink."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
import zlib
from collections.abc import Callable

from batik_vector.geometry.paths.matrix import Matrix
from batik_vector.importing.colours import colour_of
from batik_vector.importing.document import MAX_DEPTH, Document, local, reference
from batik_vector.importing.gradients import declared_on, gradient_of
from batik_vector.importing.painting import Paint
from batik_vector.importing.styles import Style, share_of

EXPAND = "expand it to outlines first"
SOLID = "what is half transparent is taken as solid, but at the seam, where tints must agree"
FIRST_COLOUR = "a gradient is taken as one ink, in the colour it begins with"
_URL = re.compile(r"""\s*+url\(\s*+['"]?+([^'")]*+)['"]?+\s*+\)(.*+)""", re.DOTALL)
Box = tuple[float, float, float, float]
"""Left, upper edge, width and height."""
GRADIENTS = ("linearGradient", "radialGradient", "meshgradient")


def paint_of(document: Document, element: ET.Element, style: Style, what: str) -> str:
    """Return the colour of a fill or a stroke as ``#rrggbb``, or nothing where there is none.

    Args:
        document: keeps notes, and faults where the paint is a pattern.
        element: the shape.
        style: its own.
        what: "fill" or "stroke".
    """
    text = style[what]
    share = share_of(style[f"{what}-opacity"])
    if text in ("none", "context-fill", "context-stroke") or share == 0:
        return ""
    server = url_of(text)
    if server is not None:
        return _server(document, element, what, *server)
    found = colour_of(text, style["color"])
    if found is None:
        return _stand_in(document, style["color"] if text.lower() == "currentcolor" else text)
    colour, opacity = found
    if opacity == 0:
        return ""
    if opacity * share * share_of(style.get("opacity", "1")) < 1:
        document.note(SOLID)
    return colour


def look_of(
    document: Document,
    style: Style,
    what: str,
    ink: str,
    opacity: float,
    space: tuple[Matrix, Callable[[], Box]],
) -> Paint | None:
    """Return what a fill or a stroke looks like on a screen; None where that cannot be told.

    Args:
        document: where its gradients stand.
        style: of the shape.
        what: "fill" or "stroke".
        ink: the colour that stands for it, as :func:`paint_of` finds it.
        opacity: of the groups that it lies in, and its own.
        space: from the shape's user units to the page, and what tells the shape's box in them.
    """
    text = style[what]
    opacity *= share_of(style[f"{what}-opacity"])
    server = url_of(text)
    target = document.by_id.get(server[0][1:]) if server and server[0].startswith("#") else None
    if target is not None:
        ramp = gradient_of(document, target, space[0], space[1](), style["color"])
        return None if ramp is None else Paint(ink, ink, opacity, ramp)
    found = colour_of(server[1] if server else text, style["color"])
    return Paint(ink, ink, opacity * (found[1] if found else 1.0))


def url_of(text: str) -> tuple[str, str] | None:
    """Return what url() refers to and what stands behind it, or None where the text is no url()."""
    match = _URL.fullmatch(text) if "(" in text else None
    return None if match is None else (match[1].strip(), match[2].strip())


def _stand_in(document: Document, text: str) -> str:
    """Return a colour for one that is not understood, another for every text, so that inks stay apart."""
    colour = f"#{zlib.crc32(text.encode('utf-8', 'replace')) & 0xFFFFFF:06x}"
    document.note(f'the colour "{text[:40]}" is not understood; {colour} stands for it')
    return colour


def _server(document: Document, element: ET.Element, what: str, target: str, fallback: str) -> str:
    """Return the one ink that a gradient stands for."""
    server = document.by_id.get(target[1:]) if target.startswith("#") else None
    kind = "" if server is None else local(server)
    if kind in GRADIENTS:
        document.note(FIRST_COLOUR)
        return _first_stop(document, server) or "#000000"
    if server is not None:
        document.refuse(element, f"is {'filled' if what == 'fill' else 'stroked'} with a {kind}; {EXPAND}")
    elif fallback and fallback != "none":
        found = colour_of(fallback)
        if found is None:
            return _stand_in(document, fallback)
        return found[0] if found[1] else ""
    return ""


def _first_stop(document: Document, server: ET.Element | None) -> str:
    for _ in range(MAX_DEPTH):
        if server is None:
            break
        for stop in server.iter():
            if local(stop) == "stop":
                text = declared_on(stop, "stop-color") or "black"
                found = colour_of(text)
                return found[0] if found else _stand_in(document, text)
        server = document.by_id.get(reference(server)[1:])
    return ""
