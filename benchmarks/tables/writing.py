"""Tables of writers: everyone beside us."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmarks.acceptance import MIB, seconds, times
from benchmarks.contests.entrants import BATIK, Contest
from benchmarks.drawing import RING
from benchmarks.results import Results
from benchmarks.tables.spelling import NONE, cost, median, table


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
