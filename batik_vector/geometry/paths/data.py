"""SVG path data, parsed to outlines of lines and cubic Béziers."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from batik_vector.errors import GeometryError
from batik_vector.fields.fitting import shown
from batik_vector.geometry.paths.bulk import commands_of
from batik_vector.geometry.paths.outline import Outline
from batik_vector.geometry.paths.pen import Command, drawn
from batik_vector.patterns import NUMBER, numbers_in

_COMMAND = re.compile(r"([MmZzLlHhVvCcSsQqTtAa])([^MmZzLlHhVvCcSsQqTtAa]*)")
_TOKEN = re.compile(rf"{NUMBER}|[^\s,]")
_LETTERS = frozenset("MmZzLlHhVvCcSsQqTt")
_ARC = re.compile(
    r"[\s,]*+({0})[\s,]*+({0})[\s,]*+({0})[\s,]*+([01])[\s,]*+([01])[\s,]*+({0})[\s,]*+({0})".replace(
        "{0}", NUMBER
    )
)
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_TAKES |= {letter.lower(): takes for letter, takes in _TAKES.items()}


def parse_path(text: str) -> Outline:
    """Return the outline that path data draw (SVG 2, 9.3); a mere move draws no subpath.

    Raises:
        ValueError: where the data break off or are none.
    """
    commands = commands_of(text) or _tokens(text)
    return drawn(_commands(text) if commands is None else commands)


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


def _tokens(text: str) -> list[Command] | None:
    """Return the commands of sound path data without arcs, read at once; None of any other."""
    if "a" in text or "A" in text:
        return None
    tokens = _TOKEN.findall(text)
    places = [place for place, token in enumerate(tokens) if token in _LETTERS]
    if not places or places[0] != 0:
        return None
    places.append(len(tokens))
    commands, last = list[Command](), ""
    try:
        for place, after in pairwise(places):
            letter = tokens[place]
            takes, count = _TAKES[letter], after - place - 1
            if count % takes or not count if takes else count:
                return None
            numbers = list(map(float, tokens[place + 1 : after]))
            # One letter again and again, as some programs write it, is one command with many numbers.
            if letter == last and letter not in "MmZz":
                commands[-1][1].extend(numbers)
            else:
                commands.append((letter, numbers))
            last = letter
    except ValueError:
        return None
    return commands


def _commands(text: str) -> Iterator[Command]:
    """Yield the commands of path data, and fail where they break off."""
    at = 0
    for match in _COMMAND.finditer(text):
        if text[at : match.start()].strip():
            break
        at = match.end()
        yield match[1], _numbers(match[1], match[2])
    if text[at:].strip():
        raise ValueError(f'path data "…{text[at : at + 40].strip()}" cannot be read')


def _numbers(letter: str, text: str) -> list[float]:
    if letter in "Aa":
        found, at = list[float](), 0
        while match := _ARC.match(text, at):
            found += map(float, match.groups())
            at = match.end()
        read = None if text[at:].strip(" \t\r\n,") else found
    else:
        read = numbers_in(text)
    if read is None:
        raise ValueError(f'path data "{letter}{text[:40]}" cannot be read')
    takes = _TAKES[letter]
    if (len(read) % takes if takes else len(read)) or (takes and not read):
        some = f"{takes} or a multiple" if takes else "none"
        count = f"{len(read)} number{'' if len(read) == 1 else 's'}"
        raise ValueError(f'path command "{letter}" has {count}, expected {some}')
    return read
