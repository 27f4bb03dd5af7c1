"""Cloth on forms, as a designer shows it: the field itself, cut to the outline of a cushion or a shirt.

The cloth lies at its true scale in the warp's direction, sleeves are turned as their grain is. Folds and the
fall of light are laid over it as shades; nothing of the pattern is bent, so that it stays the writer's own.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from batik_vector.artwork import Artwork
from batik_vector.errors import TooLargeError
from batik_vector.export.options import Profile, SvgOptions
from batik_vector.export.svg import INKSCAPE, svg_text
from batik_vector.tiling.cloth.field import field_page
from batik_vector.units import format_mm
from batik_vector.values import frozen

MOST = 800_000
"""Vertices of the cloth under a form."""
_BODY = re.compile(r"<svg\b[^>]*>(.*)</svg>", re.DOTALL)
_FRONT = re.compile(
    r"<(?:title|desc|metadata|sodipodi:namedview)\b.*?(?:/>|</(?:title|desc|metadata)>)", re.S
)


@frozen
class Piece:
    """A piece of cloth on a form: its outline as path data in mm, y down, and how its grain is turned."""

    outline: str
    turn: float = 0.0


@frozen
class Form:
    """What cloth is shown on: how large it is in mm, its pieces, and shades: path data, colour, opacity."""

    size: tuple[float, float]
    pieces: tuple[Piece, ...]
    shades: tuple[tuple[str, str, float], ...] = ()
    seams: tuple[str, ...] = ()


CUSHION = Form(
    (520.0, 520.0),
    (
        Piece(
            "M45 40 C150 62 370 62 475 40 C484 36 489 42 485 52 C461 150 461 370 485 468 "
            "C489 479 483 486 475 481 C370 459 150 459 45 481 "
            "C36 485 31 479 35 469 C59 370 59 150 35 52 C31 42 37 36 45 40 Z"
        ),
    ),
    (
        (
            "M45 481 C150 459 370 459 475 481 C440 440 360 425 260 425 C160 425 80 440 45 481 Z",
            "#000000",
            0.16,
        ),
        (
            "M485 52 C461 150 461 370 485 468 C450 420 440 350 440 260 C440 170 452 100 485 52 Z",
            "#000000",
            0.1,
        ),
        ("M70 75 C160 92 300 92 380 88 C250 120 130 150 95 330 C84 240 82 150 70 75 Z", "#ffffff", 0.12),
    ),
)
SHIRT = Form(
    (1100.0, 900.0),
    (
        Piece(
            "M330 150 L165 240 L55 470 L190 540 L300 400 L310 330 Z",
            24.0,
        ),
        Piece(
            "M770 150 L935 240 L1045 470 L910 540 L800 400 L790 330 Z",
            -24.0,
        ),
        Piece(
            "M330 150 L430 112 C470 160 630 160 670 112 L770 150 L790 330 C784 500 788 690 800 852 "
            "C650 872 450 872 300 852 C312 690 316 500 310 330 Z"
        ),
    ),
    (
        ("M330 150 C360 260 352 420 372 852 L300 852 C312 690 316 500 310 330 Z", "#000000", 0.13),
        ("M770 150 C742 260 752 430 728 858 L800 852 C788 690 784 500 790 330 Z", "#000000", 0.16),
        ("M470 180 C462 380 470 620 452 868 L486 869 C500 620 486 400 492 190 Z", "#000000", 0.08),
        ("M600 190 C610 400 596 640 622 868 L596 869 C574 640 588 400 580 186 Z", "#ffffff", 0.08),
        ("M55 470 L190 540 L205 520 L70 440 Z", "#000000", 0.12),
        ("M1045 470 L910 540 L895 520 L1030 440 Z", "#000000", 0.12),
    ),
    (
        "M430 112 C470 160 630 160 670 112",
        "M437 122 C478 176 622 176 663 122",
        "M550 156 L550 866",
        "M330 150 L310 330 L300 400",
        "M770 150 L790 330 L800 400",
    ),
)
FORMS: Mapping[str, Form] = {"cushion": CUSHION, "shirt": SHIRT}


def draped(tile: Artwork, name: str) -> tuple[str, tuple[float, float]]:
    """Return a picture of a form in the cloth of a tile, and its size in mm.

    Raises:
        TooLargeError: where the cloth would be too much to show.
    """
    form = FORMS[name]
    width, height = form.size
    # Turned pieces reach beyond the form's own rectangle.
    reach = math.hypot(width, height) if any(piece.turn for piece in form.pieces) else max(width, height)
    across, up = (max(1, math.ceil(reach / side)) for side in (tile.cell.width, tile.cell.height))
    page = field_page(tile, across, up)
    if page.vertex_count > MOST:
        raise TooLargeError(
            f"the cloth of the {name} has about {page.vertex_count:,} vertices, more than can be shown: look "
            "at the tile or the field"
        )
    cloth = _body(svg_text(page, SvgOptions(profile=Profile.COMPACT)))
    dx, dy = (format_mm((side - whole) / 2) for side, whole in zip(form.size, _size(page), strict=True))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="{INKSCAPE}" '
        f'width="{width:g}mm" height="{height:g}mm" viewBox="0 0 {width:g} {height:g}">'
    ]
    parts.append(f'<defs><g id="cloth-on-{name}" transform="translate({dx} {dy})">{cloth}</g>')
    parts += [
        f'<clipPath id="{name}-{number}"><path d="{piece.outline}"/></clipPath>'
        for number, piece in enumerate(form.pieces)
    ]
    parts.append("</defs>")
    for number, piece in enumerate(form.pieces):
        turn = f' transform="rotate({piece.turn:g} {width / 2:g} {height / 2:g})"' if piece.turn else ""
        parts.append(f'<g clip-path="url(#{name}-{number})"><use href="#cloth-on-{name}"{turn}/></g>')
    thin = max(form.size) / 600
    for outline, colour, opacity in form.shades:
        parts.append(f'<path d="{outline}" fill="{colour}" fill-opacity="{opacity}"/>')
    lines = [piece.outline for piece in form.pieces] + list(form.seams)
    for line in lines:
        parts.append(
            f'<path d="{line}" fill="none" stroke="#000000" stroke-opacity="0.45" stroke-width="{thin:.2f}"/>'
        )
    return "".join([*parts, "</svg>\n"]), form.size


def _size(page: object) -> tuple[float, float]:
    cell = page.cell  # type: ignore[attr-defined]
    return cell.width, cell.height


def _body(svg: str) -> str:
    """Return what our writer wrote within its root, without what is not drawn."""
    found = _BODY.search(svg)
    return _FRONT.sub("", found[1]) if found else ""
