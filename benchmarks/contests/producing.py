"""Contests of what makes a drawing ready for a machine."""

from __future__ import annotations

from benchmarks.contests.entrants import BATIK, Contest, Entrant, Fact, own, peer
from benchmarks.contests.plans import Plan


def lines(plan: Plan) -> list[Contest]:
    """Lines drawn once and joined."""

    def contest(name: str, side: int, steps: str) -> Contest:
        theirs = peer("vpype_lines", steps, str(side))
        return Contest(
            name,
            (
                Entrant(BATIK, "batik_vector, drawn once and joined", own("stages", "once", str(side)), True),
                Entrant("vpype", "vpype", theirs, True),
            ),
            plan.rounds,
        )

    return [
        contest("lines drawn twice", plan.squares, "deduplicate,linemerge,linesort"),
        contest("lines joined", plan.merged, "linemerge,linesort"),
    ]


def plotted(plan: Plan) -> list[Contest]:
    """Strokes of a plotter, each drawn once, joined and in order."""
    side = str(plan.plotted)
    theirs = peer("vpype_lines", "deduplicate,linemerge,linesort", side)
    mine = Entrant(BATIK, BATIK, own("plotting", side), True)
    # The peer takes half a minute each time.
    return [Contest("plotted", (mine, Entrant("vpype", "vpype", theirs, True)), min(plan.rounds, 3))]


MOST_TURNED = 10_000
"""Strokes up to which vpype's 2-opt takes part in every round: its work grows with their square."""


def order(plan: Plan) -> list[Contest]:
    """Strokes brought into an order with little way between them."""

    def contest(count: int) -> Contest:
        turned = "vpype `linesort --two-opt --passes 5`"
        rounds = 1 if count > MOST_TURNED else None
        entrants = (
            Entrant(BATIK, BATIK, own("ordering", str(count)), True),
            Entrant("0", "vpype `linesort`", peer("vpype_order", "0", str(count)), True),
            Entrant("5", turned, peer("vpype_order", "5", str(count)), True, rounds=rounds),
        )
        return Contest(f"order {count}", entrants, plan.rounds)

    return [contest(count) for count in plan.strokes]


def hatch(plan: Plan) -> list[Contest]:
    """The drawing's marks filled at 0.5 mm."""
    size = str(plan.rings)
    ways = {
        BATIK: ("parallel", "batik_vector, `parallel`, ink inside, and the edge"),
        "bare": ("bare", "batik_vector, `parallel` up to the edge"),
        "concentric": ("concentric", "batik_vector, `concentric`"),
        "spiral": ("spiral", "batik_vector, `spiral`"),
    }
    mine = [Entrant(name, says, own("hatching", way, size), True) for name, (way, says) in ways.items()]
    peers = [
        Entrant(name, f"vpype `{name}`", peer("vpype_hatch", name, size), True) for name in ("efill", "cfill")
    ]
    return [Contest("hatch", (*mine, *peers), min(plan.rounds, 3))]


def cut(plan: Plan) -> list[Contest]:
    """Stars cut by a drag knife."""
    count = str(plan.rings)
    entrants = (
        Entrant(BATIK, BATIK, own("cutting", count), True),
        Entrant("plottool", "plottool, `optimizeCut` and `bladeOffset`", peer("plottool_knife", count), True),
    )
    return [Contest("cut", entrants, plan.rounds)]


def audit(plan: Plan) -> list[Contest]:
    """A tile held to a machine, beside what it costs to compile it."""
    entrants = (
        Entrant(name, says, own("auditing", str(plan.rings), name), True)
        for name, says in (("apart", "marks apart"), ("welded", "marks welded to a net"))
    )
    return [Contest("audit", tuple(entrants), plan.rounds)]


def _once_more(contests: list[Contest], word: str) -> list[Fact]:
    """Return facts that every entrant's own command tells, asked by one word more."""
    return [
        Fact(f"{contest.name}/{entrant.name} {word}", (*entrant.command, word), contest.rings)
        for contest in contests
        for entrant in contest.entrants
        # Who takes minutes is not asked a second time.
        if entrant.rounds is None
    ]


def order_facts(plan: Plan) -> list[Fact]:
    """What way is left with the pen up."""
    return _once_more(order(plan), "way")


def cut_facts(plan: Plan) -> list[Fact]:
    """How far a knife's tip is off what it was to cut."""
    count = str(plan.few)
    return [
        Fact(f"cut/{BATIK} off", own("cutting", count, "off")),
        Fact("cut/plottool off", peer("plottool_knife", count, "off")),
    ]


def hatch_facts(plan: Plan) -> list[Fact]:
    """How many strokes fill the drawing, and how long they are."""
    return _once_more(hatch(plan), "drawn")
