"""Words have the length that was foretold, whichever way they are written."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from batik_vector.errors import TooLargeError
from batik_vector.geometry.lsystems import expansion
from batik_vector.geometry.lsystems.catalogue import NAMED
from batik_vector.geometry.lsystems.expansion import Word, expanded, foretold
from batik_vector.geometry.lsystems.grammar import grammar_of

SLOW = [HealthCheck.too_slow]
"""Others may be at work on the machine."""


def text(word: Word) -> str:
    return "".join(word.symbols[code] for code in word.codes.tolist())


def rewritten(axiom: str, rules: dict[str, str], level: int) -> str:
    for _ in range(level):
        axiom = "".join(rules.get(each, each) for each in axiom)
    return axiom


BODY = st.text(alphabet="ABF+-", max_size=5)


@settings(max_examples=50, deadline=None, derandomize=True, suppress_health_check=SLOW)
@given(BODY.filter(bool), BODY, BODY, st.integers(0, 5))
def test_words_are_rewritten_symbol_by_symbol(axiom: str, a: str, b: str, level: int) -> None:
    rules = {"A": a, "B": b, "F": "F"}
    grammar = grammar_of(axiom, [f"{symbol} -> {body}" for symbol, body in rules.items()], "F")
    expected = rewritten(axiom, rules, level)
    assert foretold(grammar, level) == len(expected)
    assert text(expanded(grammar, level)) == expected
    # The road of numbers and chance writes the same.
    assert text(expansion._rewritten(grammar, level, 0)) == expected


@pytest.mark.parametrize("name", NAMED)
def test_the_length_of_every_known_word_is_foretold(name: str) -> None:
    known = NAMED[name]
    grammar = grammar_of(known.axiom, known.rules, known.draws)
    assert foretold(grammar, known.level) == len(expanded(grammar, known.level).codes) > 20
    assert known.source


def test_words_too_long_are_refused_with_their_length() -> None:
    grammar = grammar_of("F", ["F -> FF"], "F")
    with pytest.raises(TooLargeError, match=r"level = 40 writes a word of about 10\^12 symbols"):
        expanded(grammar, 40)
    with pytest.raises(TooLargeError, match=r"word of 8,388,608 symbols, more than 5,000,000"):
        expanded(grammar, 23)
    with pytest.raises(TooLargeError, match="at least"):
        expanded(grammar_of("F", ["F -> FF", "F -> FFF"], "F"), 40)
    with pytest.raises(TooLargeError, match="past all bounds"):
        expanded(grammar_of("F(1)", ["F(s) -> F(s*1e200)"], "F"), 2)


def test_what_is_out_of_reach_costs_nothing() -> None:
    grammar = grammar_of("A", ["A -> B", "B -> BBBBBBBBBB"], "AB")
    assert len(expanded(grammar, 7).codes) == 10**6


def test_numbers_are_carried_from_level_to_level() -> None:
    word = expanded(grammar_of("A(8)", ["A(s) -> F(s)[A(s/2)]"], "F"), 3)
    assert word.values is not None
    assert word.values[~np.isnan(word.values)].tolist() == [8, 4, 2, 1]


def test_chance_hangs_on_the_seed_and_keeps_to_the_weights() -> None:
    grammar = grammar_of("F" * 2000, ["F: 3 -> F+", "F -> F-"], "F")
    one, same, other = (text(expanded(grammar, 1, seed)) for seed in (1, 1, 2))
    assert one == same != other
    assert 0.7 < one.count("+") / 2000 < 0.8
