"""Write docs/recipe.md from the program itself: every key, its bounds, its default and its help.

So are the table of features in docs/library.md and that of machines in docs/audit.md.

Bounds and help are said once, beside the attribute they belong to; this page is read off them.
``python tools/reference.py`` writes it, ``--check`` tells whether it is stale.
"""

from __future__ import annotations

import argparse
import ast
import dataclasses
import enum
import inspect
import itertools
import json
import sys
import types
import typing
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any

from batik_vector.artwork import Overlap
from batik_vector.fields import HIDDEN, Between, LengthUnit, OneOf, Says, Several
from batik_vector.geometry.curves import CURVES, AttractorMap, FractalName, Origin, YAxis
from batik_vector.geometry.maps import VARIATIONS
from batik_vector.geometry.regions import FillRule
from batik_vector.library.features import FEATURES
from batik_vector.machines import MACHINES, Limits, Machine, Motion, Tool, Twice
from batik_vector.machines.gcode import Comment, Gcode, Stop
from batik_vector.processes.hatching.options import HATCHES
from batik_vector.processes.options import PROCESSES
from batik_vector.recipe.border import BorderSpec, Corner, Ends, Facing, RailSpec
from batik_vector.recipe.colourways import ColourwaySpec
from batik_vector.recipe.drawing import Dressing, Svg
from batik_vector.recipe.fills import FILLS, Follow, Rows, Style
from batik_vector.recipe.lsystem import Grown, Growth
from batik_vector.recipe.model import ClothSpec, InkSpec, Placement, Recipe, YardageSpec
from batik_vector.recipe.motif import (
    MOTIFS,
    Core,
    Dress,
    Element,
    Flower,
    Leaf,
    PathMotif,
    Petals,
    Pistil,
    Rosette,
    Treatment,
)
from batik_vector.recipe.motifs.composing import Composed, Isen, Plate
from batik_vector.recipe.outputs import OUTPUTS
from batik_vector.recipe.reading.machines import read_machine
from batik_vector.tiling.cloth.spec import Align, Edge
from batik_vector.tiling.layouts import LAYOUTS, Clear, MapSpec, Spot, Term
from batik_vector.tiling.symmetry.friezes import FRIEZES
from batik_vector.tiling.symmetry.groups import GROUPS
from batik_vector.tiling.symmetry.machine_fit import Fit
from batik_vector.tiling.symmetry.repeats import Cut, TileSpec
from batik_vector.tiling.symmetry.spread import Spread
from batik_vector.units import MM_PER_UNIT, format_mm

PAGE = Path(__file__).resolve().parent.parent / "docs" / "recipe.md"

HEAD = """# The recipe

A recipe is a [TOML](https://toml.io) file. Lengths on cloth carry a unit ({units});
a bare number is millimetres. Motifs are measured in units of their own, in which the paper's petal is
1 long. Angles are degrees, anticlockwise. `batik-vector schema` prints all this for editors;
`batik-vector new` writes a recipe to begin with. This page is made from the program by `make docs`.
"""


def marks_of(hint: Any) -> tuple[Any, list[Any]]:
    """Return a type without its annotations, and all of these, however deep they stand."""
    found: list[Any] = []
    while typing.get_origin(hint) in (Annotated, types.UnionType, typing.Union):
        if typing.get_origin(hint) is not Annotated:
            inner = [arg for arg in typing.get_args(hint) if arg is not type(None)]
            if len(inner) != 1:
                break
            hint = inner[0]
            continue
        found += hint.__metadata__
        hint = hint.__origin__
    return hint, found


