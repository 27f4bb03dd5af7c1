"""Results as tables in Markdown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from benchmarks.acceptance import LIMITS, MIB, NEAR, NOT_RUN, rows, seconds, times
from benchmarks.contests import BATIK, FORMATS, SEARCHES, SECTIONS, SLIDER_KNOBS, Contest, Plan
from benchmarks.drawing import RING
from benchmarks.results import Results, exponent, over_log

NONE = "–"
STAGES = ("generation", "tiling", *FORMATS)
TITLES: Mapping[str, str] = MappingProxyType(
    {
        "svg": "SVG",
        "pdf": "PDF",
        "dxf": "DXF",
        "three": "Three files of one drawing",
        "lines": "Lines drawn once and joined",
        "plotted": "Strokes of a plotter",
        "order": "Strokes in order",
        "hatch": "Areas hatched",
        "audit": "Held to a machine",
        "growth": "Growth",
        "limits": "Beside the least",
        "start": "Start-up",
        "slider": "A slider's step",
        "levels": "Levels of a layout",
        "cloth": "Metres of cloth",
        "motif": "A drawing of one's own",
        "library": "The library",
        "sweep": "A sweep",
        "grown": "L-systems and contours",
    }
)


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


def acceptance(results: Results, plan: Plan, said: str) -> list[str]:
    """Return what was asked, line by line."""
    found = rows(results, plan, said)
    body = [(str(row.line), row.asked, row.measured, row.verdict) for row in found if row.measured != NOT_RUN]
    return table(("line", "asked", "measured", ""), body, left=4)


def race(contest: Contest, results: Results) -> list[str]:
    """Return a contest as a table: everyone beside us."""
    body = []
    per_vertex = contest.rings * RING
    for entrant in contest.entrants:
        name = f"{contest.name}/{entrant.name}"
        if name in results.missing:
            body.append((entrant.says, f"skipped: {results.missing[name]}", *[""] * 5))
            continue
        ratio = results.ratio(name, f"{contest.name}/{BATIK}")
        read = [f"{fact['vertices']:,} / {fact['share']:.4f}" for fact in results.facts.get(name, [])]
        drawn = "; ".join(dict.fromkeys(read)) or NONE
        memory = median(results, name, "mib", lambda mib: f"{mib:.0f} MiB, {mib * MIB / per_vertex:.0f}")
        body.append(
            (
                entrant.says,
                cost(results, name),
                median(results, name, "wall", seconds),
                "1" if entrant.name == BATIK or ratio is None else times(ratio),
                memory,
                median(results, name, "bytes", lambda size: f"{size:,.0f}"),
                drawn,
            )
        )
    head = ("", "CPU", "wall", "ratio of CPU", "memory, bytes per vertex", "bytes", "vertices / share")
    return table(head, body)


def races(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield contests as tables, each under its name."""
    for contest in contests:
        alone = "the writer alone" if contest.name.endswith("alone") else "whole processes, start-up included"
        yield f"{contest.rings * RING:,} vertices, {alone}:"
        yield ""
        yield from race(contest, results)
        yield ""


