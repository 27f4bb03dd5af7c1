"""Reports of processes in words: what `batik-vector compile` prints for people of strokes and plates."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from batik_vector.units import format_mm

Facts = Mapping[str, Any]

TOLD_MM = 0.05
"""What is left out is told of in words from here on: shorter stretches are no more than the grid's."""
LEAST_BARE = 0.005
"""mm² of cloth that are told of: what rounds to nothing is none."""


def told_of(facts: Facts) -> Iterator[str]:
    """Yield in lines what the processes that a file went through have to report."""
    for kind, tell in _TOLD.items():
        if kind in facts:
            yield from tell(facts[kind])


def _plot(facts: Facts) -> Iterator[str]:
    yield f"{_work(facts)}{_changes(facts['pen_changes'])}"
    if len(facts["pens"]) > 1:
        for each in facts["pens"]:
            yield f"pen {each['pen']}, {each['ink']}: {_work(each)}"
    doubled = facts["doubled"]
    if doubled["saved_mm"] >= TOLD_MM:
        longest = doubled["places"][0]
        x, y = longest["at_mm"]
        yield (
            f"{_counted(doubled['stretches'], 'stretch', 'stretches')} drawn already left out, "
            f"{metres(doubled['saved_mm'])}; the longest at {x:.3f}, {y:.3f} mm ({longest['ink']})"
        )
    if facts.get("unreached_mm2"):
        yield f"{facts['unreached_mm2']:,} mm² are too narrow for the pen and stay white"
    if facts.get("hidden_mm", 0.0) >= TOLD_MM:
        yield f"{metres(facts['hidden_mm'])} hidden under higher inks left out"


def _cut(facts: Facts) -> Iterator[str]:
    for each in facts["tools"]:
        yield f"{each['tool']}: {_cuts(each)}"
        if each.get("shared_edges"):
            yield f"{metres(each['shared_mm'])} that two parts share, cut once"
        if each.get("left_uncut_mm2", 0.0) >= 0.005:  # what rounds to nothing is not worth a line
            yield f"{each['left_uncut_mm2']:,.2f} mm² of corners and gaps too narrow for the kerf stay uncut"
        if "sheets" in each:
            yield (
                f"{_counted(each['pieces'], 'piece', 'pieces')} on {format_mm(each['height_used_mm'])} mm of "
                f"the sheet, {each['covered']:.0%} of it covered, one of {each['sheets']}"
            )


def _wax(facts: Facts) -> Iterator[str]:
    for each in facts["plates"]:
        pieces = _counted(each["pieces"], "piece", "pieces")
        area = f"{each['area_mm2'] / 100:,.1f} cm²"
        yield f"{each['plate']}: {area} in {pieces}, {each['covers']:.1%} of the cloth"
        drawn = [
            f"{metres(1000 * one['metres'])} with {one['canting']} ({format_mm(one['spout_mm'])} mm)"
            for one in each["cantings"]
            if one["metres"] >= 0.001
        ]
        dots = [f"{_counted(each['dots'], 'dot', 'dots')} among them"] if each["dots"] else []
        if drawn:
            yield f"  {', '.join(drawn + dots)}"
        for one in each["cantings"]:
            saved = one.get("at_once", {})
            if saved.get("metres_saved") or saved.get("dots_saved"):
                spouts = f"{saved['spouts']} spouts {format_mm(saved['pitch_mm'])} mm apart"
                yield (
                    f"  {one['canting']} with {spouts} saves "
                    f"{metres(1000 * saved['metres_saved'])} of line and "
                    f"{_counted(saved['dots_saved'], 'touch', 'touches')} for dots"
                )
        if each["finer_mm2"] >= 0.05:
            yield f"  {each['finer_mm2']:,.1f} mm² are finer than the finest canting: points, or thin lines"


def _stencil(facts: Facts) -> Iterator[str]:
    for each in facts["sheets"]:
        yield f"{each['ink']}: {_held(each, facts)}"
        if each["dropped"]:
            yield f"{_counted(each['dropped'], 'small island', 'small islands')} left to fall out"
        if member := each["narrowest_member"]:
            yield f"narrowest member {format_mm(member['mm'])} mm {_place(member)}"
        if neck := each["weakest_neck"]:
            bridges = _counted(neck["bridges"], "bridge", "bridges")
            yield f"weakest neck {_place(neck)}: {neck['holds_mm2']:,} mm² hang on {bridges}"


