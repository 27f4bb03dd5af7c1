"""Tables of a designer's work."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmarks.acceptance import seconds, times
from benchmarks.contests.designing import SEARCHES
from benchmarks.contests.entrants import BATIK, Contest
from benchmarks.drawing import RING
from benchmarks.results import Results
from benchmarks.tables.spelling import NONE, cost, median, table


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


def fill(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what fills cost mark by mark and all at once, and packing beside a toss."""
    *fills, leaves = contests
    for contest in fills:
        body = []
        for entrant in contest.entrants:
            name = f"{contest.name}/{entrant.name}"
            ratio, drawn = results.ratio(name, f"{contest.name}/{BATIK}"), results.facts.get(f"{name} drawn")
            shown = results.missing.get(name) or cost(results, name)
            told = NONE if ratio is None or entrant.name == BATIK else times(ratio)
            body.append((entrant.says, shown, told, f"{drawn['marks']:,}" if drawn else NONE))
        yield from table((contest.name.split()[-1], "CPU", "ratio of CPU", "marks"), body)
        yield ""
    packed: list[tuple[str, ...]] = []
    for entrant in leaves.entrants:
        name = f"{leaves.name}/{entrant.name}"
        drawn = results.facts.get(f"{name} drawn")
        made = [NONE] * 3
        if drawn:
            made = [f"{drawn['marks']:,}", f"{drawn['covers']} %", f"{drawn['gap']:g} mm"]
        packed.append((entrant.says, results.missing.get(name) or cost(results, name), *made))
    side = leaves.entrants[0].command[-1]
    yield from table((f"twelve leaves on {side} × {side} mm", "CPU", "marks", "cover", "least gap"), packed)
    yield ""
