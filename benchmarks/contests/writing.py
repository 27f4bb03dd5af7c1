"""Contests of writers: SVG, PDF and DXF, alone and as whole processes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from benchmarks.contests.entrants import BATIK, Contest, Entrant, Fact, compiling, own, peer
from benchmarks.contests.plans import Plan
from benchmarks.timing import PEERS

FORMATS = ("svg", "pdf", "dxf")

PEER_SCRIPTS: Mapping[str, str] = MappingProxyType(
    {
        "vpype_svg": "vpype, `write_svg`",
        "vsketch_svg": "vsketch, a sketch of polygons",
        "svgwrite_polygon": "svgwrite, `polygon(points=…)`",
        "svgwrite_push": "svgwrite, `path.push` per vertex",
        "svgwrite_bare": "svgwrite, `polygon`, checks off",
        "svgwrite_ready": "svgwrite, ready `d` strings, checks off",
        "drawsvg_svg": "drawsvg, `Lines`",
        "pycairo_svg": "pycairo, SVG surface",
        "pycairo_pdf": "pycairo, PDF surface",
        "matplotlib_svg": "matplotlib, `PolyCollection`, SVG",
        "matplotlib_pdf": "matplotlib, `PolyCollection`, PDF",
        "cairosvg_pdf": "cairosvg, from batik_vector's SVG",
        "vpype_hpgl": "vpype, `write_hpgl`",
        "vpype_gcode": "vpype-gcode, `gwrite`",
        "ezdxf_dxf": "ezdxf, `add_lwpolyline` and `saveas`",
        "three_files": "svgwrite (ready strings), cairosvg, ezdxf",
    }
)


def writers(format_: str, scripts: Sequence[str], plan: Plan) -> Contest:
    """Return a contest of writers alone: the same arrays to a file."""
    mine = Entrant(
        BATIK, BATIK, own("own", "write", str(plan.rings), "{folder}", format_), True, (f"own.{format_}",)
    )
    theirs = [
        Entrant(
            name,
            PEER_SCRIPTS[name],
            peer(name, "alone", str(plan.rings), "{folder}"),
            True,
            (f"{name}.{format_}",),
        )
        for name in scripts
    ]
    return Contest(f"{format_} alone", (mine, *theirs), plan.rounds, plan.rings)


def processes(name: str, formats: str, scripts: Sequence[str], rings: int, rounds: int) -> Contest:
    """Return a contest of whole processes: from recipe or script to files, start-up included."""
    suffixes = formats.split(",")
    mine = Entrant(
        BATIK,
        f"batik-vector compile -f {formats}",
        compiling(formats),
        drawn=tuple(f"drawing.{suffix}" for suffix in suffixes),
        tiny=compiling(formats, "tiny"),
    )
    theirs = [
        Entrant(
            each,
            PEER_SCRIPTS[each],
            peer(each, "whole", str(rings), "{folder}"),
            drawn=tuple(f"{each}.{suffix}" for suffix in suffixes),
            tiny=peer(each, "whole", "4", "{folder}"),
        )
        for each in scripts
    ]
    return Contest(name, (mine, *theirs), rounds, rings)


def svg(plan: Plan) -> list[Contest]:
    """SVG: the writer alone, and the whole process."""
    scripts = ["vpype_svg", "svgwrite_polygon", "svgwrite_push", "svgwrite_bare", "svgwrite_ready"]
    others = ["drawsvg_svg", "pycairo_svg", "matplotlib_svg"]
    whole = ["vpype_svg", "vsketch_svg", "svgwrite_polygon", "svgwrite_ready", *others]
    return [
        writers("svg", [*scripts, *others], plan),
        processes("svg whole", "svg", whole, plan.rings, plan.rounds),
    ]


def pdf(plan: Plan) -> list[Contest]:
    """PDF: the writer alone."""
    return [writers("pdf", ["cairosvg_pdf", "pycairo_pdf", "matplotlib_pdf"], plan)]


def dxf(plan: Plan) -> list[Contest]:
    """DXF: the writer alone."""
    return [writers("dxf", ["ezdxf_dxf"], plan)]


def hpgl(plan: Plan) -> list[Contest]:
    """HP-GL: the writer alone."""
    return [writers("hpgl", ["vpype_hpgl"], plan)]


def gcode(plan: Plan) -> list[Contest]:
    """G-code: the writer alone."""
    return [writers("gcode", ["vpype_gcode"], plan)]


def three(plan: Plan) -> list[Contest]:
    """All three files of one drawing, whole processes, large and small."""
    return [
        processes(name, ",".join(FORMATS), ["three_files"], rings, plan.rounds)
        for name, rings in (("three whole", plan.rings), ("three whole, fewer", plan.few))
    ]


def pdf_facts(plan: Plan) -> list[Fact]:
    """What layers and boxes the PDF has."""
    return [Fact("pdf boxes", own("readback", "pdf", "{folder}/own.pdf"), plan.rings)]


def dxf_facts(plan: Plan) -> list[Fact]:
    """What was imported to write the DXF, and what others make of it."""
    imports = own("readback", "imports", "{folder}/drawing.dxf", "{folder}/drawing.toml")
    audit = (str(PEERS / "python"), "-m", "benchmarks.readback", "audit", "{folder}/drawing.dxf")
    return [
        # The first writes the file that the others read.
        Fact("dxf imports", imports, plan.few),
        Fact("dxf audit", audit, plan.few),
        Fact("dxf librecad", own("readback", "librecad", "{folder}/drawing.dxf"), plan.few),
    ]
