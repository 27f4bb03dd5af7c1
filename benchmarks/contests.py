"""What is run against what: each section of the benchmark as contests between entrants.

Commands are written with ``{folder}``, where a drawing of the contest's size
lies ready and where files go.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from benchmarks.drawing import TIMES, size
from benchmarks.timing import OWN, PEERS

FOUR_SQUARE = "samples/four-square.toml"
FORMATS = ("svg", "pdf", "dxf")
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
SLIDER_KNOBS = ("petal length", "pistil length", "leaf point", "size of all")
"""What is turned in the sample, one at a time."""
BATIK = "batik_vector"
"""The entrant that all others are measured by."""


@dataclass(frozen=True)
class Entrant:
    """One that takes part.

    ``inside`` says that the command times parts of its own work and prints them; otherwise its process is
    timed as a whole. ``drawn`` are the files that are read back to see that the drawing is the same.
    ``tiny`` is the same command for four marks: what memory it needs is not the drawing's.
    """

    name: str
    says: str
    command: tuple[str, ...]
    inside: bool = False
    drawn: tuple[str, ...] = ()
    tiny: tuple[str, ...] = ()


@dataclass(frozen=True)
class Contest:
    """Entrants that run in turn, round after round. ``rings`` is how large a drawing they find ready."""

    name: str
    entrants: tuple[Entrant, ...]
    rounds: int
    rings: int = 0


@dataclass(frozen=True)
class Fact:
    """What a command finds out once, told as JSON, with a drawing of ``rings`` marks ready."""

    name: str
    command: tuple[str, ...]
    rings: int = 0


@dataclass(frozen=True)
class Plan:
    """How large and how often."""

    rings: int
    """Marks of the drawing."""
    few: int
    """Marks of a small one."""
    growth: tuple[int, ...]
    """Marks of the drawing as it grows."""
    overlays: tuple[int, ...]
    """The same where marks are welded, or lines joined."""
    squares: int
    """Squares in a row whose sides are drawn twice."""
    merged: int
    """Squares in a row whose sides are joined."""
    plotted: int
    """Squares in a row of which a plotter draws each side once."""
    strokes: tuple[int, ...]
    """Strokes that are brought into order."""
    cloth: tuple[int, ...]
    """Lengths of cloth in metres."""
    patterns: int
    """Patterns in a library."""
    variants: int
    """Variants of a sweep."""
    hilbert: int
    """Level of Hilbert's curve: 9 writes 873,811 symbols."""
    dragon: int
    """Level of the dragon: 16 writes 131,071 symbols, beyond which others take minutes."""
    samples: int
    """Samples across and up a field whose rings are drawn."""
    rounds: int
    """How often everything runs."""
    starts: int
    """Rounds of what is over soon."""


FULL = Plan(
    rings=10_000,
    few=1_000,
    growth=(100, 1_000, 10_000, 40_000),
    overlays=(100, 1_000, 10_000),
    squares=40,
    merged=160,
    plotted=80,
    strokes=(1_000, 10_000, 100_000),
    cloth=(1, 3, 10),
    patterns=10_000,
    variants=200,
    hilbert=9,
    dragon=16,
    samples=2_000,
    rounds=5,
    starts=11,
)
QUICK = Plan(
    rings=400,
    few=100,
    growth=(100, 400, 1_600),
    overlays=(100, 400),
    squares=12,
    merged=30,
    plotted=12,
    strokes=(100, 400),
    cloth=(1,),
    patterns=200,
    variants=20,
    hilbert=5,
    dragon=8,
    samples=200,
    rounds=2,
    starts=3,
)

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
        "ezdxf_dxf": "ezdxf, `add_lwpolyline` and `saveas`",
        "three_files": "svgwrite (ready strings), cairosvg, ezdxf",
    }
)


def own(module: str, *words: str) -> tuple[str, ...]:
    """Return the command that runs a module of ours in our environment."""
    return str(OWN / "python"), "-m", f"benchmarks.{module}", *words


def compiling(formats: str, recipe: str = "drawing") -> tuple[str, ...]:
    """Return the command that compiles the ready recipe."""
    return str(OWN / "batik-vector"), "compile", f"{{folder}}/{recipe}.toml", "-o", "{folder}", "-f", formats


def peer(script: str, mode: str, rings: int) -> tuple[str, ...]:
    """Return the command that runs a peer's script in the peers' environment."""
    return str(PEERS / "python"), "-m", f"benchmarks.peers.{script}", mode, str(rings), "{folder}"


