"""What a sweep varies: values of keys, all of them together or a sample, and what each variant is called.

    layout.dist=0.4:4:10          ten values from 0.4 to 4, evenly spaced
    tolerance=0.01:1:5:log        five values, each the same number of times the one before
    pistil.count=8,16,24          these values
    petal.length=0.5:1.5          any value between, for a sample

A sample takes Halton's sequence (1960), a prime to each key, whose digits are exchanged as the seed says
(Braaten and Weller 1979, at random): each key by itself is covered evenly, and no two of them in step.
"""

from __future__ import annotations

import hashlib
import itertools
import math
import re
from collections.abc import Iterator, Sequence

from batik_vector.errors import Fault, RecipeError, shortened
from batik_vector.values import frozen

MOST = 100_000
"""Variants of a sweep, unless more are asked for."""
LONGEST = 120
"""Bytes of a variant's name; where they do not do, a number stands for what was varied."""
DIGITS = 6
"""Significant digits of values in a range."""
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_RANGE = re.compile(rf"({_NUMBER})\s*([a-z]*):({_NUMBER})\s*([a-z]*)(?::(\d+)(:log)?)?")
_LIKE_RANGE = re.compile(rf"(?:{_NUMBER}|[+-]?(?:inf|nan)\b)\s*[a-z]*\s*:")
"""What begins as a range does, and is no time of day or other text of a recipe."""
_FORBIDDEN = re.compile(r"[^\w.+-]+")


@frozen
class Axis:
    """A key that is varied: its values as a recipe writes them, or bounds between which any will do."""

    key: str
    values: tuple[str, ...] = ()
    bounds: tuple[float, float] = (0.0, 0.0)
    unit: str = ""
    whole: bool = False
    changes: tuple[tuple[str, ...], ...] = ()
    """What each value sets, where that is more than the key."""

    def sets(self, value: str) -> tuple[str, ...]:
        """Return what a value sets in the recipe, as ``KEY=VALUE``."""
        return self.changes[self.values.index(value)] if self.changes else (f"{self.key}={value}",)

    def at(self, share: float) -> str:
        """Return the value a share of the way along, in [0, 1)."""
        if self.values:
            return self.values[int(share * len(self.values))]
        low, high = self.bounds
        if self.whole:
            return f"{int(low) + int(share * (high - low + 1))}{self.unit}"
        span = abs(high - low) or 1.0
        places = max(0, 3 - math.floor(math.log10(span)))
        return _written(round(low + share * (high - low), places), self.unit)


@frozen
class Variant:
    """One of the variants: its number from 0, its name, and what is set in the recipe, as ``KEY=VALUE``.

    ``values`` are those of the axes, in their order.
    """

    number: int
    name: str
    changes: tuple[str, ...]
    values: tuple[str, ...] = ()


def parse_axis(text: str) -> Axis:
    """Return what ``KEY=VALUES`` asks for; see the module.

    Raises:
        RecipeError: with what was expected.
    """
    key, equals, values = (part.strip() for part in text.partition("="))
    try:
        if not equals or not key or not values:
            raise ValueError("expected KEY=VALUES, such as petal.count=4,8,16 or layout.dist=0.4:4:10")
        if found := _RANGE.fullmatch(values):
            return _ranged(key, *found.groups())
        if _LIKE_RANGE.match(values):
            raise ValueError("expected START:STOP:COUNT, numbers and a whole COUNT, with or without :log")
        if not (parts := tuple(dict.fromkeys(_parts(values)))):
            raise ValueError("expected values between the commas")
        return Axis(key, parts)
    except ValueError as error:
        raise RecipeError([Fault(str(error), source=f"--vary {text[:80]}")]) from None


def _ranged(
    key: str, first: str, unit: str, last: str, unit_too: str, count: str | None, log: str | None
) -> Axis:
    low, high, unit = float(first), float(last), unit or unit_too
    if unit_too and unit_too != unit:
        raise ValueError(f"from {unit} to {unit_too}: expected one unit")
    if not (math.isfinite(low) and math.isfinite(high)):
        raise ValueError("expected numbers that are finite")
    whole = all(re.fullmatch(r"[+-]?\d+", each) for each in (first, last))
    if count is None:
        if low == high:
            raise ValueError(f"from {first} to {last} there is nothing between")
        return Axis(key, (), (min(low, high), max(low, high)), unit, whole)
    if not 1 <= int(count) <= MOST:
        raise ValueError(f"{int(count):,} values, expected 1 to {MOST:,}")
    if log and not low * high > 0:
        raise ValueError(f"a logarithmic range from {first} to {last}: expected ends of one sign, and not 0")
    return Axis(key, tuple(dict.fromkeys(_spaced(low, high, int(count), bool(log), unit))))


def _spaced(low: float, high: float, count: int, log: bool, unit: str) -> Iterator[str]:
    for number in range(count):
        share = number / (count - 1) if count > 1 else 0.0
        value = low * (high / low) ** share if log else low + (high - low) * share
        # Binary leftovers (0.30000000000000004) are in nobody's mind.
        yield _written(float(f"{value:.{DIGITS}g}"), unit)


