"""Reports in words: what ``batik-vector check`` and ``compile`` print for people."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from batik_vector.tiling.symmetry.machine_fit import per_cent
from batik_vector.units import format_mm

MOST_FAULTS = 20
"""Faults of a tile that are told in words; the report for machines has them all."""

MOST_REMARKS = 5
"""Remarks that are told in words."""

MOST_STRETCHES = 4
"""Stretches of ink along the edges that are told in words."""

TOLD_PERCENT = 0.001
"""A stretch below this comes from the grid alone, and nobody need hear of it."""


def told(facts: dict[str, Any]) -> list[str]:
    """Return the lines that tell the facts of a tile, as :mod:`batik_vector.command.checks` gathers them."""
    wrong = list(_faults(facts))
    source, count = facts["recipe"], len(wrong)
    lines = [f"{source}: {facts['title']}", *_drawing(facts), *_measures(facts["certificate"])]
    if count > MOST_FAULTS:
        wrong = [*wrong[:MOST_FAULTS], f"  and {count - MOST_FAULTS} more: --json tells them all"]
    lines += wrong
    lines += _remarks(facts["certificate"])
    audited = facts.get("audit")
    lines += _audited(audited) if audited else []
    lines += [f"  hint: {words}" for words in facts["certificate"]["hints"]]
    lines += [f"  not measured: {words}" for words in facts["certificate"]["unmeasured"]]
    lines += [f"  differs: {words}" for words in facts["differences"]]
    lines += [f"  warning: {words}" for words in facts["warnings"]]
    lines += [f"  note: {words}" for words in facts["notes"]]
    many = f"{count} fault{'s' if count != 1 else ''}" if count else ""
    if facts["passed"]:
        lines.append(f"{source}: passed{_passed(facts['certificate'])}")
    elif audited and not audited["passed"]:
        failed = f"{len(audited['findings']):,} findings for {audited['machine']}"
        lines.append(f"{source}: FAILED: {', '.join(filter(None, (many, failed)))}")
    elif not count:
        lines.append(f"{source}: NOT PASSED: no fault, but not all could be measured; --lenient lets it pass")
    else:
        lines.append(f"{source}: FAILED: {many}")
    return lines


def verdict(facts: dict[str, Any]) -> str:
    """Return the verdict on a tile in one or two words."""
    if facts["passed"]:
        return "passed"
    failed = list(_faults(facts)) or not facts.get("audit", {"passed": True})["passed"]
    return "FAILED" if failed else "NOT PASSED"


def table(sources: Sequence[str], found: Sequence[dict[str, Any]]) -> list[str]:
    """Return a table of what was found of many sources, one line each, those that could not be read too.

    Args:
        sources: as they were given.
        found: the facts of those that could be measured, in that order.
    """
    known = {facts["recipe"]: facts for facts in found}
    rows = [("", "verdict", "faults", "remarks", "crossings", "apart mm", "symmetry")]
    for source in dict.fromkeys(sources):
        facts = known.get(source)
        if facts is None:
            rows.append((source, "error", "", "", "", "", ""))
            continue
        certificate, worst = facts["certificate"], facts["certificate"]["measures"]
        faults, remarks = len(list(_faults(facts))), len(certificate["remarks"])
        counts = f"{faults:,}", f"{remarks:,}", f"{worst['crossings']:,}", _small(worst["mismatch"])
        rows.append((source, verdict(facts), *counts, certificate["symmetry"]["found"] or ""))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for row in rows:
        cells = (
            text.rjust(width) if 2 <= i <= 5 else text.ljust(width)
            for i, (text, width) in enumerate(zip(row, widths, strict=True))
        )
        lines.append("  ".join(cells).rstrip())
    return lines


def _passed(certificate: dict[str, Any]) -> str:
    """Return what is said behind "passed": that all agrees, or where ink ends by design."""
    along = certificate["ends_along_edges"]
    if not along:
        return ": opposite edges agree" + ("" if certificate["remarks"] else ", nothing is drawn twice")
    places = [
        f"the {each['edge']} edge at {'xy'[each['edge'][0] in 'lr' and each['edge'] != 'lower']} = "
        f"{format_mm(each['from_mm'])} to {format_mm(each['to_mm'])}"
        for each in along[:MOST_STRETCHES]
    ]
    more = f", and {len(along) - MOST_STRETCHES} more" if len(along) > MOST_STRETCHES else ""
    return (
        f"; ink ends along {', '.join(places)}{more} (exact there; welding or overprint decides whether a "
        "hair shows)"
    )


def _drawing(facts: dict[str, Any]) -> Iterator[str]:
    width, height = (format_mm(side) for side in facts["cell_mm"])
    drop, axis = facts["drop"], facts["drop_axis"]
    repeat = "straight" if drop == "0" else f"with a drop of {drop} of the {axis}"
    how = "compiled from the recipe" if facts["checked"] == "recipe" else "read from what is drawn"
    yield f"  tile {width} × {height} mm, repeats {repeat}; {facts['vertices']:,} vertices, {how}"
    for layer in facts["layers"]:
        marks = f"{layer['areas']:,} areas, {layer['lines']:,} lines"
        yield f"  {layer['ink']} ({layer['colour']}): {marks}, covers {100 * layer['covers']:.1f} %"


def _measures(certificate: dict[str, Any]) -> Iterator[str]:
    found, asked = certificate["symmetry"]["found"], certificate["symmetry"]["asked"]
    worst = certificate["measures"]
    yield f"  symmetry {found}" + (f", {asked} asked for" if asked else "")
    yield (
        f"  seam: {worst['crossings']:,} crossings, {worst['unpaired']:,} unpaired, at worst "
        f"{_small(worst['mismatch'])} mm and {_small(worst['turn'])}° apart"
    )
    yield (
        f"  cut elsewhere: {_small(worst['identity'])} mm² differ; slivers {_small(worst['slivers'])} mm; "
        f"drawn twice {_small(worst['doubled_length'])} mm, {_small(worst['doubled_area'])} mm²"
    )
    yield f"  striping: columns {worst['columns']:.1f} %, rows {worst['rows']:.1f} %"


def _small(value: float) -> str:
    """Return a figure that ought to be nought: two digits of it, or plain 0."""
    return f"{value:.2g}" if value else "0"


def _faults(facts: dict[str, Any]) -> Iterator[str]:
    yield from (f"  fault: {words}" for words in facts["broken"])
    yield from (f"  fault: {words}" for words in facts["violations"])
    certified = facts["certificate"]["faults"]
    for gap in facts["seam"] if not certified else ():
        words = f"{gap['edges']} edges disagree from {gap['from_mm']:g} to {gap['to_mm']:g} mm"
        yield f"  fault: {gap['ink']}: {words}"
    yield from (f"  {_at(fault)}" for fault in certified)


def _at(fault: dict[str, Any]) -> str:
    x, y = fault["where_mm"]
    ink = f"{fault['ink']}: " if fault["ink"] else ""
    return f"at {x:.3f}, {y:.3f} mm: {ink}{fault['words']}"


MOST_PLACES = 3
"""Findings of one kind and ink that an audit tells in words."""


def _audited(audit: dict[str, Any]) -> Iterator[str]:
    """Yield the lines that tell what a machine would fail at, the worst first."""
    measured = ", ".join(audit["measured"])
    yield f"  held to {audit['machine']}: {measured or 'no limits'}"
    for group in audit["groups"]:
        of = [
            each for each in audit["findings"] if (each["kind"], each["ink"]) == (group["kind"], group["ink"])
        ]
        ink = f" of ink {group['ink']}" if group["ink"] else ""
        yield f"  {group['count']:,} {GROUPS[group['kind']]}{ink}"
        for each in of[:MOST_PLACES]:
            x, y = each["where_mm"]
            yield f"    at {x:.2f}, {y:.2f} mm: {each['words']}"
        if len(of) > MOST_PLACES:
            yield f"    and {len(of) - MOST_PLACES:,} more: --json tells them all"


GROUPS = {
    "size": "sides larger than the machine",
    "open": "open paths",
    "double": "stretches drawn again",
    "sliver": "slivers",
    "line": "narrow lines",
    "gap": "narrow gaps",
    "hole": "small holes",
    "nodes": "paths with crowded nodes",
}
"""What findings of an audit are called, by kind."""


def _remarks(certificate: dict[str, Any]) -> list[str]:
    """Return the lines that tell what is no fault of the seam, and would be one for a plotter."""
    remarks = certificate["remarks"]
    lines = [f"  remark: {_at(fault)}" for fault in remarks[:MOST_REMARKS]]
    if len(remarks) > MOST_REMARKS:
        lines.append(f"  and {len(remarks) - MOST_REMARKS} more: --json tells them all")
    return lines


def made_of(done: dict[str, Any]) -> Iterator[str]:
    """Yield in lines how a compiled recipe came out: what was stretched, tossed and fitted."""
    across, along = done.get("stretch_percent", (0.0, 0.0))
    if max(abs(across), abs(along)) >= TOLD_PERCENT:
        ways = (per_cent(1 + share / 100) for share in (across, along))
        yield "stretched by {} across and {} along the cloth".format(*ways)
    for toss in done.get("tossed", ()):
        counts = ", ".join(
            f"{count} {name}" for name, count in zip(toss["motifs"], toss["counts"], strict=True)
        )
        yield (
            f"place[{toss['place']}]: {counts} tossed, {100 * toss['covers']:.1f} % covered, "
            f"{toss['per_m2']:,.0f} per m², least gap {toss['distance']:g} mm"
        )
    for stripes in done.get("stripes", ()):
        asked = stripes["asked"]
        off = "" if asked is None or round(asked, 2) == round(stripes["angle"], 2) else f" (asked: {asked:g})"
        yield (
            f"place[{stripes['place']}]: {stripes['lines']} lines at {stripes['angle']:.2f} degrees{off}, "
            f"{stripes['distance']:.3f} mm apart, links of {stripes['link']:.3f} mm, "
            f"stretched by {per_cent(stripes['stretch'])}"
        )
    for number, fits in _by_border(done.get("yardage", {}).get("borders", ())).items():
        sides = ", ".join(f"{fit['side']} {fit['periods']:g}" for fit in fits)
        worst = max((fit["stretch"] for fit in fits), key=lambda stretch: abs(stretch - 1))
        yield f"border[{number}]: periods {sides}; stretched by {per_cent(worst)} at most"


def _by_border(fits: Iterable[dict[str, Any]]) -> dict[int, list[dict[str, Any]]]:
    found: dict[int, list[dict[str, Any]]] = {}
    for fit in fits:
        found.setdefault(fit["border"], []).append(fit)
    return found
