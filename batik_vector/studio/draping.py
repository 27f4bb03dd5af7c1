"""Cloth on forms, as a designer shows it: the field itself, cut to the outline of a cushion or a shirt.

The cloth lies at its true scale in the warp's direction, sleeves are turned as their grain is. Folds and the
fall of light are laid over it as shades; nothing of the pattern is bent, so that it stays the writer's own.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from batik_vector.artwork import Artwork, DropAxis
from batik_vector.errors import TooLargeError
from batik_vector.export.options import Profile, SvgOptions
from batik_vector.export.svg import INKSCAPE, svg_text
from batik_vector.tiling.cloth.field import field_page
from batik_vector.units import format_mm
from batik_vector.values import frozen

MOST = 400_000
"""Vertices of cloth that are drawn one by one; of finer cloth a block is, and repeated by the browser."""
BLOCK = 60_000
"""Vertices of such a block, about: the larger, the fewer edges at which the browser's pixels must meet."""
SHOWN = SvgOptions(profile=Profile.COMPACT)
"""How pictures are written: the marks of an ink in as few paths as can be."""
Bounds: TypeAlias = tuple[float, float, float, float]
_NUMBER = re.compile(r"-?[0-9.]+")
_BODY = re.compile(r"<svg\b[^>]*>(.*)</svg>", re.DOTALL)
_FRONT = re.compile(
    r"<(?:title|desc|metadata|sodipodi:namedview)\b.*?(?:/>|</(?:title|desc|metadata)>)", re.S
)


@frozen
class Piece:
    """A piece of cloth on a form: its outline as path data in mm, y down, and how its grain is turned."""

    outline: str
    turn: float = 0.0

    @property
    def bounds(self) -> Bounds:
        """Where its points lie, those of its curves included: left, top, right, bottom."""
        numbers = [float(each) for each in _NUMBER.findall(self.outline)]
        return min(numbers[::2]), min(numbers[1::2]), max(numbers[::2]), max(numbers[1::2])

    @property
    def middle(self) -> tuple[float, float]:
        """The point that its grain is turned about."""
        left, top, right, bottom = self.bounds
        return (left + right) / 2, (top + bottom) / 2

    @property
    def reach(self) -> Bounds:
        """The bounds of the cloth that it is cut from, before its grain is turned."""
        left, top, right, bottom = self.bounds
        x, y = self.middle
        angle = math.radians(self.turn)
        cos, sin = abs(math.cos(angle)), abs(math.sin(angle))
        width, height = (
            (right - left) * cos + (bottom - top) * sin,
            (right - left) * sin + (bottom - top) * cos,
        )
        return x - width / 2, y - height / 2, x + width / 2, y + height / 2


@frozen
class Tone:
    """Something that is painted in one tone: path data in mm, y down, its colour and how much it hides."""

    outline: str
    colour: str
    opacity: float


@frozen
class Form:
    """What cloth is shown on.

    Args:
        size: breadth and height in mm.
        pieces: of cloth, the lowest first.
        under: what lies beneath all cloth, such as the inside of a collar.
        folds: soft shades and lights on the cloth.
        seams: lines on the cloth, as path data.
        dots: middles of buttons.
    """

    size: tuple[float, float]
    pieces: tuple[Piece, ...]
    under: tuple[Tone, ...] = ()
    folds: tuple[Tone, ...] = ()
    seams: tuple[str, ...] = ()
    dots: tuple[tuple[float, float], ...] = ()

    @property
    def reach(self) -> Bounds:
        """The bounds of the cloth that all its pieces are cut from."""
        left, top, right, bottom = zip(*(piece.reach for piece in self.pieces), strict=True)
        return min(left), min(top), max(right), max(bottom)


