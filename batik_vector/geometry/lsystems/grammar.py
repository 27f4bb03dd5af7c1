"""The grammar of an L-system: its axiom and rules read from text, and what is wrong with them in words.

A symbol is one character; one may carry a number, as ``F(2)`` or ``+(25.7)``. A rule that names the number,
``F(s) -> F(s/3)+F(s/3)``, makes the numbers of what it writes by sums, products and quotients with constants.
Prusinkiewicz & Lindenmayer, *The Algorithmic Beauty of Plants* (1990), §1.10.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence

from batik_vector.errors import GeometryError, shortened
from batik_vector.values import frozen

OPEN, CLOSE = "[", "]"
TURTLE = '+-|[]!"f'
"""What the turtle knows beside the letters that draw: turns, branches, thinner, shorter, and a bare step."""

MOST_RULES, LONGEST_RULE = 200, 10_000
"""Rules of one system, and characters of one rule."""

MOST_SYMBOLS = 250
"""Symbols of one system: their numbers are bytes."""

_HEAD = re.compile(r"\s*+([^\s])\s*+(?:\(\s*+([a-z]\w*+)\s*+\))?\s*+(?::\s*+(\S++))?\s*+", re.ASCII)
_FACTOR = r"(?:(?:\d++\.?+\d*+|\.\d++)(?:[eE][-+]?+\d++)?|[a-zA-Z]\w*+)"
_TERM = re.compile(rf"\s*+([-+]?+)\s*+({_FACTOR}(?:\s*+[*/]\s*+{_FACTOR})*)\s*+", re.ASCII)
_FACTORS = re.compile(rf"([*/]?+)\s*+({_FACTOR})", re.ASCII)


@frozen
class Module:
    """A symbol of a word. Its number is ``slope`` · (that of the symbol it is written for) + ``value``.

    A ``value`` of None is no number: the symbol hands on nothing.
    """

    symbol: str
    slope: float = 0.0
    value: float | None = None


@frozen
class Rule:
    """What a symbol is rewritten to, and how often beside the other rules of that symbol."""

    symbol: str
    word: tuple[Module, ...]
    weight: float = 1.0


@frozen
class Grammar:
    """An axiom, the rules of each symbol, and which letters draw a step."""

    axiom: tuple[Module, ...]
    rules: tuple[Rule, ...]
    draws: str

    @property
    def is_stochastic(self) -> bool:
        """Whether some symbol has several rules, of which chance takes one."""
        return len({rule.symbol for rule in self.rules}) < len(self.rules)

    @property
    def is_parametric(self) -> bool:
        """Whether some symbol carries a number."""
        words = [self.axiom, *(rule.word for rule in self.rules)]
        return any(module.value is not None for word in words for module in word)


def grammar_of(axiom: str, rules: Sequence[str], draws: str) -> Grammar:
    """Read an L-system.

    Args:
        axiom: the word to begin with, such as ``"F--F--F"``.
        rules: such as ``"F -> F+F--F+F"``; ``"F: 2 -> FF"`` is taken twice as often as another rule of F.
        draws: letters that draw a step.

    Raises:
        GeometryError: for unbalanced brackets, symbols that mean nothing, and rules that are none, naming
            the word.
    """
    if len(rules) > MOST_RULES:
        raise GeometryError(f"rules = a list of {len(rules)}, expected {MOST_RULES} at most")
    for letter in draws:
        if not letter.isalpha() or letter == "f":
            raise GeometryError(
                f'draws = "{shortened(draws)}": "{letter}" is no letter but f that could draw a step'
            )
    read = tuple(_rule(text, f"rules[{number}]") for number, text in enumerate(rules))
    begin = tuple(_modules(axiom, "", "axiom"))
    if not begin:
        raise GeometryError('axiom = "", expected a word to begin with, such as "F"')
    known = {*TURTLE, *draws, *(rule.symbol for rule in read)}
    if len(known) > MOST_SYMBOLS:
        raise GeometryError(f"rules of {len(known)} symbols, expected {MOST_SYMBOLS} at most")
    words = [("axiom", axiom, begin)]
    words += [
        (f"rules[{n}]", text, rule.word) for n, (text, rule) in enumerate(zip(rules, read, strict=True))
    ]
    for key, text, word in words:
        _refuse_unknown(word, known, key, text)
        _refuse_unbalanced(word, key, text)
    return Grammar(begin, read, draws)


def _rule(text: str, key: str) -> Rule:
    head, arrow, body = text.partition("->")
    found = _HEAD.fullmatch(head)
    if not arrow or not found:
        raise _fault(key, text, 'expected a symbol, an arrow and a word, such as "F -> F+F--F+F"')
    symbol, name, weight = found.groups()
    if symbol in "[]()":
        raise _fault(key, text, f'"{symbol}" cannot be rewritten')
    try:
        share = float(weight) if weight else 1.0
    except ValueError:
        share = 0.0
    if not 1e-6 <= share <= 1e6:
        raise _fault(
            key, text, f'"{shortened(weight)}" is no weight, expected a number from 1e-06 to 1000000'
        )
    return Rule(symbol, tuple(_modules(body, name or "", key)), share)


def _modules(text: str, name: str, key: str) -> Iterator[Module]:
    """Yield the symbols of a word, of which the number of the rewritten symbol is called ``name``."""
    if len(text) > LONGEST_RULE:
        raise GeometryError(f"{key}: a word of {len(text):,} characters, expected {LONGEST_RULE:,} at most")
    place = 0
    while place < len(text):
        symbol = text[place]
        place += 1
        if symbol.isspace():
            continue
        if symbol in "()":
            raise _fault(key, text, f'a "{symbol}" that follows no symbol')
        if text[place : place + 1] != "(":
            yield Module(symbol)
            continue
        end = text.find(")", place)
        if end < 0:
            raise _fault(key, text, f'the "(" after {symbol} is not closed')
        yield Module(symbol, *_linear(text[place + 1 : end], name, key, text))
        place = end + 1


def _linear(words: str, name: str, key: str, text: str) -> tuple[float, float]:
    """Return slope and constant of an expression in ``name``: sums of products and quotients, no brackets."""
    slope = constant = 0.0
    place = 0
    while place < len(words) or not place:
        found = _TERM.match(words, place)
        if not found or (place and not found[1]):
            raise _fault(key, text, f'"{shortened(words)}" is no number, expected such as "0.5" or "s*0.7"')
        term = _product(found[2], name)
        if term is None:
            expected = f'numbers and multiples of "{name}"' if name else "a number"
            raise _fault(key, text, f'"{shortened(words)}": expected {expected}')
        sign = -1.0 if found[1] == "-" else 1.0
        slope, constant = slope + sign * term[0], constant + sign * term[1]
        place = found.end()
    return slope, constant


def _product(words: str, name: str) -> tuple[float, float] | None:
    """Return a product as slope and constant, or None where it is no line in ``name``, or not finite."""
    slope, constant = 0.0, 1.0
    for operator, factor in _FACTORS.findall(words):
        if factor == name and name and operator != "/" and not slope:
            slope, constant = constant, 0.0
        elif factor[0].isalpha() or (operator == "/" and not float(factor)):
            return None
        else:
            by = 1 / float(factor) if operator == "/" else float(factor)
            slope, constant = slope * by, constant * by
    return (slope, constant) if math.isfinite(slope) and math.isfinite(constant) else None


def _refuse_unknown(word: Sequence[Module], known: set[str], key: str, text: str) -> None:
    for module in word:
        if module.symbol not in known:
            raise _fault(
                key,
                text,
                f'unknown symbol "{module.symbol}": expected one with a rule, one that draws, or one of '
                '+ - | [ ] ! " f',
            )


def _refuse_unbalanced(word: Sequence[Module], key: str, text: str) -> None:
    depth = 0
    for module in word:
        depth += (module.symbol == OPEN) - (module.symbol == CLOSE)
        if depth < 0:
            raise _fault(key, text, 'unbalanced brackets: a "]" closes no branch')
    if depth:
        raise _fault(
            key, text, f'unbalanced brackets: {depth} "[" {"is" if depth == 1 else "are"} not closed'
        )


def _fault(key: str, text: str, words: str) -> GeometryError:
    return GeometryError(f'{key} = "{shortened(text.strip())}": {words}')
