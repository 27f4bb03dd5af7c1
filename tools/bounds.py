"""Tries every numeric key of the schema at its least, its greatest and values between, in a few recipes.

    .venv/bin/python -m tools.bounds                        # 50 values of each key between its bounds
    .venv/bin/python -m tools.bounds --values 2 --only toss --recipes kawung
    .venv/bin/python -m tools.bounds --signals 100          # and the slowest stopped at random moments

Each try is a process of its own that may hold 4 GB: it must write a file or refuse in words, and within 20
seconds of its own time. What does neither is printed and makes the call fail. A value is set in the recipe as
it stands; a table that the recipe has not is put in.
"""

from __future__ import annotations

import argparse
import collections
import contextlib
import copy
import io
import math
import os
import random
import resource
import signal
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import tomlkit

from batik_vector.recipe.schema import schema

SAMPLES = Path(__file__).resolve().parent.parent / "samples"
RECIPES = ("four-square", "kawung", "lotus-pond", "group-p4g")
DRAWN = ("Dressing", "motif.svg")
"""Tables of drawings in files of their own, which the samples tried have not beside them: left out."""
PATH = "M0 0C2 0 2 2 0 2Z"
UNBOUNDED = 1000.0
"""What stands for a bound where the schema has none."""
HEARD = 2.0
"""Seconds in which a signal must be heard."""

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
    names = [place["motif"] for place in data["place"]]
    name = next((each for each in names if data["motif"][each]["kind"] == kind), None)
    if name is None:
        ink = {"ink": next(iter(data["ink"]))} if "ink" in data else {}
        made: Tables = {"kind": "flower", "leaf": dict(ink)}
        if kind == "path":
            made = {"kind": kind, "d": PATH, **ink}
        elif kind == "rosette":
            made = {"kind": kind, "elements": [{"curve": {"kind": "circle"}, **ink}]}
        else:
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


def _part(name: str) -> Put:
    return lambda data: _placed(data, "flower").setdefault(name, {})


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
        "places": {"at": [[0.0, 0.0]]},
        "free": {"spots": [{"shift": [0.0, 0.0]}, {"shift": [1.0, 1.0]}]},
    }

    def put(data: Tables) -> Tables:
        place: Tables = data["place"][0]
        if place.get("layout", {}).get("kind") != kind:
            place["layout"] = {"kind": kind, **needs.get(kind, {})}
        if kind in ("toss", "stripes"):
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
    "recipe": lambda data: data,
    "TileSpec": lambda data: data["tile"],
    "Fit": lambda data: data["tile"].setdefault("fit", {"width": 1000.0, "limit": 50}),
    "Placement": lambda data: data["place"][0],
    "InkSpec": lambda data: data.setdefault("ink", {"ink": {}})[next(iter(data["ink"]))],
    "Element": _element,
    "Dress": _part("disc"),
    "Leaf": _part("leaf"),
    "Petals": _part("petal"),
    "Pistil": _part("pistil"),
    "Core": _part("core"),
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
    if key.table == "BorderSpec" and key.name == "radius":
        table["corner"] = "bend"
    return tomlkit.dumps(data)


LENGTHS = {"matrix": 6, "turns": 3, "weights": 1}
"""Items of lists that have no length of their own."""


def _filled(now: Any, key: Key, value: float | int, chance: random.Random) -> list[Any]:
    """Return a list with the value where the key says, and between two numbers in order."""
    if len(key.within) == 2:
        rows = [list(row) for row in now]
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


@dataclass(frozen=True)
class Try:
    """One recipe, to be compiled."""

    recipe: str
    key: str
    value: float
    text: str


@dataclass(frozen=True)
class Outcome:
    """How a try ended. ``kind`` is "written", "refused", or what is wrong."""

    kind: str
    words: str
    cpu: float
    wall: float
    megabytes: float

    @property
    def is_good(self) -> bool:
        """Whether there is an answer or a refusal."""
        return self.kind in ("written", "refused")


def tries(recipes: Sequence[str], count: int, only: str) -> Iterator[Try]:
    """Yield every try."""
    for key in keys():
        if only not in str(key):
            continue
        for recipe in recipes:
            chance = random.Random(f"{recipe} {key}")
            for value in key.values(count):
                yield Try(recipe, str(key), value, recipe_with(recipe, key, value, chance))


def tried(each: Try, seconds: float, gigabytes: float) -> Outcome:
    """Compile a recipe in a process of its own."""
    read, write = os.pipe()
    begun = time.perf_counter()
    child = os.fork()
    if not child:
        os.close(read)
        _compile(each, write, seconds, gigabytes)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        told = pipe.read().decode("utf-8", "replace")
    _, status, used = os.wait4(child, 0)
    kind, _, words = told.partition(" ")
    cpu = used.ru_utime + used.ru_stime
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        late = number in (signal.SIGXCPU, signal.SIGKILL, signal.SIGALRM)
        kind, words = ("too slow" if late else "killed"), signal.Signals(number).name
    elif cpu > seconds:
        kind, words = "too slow", words or kind
    return Outcome(kind or "lost", words, cpu, time.perf_counter() - begun, used.ru_maxrss / 1024)