DARK, LIGHT = "#101018", "#ffffff"
CUSHION = Form(
    (560.0, 560.0),
    (
        Piece(
            "M66 56 C175 80 385 80 494 56 C506 53 511 59 507 70 C481 172 481 388 507 490 "
            "C511 501 506 507 494 504 C385 480 175 480 66 504 C54 507 49 501 53 490 "
            "C79 388 79 172 53 70 C49 59 54 53 66 56 Z"
        ),
    ),
    under=(
        Tone("M90 500 C180 492 380 492 470 500 C500 520 440 532 280 532 C120 532 60 520 90 500 Z", DARK, 0.3),
    ),
    folds=(
        Tone("M40 520 L520 520 L520 40 C492 210 470 380 440 440 C330 478 190 480 40 520 Z", DARK, 0.34),
        Tone("M40 40 L520 40 C400 92 180 92 100 110 C84 190 92 380 40 520 Z", DARK, 0.14),
        Tone(
            "M150 140 C230 110 330 118 372 140 C330 240 230 330 168 372 C130 320 120 200 150 140 Z",
            LIGHT,
            0.2,
        ),
        Tone("M66 56 C110 110 140 150 176 176 C136 160 96 120 60 66 Z", DARK, 0.3),
        Tone("M494 56 C450 110 420 150 384 176 C424 160 464 120 500 66 Z", DARK, 0.3),
        Tone("M66 504 C110 450 140 410 176 384 C136 400 96 440 60 494 Z", DARK, 0.3),
        Tone("M494 504 C450 450 420 410 384 384 C424 400 464 440 500 494 Z", DARK, 0.3),
    ),
    seams=(
        "M70 64 C178 88 382 88 490 64 M499 72 C473 174 473 386 499 488 M490 496 C382 472 178 472 70 496 "
        "M61 488 C87 386 87 174 61 72",
    ),
)
SHIRT = Form(
    (1120.0, 960.0),
    (
        Piece(
            "M348 172 C290 190 226 222 178 262 C128 330 84 424 58 516 L198 574 C226 512 268 450 316 404 Z",
            22.0,
        ),
        Piece(
            "M772 172 C830 190 894 222 942 262 C992 330 1036 424 1062 516 L922 574 "
            "C894 512 852 450 804 404 Z",
            -22.0,
        ),
        Piece(
            "M348 172 C392 156 424 146 458 132 C470 182 520 236 560 246 C600 236 650 182 662 132 "
            "C696 146 728 156 772 172 C790 240 800 330 804 404 C800 560 806 730 820 884 "
            "C660 908 460 908 300 884 C314 730 320 560 316 404 C320 330 330 240 348 172 Z"
        ),
        Piece(
            "M458 132 C450 128 446 120 450 110 L470 98 C482 160 524 208 562 226 "
            "L560 252 C514 238 468 184 458 132 Z",
            90.0,
        ),
        Piece(
            "M662 132 C670 128 674 120 670 110 L650 98 C638 160 596 208 558 226 "
            "L560 252 C606 238 652 184 662 132 Z",
            90.0,
        ),
    ),
    under=(
        Tone("M100 880 C300 930 820 930 1020 880 C900 950 220 950 100 880 Z", DARK, 0.1),
        Tone(
            "M470 98 C520 84 600 84 650 98 C640 160 600 206 560 228 C520 206 480 160 470 98 Z",
            "#2b2b33",
            0.92,
        ),
    ),
    folds=(
        Tone(
            "M300 884 C314 730 320 560 316 404 C320 330 330 240 348 172 C386 300 372 560 384 892 Z",
            DARK,
            0.26,
        ),
        Tone(
            "M820 884 C806 730 800 560 804 404 C800 330 790 240 772 172 C734 300 748 560 736 892 Z", DARK, 0.3
        ),
        Tone("M420 300 C452 480 420 700 446 896 L478 898 C462 700 484 480 452 290 Z", LIGHT, 0.16),
        Tone("M660 330 C640 520 672 720 650 896 L628 898 C640 720 612 520 634 320 Z", DARK, 0.16),
        Tone("M560 250 L576 250 L576 902 L560 902 Z", DARK, 0.2),
        Tone("M58 516 L198 574 C212 540 232 504 256 470 L96 404 C80 440 68 480 58 516 Z", DARK, 0.16),
        Tone(
            "M1062 516 L922 574 C908 540 888 504 864 470 L1024 404 C1040 440 1052 480 1062 516 Z", DARK, 0.24
        ),
        Tone("M330 250 C300 300 280 350 316 404 L300 420 C262 380 268 300 330 250 Z", DARK, 0.3),
        Tone("M790 250 C820 300 840 350 804 404 L820 420 C858 380 852 300 790 250 Z", DARK, 0.34),
        Tone("M250 250 C200 300 160 380 130 470 L160 482 C190 390 226 320 274 268 Z", LIGHT, 0.14),
    ),
    seams=(
        "M560 250 L560 901 M590 244 L590 900",
        "M66 494 L206 552 M1054 494 L914 552",
        "M302 868 C462 892 658 892 818 868",
    ),
    dots=((575.0, 330.0), (575.0, 440.0), (575.0, 550.0), (575.0, 660.0), (575.0, 770.0)),
)
FORMS: Mapping[str, Form] = {"cushion": CUSHION, "shirt": SHIRT}


def draped(tile: Artwork, name: str) -> tuple[str, tuple[float, float]]:
    """Return a picture of a form in the cloth of a tile, and its size in mm.

    Raises:
        TooLargeError: where a single tile would be too much to show.
    """
    form = FORMS[name]
    left, top, right, bottom = form.reach
    across = max(1, math.ceil((right - left) / tile.cell.width))
    up = max(1, math.ceil((bottom - top) / tile.cell.height))
    # Its middle lies on the middle of the form: a design that is its own mirror image is worn so.
    wide, high = across * tile.cell.width, up * tile.cell.height
    x, y = (left + right - wide) / 2, (top + bottom - high) / 2
    if too_fine(across * up * tile.vertex_count):
        cloth = repeated_cloth(tile, (wide, high))
    else:
        cloth = _body(svg_text(field_page(tile, across, up), SHOWN))
    moved = f'<g transform="translate({format_mm(x)} {format_mm(y)})">{cloth}</g>'
    return _drawn(form, name, moved), form.size


