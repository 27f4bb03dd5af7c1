"""Rewriting: how long a word will be, told before it is written, and the word itself, in bulk."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from batik_vector.errors import TooLargeError
from batik_vector.geometry.lsystems.grammar import Grammar, Module, Rule
from batik_vector.geometry.sampling import Array, Indices
from batik_vector.values import frozen

LONGEST = 5_000_000
"""Symbols of a word at most: its line alone would then take as long to draw as a whole cloth."""

Codes = NDArray[np.uint8]


@frozen(eq=False)
class Word:
    """A word: ``codes`` are places in ``symbols``; ``values`` the numbers they carry, nan for none."""

    symbols: str
    codes: Codes
    values: Array | None = None


def foretold(grammar: Grammar, level: int) -> int:
    """Return how many symbols the word of a level has: the sum of the axiom's counts times Mᵏ.

    M is the matrix of a system: how often each rule writes each symbol. Where chance chooses it is the
    longest rule of each symbol that counts.
    """
    grown = {symbol: Counter(m.symbol for m in rule.word) for symbol, rule in _longest(grammar).items()}
    count = Counter(module.symbol for module in grammar.axiom)
    for _ in range(level):
        longer: Counter[str] = Counter()
        for symbol, times in count.items():
            for written, often in grown.get(symbol, {symbol: 1}).items():
                longer[written] += often * times
        count = longer
    return sum(count.values())


def expanded(grammar: Grammar, level: int, seed: int = 0) -> Word:
    """Return the word of a level.

    Args:
        grammar: the system.
        level: how often all symbols are rewritten at once.
        seed: of the chance by which symbols of several rules are rewritten.

    Raises:
        TooLargeError: with the length, before anything is written.
    """
    if not grammar.is_stochastic:
        length = foretold(grammar, level)
        if length > LONGEST:
            raise _too_long(level, length, "")
        if not grammar.is_parametric:
            return _joined(grammar, level)
    return _rewritten(grammar, level, seed)


def _too_long(level: int, length: int, about: str) -> TooLargeError:
    told = f"{length:,}" if length < 10**9 else f"about 10^{math.floor(math.log10(length))}"
    return TooLargeError(
        f"level = {level} writes a word of {about}{told} symbols, more than {LONGEST:,}: "
        "expected a lower level"
    )


def _longest(grammar: Grammar) -> Mapping[str, Rule]:
    """Return the longest rule of each symbol."""
    found: dict[str, Rule] = {}
    for rule in grammar.rules:
        if rule.symbol not in found or len(rule.word) > len(found[rule.symbol].word):
            found[rule.symbol] = rule
    return found


def _alphabet(grammar: Grammar) -> str:
    words = [grammar.axiom, *(rule.word for rule in grammar.rules)]
    written = {module.symbol for word in words for module in word} | {rule.symbol for rule in grammar.rules}
    return "".join(sorted(written))


def _joined(grammar: Grammar, level: int) -> Word:
    """Return a word of plain symbols: what one becomes in k steps is joined of what others do in k − 1."""
    symbols = _alphabet(grammar)
    code = {symbol: number for number, symbol in enumerate(symbols)}
    body = {code[rule.symbol]: [code[m.symbol] for m in rule.word] for rule in grammar.rules}
    axiom = [code[module.symbol] for module in grammar.axiom]
    needed = [set(axiom)]
    for _ in range(level):
        needed.append({c for each in needed[-1] for c in body.get(each, [each])})
    words = {each: bytes([each]) for each in needed[-1]}
    for wanted in reversed(needed[:-1]):
        words = {each: b"".join([words[c] for c in body.get(each, [each])]) for each in sorted(wanted)}
    return Word(symbols, np.frombuffer(b"".join([words[c] for c in axiom]), np.uint8))


def _rewritten(grammar: Grammar, level: int, seed: int) -> Word:
    """Return a word whose symbols carry numbers, or are rewritten by chance."""
    symbols = _alphabet(grammar)
    table = _Table.of(grammar, symbols)
    codes, values = table.word(grammar.axiom)
    for step in range(level):
        rule = table.chosen(codes, np.random.default_rng((seed, step)))
        count = table.length[rule]
        total = int(count.sum())
        if total > LONGEST:
            raise _too_long(level, total, "at least ")
        source = np.repeat(np.arange(len(codes)), count)
        place = np.arange(total) + np.repeat(table.start[rule] - (np.cumsum(count) - count), count)
        with np.errstate(over="ignore"):
            given: Array = table.slope[place] * np.nan_to_num(values[source], nan=1.0)
            # What is written by no rule stays what it is.
            kept = np.repeat(rule < len(symbols), count)
            values = np.where(kept, values[source], given + table.constant[place])
        codes = table.codes[place]
        if np.isinf(values).any():
            raise TooLargeError(
                f"level = {level}: the numbers of its symbols grow past all bounds: expected a lower level"
            )
    return Word(symbols, codes, values if grammar.is_parametric else None)


@frozen(eq=False)
class _Table:
    """All rules as arrays: the first ones, one for each symbol, write the symbol itself."""

    codes: Codes
    slope: Array
    constant: Array
    start: Indices
    length: Indices
    first: Indices
    shares: tuple[Array, ...]
    symbols: str

    @staticmethod
    def of(grammar: Grammar, symbols: str) -> _Table:
        """Return the table of a grammar."""
        words: list[Sequence[Module]] = [(Module(each),) for each in symbols]
        first, shares = list(range(len(symbols))), [np.ones(1)] * len(symbols)
        for number, symbol in enumerate(symbols):
            mine = [rule for rule in grammar.rules if rule.symbol == symbol]
            if mine:
                first[number] = len(words)
                words += [rule.word for rule in mine]
                weight = np.cumsum([rule.weight for rule in mine])
                shares[number] = weight / weight[-1]
        flat = [module for word in words for module in word]
        length = np.array([len(word) for word in words], np.intp)
        return _Table(
            np.array([symbols.index(module.symbol) for module in flat], np.uint8),
            np.array([module.slope for module in flat]),
            np.array([np.nan if module.value is None else module.value for module in flat]),
            np.asarray(np.cumsum(length) - length, np.intp),
            length,
            np.array(first, np.intp),
            tuple(shares),
            symbols,
        )

    def word(self, modules: Sequence[Module]) -> tuple[Codes, Array]:
        """Return a word as arrays."""
        codes = np.array([self.symbols.index(module.symbol) for module in modules], np.uint8)
        return codes, np.array([np.nan if module.value is None else module.value for module in modules])

    def chosen(self, codes: Codes, chance: np.random.Generator) -> Indices:
        """Return by which rule each symbol is rewritten."""
        rule: Indices = self.first[codes]
        for number, share in enumerate(self.shares):
            if len(share) > 1:
                mine = np.flatnonzero(codes == number)
                rule[mine] += np.searchsorted(share, chance.random(len(mine)), side="right")
        return rule
