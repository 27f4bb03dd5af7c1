"""Words and rules are read as written, or refused in words that help."""

from __future__ import annotations

import contextlib

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from batik_vector.errors import GeometryError
from batik_vector.geometry.lsystems.grammar import Module, grammar_of

SLOW = [HealthCheck.too_slow]
"""Others may be at work on the machine."""


def test_numbers_of_symbols_are_lines_in_the_number_rewritten() -> None:
    grammar = grammar_of("A(2)", ["A(s) -> F(s/2)+(25.5)A(1 - s*0.5)F(-s)F(2*s*3 + 1)"], "F")
    numbers = [(m.symbol, m.slope, m.value) for m in grammar.rules[0].word]
    assert numbers == [("F", 0.5, 0), ("+", 0, 25.5), ("A", -0.5, 1), ("F", -1, 0), ("F", 6, 1)]
    assert grammar.axiom == (Module("A", 0.0, 2.0),)
    assert grammar.is_parametric
    assert not grammar.is_stochastic


def test_a_rule_may_have_a_weight_and_erase() -> None:
    grammar = grammar_of("F", ["F: 2 -> FF", "F:0.5->", " F -> [F] "], "F")
    assert [(rule.weight, len(rule.word)) for rule in grammar.rules] == [(2, 2), (0.5, 0), (1, 3)]
    assert grammar.is_stochastic


@pytest.mark.parametrize(
    ("axiom", "rules", "words"),
    [
        ("F[+F", [], 'axiom = "F[+F": unbalanced brackets: 1 "[" is not closed'),
        ("F", ["F -> F]F["], 'rules[0] = "F -> F]F[": unbalanced brackets: a "]" closes no branch'),
        ("FX", ["F -> FF"], 'axiom = "FX": unknown symbol "X": expected one with a rule'),
        ("F", ["F -> F?F"], 'unknown symbol "?"'),
        ("", [], 'axiom = "", expected a word'),
        ("F", ["F > FF"], 'rules[0] = "F > FF": expected a symbol, an arrow and a word'),
        ("F", ["FG -> FF"], "expected a symbol, an arrow and a word"),
        ("F", ["F: x -> FF"], '"x" is no weight'),
        ("F", ["F: 0 -> FF"], '"0" is no weight'),
        ("F", ["[ -> FF"], '"[" cannot be rewritten'),
        ("F(2", [], 'the "(" after F is not closed'),
        ("F(two)", [], '"two": expected a number'),
        ("F", ["F(s) -> F(t)"], '"t": expected numbers and multiples of "s"'),
        ("F", ["F(s) -> F(s*s)"], '"s*s": expected numbers and multiples'),
        ("F", ["F(s) -> F(1/s)"], "expected numbers and multiples"),
        ("F", ["F(s) -> F(s/0)"], "expected numbers and multiples"),
        ("F", ["F(s) -> F(1..2)"], "is no number"),
        ("F()", [], "is no number"),
        ("F)", [], 'a ")" that follows no symbol'),
    ],
)
def test_what_is_no_grammar_is_told(axiom: str, rules: list[str], words: str) -> None:
    with pytest.raises(GeometryError) as error:
        grammar_of(axiom, rules, "F")
    assert words in str(error.value)


@settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=SLOW)
@given(st.text(alphabet="F+-[]() ->s:2/*.X", max_size=40), st.text(alphabet="F+-[]()2.X", max_size=20))
def test_any_text_is_read_or_refused(rule: str, axiom: str) -> None:
    with contextlib.suppress(GeometryError):
        assert grammar_of(axiom, [rule], "F").axiom