def writers(format_: str, scripts: Sequence[str], plan: Plan) -> Contest:
    """Return a contest of writers alone: the same arrays to a file."""
    mine = Entrant(
        BATIK, BATIK, own("own", "write", str(plan.rings), "{folder}", format_), True, (f"own.{format_}",)
    )
    theirs = [
        Entrant(name, PEER_SCRIPTS[name], peer(name, "alone", plan.rings), True, (f"{name}.{format_}",))
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
            peer(each, "whole", rings),
            drawn=tuple(f"{each}.{suffix}" for suffix in suffixes),
            tiny=peer(each, "whole", 4),
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


def three(plan: Plan) -> list[Contest]:
    """All three files of one drawing, whole processes, large and small."""
    return [
        processes(name, ",".join(FORMATS), ["three_files"], rings, plan.rounds)
        for name, rings in (("three whole", plan.rings), ("three whole, fewer", plan.few))
    ]


def lines(plan: Plan) -> list[Contest]:
    """Lines drawn once and joined."""

    def contest(name: str, side: int, steps: str) -> Contest:
        theirs = (str(PEERS / "python"), "-m", "benchmarks.peers.vpype_lines", steps, str(side))
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
    theirs = (
        str(PEERS / "python"),
        "-m",
        "benchmarks.peers.vpype_lines",
        "deduplicate,linemerge,linesort",
        side,
    )
    mine = Entrant(BATIK, BATIK, own("plotting", side), True)
    # The peer takes half a minute each time.
    return [Contest("plotted", (mine, Entrant("vpype", "vpype", theirs, True)), min(plan.rounds, 3))]


MOST_TURNED = 10_000
"""Strokes up to which vpype's 2-opt takes part: its work grows with their square."""


def order(plan: Plan) -> list[Contest]:
    """Strokes brought into an order with little way between them."""

    def contest(count: int) -> Contest:
        theirs = (str(PEERS / "python"), "-m", "benchmarks.peers.vpype_order")
        entrants = [
            Entrant(BATIK, BATIK, own("ordering", str(count)), True),
            Entrant("0", "vpype `linesort`", (*theirs, "0", str(count)), True),
            Entrant("5", "vpype `linesort --two-opt --passes 5`", (*theirs, "5", str(count)), True),
        ]
        return Contest(f"order {count}", tuple(entrants[: 3 if count <= MOST_TURNED else 2]), plan.rounds)

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
    theirs = (str(PEERS / "python"), "-m", "benchmarks.peers.vpype_hatch")
    mine = [Entrant(name, says, own("hatching", way, size), True) for name, (way, says) in ways.items()]
    peers = [Entrant(name, f"vpype `{name}`", (*theirs, name, size), True) for name in ("efill", "cfill")]
    return [Contest("hatch", (*mine, *peers), min(plan.rounds, 3))]


def audit(plan: Plan) -> list[Contest]:
    """A tile held to a machine, beside what it costs to compile it."""
    entrants = (
        Entrant(name, says, own("auditing", str(plan.rings), name), True)
        for name, says in (("apart", "marks apart"), ("welded", "marks welded to a net"))
    )
    return [Contest("audit", tuple(entrants), plan.rounds)]


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
    peers = (str(PEERS / "python"), "-m", "benchmarks.peers.svgelements_read", rings, "{folder}")
    readers = (
        Entrant(BATIK, "batik_vector, `Svg.read`", own("own", "read", rings, "{folder}"), True),
        Entrant("svgelements", "svgelements, `SVG.parse`", peers, True),
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
    mine = [Entrant(way, says, own("sweeps", way, count, "{folder}")) for way, says in ways.items()]
    peer = (str(PEERS / "python"), "-m", "benchmarks.peers.vsketch_sweep", count, "{folder}")
    return [
        Contest("sweep", (*mine, Entrant("vsketch", "vsketch, its curves alone", peer)), min(plan.rounds, 3))
    ]


def grown(plan: Plan) -> list[Contest]:
    """L-systems to lines and to strokes, and a field to rings."""

    def task(name: str, says: str, *words: str) -> Entrant:
        return Entrant(name, says, own("growing", *words), True)

    hilbert, dragon, samples = str(plan.hilbert), str(plan.dragon), str(plan.samples)
    walked = str(PEERS / "python"), "-m", "benchmarks.peers.lsys_line", hilbert
    contour = str(PEERS / "python"), "-m", "benchmarks.peers.matplotlib_contour", samples, "{folder}"
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


def facts(section: str, plan: Plan) -> list[Fact]:
    """Return what is to be found out about the files of a section."""
    if section == "pdf":
        return [Fact("pdf boxes", own("readback", "pdf", "{folder}/own.pdf"), plan.rings)]
    if section == "order":
        return [
            Fact(f"{contest.name}/{entrant.name} way", (*entrant.command, "way"))
            for contest in order(plan)
            for entrant in contest.entrants
        ]
    if section == "hatch":
        return [
            Fact(f"hatch/{entrant.name} drawn", (*entrant.command, "drawn"))
            for entrant in hatch(plan)[0].entrants
        ]
    if section != "dxf":
        return []
    audit = (str(PEERS / "python"), "-m", "benchmarks.readback", "audit", "{folder}/drawing.dxf")
    return [
        # The first writes the file that the others read.
        Fact(
            "dxf imports",
            own("readback", "imports", "{folder}/drawing.dxf", "{folder}/drawing.toml"),
            plan.few,
        ),
        Fact("dxf audit", audit, plan.few),
        Fact("dxf librecad", own("readback", "librecad", "{folder}/drawing.dxf"), plan.few),
    ]


SECTIONS: Mapping[str, Callable[[Plan], list[Contest]]] = MappingProxyType(
    {
        "svg": svg,
        "pdf": pdf,
        "dxf": dxf,
        "three": three,
        "lines": lines,
        "plotted": plotted,
        "order": order,
        "hatch": hatch,
        "audit": audit,
        "growth": growth,
        "limits": limits,
        "start": start,
        "slider": slider,
        "levels": levels,
        "cloth": cloth,
        "motif": motif,
        "library": library,
        "sweep": sweep,
        "grown": grown,
    }
)
"""The sections by name, in the order in which they run."""