def too_fine(vertices: float) -> bool:
    """Whether cloth has more vertices than are drawn one by one."""
    return vertices > MOST


def flat(tile: Artwork, size: tuple[float, float]) -> str:
    """Return a picture of plain cloth, too fine to be drawn mark by mark.

    Raises:
        TooLargeError: where a single tile would be too much to show.
    """
    return _root(size, repeated_cloth(tile, size))


def repeated_cloth(tile: Artwork, size: tuple[float, float]) -> str:
    """Return a rectangle of cloth of which the browser repeats a block; its upper left corner is a tile's.

    Raises:
        TooLargeError: where a single tile would be too much to show.
    """
    cell = tile.cell
    # So many tiles side by side that what they drop by is whole repeats.
    columns, rows = (cell.drop.denominator, 1) if cell.axis == DropAxis.COLUMN else (1, cell.drop.denominator)
    if too_fine(columns * rows * tile.vertex_count):
        raise TooLargeError(
            f"the tile has about {tile.vertex_count:,} vertices, more than a cloth of it can show: look at "
            "the tile, or set a larger tolerance"
        )
    more = max(1, math.isqrt(BLOCK // max(columns * rows * tile.vertex_count, 1)))
    page = field_page(tile, columns * more, rows * more)
    wide, high = page.cell.width, page.cell.height
    block = _body(svg_text(page, SHOWN))
    return (
        f'<defs><pattern id="block" patternUnits="userSpaceOnUse" width="{format_mm(wide)}" '
        f'height="{format_mm(high)}">{block}</pattern></defs>'
        f'<rect width="{format_mm(size[0])}" height="{format_mm(size[1])}" fill="url(#block)"/>'
    )


def _drawn(form: Form, name: str, cloth: str) -> str:
    """Return the picture: what lies under, pieces cut out of the cloth, folds on them, and seams."""
    soft, thin = max(form.size) / 70, max(form.size) / 700
    defs = [f'<g id="{name}-cloth">{cloth}</g>']
    defs.append(_blur(f"{name}-soft", soft))
    defs.append(
        f'<clipPath id="{name}-all">' + "".join(_path(each.outline) for each in form.pieces) + "</clipPath>"
    )
    shown = [f'<g filter="url(#{name}-soft)">{_tones(form.under[:1])}</g>{_tones(form.under[1:])}']
    for number, piece in enumerate(form.pieces):
        defs.append(f'<clipPath id="{name}-{number}">{_path(piece.outline)}</clipPath>')
        x, y = piece.middle
        turn = f' transform="rotate({piece.turn:g} {x:g} {y:g})"' if piece.turn else ""
        shown.append(f'<g clip-path="url(#{name}-{number})"><use href="#{name}-cloth"{turn}/></g>')
    shown.append(
        f'<g clip-path="url(#{name}-all)"><g filter="url(#{name}-soft)">{_tones(form.folds)}</g></g>'
    )
    drawn = f'fill="none" stroke="{DARK}" stroke-linejoin="round" stroke-linecap="round"'
    edges = "".join(_path(each.outline) for each in form.pieces)
    shown.append(f'<g {drawn} stroke-opacity="0.55" stroke-width="{thin:.2f}">{edges}</g>')
    stitched = (
        f'stroke-opacity="0.4" stroke-width="{thin:.2f}" stroke-dasharray="{4 * thin:.1f} {3 * thin:.1f}"'
    )
    shown.append(f"<g {drawn} {stitched}>" + "".join(map(_path, form.seams)) + "</g>")
    for x, y in form.dots:
        shown.append(
            f'<circle cx="{x:g}" cy="{y:g}" r="7" fill="#f3efe6" stroke="{DARK}" stroke-opacity="0.6"/>'
        )
    return _root(form.size, f"<defs>{''.join(defs)}</defs>{''.join(shown)}")


def _root(size: tuple[float, float], drawn: str) -> str:
    width, height = size
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="{INKSCAPE}" '
        f'width="{width:g}mm" height="{height:g}mm" viewBox="0 0 {width:g} {height:g}">{drawn}</svg>\n'
    )


def _blur(name: str, reach: float) -> str:
    room = 'x="-20%" y="-20%" width="140%" height="140%"'
    return f'<filter id="{name}" {room}><feGaussianBlur stdDeviation="{reach:.1f}"/></filter>'


def _path(outline: str) -> str:
    return f'<path d="{outline}"/>'


def _tones(tones: Sequence[Tone]) -> str:
    return "".join(
        f'<path d="{each.outline}" fill="{each.colour}" fill-opacity="{each.opacity:g}"/>' for each in tones
    )


def _body(svg: str) -> str:
    """Return what our writer wrote within its root, without what is not drawn."""
    found = _BODY.search(svg)
    return _FRONT.sub("", found[1]) if found else ""