def lines(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield the steps on lines, vpype's beside ours that does several of them at once."""
    for contest in contests:
        sides, commands = int(contest.entrants[1].command[-1]), contest.entrants[1].command[-2].split(",")
        own = f"{contest.name}/{BATIK}/once"
        body = [(contest.entrants[0].says, f"{4 * sides * sides:,}", cost(results, own), "1")]
        given = 4 * sides * sides if "deduplicate" in commands else 2 * sides * (sides + 1)
        for command in commands:
            name = f"{contest.name}/vpype/{command}"
            ratio = results.ratio(name, own)
            shown = results.missing.get(f"{contest.name}/vpype") or cost(results, name)
            body.append((f"vpype `{command}`", f"{given:,}", shown, NONE if ratio is None else times(ratio)))
        yield from table(("", "segments", "CPU", "ratio of CPU"), body)
        yield ""


def plotted(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what a plotter's passes take, vpype's beside ours."""
    for contest in contests:
        sides = int(contest.entrants[0].command[-1])
        body = []
        for pass_, command in (("once", "deduplicate"), ("joined", "linemerge"), ("ordered", "linesort")):
            own, name = f"{contest.name}/{BATIK}/{pass_}", f"{contest.name}/vpype/{command}"
            ratio = results.ratio(name, own)
            theirs = results.missing.get(f"{contest.name}/vpype") or cost(results, name)
            ratio_words = NONE if ratio is None else times(ratio)
            body.append((f"{pass_}, vpype `{command}`", cost(results, own), theirs, ratio_words))
        yield from table((f"{4 * sides * sides:,} segments", BATIK, "vpype", "ratio of CPU"), body)
        yield ""


def order(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what it takes to order strokes, and the way that is left, as a multiple of the shortest tree."""
    yield "The way with the pen up is told as a multiple of the shortest tree that joins the strokes: none is"
    yield "shorter, and about 1.25 times it is the least there is for such strokes."
    yield ""
    for contest in contests:
        body = []
        for entrant in contest.entrants:
            name = f"{contest.name}/{entrant.name}"
            ratio = results.ratio(name, f"{contest.name}/{BATIK}")
            way = results.facts.get(f"{name} way")
            shown = NONE if ratio is None or entrant.name == BATIK else times(ratio)
            left = NONE if way is None else f"{way['ratio']:.3f}"
            body.append((entrant.says, results.missing.get(name) or cost(results, name), shown, left))
        yield from table((f"{contest.name.split()[-1]} strokes", "CPU", "ratio of CPU", "way"), body)
        yield ""


def hatch(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what it takes to fill areas with strokes, and how many and how long these are."""
    (contest,) = contests
    yield "`efill` (parallel, vpype-embroidery) goes up to the edge and along it again and again: a mark is"
    yield "one stroke; `cfill` (concentric, vpype-cfill) begins with the edge. batik_vector keeps the ink"
    yield "inside, but in the second row."
    yield ""
    body = []
    for entrant in contest.entrants:
        name = f"{contest.name}/{entrant.name}"
        drawn = results.facts.get(f"{name} drawn")
        told = [f"{drawn['strokes']:,}", f"{drawn['metres']:,.0f} m"] if drawn else [NONE, NONE]
        ratios = [results.ratio(f"{contest.name}/{peer}", name) for peer in ("efill", "cfill")]
        shown = [NONE if ratio is None else times(ratio) for ratio in ratios]
        body.append((entrant.says, results.missing.get(name) or cost(results, name), *shown, *told))
    yield from table(("0.5 mm apart", "CPU", "efill takes", "cfill takes", "strokes", "drawn"), body)
    yield ""


def audit(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what a tile's audit costs beside its compiling."""
    for contest in contests:
        body = []
        for entrant in contest.entrants:
            name = f"{contest.name}/{entrant.name}"
            ratio = results.ratio(f"{name}/audit", f"{name}/compile")
            shown = NONE if ratio is None else times(ratio)
            body.append(
                (entrant.says, cost(results, f"{name}/compile"), cost(results, f"{name}/audit"), shown)
            )
        yield from table(("", "compiled and written", "audited", "ratio of CPU"), body)
        yield ""


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


def motif(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what reading a drawing costs, and a grid of it."""
    for contest in contests:
        body = []
        for entrant in contest.entrants:
            name = f"{contest.name}/{entrant.name}"
            ratio = results.ratio(name, f"{contest.name}/{BATIK}")
            shown = results.missing.get(name) or cost(results, name)
            size = median(results, name, "bytes", lambda size: f"{size:,.0f}" if size else NONE)
            body.append((entrant.says, shown, NONE if ratio is None else times(ratio), size))
        segments = f"{contest.name}, {contest.rings * RING:,} segments"
        yield from table((segments, "CPU", "ratio of CPU", "bytes"), body)
        yield ""


def library(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what searching a library costs."""
    inside, commands = contests
    count = int(inside.entrants[0].command[-2])
    names = {f"{way}, in process": f"library/{BATIK}/{way}" for way in SEARCHES}
    names |= {each.says: f"{commands.name}/{each.name}" for each in commands.entrants}
    body = [(says, cost(results, name), cost(results, name, "wall")) for says, name in names.items()]
    yield from table((f"{count:,} patterns", "CPU", "wall"), body)
    yield ""


def sweep(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what a sweep costs, and how much longer others take."""
    (contest,) = contests
    count = int(contest.entrants[0].command[-2])
    body = []
    for entrant in contest.entrants:
        name = f"sweep/{entrant.name}"
        found = results.of(name, "wall")
        shown = results.missing.get(name) or cost(results, name, "wall")
        ratio = results.ratio(name, "sweep/2", "wall")
        each = NONE if found is None else seconds(found.median / count)
        body.append((entrant.says, shown, cost(results, name), each, NONE if ratio is None else times(ratio)))
    yield from table((f"{count:,} variants", "wall", "CPU", "wall of each", "ratio of wall"), body)
    yield ""


def grown(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what lines, strokes and rings cost."""
    for contest in contests:
        body = []
        for entrant in contest.entrants:
            name = f"{contest.name}/{entrant.name}"
            ratio = results.ratio(name, f"{contest.name}/{BATIK}")
            shown = results.missing.get(name) or cost(results, name)
            body.append((entrant.says, shown, NONE if ratio is None else times(ratio)))
        yield from table((contest.name, "CPU", "ratio of CPU"), body)
        yield ""


SHOWN: Mapping[str, Callable[[Sequence[Contest], Results], Iterator[str]]] = MappingProxyType(
    {
        **dict.fromkeys(("svg", "pdf", "dxf", "three"), races),
        "lines": lines,
        "plotted": plotted,
        "order": order,
        "hatch": hatch,
        "audit": audit,
        "growth": growth,
        "limits": limits,
        "start": start,
        "slider": slider,
        "levels": levels,
        "cloth": cloth,
        "motif": motif,
        "library": library,
        "sweep": sweep,
        "grown": grown,
    }
)


def machine(about: Mapping[str, Any]) -> list[str]:
    """Return on what it ran."""

    def listed(versions: Mapping[str, str]) -> str:
        return ", ".join(f"{name} {version}" for name, version in versions.items()) or "not installed"

    return [
        f"{about['date']}, {about['processor']}, {about['cores']} cores, {about['system']}, "
        f"load {about['load']} at the start.",
        "",
        f"batik_vector with {listed(about['own'])}.",
        "",
        f"Peers with {listed(about['peers'])}.",
    ]


def page(results: Results, plan: Plan, sections: Sequence[str], said: str = "") -> str:
    """Return everything that is generated; ``said`` is what stands behind it."""
    out = [
        *machine(results.facts["about"]),
        "",
        "### What was asked",
        "",
        *acceptance(results, plan, said),
        "",
    ]
    for section in sections:
        out += [f"### {TITLES[section]}", "", *SHOWN[section](SECTIONS[section](plan), results)]
    return "\n".join(out).strip() + "\n"