def _written(value: float, unit: str) -> str:
    text = repr(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    return f"{text} {unit}" if unit else text


def _parts(text: str) -> Iterator[str]:
    """Yield what commas part, but for those in brackets, braces and quotes."""
    depth, quote, begin = 0, "", 0
    for at, sign in enumerate(text + ","):
        if quote:
            quote = "" if sign == quote else quote
        elif sign in "\"'":
            quote = sign
        elif sign in "[{":
            depth += 1
        elif sign in "]}":
            depth -= 1
        elif sign == "," and depth <= 0:
            if part := text[begin:at].strip():
                yield part
            begin = at + 1
    if quote or depth > 0:
        what = "a quote" if quote else "a bracket"
        raise ValueError(f'{what} is not closed in "{shortened(text[begin:].strip())}"')


def variants(
    axes: Sequence[Axis], stem: str, *, sample: int = 0, seed: int = 0, most: int = MOST
) -> Iterator[Variant]:
    """Return the variants of a sweep: every combination of values, the last axis first, or a sample of them.

    Args:
        axes: what is varied.
        stem: what their names begin with.
        sample: how many; 0 takes all combinations.
        seed: which sample.
        most: how many there may be.

    Raises:
        RecipeError: where there are none, or too many, with the count; or where two axes vary one key.
    """
    keys = [axis.key for axis in axes]
    if len(set(keys)) < len(keys):
        twice = next(key for key in keys if keys.count(key) > 1)
        raise RecipeError([Fault("is varied twice", source=f"--vary {twice}")])
    if not axes:
        raise RecipeError("nothing is varied: expected --vary KEY=VALUES")
    open_ = next((axis for axis in axes if not axis.values), None)
    if open_ is not None and not sample:
        words = "has no count of values: expected START:STOP:COUNT, or --random N for a sample"
        raise RecipeError([Fault(words, source=f"--vary {open_.key}")])
    count = sample or math.prod(len(axis.values) for axis in axes)
    if count > most:
        raise RecipeError(f"{count:,} variants, expected at most {most:,}: ask for fewer values, or --limit")
    chosen = _sampled(axes, sample, seed) if sample else itertools.product(*(axis.values for axis in axes))
    return _named(axes, stem, chosen, count)


def _named(
    axes: Sequence[Axis], stem: str, chosen: Iterator[tuple[str, ...]], count: int
) -> Iterator[Variant]:
    short, width = short_names([axis.key for axis in axes]), len(str(count - 1))
    taken: set[str] = set()
    for number, values in enumerate(chosen):
        told = "_".join(f"{key}-{_plain(value)}" for key, value in zip(short, values, strict=True))
        name = f"{stem}_{told}"
        if len(name.encode()) > LONGEST or name.lower() in taken:
            name = f"{stem}_{number:0{width}}"
        taken.add(name.lower())
        changes = [change for axis, value in zip(axes, values, strict=True) for change in axis.sets(value)]
        yield Variant(number, name, tuple(changes), values)


def short_names(keys: Sequence[str]) -> list[str]:
    """Return the ends of keys that tell them apart, as parts of a file's name: pistil-count, dist."""
    parted = [re.split(r"[.\[\]\"']+", key.rstrip("]\"'")) for key in keys]
    found = []
    for mine in parted:
        depth = 1
        while depth < len(mine) and sum(other[-depth:] == mine[-depth:] for other in parted) > 1:
            depth += 1
        found.append(_plain("-".join(part for part in mine[-depth:] if part not in ("", "*"))))
    return found


def _plain(text: str) -> str:
    """Return a text as far as it may stand in a file's name on any system."""
    return _FORBIDDEN.sub("-", text).strip("-.") or "none"


def _sampled(axes: Sequence[Axis], count: int, seed: int) -> Iterator[tuple[str, ...]]:
    """Yield points of Halton's sequence as values."""
    digits = [_Digits(base, seed) for base in itertools.islice(_primes(), len(axes))]
    for number in range(count):
        yield tuple(axis.at(each.mirrored(number)) for axis, each in zip(axes, digits, strict=True))


class _Digits:
    """The digits of numbers to a base, exchanged at each place after an order of its own."""

    def __init__(self, base: int, seed: int) -> None:
        self.base = base
        places = math.ceil(32 / math.log2(base))
        self._orders = [
            sorted(
                range(base),
                key=lambda digit: hashlib.sha256(repr((seed, base, place, digit)).encode()).digest(),
            )
            for place in range(places)
        ]

    def mirrored(self, number: int) -> float:
        """Return the digits of a number behind the point, the last first."""
        share, unit = 0.0, 1.0
        for order in self._orders:
            number, digit = divmod(number, self.base)
            unit /= self.base
            share += order[digit] * unit
        return min(share, 1.0 - 2.0**-40)


def _primes() -> Iterator[int]:
    found: list[int] = []
    for number in itertools.count(2):
        if all(number % prime for prime in found):
            found.append(number)
            yield number
