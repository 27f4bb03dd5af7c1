"""How large the drawings are, and how often everything runs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Plan:
    """How large and how often."""

    rings: int
    """Marks of the drawing."""
    few: int
    """Marks of a small one."""
    growth: tuple[int, ...]
    """Marks of the drawing as it grows."""
    overlays: tuple[int, ...]
    """The same where marks are welded, or lines joined."""
    squares: int
    """Squares in a row whose sides are drawn twice."""
    merged: int
    """Squares in a row whose sides are joined."""
    plotted: int
    """Squares in a row of which a plotter draws each side once."""
    strokes: tuple[int, ...]
    """Strokes that are brought into order."""
    cloth: tuple[int, ...]
    """Lengths of cloth in metres."""
    patterns: int
    """Patterns in a library."""
    variants: int
    """Variants of a sweep."""
    hilbert: int
    """Level of Hilbert's curve: 9 writes 873,811 symbols."""
    dragon: int
    """Level of the dragon: 16 writes 131,071 symbols, beyond which others take minutes."""
    samples: int
    """Samples across and up a field whose rings are drawn."""
    dots: int
    """Dots of a fill."""
    packed: int
    """Sides in mm of a tile that leaves are packed on."""
    rounds: int
    """How often everything runs."""
    starts: int
    """Rounds of what is over soon."""


FULL = Plan(
    rings=10_000,
    few=1_000,
    growth=(100, 1_000, 10_000, 40_000),
    overlays=(100, 1_000, 10_000),
    squares=40,
    merged=160,
    plotted=80,
    strokes=(1_000, 10_000, 100_000),
    cloth=(1, 3, 10),
    patterns=10_000,
    variants=200,
    hilbert=9,
    dragon=16,
    samples=2_000,
    dots=100_000,
    packed=300,
    rounds=5,
    starts=11,
)

QUICK = Plan(
    rings=400,
    few=100,
    growth=(100, 400, 1_600),
    overlays=(100, 400),
    squares=12,
    merged=30,
    plotted=12,
    strokes=(100, 400),
    cloth=(1,),
    patterns=200,
    variants=20,
    hilbert=5,
    dragon=8,
    samples=200,
    dots=1_000,
    packed=100,
    rounds=2,
    starts=3,
)
