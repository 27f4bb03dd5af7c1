"""Contests of a designer's work: drawings of one's own, a library, sweeps, grown lines, fills."""

from __future__ import annotations

from benchmarks.contests.entrants import BATIK, Contest, Entrant, Fact, own, peer
from benchmarks.contests.plans import Plan
from benchmarks.drawing import TIMES, size
from benchmarks.timing import OWN, PEERS

SEARCHES = (
    "list",
    "text",
    "text of two letters",
    "text in all",
    "tag",
    "feature",
    "likeness",
    "all together",
)
"""Ways of searching a library."""

VPYPE_RINGS = 10
"""Marks of the drawing that vpype sets out: it reads the file again for every copy, 100 times."""


def motif(plan: Plan) -> list[Contest]:
    """A drawing of one's own: read, and set out in a grid."""
    rings = str(plan.few)
    compile_ = (str(OWN / "batik-vector"), "compile", "{folder}/curves.toml", "-o", "{folder}/out")
    mine = Entrant(BATIK, "`batik-vector compile`", compile_, drawn=("out/curves.svg",))
    width, height = (f"{side / TIMES}mm" for side in size(VPYPE_RINGS))
    grid = ("begin", "grid", "-o", width, height, str(TIMES), str(TIMES))
    read = ("read", "-q", "0.2mm", "{folder}/curves.svg", "scale", str(1 / TIMES), str(1 / TIMES), "end")
    theirs = (str(PEERS / "vpype"), *grid, *read, "write", "{folder}/vpype.svg")
    readers = (
        Entrant(BATIK, "batik_vector, `Svg.read`", own("own", "read", rings, "{folder}"), True),
        Entrant("svgelements", "svgelements, `SVG.parse`", peer("svgelements_read", rings, "{folder}"), True),
    )
    vpype = Entrant("vpype", "`vpype begin grid … read … end write`", theirs, drawn=("vpype.svg",))
    return [
        Contest("drawing read", readers, plan.rounds, plan.few),
        Contest("drawing in a grid", (mine,), plan.rounds, plan.few),
        Contest("small drawing in a grid", (mine, vpype), plan.rounds, VPYPE_RINGS),
    ]


def library(plan: Plan) -> list[Contest]:
    """A library of many patterns with pictures, searched within a process and as a command."""
    inside = Entrant(BATIK, BATIK, own("library", str(plan.patterns), "{folder}"), True)
    batik, file = str(OWN / "batik-vector"), "{folder}/patterns.library"
    command = (
        batik,
        "library",
        "search",
        "kembang",
        "--where",
        "inks <= 3, coverage 20..40",
        "--library",
        file,
    )
    like = (batik, "library", "search", "--like", "sample/kawung", "--library", file)
    commands = (
        Entrant("search", "`library search kembang --where …`", command),
        Entrant("like", "`library search --like …`", like),
    )
    return [Contest("library", (inside,), plan.rounds), Contest("library command", commands, plan.starts)]


def sweep(plan: Plan) -> list[Contest]:
    """Many variants of the sample."""
    count = str(plan.variants)
    ways = {"1": "`sweep -j 1`", "2": "`sweep -j 2`", "loop": "a shell's loop over `compile --set`"}
    mine = [
        Entrant(way, says, own("sweeps", way, count, "{folder}"), rounds=1 if way == "loop" else None)
        for way, says in ways.items()
    ]
    peers = [
        Entrant(name, says, peer(script, count, "{folder}"), rounds=1)
        for name, says, script in (
            ("vsketch", "vsketch, its curves alone", "vsketch_sweep"),
            ("same", "vsketch with shapely, the same tiles", "vsketch_whole"),
        )
    ]
    return [Contest("sweep", (*mine, *peers), min(plan.rounds, 3))]


def grown(plan: Plan) -> list[Contest]:
    """L-systems to lines and to strokes, and a field to rings."""

    def task(name: str, says: str, *words: str) -> Entrant:
        return Entrant(name, says, own("growing", *words), True)

    hilbert, dragon, samples = str(plan.hilbert), str(plan.dragon), str(plan.samples)
    walked = peer("lsys_line", hilbert)
    contour = peer("matplotlib_contour", samples, "{folder}")
    strokes = [
        Contest(
            f"{name} stroked",
            (
                task(BATIK, "batik_vector, `on_lattice`", "stroke", name, level),
                task("shapely", "shapely, `buffer` of the same line", "buffer", name, level),
            ),
            plan.rounds,
        )
        for name, level in (("hilbert", hilbert), ("dragon", dragon))
    ]
    line = (
        task(BATIK, "batik_vector", "line", "hilbert", hilbert),
        Entrant("lsys", "lsys, `coords`", walked, True),
    )
    ringed = (
        # Who comes first leaves the field for the others.
        task("field", "the field itself, batik_vector", "field", samples, "{folder}"),
        task(BATIK, "batik_vector, smooth rings", "rings", samples, "{folder}"),
        Entrant("matplotlib", "matplotlib, `contour` of the same field", contour, True),
    )
    return [
        Contest("hilbert walked", line, plan.rounds),
        *strokes,
        Contest("mandelbrot ringed", ringed, plan.rounds),
    ]


def fill(plan: Plan) -> list[Contest]:
    """Dots in rows and parallel lines that fill a disc, and leaves that fill a tile."""
    size, side = str(plan.dots), str(plan.packed)
    fills = [
        Contest(
            f"fill {kind}",
            (
                Entrant(BATIK, BATIK, own("filling", kind, size), True),
                Entrant("loop", "a loop with shapely", own("filling", kind, size, "loop"), True),
                Entrant("vsketch", "a sketch of vsketch, shapely", peer("vsketch_fill", kind, size), True),
            ),
            plan.rounds,
        )
        for kind in ("cecek", "galaran")
    ]
    leaves = tuple(
        Entrant(name, f'`layout = {{ kind = "{name}" }}`', own("filling", name, side), True)
        for name in ("pack", "toss")
    )
    return [*fills, Contest("leaves", leaves, plan.rounds)]


def fill_facts(plan: Plan) -> list[Fact]:
    """How many marks were made, and what leaves cover."""
    return [
        Fact(f"{contest.name}/{entrant.name} drawn", (*entrant.command, "drawn"))
        for contest in fill(plan)
        for entrant in contest.entrants
    ]