def expected(hint: Any) -> str:
    """Say in a few words what a key takes."""
    base, marks = marks_of(hint)
    bounds = next((mark for mark in marks if isinstance(mark, Between)), None)
    catalogue = next((mark for mark in marks if isinstance(mark, OneOf)), None)
    if catalogue is not None:
        return f"a {catalogue.what}"
    if any(isinstance(mark, Several) for mark in marks):
        return "text, or a list of texts"
    if isinstance(base, type) and issubclass(base, enum.Enum):
        return ", ".join(f"`{member.value}`" for member in base)
    length = any(isinstance(mark, LengthUnit) for mark in marks)
    if bounds is not None:
        low, high = (f"{n:g}" if n < 1e5 else f"{int(n):,}" for n in (bounds.low, bounds.high))
        span = f"{low} to {high}"
        return f"length, {span} mm" if length else span
    if length:
        return "length"
    if typing.get_origin(base) is tuple:
        inner = typing.get_args(base)
        if len(inner) == 2 and inner[1] is Ellipsis:
            return f"list of {plural(inner[0])}"
        return "[" + ", ".join(expected(each) for each in inner) + "]"
    if typing.get_origin(base) is dict:
        return "tables by name"
    if isinstance(base, type) and issubclass(base, Isen | Plate):
        return "isen" if issubclass(base, Isen) else "plate"
    names = {bool: "`true` or `false`", str: "text", int: "whole number", float: "number"}
    if typing.get_origin(base) is typing.Literal:
        return ", ".join(f"`{word}`" for word in typing.get_args(base))
    return names.get(base, "table")


def plural(hint: Any) -> str:
    """Say what a list holds."""
    base, _ = marks_of(hint)
    return "texts" if base is str else "tables" if dataclasses.is_dataclass(base) else expected(hint)


def default_of(field: dataclasses.Field[Any]) -> str:
    """Say what a key is when it is left out."""
    if field.default is dataclasses.MISSING:
        return "" if field.default_factory is not dataclasses.MISSING else "*needed*"
    value = field.default
    if value is None or value in ("", ()):
        return ""
    if isinstance(value, enum.Enum):
        return f"`{value.value}`"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, float):
        return f"`{format_mm(value)}`"
    if isinstance(value, tuple):
        return "" if any(map(dataclasses.is_dataclass, value)) else f"`{json.dumps(value)}`"
    return f"`{value}`"


def table(cls: type, skip: frozenset[str] = frozenset()) -> Iterator[str]:
    """Yield the rows of a dataclass's keys."""
    hints = typing.get_type_hints(cls, include_extras=True)
    rows = []
    for field in dataclasses.fields(cls):
        _, marks = marks_of(hints[field.name])
        if field.name in skip or HIDDEN in field.metadata:
            continue
        says = next((mark for mark in marks if isinstance(mark, Says)), Says(""))
        symbol = f" (the paper's *{says.symbol}*)" if says.symbol else ""
        takes = expected(hints[field.name])
        rows.append(f"| `{field.name}` | {takes} | {default_of(field)} | {says.text}{symbol} |")
    if rows:
        yield "| key | takes | default | |"
        yield "| --- | --- | --- | --- |"
        yield from rows
    else:
        yield "No keys of its own."
    yield ""


def story(cls: type) -> str:
    """Return the docstring as one Markdown paragraph per paragraph."""
    text = typing.cast(str, cls.__doc__).strip()
    return "\n".join(line.strip() for line in text.splitlines()).replace("``", "`")


def section(title: str, cls: type, level: int = 3, skip: frozenset[str] = frozenset()) -> Iterator[str]:
    """Yield a heading, the docstring and the keys of a class."""
    yield f"{'#' * level} {title}"
    yield ""
    yield story(cls)
    yield ""
    yield from table(cls, skip)


def words(key: str, kind: type[enum.StrEnum]) -> Iterator[str]:
    """Yield what each word of an enumeration means: the text that stands below it in the source."""
    body = typing.cast(ast.ClassDef, ast.parse(inspect.getsource(kind)).body[0]).body
    yield f"`{key}`:"
    yield ""
    for member, says in itertools.pairwise(body):
        if isinstance(member, ast.Assign) and isinstance(says, ast.Expr):
            name = typing.cast(ast.Name, member.targets[0]).id
            note = " ".join(typing.cast(str, ast.literal_eval(says.value)).split())
            yield f"- `{kind[name].value}`: {note}".replace("``", "`")
    yield ""


def catalogue(title: str, key: str, classes: Mapping[str, type]) -> Iterator[str]:
    """Yield a section for every class that a key may name."""
    yield from (f"## {title}", "", f"The {key} says which of these it is.", "")
    for name, cls in classes.items():
        yield from section(f'"{name}"', cls)


