"""SVG path data, parsed to outlines of lines and cubic Béziers."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields.fitting import shown
from batik_vector.geometry.paths.decimals import decimals_in, placed_decimals
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.pen import Command, drawn
from batik_vector.patterns import NUMBER, numbers_in

_LETTER = re.compile("([MmZzLlHhVvCcSsQqTtAa])")
_DECIMALS = re.compile(r"[-.,0-9 \t\r\n]*+")
_WHOLE = re.compile(r"[-.,0-9 \t\r\nMmZzLlHhVvCcSsQqTt]*+")
_PLAIN = re.compile(r"[-+.,eE0-9 \t\r\n]*+")
_ARC = re.compile(
    r"[\s,]*+({0})[\s,]*+({0})[\s,]*+({0})[\s,]*+([01])[\s,]*+([01])[\s,]*+({0})[\s,]*+({0})".replace(
        "{0}", NUMBER
    )
)
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_TAKES |= {letter.lower(): takes for letter, takes in _TAKES.items()}
_NONE = 1 << 40
"""Stands for none where numbers are divided by what a letter takes."""
_TAKEN = np.full(128, _NONE, np.intp)
_TAKEN[[ord(letter) for letter in _TAKES]] = [takes or _NONE for takes in _TAKES.values()]
_ALONE = np.isin(np.arange(128), list(b"MmZz"))
_BARE = bytes.maketrans(bytes(range(65, 128)), b" " * 63)


def parse_path(text: str) -> Outline:
    """Return the outline that path data draw (SVG 2, 9.3); a mere move draws no subpath.

    Raises:
        ValueError: where the data break off or are none.
    """
    at_once = _at_once(text) if len(text) >= WHOLE else None
    return drawn(_commands(text) if at_once is None else at_once)


WHOLE, LONG = 800, 2000
"""Characters of path data, and of the numbers behind one letter, from which on all are read at once; fewer
are sooner read one by one."""
FARTHEST = 1e6
"""Coordinates of a curve at most: floats then tell places apart to a part in 10¹⁰ of them."""


@functools.lru_cache(maxsize=64)
def path_of(text: str, upward: bool = False, centre: tuple[float, float] = (0.0, 0.0)) -> Outline:
    """Return the outline that path data draw, y up. Kept: a recipe asks for it again and again.

    Args:
        text: path data.
        upward: whether their y points up; as SVG has it, it points down.
        centre: the point of theirs that becomes the origin.

    Raises:
        GeometryError: where they cannot be read, draw nothing, or reach too far.
    """
    try:
        outline = parse_path(text)
    except ValueError as error:
        raise GeometryError(f"d = {shown(text)}: {error}") from None
    if not len(outline.points) or not np.ptp(outline.points, axis=0).any():
        raise GeometryError(f'd = {shown(text)} draws nothing, expected path data such as "M0 0L2 0L1 2Z"')
    if (far := float(np.abs(outline.points).max())) > FARTHEST:
        words = f"reaches as far as {far:.3g}, expected coordinates up to {FARTHEST:,.0f}"
        raise GeometryError(f"d = {shown(text)} {words}")
    flip = 1.0 if upward else -1.0
    return outline.moved((1.0, 0.0, 0.0, flip, -centre[0], -flip * centre[1]))


def _at_once(text: str) -> Iterator[Command] | None:
    """Return the commands of path data whose numbers are plain decimals, all read in one go.

    None where something else stands there, or is wrong: then they are read one by one, which knows what.
    """
    if not text.isascii() or _WHOLE.fullmatch(text) is None:
        return None
    raw = text.encode("ascii")
    found = placed_decimals(raw.translate(_BARE))
    if found is None:
        return None
    numbers, ends = found
    characters = np.frombuffer(raw, np.uint8)
    at = np.flatnonzero(characters >= ord("A"))
    letters = characters[at]
    bounds = np.full(len(at) + 1, len(ends))
    bounds[:-1] = ends.searchsorted(at)
    counts, takes = bounds[1:] - bounds[:-1], _TAKEN[letters]
    # A letter that takes none is refused any, and one that takes some is refused none.
    if bounds[0] or (counts % takes).any() or ((counts > 0) == (takes == _NONE)).any():
        return None
    # One letter again and again, as some programs write it, is one command with many numbers.
    begins = np.ones(len(at), bool)
    begins[1:] = (letters[1:] != letters[:-1]) | _ALONE[letters[1:]]
    known, cuts = numbers.tolist(), [*bounds[:-1][begins].tolist(), len(ends)]
    names = letters[begins].tobytes().decode()
    return ((name, known[low:high]) for name, low, high in zip(names, cuts[:-1], cuts[1:], strict=True))


def _commands(text: str) -> Iterator[Command]:
    """Yield the commands of path data, and fail where they break off."""
    begin, *parts = _LETTER.split(text)
    if begin.strip():
        raise ValueError(f'path data "…{begin.strip()[:40]}" cannot be read')
    last, run = "", list[float]()
    for letter, chunk in zip(parts[::2], parts[1::2], strict=True):
        numbers = _numbers(letter, chunk)
        # One letter again and again, as some programs write it, is one command with many numbers.
        if letter == last and letter not in "MmZz":
            run += numbers
            continue
        if last:
            yield last, run
        last, run = letter, numbers
    if last:
        yield last, run


def _numbers(letter: str, text: str) -> list[float]:
    if letter in "Aa":
        found, at = list[float](), 0
        while match := _ARC.match(text, at):
            found += map(float, match.groups())
            at = match.end()
        read = None if text[at:].strip(" \t\r\n,") else found
    else:
        long = len(text) >= LONG and _DECIMALS.fullmatch(text)
        read = (decimals_in(text) if long else None) or _plain(text) or numbers_in(text)
    if read is None:
        raise ValueError(f'path data "{letter}{text[:40]}" cannot be read')
    takes = _TAKES[letter]
    if (len(read) % takes if takes else len(read)) or (takes and not read):
        some = f"{takes} or a multiple" if takes else "none"
        count = f"{len(read)} number{'' if len(read) == 1 else 's'}"
        raise ValueError(f'path command "{letter}" has {count}, expected {some}')
    return read


def _plain(text: str) -> list[float] | None:
    """Return numbers between which something stands, as most programs write them, or None."""
    if _PLAIN.fullmatch(text) is None:
        return None
    try:
        return list(map(float, text.replace(",", " ").replace("-", " -").split()))
    except ValueError:
        return None
