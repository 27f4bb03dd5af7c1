"""Elements of SVG: which paint nothing where they stand, and which paint what is no geometry."""

from __future__ import annotations

_SILENT = """
defs symbol clipPath mask pattern linearGradient radialGradient meshgradient hatch solidcolor filter marker
style script title desc metadata view cursor font font-face glyph animate animateTransform animateMotion
animateColor set color-profile
"""
PASSED = frozenset(_SILENT.split())
"""Elements that paint nothing where they stand."""

REFUSED = {
    "image": "a picture has no outlines; trace it (Inkscape: Path → Trace Bitmap), or take it out",
    "text": "text hangs on a font; convert it to outlines first (Inkscape: Path → Object to Path)",
    "foreignObject": "foreign content cannot be read as geometry",
    "video": "is no geometry",
    "canvas": "is no geometry",
    "iframe": "is no geometry",
}
"""Elements that paint what is no geometry, with the way out where there is one."""
