"""Tables of what makes a drawing ready for a machine."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmarks.acceptance import times
from benchmarks.contests.entrants import BATIK, Contest
from benchmarks.results import Results
from benchmarks.tables.spelling import NONE, cost, table


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


def cut(contests: Sequence[Contest], results: Results) -> Iterator[str]:
    """Yield what it takes to lead a drag knife round stars, and how far its tip is off them."""
    (contest,) = contests
    count = int(contest.entrants[0].command[-1])
    yield "How far the tip is off is simulated: it trails behind its holder as a castor does."
    yield ""
    body = []
    for entrant in contest.entrants:
        name = f"{contest.name}/{entrant.name}"
        ratio, found = results.ratio(name, f"{contest.name}/{BATIK}"), results.facts.get(f"{name} off")
        shown = NONE if ratio is None or entrant.name == BATIK else times(ratio)
        told = [NONE] * 3
        if found:
            told = [f"{found['corners']:.3f} mm", f"{found['astray']:.3f} mm", f"{found['area']:.4%}"]
        body.append((entrant.says, results.missing.get(name) or cost(results, name), shown, *told))
    head = ("CPU", "ratio of CPU", "off a corner", "off the outline", "off in area")
    yield from table((f"{count:,} stars of ten corners", *head), body)
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
