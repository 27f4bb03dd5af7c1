"""Pictures of one drawing by different programs, and how far they differ.

No two rasterisers agree on the grey of an edge, and programs round a page's size differently. So a pixel
counts as the same where its colour lies between the darkest and the lightest of the other picture's
pixels around it: that forgives one pixel of place and every grey of an edge, and nothing else.
"""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageFilter

Mask = NDArray[np.bool_]

SLACK = 32
"""Levels of 255 by which a colour may leave the range around it: programs round colours."""
DARK = 160
"""Below this grey a pixel belongs to a line."""
RIM = 2
"""Pixels along the page's edges that are not compared."""
EDGE = 3
"""Pixels along the page's edges where lines are not compared: there half of a line is off the page."""


def load(source: Path | bytes) -> Image.Image:
    """Return a picture on a white ground."""
    picture = Image.open(io.BytesIO(source) if isinstance(source, bytes) else source).convert("RGBA")
    white = Image.new("RGBA", picture.size, "white")
    return Image.alpha_composite(white, picture).convert("RGB")


def reference(svg: bytes, per_mm: float) -> Image.Image:
    """Return what cairosvg makes of an SVG, at so many pixels to the millimetre of paper."""
    import cairosvg

    return load(cairosvg.svg2png(bytestring=svg, dpi=96, scale=per_mm * 25.4 / 96))


def differing(one: Image.Image, other: Image.Image) -> float:
    """Return the share of pixels that do not belong, in whichever picture has more of them."""
    one, other = _common(one, other)
    # A page that is no whole number of pixels ends within the last ones, where paper shows through.
    inside = slice(RIM, -RIM)
    return max(float(_strange(*pair)[inside, inside].mean()) for pair in ((one, other), (other, one)))


def shade_apart(one: Image.Image, other: Image.Image) -> float:
    """Return by how many levels of 255 the mean colours differ: whether as much is covered."""
    one, other = _common(one, other)
    means = (np.asarray(picture, float).mean(axis=(0, 1)) for picture in (one, other))
    return float(np.abs(np.subtract(*means)).max())


def stray(one: Image.Image, other: Image.Image, reach: int = 1) -> float:
    """Return the share of line pixels that stand more than ``reach`` off the other picture's lines."""
    a, b = (np.asarray(each.convert("L")) < DARK for each in _common(one, other))
    return max(_alone(a, b, reach), _alone(b, a, reach))


def _common(one: Image.Image, other: Image.Image) -> tuple[Image.Image, Image.Image]:
    """Return both cut to a common size, from the upper left corner."""
    width, height = (min(pair) for pair in zip(one.size, other.size, strict=True))
    apart = max(abs(a - b) for a, b in zip(one.size, other.size, strict=True))
    # A page that is no whole number of pixels is rounded up by some and down by others.
    assert apart <= 1, f"pictures of {one.size} and {other.size} pixels"
    return one.crop((0, 0, width, height)), other.crop((0, 0, width, height))


def _strange(one: Image.Image, other: Image.Image) -> Mask:
    pixels = np.asarray(one, np.int16)
    low = np.asarray(other.filter(ImageFilter.MinFilter(3)), np.int16)
    high = np.asarray(other.filter(ImageFilter.MaxFilter(3)), np.int16)
    return np.asarray(((pixels < low - SLACK) | (pixels > high + SLACK)).any(axis=2), np.bool_)


def _alone(one: Mask, other: Mask, reach: int) -> float:
    near = np.asarray(Image.fromarray(other).convert("L").filter(ImageFilter.MaxFilter(2 * reach + 1))) > 0
    inside = slice(EDGE, -EDGE)
    left = int(np.count_nonzero((one & ~near)[inside, inside]))
    return left / max(int(np.count_nonzero(one)), 1)
