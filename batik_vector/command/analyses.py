"""What ``batik-vector analyse`` finds out: recipes and drawings, told of in the paper's terms."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from batik_vector.analysis import COLUMNS, Analysis, analyse
from batik_vector.command.drawing_files import is_drawing
from batik_vector.errors import Fault, RecipeError
from batik_vector.recipe.reading.sources import is_compiled
from batik_vector.units import format_mm

MOST_INKS = 6
"""Inks whose coverage is told in words."""


def analyse_source(source: str, overrides: Sequence[str], tell: Callable[[str], None]) -> dict[str, Any]:
    """Return what is found of a recipe's tile, or of a drawing, whatever recipe it carries, as plain values.

    Raises:
        RecipeError: where it cannot be read, or the call asks of it what it cannot give.
    """
    if is_drawing(source):
        if overrides:
            words = f"is measured as it is drawn, which --set {overrides[0]} cannot change: give its recipe"
            raise RecipeError([Fault(words, source=source)])
        tell(f"reading {Path(source).name}")
        return _facts(source, "geometry", analyse(source))
    # What compiles recipes is imported for them alone: a drawing is measured in half a second.
    from batik_vector.making.jobs import read_jobs
    from batik_vector.making.running import made

    (job,) = read_jobs([source], overrides)
    artwork = made(job, tell)
    tell("measuring")
    facts = _facts(source, "recipe", analyse(artwork))
    if is_compiled(source):
        facts["notes"].append("the recipe that it carries was analysed, not what the file draws")
    return facts


def _facts(source: str, analysed: str, found: Analysis) -> dict[str, Any]:
    return {"recipe": source, "analysed": analysed, **found.as_dict()}


def told(facts: dict[str, Any]) -> Iterator[str]:
    """Yield the lines that tell what was found of a drawing."""
    yield f"{facts['recipe']}: {facts['title']}"
    yield f"  {', '.join(facts['row'].values())}"
    if not facts["judged"]:
        yield f"  cannot be judged as a flower: {facts['reason']}"
    yield from _flower(facts)
    inks = ", ".join(f"{name} {100 * share:.1f} %" for name, share in list(facts["inks"].items())[:MOST_INKS])
    widths = facts["line_widths_mm"]
    lines = (
        f"lines {' to '.join(dict.fromkeys(format_mm(round(each, 2)) for each in widths))} mm; "
        if widths
        else ""
    )
    yield f"  covers {100 * facts['covers']:.1f} % ({inks}); {lines}{facts['nodes']:,} nodes"
    fit = facts["box_dimension"]
    if fit is not None:
        yield (
            f"  box dimension {fit['dimension']:.3f}, fitted from boxes of {fit['from_mm']:.2g} to "
            f"{fit['to_mm']:.3g} mm, residual {fit['residual']:.3f}"
        )
    yield from (f"  note: {words}" for words in facts["notes"])


def _flower(facts: dict[str, Any]) -> Iterator[str]:
    marks, kinds = (
        f"{facts[of]:,} {word}{'s' * (facts[of] != 1)}"
        for of, word in (("marks", "mark"), ("kinds", "shape"))
    )
    yield f"  {marks} of {kinds}; symmetry {_group(facts)}"
    if facts["centre_mm"] is not None:
        yield f"  flower {_place(facts)}"
        yield from _layers(facts)
    for other in facts["others"]:
        yield f"  another {_place(other)}: {', '.join(other['row'].values())}; {_group(other)}"
        yield from _layers(other)


def _group(facts: dict[str, Any]) -> str:
    return f"{facts['symmetry']['group']}, {facts['symmetry']['kind']}"


def _place(facts: dict[str, Any]) -> str:
    x, y = (format_mm(round(value, 2)) for value in facts["centre_mm"])
    alike = f", one of {facts['flowers']:,} alike" if facts["flowers"] > 1 else ""
    return f"about {x}, {y} mm with a radius of {format_mm(round(facts['reach_mm'], 2))} mm{alike}"


def _layers(facts: dict[str, Any]) -> Iterator[str]:
    for layer in facts["layers"]:
        shapes = " and ".join(layer["shapes"])
        yield f"    {layer['petals']} {shapes} petals that reach {format_mm(round(layer['outer_mm'], 2))} mm"


def table(sources: Sequence[str], found: Sequence[dict[str, Any]]) -> list[str]:
    """Return a table of many sources, one line each in the columns of Table 2, those that could not be read
    too."""
    known = {facts["recipe"]: facts for facts in found}
    rows: list[tuple[str, ...]] = [("", *COLUMNS)]
    for source in dict.fromkeys(sources):
        facts = known.get(source)
        if facts is None:
            rows.append((source, "error", *[""] * (len(COLUMNS) - 1)))
        else:
            rows.append((source, *(facts["row"][name] for name in COLUMNS)))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip() for row in rows
    ]
