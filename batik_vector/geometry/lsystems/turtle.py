"""The turtle: from a word to the lines that it draws, in bulk.

Prusinkiewicz & Lindenmayer, *The Algorithmic Beauty of Plants* (1990), §1.3 and §1.6: letters draw a step,
``f`` makes one and draws nothing, ``+`` turns left and ``-`` right, ``|`` turns about, brackets begin and end
a branch; ``!`` makes what follows thinner and ``"`` shorter. Every other symbol is passed over.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import GeometryError
from batik_vector.geometry.lsystems.branches import Branches
from batik_vector.geometry.lsystems.expansion import Word
from batik_vector.geometry.lsystems.grammar import CLOSE, OPEN
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.values import frozen

Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

NOTHING = "the turtle draws nothing at this level: expected a letter that draws in its word"
FULL = 360.0
MOST_WHOLE = 1 << 20
"""Headings in whole turns of the angle that are worked out once and for all."""


@frozen(eq=False)
class Walk:
    """What a turtle has drawn: strand number i is ``points[offsets[i]:offsets[i + 1]]``, x + iy in steps.

    ``widths`` are those of its points, 1 where the turtle begins. ``marks`` are the poses at the symbols that
    were asked for: for each of them places, directions (of length 1) and scales.
    """

    points: Complex
    offsets: Indices
    widths: Array
    marks: dict[str, tuple[Complex, Complex, Array]]


@frozen(eq=False)
class Gait:
    """How a turtle walks: its angles in degrees; what ``"`` and a branch leave of length and breadth."""

    angle: float
    heading: float = 0.0
    shrink: float = 1.0
    taper: float = 1.0


def walked(word: Word, draws: str, gait: Gait, marks: str = "") -> Walk:
    """Walk along a word.

    Args:
        word: the symbols.
        draws: letters that draw a step.
        gait: how.
        marks: symbols whose poses are wanted.

    Raises:
        GeometryError: where nothing is drawn, or numbers grow past all bounds.
    """
    plain = word.values is None and gait.taper == 1 and not marks
    if plain and not set(word.symbols) & set('[|!"'):
        return _plainly(word, draws, gait)
    is_draw, is_move = _which(word, draws), _which(word, "f")
    opened = _which(word, OPEN)
    branches = Branches.of(opened, _which(word, CLOSE)) if opened.any() else None

    def sums(steps: NDArray[np.float64]) -> Array:
        return branches.sums(steps) if branches else np.asarray(np.cumsum(steps))

    unit = _directions(word, gait, branches)
    scale = _factors(word, '"', gait.shrink, sums)
    step = (is_draw | is_move).astype(float)
    if word.values is not None:
        told = ~np.isnan(word.values) & (step > 0)
        step[told] = word.values[told]
    with np.errstate(over="ignore", invalid="ignore"):
        # What grows past all bounds is told below.
        if scale is not None:
            step *= scale
        move: Complex = unit * step
    at: Complex = branches.sums(move) if branches else np.asarray(np.cumsum(move))
    if not np.isfinite(at[-1:]).all() or not np.isfinite(at).all():
        raise GeometryError("its steps grow past all bounds: expected a lower level")
    drawn, start = _strands(is_draw, is_move, branches)
    if not len(drawn):
        raise GeometryError(NOTHING)
    points, offsets = _points(at, move, drawn, start)
    thin = _factors(word, "!", gait.taper, sums)
    widths = np.ones(len(points))
    if gait.taper != 1.0:
        width = _tapered(np.abs(move), is_draw, is_move, branches, gait.taper)
        if thin is not None:
            width = (width[0] * thin, width[1] * thin)
        widths = _at_points(width, drawn, start, len(points))
    found = {}
    for each in marks:
        mine = np.flatnonzero(_which(word, each))
        size = np.ones(len(mine)) if scale is None else scale[mine]
        found[each] = at[mine] - move[mine], unit[mine], size
    return Walk(points, offsets, widths, found)


def _plainly(word: Word, draws: str, gait: Gait) -> Walk:
    """Walk along a word of steps and turns alone: only what steps is looked at, behind the turns."""
    # Bytes are looked up in a table of bytes several times as fast as NumPy takes from one.
    text = word.codes.tobytes()
    steps = np.flatnonzero(_looked_up(text, [each in draws or each == "f" for each in word.symbols]))
    turns = _looked_up(text, [{"+": 1, "-": -1}.get(each, 0) for each in word.symbols])
    turned = turns.astype(np.int32)
    heading = np.cumsum(turned, out=turned)[steps]
    unit = _headed(heading, gait)
    at: Complex = np.cumsum(unit)
    is_draw = np.array([each in draws for each in word.symbols])[word.codes[steps]]
    drawn, start = _strands(is_draw, ~is_draw, None)
    if not len(drawn):
        raise GeometryError(NOTHING)
    points, offsets = _points(at, unit, drawn, start)
    return Walk(points, offsets, np.ones(len(points)), {})


def _looked_up(text: bytes, table: Sequence[int]) -> NDArray[np.int8]:
    """Return for each byte what a table of small numbers has for it."""
    row = np.zeros(256, np.int8)
    row[: len(table)] = table
    return np.frombuffer(text.translate(row.tobytes()), np.int8)


def _headed(turned: NDArray[np.int32] | NDArray[np.int64], gait: Gait) -> Complex:
    """Return the directions after so many turns."""
    parts = FULL / gait.angle if gait.angle else 1.0
    if abs(parts - round(parts)) < 1e-12 * parts:
        turned = turned % max(round(parts), 1)
    low, high = int(turned.min(initial=0)), int(turned.max(initial=0))
    if high - low > MOST_WHOLE:
        raise GeometryError("the turtle turns on the spot too often: expected a lower level")
    return np.asarray(_units(gait.heading + gait.angle * np.arange(low, high + 1))[turned - low])


