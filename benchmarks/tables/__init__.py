"""Results as tables in Markdown."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from benchmarks.acceptance import NOT_RUN, rows
from benchmarks.contests import SECTIONS
from benchmarks.contests.entrants import Contest
from benchmarks.contests.plans import Plan
from benchmarks.results import Results
from benchmarks.tables import compiling, designing, producing, writing
from benchmarks.tables.spelling import table

TITLES: Mapping[str, str] = MappingProxyType(
    {
        "svg": "SVG",
        "pdf": "PDF",
        "dxf": "DXF",
        "hpgl": "HP-GL",
        "gcode": "G-code",
        "three": "Three files of one drawing",
        "lines": "Lines drawn once and joined",
        "plotted": "Strokes of a plotter",
        "order": "Strokes in order",
        "hatch": "Areas hatched",
        "cut": "Cut by a drag knife",
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
        "fill": "Fills and packing",
    }
)


def acceptance(results: Results, plan: Plan, said: str) -> list[str]:
    """Return what was asked, line by line."""
    found = rows(results, plan, said)
    body = [(str(row.line), row.asked, row.measured, row.verdict) for row in found if row.measured != NOT_RUN]
    return table(("line", "asked", "measured", ""), body, left=4)


SHOWN: Mapping[str, Callable[[Sequence[Contest], Results], Iterator[str]]] = MappingProxyType(
    {
        **dict.fromkeys(("svg", "pdf", "dxf", "hpgl", "gcode", "three"), writing.races),
        "lines": producing.lines,
        "plotted": producing.plotted,
        "order": producing.order,
        "hatch": producing.hatch,
        "cut": producing.cut,
        "audit": producing.audit,
        "growth": compiling.growth,
        "limits": compiling.limits,
        "start": compiling.start,
        "slider": compiling.slider,
        "levels": compiling.levels,
        "cloth": compiling.cloth,
        "motif": designing.motif,
        "library": designing.library,
        "sweep": designing.sweep,
        "grown": designing.grown,
        "fill": designing.fill,
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