def _held(facts: Facts, all_: Facts) -> str:
    openings = _counted(facts["openings"], "opening", "openings")
    islands = _counted(facts["islands"], "island", "islands")
    if all_["backing"] == "net":
        return f"{openings}, {islands} held by the net"
    bridges = _counted(facts["bridges"], "bridge", "bridges")
    closed = f" that close {facts['closed_mm2']:,} mm²" if facts["bridges"] else ""
    return f"{openings}, {islands}, {bridges} of {format_mm(all_['bridge_mm'])} mm{closed}"


def _place(facts: Facts) -> str:
    x, y = facts["at_mm"]
    return f"at {x:.3f}, {y:.3f} mm"


def _trap(facts: Facts) -> Iterator[str]:
    width = format_mm(facts["width_mm"])
    for each in facts["pairs"]:
        yield f"{each['ink']} spreads {width} mm under {each['under']} along {metres(each['length_mm'])}"
    for each in facts["gains"]:
        yield f"{each['ink']} gains {each['area_mm2']:,.2f} mm²"
    if not facts["pairs"]:
        yield 'no two inks meet side by side: there is nothing to trap (overlap = "knockout" cuts inks out)'
    if facts["covered"]:
        yield f"{_counted(facts['covered'], 'mark is', 'marks are')} covered whole by traps"


def _separate(facts: Facts) -> Iterator[str]:
    if "covers" in facts:
        yield f"{facts['ink']}: covers {facts['covers']:.1%} of the page"


def _misregister(facts: Facts) -> Iterator[str]:
    for ink, (right, up) in facts["shifts_mm"].items():
        if right or up:
            yield f"{ink} is off by {format_mm(right)} mm to the right and {format_mm(up)} mm up"
    bare = facts["bare_mm2"]
    shows = f"{bare:,.2f} mm² of cloth show" if bare >= LEAST_BARE else "no cloth shows"
    yield f"{shows} between inks"


def _crackle(facts: Facts) -> Iterator[str]:
    size = format_mm(round(facts["piece_mm"], 2))
    waxed = f"{facts['dyed']:.1%} of {facts['waxed_mm2'] / 100:,.1f} cm² that were waxed"
    cracks = _counted(facts["cracks"], "crack", "cracks")
    yield f"{cracks}, pieces of {size} mm on average; {facts['dye']} takes {waxed}"


def _hand(facts: Facts) -> Iterator[str]:
    yield f"drawn by hand: places are off by up to {format_mm(facts['most_mm'])} mm"


def _cuts(facts: Facts) -> str:
    if not facts["contours"]:
        return "nothing is left to cut"
    contours = _counted(facts["contours"], "contour", "contours")
    tabs = f", {_counted(facts['tabs'], 'tab', 'tabs')}" if facts["tabs"] else ""
    return f"{contours}{tabs}, {metres(facts['cut_mm'])} cut, {_way(facts)}"


def _work(facts: Facts) -> str:
    if not facts["strokes"]:
        return "nothing is left to draw"
    strokes = _counted(facts["strokes"], "stroke", "strokes")
    return f"{strokes}, {metres(facts['drawn_mm'])} drawn, {_way(facts)}"


def _way(facts: Facts) -> str:
    return f"{metres(facts['travel_mm'])} between them, about {duration(facts['seconds'])}"


def _changes(count: int) -> str:
    return f" with {_counted(count, 'change', 'changes')} of pen" if count else ""


def _counted(count: int, one: str, many: str) -> str:
    return f"{count:,} {one if count == 1 else many}"


def metres(mm: float) -> str:
    """Return a way in m, or in mm where it is short of one."""
    return f"{mm / 1000:,.2f} m" if mm >= 1000 else f"{format_mm(round(mm, 1))} mm"


def duration(seconds: float) -> str:
    """Return a time in the two largest units that it has: ``"2 h 5 min"``."""
    whole = round(seconds)
    hours, minutes = divmod(whole // 60, 60)
    if hours:
        return f"{hours:,} h {minutes} min"
    return f"{minutes} min {whole % 60} s" if minutes else f"{whole} s"


_TOLD: dict[str, Callable[[Facts], Iterator[str]]] = {
    "stencil": _stencil,
    "plot": _plot,
    "cut": _cut,
    "wax": _wax,
    "trap": _trap,
    "separate": _separate,
    "misregister": _misregister,
    "hand": _hand,
    "crackle": _crackle,
}
"""What tells of each process, by its kind."""
