"""Tables of the road from recipe to files."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType

from benchmarks.acceptance import LIMITS, NEAR, times
from benchmarks.contests.compiling import SLIDER_KNOBS
from benchmarks.contests.entrants import BATIK, Contest
from benchmarks.contests.writing import FORMATS
from benchmarks.drawing import RING
from benchmarks.results import Results, exponent, over_log
from benchmarks.tables.spelling import NONE, cost, median, table

STAGES = ("generation", "tiling", *FORMATS)


def growth(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield every stage's cost by size, and the exponents."""
    for contest in contests:
        stages = STAGES if contest.name == "growth" else (contest.name,)
        sizes = [int(entrant.name) for entrant in contest.entrants]
        body = []
        for stage in stages:
            names = [f"{contest.name}/{rings}/{stage}" for rings in sizes]
            body.append((stage, *[cost(results, name) for name in names], *_exponents(results, names, sizes)))
        head = (
            "stage",
            *(f"{rings * RING:,}" for rings in sizes),
            "exponent",
            "largest three",
            "over log n",
        )
        yield from table(head, body)
        yield ""


def _exponents(results: Results, names: Sequence[str], sizes: Sequence[int]) -> tuple[str, str, str]:
    costs = results.medians(names)
    if costs is None or len(sizes) < 2:
        return NONE, NONE, NONE
    sorted_out = over_log([size * RING for size in sizes], costs)
    fits = exponent(sizes, costs), exponent(sizes[-3:], costs[-3:]), exponent(sizes, sorted_out)
    return f"{fits[0]:.2f}", f"{fits[1]:.2f}", f"{fits[2]:.2f}"


LEAST: Mapping[str, str] = MappingProxyType(
    {
        "generation": "the curve worked out at every vertex with NumPy",
        "tiling": "rounding to the grid, polygons from arrays, their validity",
        "svg": "digits from tables and one write",
        "pdf": "digits from tables, zlib level 1 and one write",
        "dxf": "digits and group codes from tables and one write",
        "welding": "GEOS' own union of all marks, off the grid",
        "joining": "sorting the ends, and the sides by them",
        "compile": "importing NumPy and shapely",
        "help": "starting Python",
        "version": "starting Python",
    }
)


def limits(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield every stage beside the least it could cost, and whether it is within a factor of two."""
    body = []
    for stage, own, least in LIMITS:
        ratio = results.ratio(own, least)
        within = NONE if ratio is None else "yes" if ratio.median <= NEAR else "**no**"
        body.append(
            (
                stage,
                cost(results, own),
                cost(results, least),
                NONE if ratio is None else times(ratio),
                within,
                LEAST[stage],
            )
        )
    yield from table(("stage", "ours", "the least", "ratio", "within 2×", "what the least is"), body)
    yield ""
    few = next(each for each in contests if each.name == "overlay limits").entrants[0].command[-1]
    yield (
        f"Welding and joining at {int(few) * RING:,} vertices; help, version and compile are the commands of "
        "the section on start-up."
    )
    yield ""


def start(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what commands cost before they do anything."""
    (contest,) = contests
    body = []
    for entrant in contest.entrants:
        name = f"start/{entrant.name}"
        shown = results.missing.get(name) or cost(results, name)
        body.append((entrant.says, shown, cost(results, name, "wall")))
    yield from table(("", "CPU", "wall"), body)
    yield ""


def slider(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what one step of a slider costs."""
    names = {
        "the first compilation of a process": "cold",
        **{f"{knob} turned": knob for knob in SLIDER_KNOBS},
        "nothing turned": "unchanged",
        "reading the recipe, in addition": "reading",
    }
    prefix = f"slider/{BATIK}"
    body = [
        (says, cost(results, f"{prefix}/{name}"), cost(results, f"{prefix}/{name}", "wall"))
        for says, name in names.items()
    ]
    yield from table(("", "CPU", "wall"), body)
    yield ""


def levels(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what both levels cost."""
    body = []
    for shift, says in (("", "flowers apart, as in the paper"), (", overlapping", "leaves overlap")):
        prefix = f"levels/{BATIK}"
        ratio = results.ratio(f"{prefix}/level 4{shift}", f"{prefix}/level 1{shift}")
        parts = (f"{prefix}/{part}{shift}" for part in ("level 1", "level 4", "writing"))
        shown = NONE if ratio is None else times(ratio)
        body.append((says, *(cost(results, part) for part in parts), shown))
    yield from table(("", "level 1", "level 4", "writing level 4 as SVG", "ratio"), body)
    yield ""


def cloth(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what metres of cloth cost."""
    (contest,) = contests
    body = []
    for format_ in FORMATS:
        for entrant in contest.entrants:
            name = f"cloth/{entrant.name}/{format_}"
            count = median(results, name, "vertices", lambda n: f"{n:,.0f}")
            memory = median(results, name, "mib", lambda mib: f"{mib:.0f} MiB")
            body.append((format_, entrant.says, count, cost(results, name), memory))
    yield from table(("format", "length", "vertices", "CPU", "memory"), body)
    yield ""
    lengths = [int(entrant.name) for entrant in contest.entrants]
    grown = []
    for format_ in FORMATS:
        costs = results.medians(f"cloth/{metres}/{format_}" for metres in lengths)
        if costs and len(lengths) > 1:
            grown.append(f"{format_} {exponent(lengths, costs):.2f}")
    if grown:
        yield f"Exponents by length: {', '.join(grown)}."
        yield ""