def composed(name: str, kind: type, look: frozenset[str]) -> Iterator[str]:
    """Yield the sections of a kind of motif and of its tables that have keys of their own."""
    yield from section(f'kind = "{name}"', kind)
    hints = typing.get_type_hints(kind)
    tables: dict[type, list[str]] = {}
    for field in dataclasses.fields(kind):
        part = hints[field.name]
        if dataclasses.is_dataclass(part) and {each.name for each in dataclasses.fields(part)} - look:
            tables.setdefault(typing.cast(type, part), []).append(f"{name}.{field.name}")
    for part, keys in tables.items():
        yield from section(", ".join(keys), part, 4, look)


def groups_table() -> Iterator[str]:
    """Yield the table of wallpaper groups."""
    yield "| group | orbifold | also | cell | copies in the rectangle |"
    yield "| --- | --- | --- | --- | --- |"
    for row in GROUPS.values():
        also = ", ".join(f"`{name}`" for name in row.others)
        yield f"| `{row.name}` | {row.orbifold} | {also} | {row.kind.value} | {row.copies} |"
    yield ""


def friezes_table() -> Iterator[str]:
    """Yield the table of frieze groups."""
    yield "| group | orbifold | also | copies in a period |"
    yield "| --- | --- | --- | --- |"
    for row in FRIEZES.values():
        also = ", ".join(f"`{name}`" for name in row.others)
        yield f"| `{row.name}` | {row.orbifold} | {also} | {len(row.steps())} |"
    yield ""


def page() -> str:
    """Return the whole page."""
    look = frozenset(field.name for field in dataclasses.fields(Dress))
    units = ", ".join(f"`{unit}`" for unit in MM_PER_UNIT if unit not in ('"', "µm"))
    lines = [HEAD.format(units=units)]
    lines += section("The recipe", Recipe, 2)
    lines += section("`[tile]`: the repeat", TileSpec, 2)
    lines += words("cut", Cut)
    lines += section("tile.fit", Fit)
    lines += ["### Wallpaper groups", "", *groups_table()]
    lines += section("`[yardage]`: a cloth filled from the tile", YardageSpec, 2)
    lines += words("edge", Edge)
    lines += words("align", Align)
    lines += section("`[[border]]`: bands along the sides of the yardage", BorderSpec, 2)
    for key, kind in (("corner", Corner), ("facing", Facing), ("ends", Ends)):
        lines += words(key, kind)
    lines += section("border.rails", RailSpec)
    lines += ["### Frieze groups", "", *friezes_table()]
    lines += section("`[cloth]`", ClothSpec, 2)
    lines += section("`[ink.NAME]`", InkSpec, 2)
    lines += words("overlap", Overlap)
    lines += section("`[colourway.NAME]`", ColourwaySpec, 2)
    lines += section("`[[place]]`", Placement, 2)
    lines += words("region", Spread)
    lines += ["## `[motif.NAME]`", "", "`kind` says which of these it is.", ""]
    lines += section('kind = "flower"', Flower)
    for key, part in (("leaf", Leaf), ("petal", Petals), ("pistil", Pistil), ("core", Core)):
        lines += section(f"flower.{key}", part, 4, look)
    lines += section('kind = "rosette"', Rosette)
    lines += section("rosette.elements", Element, 4, look)
    lines += section('kind = "path"', PathMotif, 3, look)
    lines += words("y (of a path)", YAxis)
    lines += section('kind = "svg"', Svg)
    lines += section("svg.dress", Dressing, 4)
    for name, motif in MOTIFS.items():
        if issubclass(motif, Composed):
            lines += composed(name, motif, look)
    lines += section("plate", Plate, 3, look - {"gap"})
    lines += section("isen", Isen, 3, look - {"treatment"})
    lines += section('kind = "lsystem"', Grown, 3, look)
    lines += words("origin (of an L-system)", Origin)
    lines += section("lsystem.marks", Growth, 4, look)
    lines += ["### The look of every element", ""]
    lines += table(Dress)
    lines += words("treatment", Treatment)
    lines += words("fill", FillRule)
    lines += catalogue("Fills", "`kind` of `fill_with` of an element or a placement", FILLS)
    lines += words("follow (of lines)", Follow)
    lines += words("follow (of dots and crosses)", Rows)
    lines += words("style (of isen), batik (of a drawing)", Style)
    lines += catalogue("Curves", "`kind` of the `curve` of an element", CURVES)
    lines += words("system (of a fractal)", FractalName)
    lines += words("map (of an attractor)", AttractorMap)
    lines += catalogue("Layouts", "`kind` of the `layout` of a placement", LAYOUTS)
    lines += words("clear (of a toss)", Clear)
    lines += section("Spots of a free layout, and `pre` and `post` of a map", Spot)
    lines += section("Maps of an ifs layout", MapSpec)
    lines += section("Terms of a map", Term)
    lines += catalogue("Variations", "`kind` of the `variation` of a term", VARIATIONS)
    lines += catalogue("`[[output]]`", "`format`", OUTPUTS)
    lines += catalogue("`process` of an output", "`kind`", PROCESSES)
    lines += catalogue("`hatch` of a process", "`kind`", HATCHES)
    lines += section("Machines' profiles", Machine, 2)
    profile: dict[str, type] = {"tool": Tool, "motion": Motion, "limits": Limits, "gcode": Gcode}
    for key, table_of in profile.items():
        lines += section(f"`[{key}]`", table_of)
    lines += words("stop (of gcode)", Stop)
    lines += words("comment (of gcode)", Comment)
    return "\n".join(lines).rstrip() + "\n"


