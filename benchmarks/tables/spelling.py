"""Tables in Markdown, and what stands in their cells."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from benchmarks.acceptance import seconds
from benchmarks.results import Results

NONE = "–"


def table(head: Sequence[str], body: Iterable[Sequence[str]], left: int = 1) -> list[str]:
    """Return a table; the first columns stand left, the others right."""
    rule = ["---"] * left + ["---:"] * (len(head) - left)
    return ["| " + " | ".join(row) + " |" for row in (head, rule, *body)]


def cost(results: Results, name: str, what: str = "cpu") -> str:
    """Return a median with its spread."""
    found = results.of(name, what)
    return NONE if found is None else f"{seconds(found.median)} ({seconds(found.low)}–{seconds(found.high)})"


def median(results: Results, name: str, what: str, spell: Callable[[float], str]) -> str:
    """Return a median, spelled."""
    found = results.of(name, what)
    return NONE if found is None else spell(found.median)
