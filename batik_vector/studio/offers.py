"""What can be added to a recipe's lists, each as the least that draws something; and words to choose from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from batik_vector.fields import OneOf
from batik_vector.recipe.palettes import PALETTES
from batik_vector.recipe.reading.field_types import Hint, members
from batik_vector.recipe.references import Path, dotted
from batik_vector.units import format_mm, parse_length
from batik_vector.values import frozen


@frozen
class Offer:
    """Something that can be added.

    Args:
        label: what it is called.
        path: the list it joins, or the table that it becomes: what ``Draft.inserted`` takes. Where the
            list is not there yet it is made.
        value: what is written there.
        single: whether it is a table that there is once, for ``Draft.with_value``.
    """

    label: str
    path: str
    value: Any
    single: bool = False


NEEDED: Mapping[str, Mapping[str, Any]] = {
    "motif rosette": {"elements": [{"curve": {"kind": "circle", "radius": 0.3}, "count": 8, "radius": 1.0}]},
    "motif path": {"d": "M0 -1 C0.8 -0.4 0.8 0.4 0 1 C-0.8 0.4 -0.8 -0.4 0 -1 Z"},
    "motif svg": {"file": "drawing.svg"},
    "motif lsystem": {
        "axiom": "F",
        "rules": ["F -> F[+F]F[-F]F"],
        "level": 2,
        "angle": 30,
        "heading": 90,
        "width": 0.3,
    },
    "layout places": {"at": [[0, 0]]},
    "curve points": {"points": [[1, 0], [0, 0.5], [-1, 0], [0, -0.5]], "smooth": True},
    "curve path": {"d": "M0 -1 C0.8 -0.4 0.8 0.4 0 1 C-0.8 0.4 -0.8 -0.4 0 -1 Z"},
    "layout ifs": {"maps": [{}, {"pre": {"turn": 45, "scale": 0.7}}]},
}
"""What kinds of a catalogue need besides their name, to draw something at once."""
FRESH, DYES = "tiga-negeri", (3, 2, 1, 0, 4)
"""The palette that fresh inks take their colours from where the recipe names none; indigo comes first."""
REPEATS = ("grid", "half-drop", "brick", "drop 1/3", "mirror")
WIDTH, METRES = 100.0, 1500.0
"""mm: of a motif where the tile says no size, and of a fresh cloth."""


def offers(hint: Hint, path: Path, tables: Mapping[str, Any]) -> tuple[Offer, ...]:
    """Return what can be added to a list, or put where an optional table is missing."""
    last = str(path[-1])
    if path == ("motif",):
        motifs = hint.item.one_of if hint.item is not None else None
        assert motifs is not None
        return tuple(_named(kind, path, tables, kinded(kind, motifs)) for kind in motifs.load())
    if path == ("ink",):
        number = len(_table(tables, "ink"))
        return (_named("ink", ("ink",), tables, {"colour": _fresh_colour(number, tables)}),)
    if path == ("colourway",):
        free = {name: dotted((*path, free_name(name, _table(tables, "colourway")))) for name in PALETTES}
        return tuple(Offer(name, where, {"palette": name}, single=True) for name, where in free.items())
    if last == "corner_place" and _corner(path, tables) != "motif":
        return ()
    if last in ("place", "corner_place"):
        return tuple(_places(path, tables))
    if path == ("border",) and "yardage" not in tables:
        # Borders go round a cloth.
        return ()
    if path == ("drawing",):
        return ()
    single = hint.item is None
    inner = hint if single else hint.item
    assert inner is not None
    where = dotted(path)
    if (of := inner.one_of) is not None:
        return tuple(Offer(kind, where, kinded(kind, of), single) for kind in of.load())
    value = _least(last, tables)
    return () if value is None else (Offer(last.removesuffix("s").replace("_", " "), where, value, single),)


def _fresh_colour(number: int, tables: Mapping[str, Any]) -> str:
    """Return the colour of a fresh ink, of so many that there are already."""
    named = tables.get("palette")
    colours = PALETTES[named if isinstance(named, str) and named in PALETTES else FRESH].colours
    return colours[DYES[number % len(DYES)] % len(colours)]


def offered_colours() -> list[str]:
    """Return the colours that a picker shows, those of each palette together."""
    return list(dict.fromkeys(colour for each in PALETTES.values() for colour in each.colours))


def kinded(kind: str, one_of: OneOf) -> dict[str, Any]:
    """Return the least table of a kind of a catalogue."""
    return {one_of.tag: kind, **NEEDED.get(f"{one_of.what} {kind}", {})}


def _named(label: str, path: Path, tables: Mapping[str, Any], value: dict[str, Any]) -> Offer:
    return Offer(label, dotted((*path, free_name(label, _table(tables, str(path[0]))))), value)


def free_name(stem: str, taken: Any) -> str:
    """Return a name that is not taken: ``flower``, ``flower-2`` and so on."""
    number, name = 1, stem
    while name in taken:
        number += 1
        name = f"{stem}-{number}"
    return name


def _table(tables: Mapping[str, Any], key: str) -> dict[str, Any]:
    held = tables.get(key)
    return held if isinstance(held, dict) else {}


def _places(path: Path, tables: Mapping[str, Any]) -> list[Offer]:
    ink = next(reversed(_table(tables, "ink")), "")
    inked = {"ink": ink} if len(_table(tables, "ink")) > 1 else {}
    width = f"{format_mm(_tile_width(tables) / 2)} mm"
    value = {"width": width, **inked}
    return [Offer(name, dotted(path), {"motif": name, **value}) for name in _table(tables, "motif")]


def _corner(path: Path, tables: Mapping[str, Any]) -> Any:
    """Return how the border of a list of placements turns its corners."""
    try:
        return tables["border"][path[1]]["corner"]
    except (LookupError, TypeError):
        return None


def _tile_width(tables: Mapping[str, Any]) -> float:
    try:
        return parse_length(tables["tile"]["size"][0])
    except (LookupError, TypeError, ValueError):
        return 2 * WIDTH


def _least(key: str, tables: Mapping[str, Any]) -> Any:
    """Return the least table of a key whose class is no catalogue's."""
    inked = {"ink": next(iter(_table(tables, "ink")))} if _table(tables, "ink") else {}
    values: dict[str, Any] = {
        "tile": {"size": [f"{2 * WIDTH:g} mm", f"{2 * WIDTH:g} mm"]},
        "yardage": {"width": f"{METRES:g} mm", "length": f"{METRES:g} mm"},
        "border": {"size": ["40 mm", "40 mm"], "rails": [{"at": "4 mm", "width": "2 mm", **inked}]},
        "rails": {"at": "4 mm", "width": "2 mm", **inked},
        "elements": {"curve": {"kind": "circle", "radius": 0.1}, "count": 8, "radius": 1.0},
        "marks": {"symbol": "F", "curve": {"kind": "circle", "radius": 0.2}},
        "maps": {"pre": {"turn": 90}},
        "terms": {"kind": "julian"},
        "fit": {},
        "clear": {"at": [0, 0], "radius": 10},
        "spots": {"at": [0, 0]},
    }
    return values.get(key)


def suggestions(path: Path, drawings: Sequence[tuple[str, str]]) -> tuple[str, ...]:
    """Return words that a text may be, where some are known: repeats, groups, friezes, machines, drawings."""
    from batik_vector.machines import MACHINES
    from batik_vector.tiling.symmetry.friezes import FRIEZES
    from batik_vector.tiling.symmetry.groups import GROUPS

    key = path[-1]
    if path == ("tile", "repeat"):
        return (*REPEATS, *GROUPS)
    if key == "symmetry":
        return tuple(GROUPS)
    if key == "frieze":
        return tuple(FRIEZES)
    if key == "machine":
        return tuple(MACHINES)
    if key == "palette":
        return tuple(PALETTES)
    if key == "file":
        return tuple(name for name, _ in drawings)
    return ()


def known_keys(hint: Hint, kind: str) -> set[str]:
    """Return the keys that a kind of a catalogue knows."""
    if hint.one_of is None or kind not in hint.one_of.load():
        return set()
    return set(members(hint.one_of.load()[kind]))
