"""From an SVG's width, height and viewBox to true millimetres.

CSS Values 3, 5.2: 96 px are an inch, and user units are px. SVG 2, 8.2 and 8.3: the viewBox and how it
lies in its viewport.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET

from batik_vector.geometry.paths.matrix import Matrix, times
from batik_vector.importing.document import Document
from batik_vector.importing.transforms import PX_PER_INCH, PX_PER_UNIT
from batik_vector.patterns import NUMBER
from batik_vector.units import GRID_MM, format_mm
from batik_vector.values import frozen

MM_PER_PX = 25.4 / PX_PER_INCH
LEAST_MM, MOST_MM = 0.1, 20_000.0
_LENGTH = re.compile(rf"\s*+({NUMBER})\s*+(%|[a-zA-Z]*+)\s*+")
_ASPECT = re.compile(r"\s*+(?:defer\s++)?(?:none|x(Min|Mid|Max)Y(Min|Mid|Max))(?:\s++(meet|slice))?\s*+")

Box = tuple[float, float, float, float]
"""Left, top, width and height in user units."""


@frozen
class Page:
    """The page in mm, and the map from the root's user units to mm on it, y still downwards.

    ``size`` are its sides in user units, to which percentages refer. ``whole`` says that it is the document's
    own page, and not the cell of a pattern on it.
    """

    width: float
    height: float
    matrix: Matrix
    size: tuple[float, float]
    guessed: str = ""
    whole: bool = True


def parse_px(text: str | None, whole: float | None = None) -> float | None:
    """Return a length in px, or None where the text is none.

    Args:
        text: as ``"12"``, ``"12mm"`` or ``"50%"``.
        whole: what percentages are shares of; without it they are no lengths.
    """
    match = _LENGTH.fullmatch(text or "")
    if match is None:
        return None
    number, unit = float(match[1]), match[2].lower()
    if unit == "%":
        return None if whole is None else number / 100 * whole
    value = number * PX_PER_UNIT[unit] if unit in PX_PER_UNIT else math.nan
    return value if math.isfinite(value) else None


def page_of(document: Document, px_per_inch: float = PX_PER_INCH) -> Page:
    """Return the page of a document.

    Args:
        document: read.
        px_per_inch: what a page in px, or of a viewBox alone, is measured by; older programs count 72.

    Raises:
        DrawingError: where its size is not said, or is none.
    """
    root = document.root
    box = view_box(document, root)
    width, height, guessed = _size(document, box, px_per_inch)
    for side, value in (("width", width), ("height", height)):
        mm = value * MM_PER_PX
        if not LEAST_MM <= mm <= MOST_MM:
            raise document.fault(f"its {side} is {mm:g} mm, expected {LEAST_MM:g} to {MOST_MM:,.0f} mm", root)
    scale = (MM_PER_PX, 0.0, 0.0, MM_PER_PX, 0.0, 0.0)
    inner = fitted(box, width, height, root.get("preserveAspectRatio", ""))
    size = (box[2], box[3]) if box else (width, height)
    return Page(width * MM_PER_PX, height * MM_PER_PX, times(scale, inner), size, guessed)


def _size(document: Document, box: Box | None, px_per_inch: float) -> tuple[float, float, str]:
    """Return width and height in px of CSS, and in words what had to be guessed of them."""
    root, larger = document.root, PX_PER_INCH / px_per_inch
    sides: list[float | None] = []
    for name in ("width", "height"):
        text = (root.get(name) or "").strip()
        value = parse_px(text)
        if value is None and text and text != "auto" and not text.endswith("%"):
            raise document.fault(f'{name} = "{text[:60]}", expected a length such as "280mm"', root)
        bare = text[-1:] == "." or text[-1:].isdigit() or text.lower().endswith("px")
        sides.append(value * larger if value is not None and bare else value)
    width, height = sides
    if width is not None and height is not None:
        return width, height, ""
    if box is None:
        if root.get("width") or root.get("height"):
            words = (
                "its page has no size of its own: width and height are shares of a window, or one is missing"
            )
        else:
            words = "has no page size: neither width and height nor a viewBox"
        raise document.fault(f'{words}; expected such as width="280mm" height="280mm"', root)
    ratio = box[3] / box[2]
    if width is not None:
        return width, width * ratio, "the height is guessed by the shape of the viewBox"
    if height is not None:
        return height / ratio, height, "the width is guessed by the shape of the viewBox"
    width, height = box[2] * larger, box[3] * larger
    mm = " × ".join(format_mm(side * MM_PER_PX) for side in (width, height))
    count = f"{px_per_inch:g} units of the viewBox to the inch"
    return width, height, f"no size in mm is given: {mm} mm is guessed, {count}"


def view_box(document: Document, element: ET.Element) -> Box | None:
    """Return the viewBox of an element, or None where it has none."""
    text = element.get("viewBox")
    if text is None:
        return None
    parts = text.replace(",", " ").split()
    try:
        x, y, width, height = (float(part) for part in parts)
    except ValueError:
        raise document.fault(f'viewBox = "{text[:80]}", expected four numbers', element) from None
    if not (all(map(math.isfinite, (x, y, width, height))) and width > 0 and height > 0):
        raise document.fault(f'viewBox = "{text[:80]}", expected a width and a height above zero', element)
    return x, y, width, height


def fitted(box: Box | None, width: float, height: float, aspect: str) -> Matrix:
    """Return the map from a viewBox to its viewport, as preserveAspectRatio says (SVG 2, 8.2)."""
    if box is None:
        return 1.0, 0.0, 0.0, 1.0, 0.0, 0.0
    left, top, across, down = box
    sx, sy = width / across, height / down
    match = _ASPECT.fullmatch(aspect)
    x_align, y_align, meet = ("Mid", "Mid", None) if match is None else match.groups()
    # Sides that were rounded on their way into the file are meant to be alike.
    apart = abs(sx - sy) * max(across, down) * MM_PER_PX
    if x_align is not None and apart > GRID_MM:
        sx = sy = max(sx, sy) if meet == "slice" else min(sx, sy)
    share = {None: 0.0, "Min": 0.0, "Mid": 0.5, "Max": 1.0}
    x = (width - across * sx) * share[x_align]
    y = (height - down * sy) * share[y_align]
    return sx, 0.0, 0.0, sy, x - left * sx, y - top * sy