LIBRARY = PAGE.with_name("library.md")
BEGIN, END = "<!-- features: written by `make docs` -->", "<!-- end of features -->"


def library_page() -> str:
    """Return the page on the library, with its table of features."""
    head, _, rest = LIBRARY.read_text(encoding="utf-8").partition(BEGIN)
    lines = ["| feature | what is measured | a difference of 1 is |", "| --- | --- | --- |"]
    for name, feature in FEATURES.items():
        if not feature.unit:
            eye = "not compared"
        elif feature.kind is str:
            eye = "another word"
        elif feature.by_factor:
            eye = f"a factor of {2**feature.unit:.3g}"
        else:
            eye = f"{feature.unit:g}"
        says = f"{feature.says}: {', '.join(feature.words)}" if feature.words else feature.says
        lines.append(f"| `{name}` | {says} | {eye} |")
    table = "\n".join(lines)
    return f"{head}{BEGIN}\n\n{table}\n\n{END}{rest.partition(END)[2]}"


AUDIT = PAGE.with_name("audit.md")
FIRST, LAST = "<!-- machines: written by `make docs` -->", "<!-- end of machines -->"


def audit_page() -> str:
    """Return the page on the audit, with its table of machines that set any limit."""
    head, _, rest = AUDIT.read_text(encoding="utf-8").partition(FIRST)
    names = [field.name for field in dataclasses.fields(Limits) if field.name != "repeats"]
    lines = [
        f"| machine | {' | '.join(f'`{name}`' for name in names)} | `size` |",
        f"| --- | {'--- | ' * len(names)}--- |",
    ]
    for machine in MACHINES:
        profile = read_machine(machine)
        if profile.limits == Limits():
            continue
        cells = [_limit(getattr(profile.limits, name)) for name in names]
        size = " × ".join(map(format_mm, profile.size)) if profile.size else ""
        lines.append(f"| `{machine}` {profile.says} | {' | '.join(cells)} | {size} |")
    table = "\n".join(lines)
    return f"{head}{FIRST}\n\n{table}\n\n{LAST}{rest.partition(LAST)[2]}"


def _limit(value: Any) -> str:
    if value is None or value is False or value == Twice.NO:
        return ""
    return "yes" if value is True else format_mm(value) if isinstance(value, float) else str(value)


def main() -> int:
    """Write the pages, or say which of them are stale."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing; exit 1 when a page is stale")
    made = {PAGE: page(), LIBRARY: library_page(), AUDIT: audit_page()}
    if parser.parse_args().check:
        stale = [
            path.name
            for path, text in made.items()
            if not path.exists() or path.read_text(encoding="utf-8") != text
        ]
        print(*(f"{name} is stale: run make docs" for name in stale), sep="\n")
        return 1 if stale else 0
    for path, text in made.items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
