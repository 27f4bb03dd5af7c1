"""The numeric keys of the schema, and how each is set in a sample to any value.

A table that the sample has not is put in.
"""

from __future__ import annotations

import copy
import math
import random
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

from batik_vector.recipe.schema import schema

SAMPLES = Path(__file__).resolve().parent.parent / "samples"
DRAWN = ("Dressing", "motif.svg")
"""Tables of drawings in files of their own, which the samples tried have not beside them: left out."""
PATH = "M0 0C2 0 2 2 0 2Z"
UNBOUNDED = 1000.0
"""What stands for a bound where the schema has none."""

Tables = dict[str, Any]
Put = Callable[[Tables], Tables]
"""Puts a kind of table into a recipe, where it is not, and returns that table."""


@dataclass(frozen=True)
class Key:
    """A numeric key: the definition it belongs to, its place there, and its bounds.

    ``within`` are the indices that lead into a list: a number, or None for every item.
    """

    table: str
    name: str
    within: tuple[int | None, ...]
    low: float
    high: float
    whole: bool

    def __str__(self) -> str:
        inner = "".join("[*]" if each is None else f"[{each}]" for each in self.within)
        return f"{self.table}.{self.name}{inner}"

    def values(self, count: int) -> Iterator[float]:
        """Yield both bounds and values between, the small ones as often as the large."""
        chance = random.Random(str(self))
        yield from (self.low, self.high)
        for number in range(count):
            value = chance.uniform(self.low, self.high)
            if number % 2 and self.high > 0:
                least = self.low if self.low > 0 else min(1e-3, self.high / 2)
                value = math.exp(chance.uniform(math.log(least), math.log(self.high)))
            yield min(max(round(value), self.low), self.high) if self.whole else round(value, 6)


def keys() -> list[Key]:
    """Return every numeric key of the schema."""
    root = schema()
    tables = {"recipe": root, **root["$defs"]}
    return [
        Key(table, name, *leaf)
        for table, node in tables.items()
        if table not in DRAWN
        for name, member in node["properties"].items()
        for leaf in _leaves(member, ())
    ]


def _leaves(
    node: Tables, within: tuple[int | None, ...]
) -> Iterator[tuple[tuple[int | None, ...], float, float, bool]]:
    if (kind := node.get("type")) in ("number", "integer"):
        yield within, node.get("minimum", -UNBOUNDED), node.get("maximum", UNBOUNDED), kind == "integer"
    for each in node.get("anyOf", ()):
        yield from _leaves(each, within)
    for index, each in enumerate(node.get("prefixItems", ())):
        yield from _leaves(each, (*within, index))
    if kind == "array" and "items" in node:
        yield from _leaves(node["items"], (*within, None))


def _placed(data: Tables, kind: str) -> Tables:
    """Return the table of a motif of some kind that is placed; the first placed is made one where none is."""
    names = [place["motif"] for place in data["place"] if "motif" in place]
    name = next((each for each in names if data["motif"][each]["kind"] == kind), None)
    if name is None:
        ink = {"ink": next(iter(data["ink"]))} if "ink" in data else {}
        needs: dict[str, Tables] = {
            "flower": {"leaf": dict(ink)},
            "lsystem": {"system": "koch-snowflake", **ink},
            "path": {"d": PATH, **ink},
            "rosette": {"elements": [{"curve": {"kind": "circle"}, **ink}]},
        }
        made: Tables = {"kind": kind, **needs.get(kind, {})}
        if kind not in ("lsystem", "path", "rosette"):
            # A flower is a unit large, where the motif that it stands for is measured in mm.
            large = _place_of(data, names[0]).get("scale") == "1 mm"
            if large:
                _place_of(data, names[0])["scale"] = "20 mm"
        _place_of(data, names[0]).update(ink)
        data["motif"][name := names[0]] = made
    table: Tables = data["motif"][name]
    return table


def _place_of(data: Tables, motif: str) -> Tables:
    found: Tables = next(place for place in data["place"] if place["motif"] == motif)
    return found