def _which(word: Word, symbols: str) -> Mask:
    """Return which symbols of a word are one of several."""
    table = np.array([each in symbols for each in word.symbols] or [False])
    return np.asarray(table[word.codes])


def _directions(word: Word, gait: Gait, branches: Branches | None) -> Complex:
    """Return the direction behind every symbol, exact where turns are whole parts of a circle."""
    turn = np.array([{"+": 1, "-": -1}.get(each, 0) for each in word.symbols] or [0])
    whole: NDArray[np.int64] = turn[word.codes]
    about = _which(word, "|")
    extra: Array | None = None
    if word.values is not None:
        told = ~np.isnan(word.values) & (whole != 0)
        if told.any():
            degrees = np.where(told, np.nan_to_num(word.values) * whole, 0.0)
            whole = np.where(told, 0, whole)
            extra = branches.sums(degrees) if branches else np.asarray(np.cumsum(degrees))
    turned = branches.sums(whole) if branches else np.cumsum(whole)
    if about.any():
        halves = about.astype(np.int64)
        flipped = branches.sums(halves) if branches else np.cumsum(halves)
    else:
        flipped = np.zeros(1, np.int64)
    unit = _headed(turned, gait)
    if extra is not None:
        unit = unit * _units(extra)
    return np.where(flipped % 2 == 1, -unit, unit) if about.any() else unit


def _units(degrees: NDArray[Any]) -> Complex:
    """Return directions; those of whole quarters, thirds and sixths of a turn have exact halves and ones."""
    angle = np.radians(np.fmod(degrees, FULL))
    unit: Complex = np.exp(1j * angle)
    x, y = unit.real.copy(), unit.imag.copy()
    for part in (x, y):
        near = np.rint(part * 2) / 2
        close = np.abs(part - near) < 1e-12
        part[close] = near[close]
    return np.asarray(x + 1j * y)


def _factors(word: Word, symbol: str, usual: float, sums: Callable[[Array], Array]) -> Array | None:
    """Return the product of all factors on the way to each symbol, or None where there are none."""
    mine = _which(word, symbol)
    if not mine.any():
        return None
    factor = np.where(mine, usual, 1.0)
    if word.values is not None:
        told = mine & ~np.isnan(word.values)
        factor[told] = word.values[told]
    if not (factor > 0).all():
        raise GeometryError(f'a factor of {factor.min():g} at "{symbol}", expected one above 0')
    with np.errstate(over="ignore"):
        return np.asarray(np.exp(sums(np.log(factor))))


def _strands(is_draw: Mask, is_move: Mask, branches: Branches | None) -> tuple[Indices, Indices]:
    """Return the symbols that draw, strand by strand, and which of them each strand begins with."""
    if branches is None and is_draw.all():
        return np.arange(len(is_draw)), np.zeros(1, np.intp)
    order = branches.order if branches else np.arange(len(is_draw))
    breaks = is_move[order] | branches.opens if branches else is_move
    number = np.cumsum(breaks)
    draws = np.flatnonzero(is_draw[order])
    own = number[draws]
    start = np.flatnonzero(np.append(True, own[1:] != own[:-1])[: len(own)])
    return np.asarray(order[draws]), start


def _points(at: Complex, move: Complex, drawn: Indices, start: Indices) -> tuple[Complex, Indices]:
    """Return the points of strands: where each begins, and then the end of every step."""
    begins = at[drawn[start]] - move[drawn[start]]
    if len(start) == 1 and len(drawn) == len(at):
        return np.concatenate([begins, at]), np.array([0, len(at) + 1], np.intp)
    points = np.insert(at[drawn], start, begins)
    offsets = np.append(start + np.arange(len(start)), len(points)).astype(np.intp)
    return np.asarray(points), offsets


def _tapered(
    length: Array, is_draw: Mask, is_move: Mask, branches: Branches | None, taper: float
) -> tuple[Array, Array]:
    """Return the widths before and behind every symbol.

    A strand narrows along its length to ``taper`` of the width with which it begins; what branches off begins
    with ``taper`` of the width there.
    """
    count = len(length)
    order = branches.order if branches else np.arange(count)
    bounds = branches.bounds if branches else np.array([0, count])
    before, behind = np.ones(count), np.ones(count)
    for low, high in pairwise(bounds.tolist()):
        mine = order[low:high]
        opens = branches.opens[low:high] if branches else np.zeros(len(mine), bool)
        begins = np.flatnonzero(opens | (np.arange(len(mine)) == 0))
        run = np.where(is_draw[mine], length[mine], 0.0)
        total = np.cumsum(run)
        group = np.diff(np.append(begins, len(mine)))
        gone = total - np.repeat(total[begins] - run[begins], group)
        whole = np.repeat(gone[np.append(begins[1:], len(mine)) - 1], group)
        parent = mine[begins] - 1
        base = np.where(opens[begins], behind[np.maximum(parent, 0)] * taper, 1.0)
        base[(parent < 0) & opens[begins]] = taper
        share = gone / np.where(whole > 0, whole, 1.0)
        earlier = (gone - run) / np.where(whole > 0, whole, 1.0)
        first = np.repeat(base, group)
        behind[mine], before[mine] = first * (1 - (1 - taper) * share), first * (1 - (1 - taper) * earlier)
    return before, behind


def _at_points(width: tuple[Array, Array], drawn: Indices, start: Indices, count: int) -> Array:
    before, behind = width
    widths = np.insert(behind[drawn], start, before[drawn[start]])
    assert len(widths) == count
    return np.asarray(widths)
