"""What the layers of a drawing are called."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

from batik_vector.importing.document import INKSCAPE, SERIF

_LAYER_CODE = re.compile("_x([0-9A-Fa-f]{2,4})_")


def layer_of(element: ET.Element, outer: str, top: bool) -> str:
    """Return the name of the layer that the marks in a group belong to.

    Inkscape's layers say so; elsewhere they are the groups directly in the root.
    """
    layer = element.get(f"{{{INKSCAPE}}}groupmode") == "layer"
    if not (layer or top):
        return outer
    name = element.get(f"{{{INKSCAPE}}}label") or element.get(f"{{{SERIF}}}id") or element.get("id") or ""
    return " ".join(decoded(name).split()) or outer


def decoded(name: str) -> str:
    """Return an id with what it may not hold, which Illustrator writes as ``_x20_``."""
    return _LAYER_CODE.sub(lambda code: chr(int(code[1], 16)), name)
