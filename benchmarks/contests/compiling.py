"""Contests of the road from recipe to files: its growth, its least, its start."""

from __future__ import annotations

from collections.abc import Sequence

from benchmarks.contests.entrants import BATIK, Contest, Entrant, own
from benchmarks.contests.plans import Plan
from benchmarks.timing import OWN, PEERS

FOUR_SQUARE = "samples/four-square.toml"

SLIDER_KNOBS = ("petal length", "pistil length", "leaf point", "size of all")
"""What is turned in the sample, one at a time."""


def growth(plan: Plan) -> list[Contest]:
    """The same drawing in many sizes, stage by stage; then marks that are welded, and lines joined."""

    def contest(name: str, task: str, sizes: Sequence[int]) -> Contest:
        entrants = (
            Entrant(str(rings), f"{rings:,} marks", own("stages", task, str(rings)), True) for rings in sizes
        )
        return Contest(name, tuple(entrants), plan.rounds)

    return [
        contest("growth", "stages", plan.growth),
        contest("welding", "weld", plan.overlays),
        contest("joining", "join", plan.overlays),
    ]


def limits(plan: Plan) -> list[Contest]:
    """Every stage beside the least that it could cost."""
    size = str(plan.rings)
    return [
        Contest(
            "limits",
            (
                Entrant(BATIK, BATIK, own("stages", "stages", size, "plain"), True),
                Entrant("limit", "the least", own("limits", "stages", size), True),
            ),
            plan.rounds,
        ),
        Contest(
            "overlay limits",
            (
                Entrant("weld", BATIK, own("stages", "weld", str(plan.few)), True),
                Entrant("join", BATIK, own("stages", "join", str(plan.few)), True),
                Entrant("limit", "the least", own("limits", "overlays", str(plan.few)), True),
            ),
            plan.rounds,
        ),
    ]


def start(plan: Plan) -> list[Contest]:
    """Start-up."""
    batik, vpype, python = str(OWN / "batik-vector"), str(PEERS / "vpype"), str(OWN / "python")
    compile_ = (batik, "compile", FOUR_SQUARE, "-o", "{folder}", "-f", "svg")
    commands = {
        "batik --help": ("`batik-vector --help`", (batik, "--help")),
        "batik --version": ("`batik-vector --version`", (batik, "--version")),
        "batik compile": (f"`batik-vector compile {FOUR_SQUARE} -f svg`", compile_),
        "vpype --help": ("`vpype --help`", (vpype, "--help")),
        "vpype --version": ("`vpype --version`", (vpype, "--version")),
        "python": ("`python -c pass`", (python, "-c", "pass")),
        "numpy": ("`python -c 'import numpy, shapely'`", (python, "-c", "import numpy, shapely")),
    }
    entrants = (Entrant(name, says, command) for name, (says, command) in commands.items())
    return [Contest("start", tuple(entrants), plan.starts)]


def slider(plan: Plan) -> list[Contest]:
    """Recipe to artwork within a running program."""
    return [
        Contest("slider", (Entrant(BATIK, BATIK, own("sliding", "slider", FOUR_SQUARE), True),), plan.rounds)
    ]


def levels(plan: Plan) -> list[Contest]:
    """The layout of four squares at two levels."""
    return [Contest("levels", (Entrant(BATIK, BATIK, own("sliding", "levels"), True),), plan.rounds)]


def cloth(plan: Plan) -> list[Contest]:
    """Metres of cloth."""
    entrants = (
        Entrant(str(metres), f"{metres} m", own("sliding", "cloth", str(metres), "{folder}"), True)
        for metres in plan.cloth
    )
    return [Contest("cloth", tuple(entrants), plan.rounds)]