def _compile(each: Try, pipe: int, seconds: float, gigabytes: float) -> None:
    """Do the work of a child, tell by the pipe how it ended, and end."""
    from batik_vector.errors import BatikError

    told = "crashed"
    try:
        resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 1e9),) * 2)
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds) + 1,) * 2)
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()):
            path = Path(folder) / "tried.toml"
            path.write_text(each.text, encoding="utf-8")
            told = _run(path, Path(folder) / "out")
    except BatikError as error:
        told = f"refused {error}"
    except MemoryError:
        told = "no memory"
    except BaseException as error:
        told = f"crashed {type(error).__name__}: {error}"
    finally:
        os.write(pipe, told.encode()[:4000])
        os._exit(0)


def _run(path: Path, folder: Path) -> str:
    from batik_vector.command.jobs import planned, read_jobs, run

    for job in planned(read_jobs([str(path)]), folder):
        report = run(job, lambda stage: None)
    return f"written {report['vertices']:,} vertices"


def stopped(each: Try, wait: float, number: signal.Signals) -> tuple[float, int, list[str]]:
    """Run the command on a recipe, stop it after some seconds; return how long it took to end, and how.

    The last is what it left in the folder.
    """
    import subprocess

    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder) / "tried.toml", Path(folder) / "out"
        path.write_text(each.text, encoding="utf-8")
        out.mkdir()
        command = [sys.executable, "-m", "batik_vector", "compile", str(path), "-o", str(out)]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(wait)
        begun = time.perf_counter()
        process.send_signal(number)
        code = process.wait()
        return time.perf_counter() - begun, code, sorted(os.listdir(out))


def main() -> int:
    """Try everything, print what is wrong and the slowest, and say how it came out."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n\n")[0])
    parser.add_argument("--values", type=int, default=50, help="values between the bounds of each key")
    parser.add_argument("--recipes", nargs="+", default=RECIPES, help="samples in which keys are set")
    parser.add_argument("--only", default="", help="part of the names of the keys that are tried")
    parser.add_argument("--seconds", type=float, default=20.0, help="of its own time that a try may take")
    parser.add_argument("--gigabytes", type=float, default=4.0, help="that a try may hold")
    parser.add_argument("--jobs", type=int, default=2, help="tries at a time")
    parser.add_argument("--signals", type=int, default=0, help="moments at which the slowest are stopped")
    parser.add_argument("--until", type=float, default=math.inf, help="seconds after which no try is begun")
    asked = parser.parse_args()
    _warm()
    begun = time.monotonic()
    work = list(tries(asked.recipes, asked.values, asked.only))
    random.Random(0).shuffle(work)
    found: list[tuple[Try, Outcome]] = []

    def one(each: Try) -> None:
        if time.monotonic() - begun > asked.until:
            return
        outcome = tried(each, asked.seconds, asked.gigabytes)
        found.append((each, outcome))
        if not outcome.is_good:
            print(_line(each, outcome), flush=True)

    with ThreadPoolExecutor(asked.jobs) as pool:
        list(pool.map(one, work))
    wrong = sum(not outcome.is_good for _, outcome in found)
    _sum_up(found, len(work))
    return 1 if wrong + (_signals(found, asked.signals) if asked.signals else 0) else 0


def _warm() -> None:
    """Import what a try needs, so that its process finds it there."""
    import batik_vector.command.jobs
    import batik_vector.compiling.borders
    import batik_vector.export.dxf
    import batik_vector.export.pdf
    import batik_vector.recipe.reading.validator
    import batik_vector.tiling.cloth.field
    import batik_vector.tiling.cloth.yardage
    import batik_vector.tiling.tossing.toss  # noqa: F401

    with contextlib.suppress(ImportError):
        import cairosvg  # noqa: F401


def _line(each: Try, outcome: Outcome) -> str:
    return (
        f"{outcome.kind:9} {each.recipe:11} {each.key} = {each.value:g}  "
        f"{outcome.cpu:.1f} s ({outcome.wall:.1f}) {outcome.megabytes:.0f} MB  {outcome.words[:200]}"
    )


def _sum_up(found: Sequence[tuple[Try, Outcome]], planned: int) -> None:
    kinds = collections.Counter(outcome.kind for _, outcome in found)
    print(f"\n{len(found):,} tries of {planned:,}: {', '.join(f'{n:,} {kind}' for kind, n in kinds.items())}")
    if not found:
        return
    print(f"most memory {max(outcome.megabytes for _, outcome in found):.0f} MB; the slowest:")
    for each, outcome in sorted(found, key=lambda pair: -pair[1].cpu)[:15]:
        print("  " + _line(each, outcome))


def _signals(found: Sequence[tuple[Try, Outcome]], moments: int) -> int:
    """Stop the slowest tries at random moments; return how many did not hear it in time."""
    slowest = sorted((pair for pair in found if pair[1].is_good), key=lambda pair: -pair[1].cpu)[:10]
    chance, wrong, longest = random.Random(1), 0, 0.0
    for number in range(moments):
        each, outcome = slowest[number % len(slowest)]
        signum = signal.SIGINT if number % 2 else signal.SIGTERM
        wait = chance.uniform(0.1, outcome.wall + 0.3)
        seconds, code, left = stopped(each, wait, signum)
        longest = max(longest, seconds)
        torn = [name for name in left if name.startswith(".")]
        if seconds > HEARD or torn or code not in (0, 1, 2, 128 + signum, -signum):
            wrong += 1
            print(
                f"not heard: {each.recipe} {each.key} = {each.value:g} after {wait:.2f} s: "
                f"{signum.name}, {seconds:.2f} s, exit {code}, left {left}"
            )
    print(f"{moments} signals, {wrong} of them not heard in {HEARD:g} s; the longest took {longest:.2f} s")
    return wrong


if __name__ == "__main__":
    sys.exit(main())
