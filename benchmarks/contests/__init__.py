"""What is run against what: each section of the benchmark as contests between entrants."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from benchmarks.contests import compiling, designing, producing, writing
from benchmarks.contests.entrants import Contest, Fact
from benchmarks.contests.plans import Plan

SECTIONS: Mapping[str, Callable[[Plan], list[Contest]]] = MappingProxyType(
    {
        "svg": writing.svg,
        "pdf": writing.pdf,
        "dxf": writing.dxf,
        "hpgl": writing.hpgl,
        "gcode": writing.gcode,
        "three": writing.three,
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
"""The sections by name, in the order in which they run."""


FACTS: Mapping[str, Callable[[Plan], list[Fact]]] = MappingProxyType(
    {
        "pdf": writing.pdf_facts,
        "dxf": writing.dxf_facts,
        "order": producing.order_facts,
        "hatch": producing.hatch_facts,
        "cut": producing.cut_facts,
        "fill": designing.fill_facts,
    }
)
"""What is to be found out about the files of a section, once."""


def facts(section: str, plan: Plan) -> list[Fact]:
    """Return what is to be found out about the files of a section."""
    return FACTS[section](plan) if section in FACTS else []