def _parts() -> dict[str, Put]:
    """Return how the parts of motifs are put in: each into the first motif that has it."""
    found: dict[str, Put] = {}
    for table, node in schema()["$defs"].items():
        room, _, kind = table.partition(".")
        for name, member in node["properties"].items() if room == "motif" else ():
            options = [member, *member.get("anyOf", ())]
            for part in (str(each["$ref"]).rpartition("/")[2] for each in options if "$ref" in each):
                if "." not in part:
                    found.setdefault(part, _part(kind, name))
    return found


def _part(kind: str, name: str) -> Put:
    def put(data: Tables) -> Tables:
        table: Tables = _placed(data, kind).setdefault(name, {})
        return table

    return put


def _growth(data: Tables) -> Tables:
    mark = {"curve": {"kind": "circle"}, "symbol": "F", "radius": 1.0}
    table: Tables = _placed(data, "lsystem").setdefault("marks", [mark])[0]
    return table


def _element(data: Tables) -> Tables:
    element: Tables = _placed(data, "rosette")["elements"][0]
    return element


def _curve(kind: str) -> Put:
    def put(data: Tables) -> Tables:
        element = _element(data)
        known = [each for each in _placed(data, "rosette")["elements"] if each["curve"]["kind"] == kind]
        if known:
            return known[0]["curve"]  # type: ignore[no-any-return]
        start: dict[str, Tables] = {
            "polar": {"waves": [[8, 0.1, 0.0]]},
            "lsystem": {"system": "koch-snowflake"},
            "fractal": {"system": "vicsek"},
            "path": {"d": PATH},
            "points": {"points": [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]},
            "parametric": {"x": [[1, 1.0, 20.0]], "y": [[2, 1.0, 0.0]]},
        }
        element["curve"] = {"kind": kind, **start.get(kind, {})}
        if kind in ("segment", "spiral", "wave"):
            element["treatment"] = "stroke"
        curve: Tables = element["curve"]
        return curve

    return put


def _layout(kind: str) -> Put:
    needs: dict[str, Tables] = {
        "ifs": {"maps": [{"terms": [{"variation": {"kind": "linear"}}]}]},
        "places": {"at": [[0.0, 0.0]], "mirrored": [[0.0, 0.0]]},
        "free": {"spots": [{"shift": [0.0, 0.0]}, {"shift": [1.0, 1.0]}]},
    }

    def put(data: Tables) -> Tables:
        place: Tables = data["place"][0]
        if place.get("layout", {}).get("kind") != kind:
            place["layout"] = {"kind": kind, **needs.get(kind, {})}
        if kind in ("toss", "pack", "stripes"):
            place.pop("at", None)
            place.pop("turn", None)
        layout: Tables = place["layout"]
        return layout

    return put


def _variation(kind: str) -> Put:
    def put(data: Tables) -> Tables:
        term: Tables = _layout("ifs")(data)["maps"][0]["terms"][0]
        term["variation"] = {"kind": kind}
        found: Tables = term["variation"]
        return found

    return put


def _output(form: str) -> Put:
    def put(data: Tables) -> Tables:
        data["output"] = [{"format": form}]
        if form in ("svg", "pdf"):
            data["output"][0]["curves"] = "bezier"
        found: Tables = data["output"][0]
        return found

    return put


def _process(kind: str) -> Put:
    def put(data: Tables) -> Tables:
        found: Tables = _output("svg")(data).setdefault("process", {"kind": kind})
        return found

    return put


def _hatch(kind: str) -> Put:
    def put(data: Tables) -> Tables:
        found: Tables = _process("plot")(data).setdefault("hatch", {"kind": kind})
        return found

    return put


def _fill(kind: str) -> Put:
    def put(data: Tables) -> Tables:
        found: Tables = data["place"][0].setdefault("fill_with", {"kind": kind})
        return found

    return put


def _yardage(data: Tables) -> Tables:
    width, length = (2 * float(str(side).split()[0]) for side in data["tile"]["size"])
    found: Tables = data.setdefault("yardage", {"width": width, "length": length})
    return found


def _border(data: Tables) -> Tables:
    _yardage(data)
    ink = next(iter(data.get("ink", {"ink": {}})))
    rail = {"at": 10.0, "ink": ink}
    place = {**copy.deepcopy(data["place"][-1]), "at": [20.0, 20.0]}
    data.setdefault("border", [{"size": [40.0, 40.0], "rails": [rail], "place": [place]}])
    found: Tables = data["border"][0]
    return found


PUT: dict[str, Put] = {
    **_parts(),
    "recipe": lambda data: data,
    "TileSpec": lambda data: data["tile"],
    "Fit": lambda data: data["tile"].setdefault("fit", {"width": 1000.0, "limit": 50}),
    "Placement": lambda data: data["place"][0],
    "InkSpec": lambda data: data.setdefault("ink", {"ink": {}})[next(iter(data["ink"]))],
    "Element": _element,
    "Growth": _growth,
    "Row": lambda data: _placed(data, "lereng").setdefault("rows", [{"kind": "dots", "height": 0.4}])[0],
    "Spot": lambda data: _layout("free")(data)["spots"][0],
    "Term": lambda data: _layout("ifs")(data)["maps"][0]["terms"][0],
    "YardageSpec": _yardage,
    "BorderSpec": _border,
    "RailSpec": lambda data: _border(data)["rails"][0],
}
ROOMS: dict[str, Callable[[str], Put]] = {
    "motif": lambda kind: lambda data: _placed(data, kind),
    "curve": _curve,
    "layout": _layout,
    "variation": _variation,
    "output": _output,
    "process": _process,
    "hatch": _hatch,
    "fill": _fill,
}


def recipe_with(recipe: str, key: Key, value: float, chance: random.Random) -> str:
    """Return a sample's text with one key set to a value, in TOML."""
    data = tomllib.loads((SAMPLES / f"{recipe}.toml").read_text(encoding="utf-8"))
    room, _, kind = key.table.partition(".")
    table = PUT[key.table](data) if key.table in PUT else ROOMS[room](kind)(data)
    exact: float | int = int(value) if key.whole else float(value)
    if key.within:
        table[key.name] = _filled(table.get(key.name), key, exact, chance)
    else:
        table[key.name] = exact
    if key.table == "Placement" and key.name in ("width", "scale"):
        table.pop("scale" if key.name == "width" else "width", None)
    table.update(BESIDE.get(str(key), {}))
    return tomlkit.dumps(data)


ROWS: dict[str, list[list[float]]] = {
    "arrows": [[1, 1.0, 0.0], [-3, 0.3, 0.0]],
    "matrix": [[1, 1], [1, 0]],
    "points": [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]],
}
"""What stands in lists of rows that the sample has not."""

BESIDE: dict[str, Tables] = {
    "BorderSpec.radius": {"corner": "bend"},
    "process.plot.margin": {"hidden": "remove"},
    "process.cut.sheet_number": {"sheet": ["2 m", "2 m"]},
}
"""What keys are refused without."""

LENGTHS = {"matrix": 6, "turns": 3, "weights": 1}
"""Items of lists that have no length of their own."""


def _filled(now: Any, key: Key, value: float | int, chance: random.Random) -> list[Any]:
    """Return a list with the value where the key says, and between two numbers in order."""
    if len(key.within) == 2:
        rows = [list(row) for row in now or ROWS[key.name]]
        for row in rows:
            row[int(key.within[1] or 0)] = value
        return rows
    count = LENGTHS.get(key.name, 2)
    bound = value in (key.low, key.high)
    others = [value if bound else next(iter(_between(key, chance))) for _ in range(count - 1)]
    found = [value, *others]
    return sorted(found) if key.table == "layout.toss" else found


def _between(key: Key, chance: random.Random) -> Iterator[float | int]:
    value = chance.uniform(key.low, key.high)
    yield int(value) if key.whole else round(value, 6)
