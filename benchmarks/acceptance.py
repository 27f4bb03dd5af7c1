"""What was asked of the speed, and whether the measurements say so: nothing here is known beforehand."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from benchmarks.contests.compiling import SLIDER_KNOBS
from benchmarks.contests.designing import SEARCHES, VPYPE_RINGS
from benchmarks.contests.entrants import BATIK
from benchmarks.contests.plans import Plan
from benchmarks.contests.writing import FORMATS
from benchmarks.drawing import RING, TIMES
from benchmarks.results import Results, Spread, exponent, over_log

LINEAR = 1.1
"""Exponents below this count as linear."""
MIB = 1 << 20
LIMITS: tuple[tuple[str, str, str], ...] = (
    *(
        (stage, f"limits/{BATIK}/{stage}", f"limits/limit/{stage}")
        for stage in ("generation", "tiling", *FORMATS)
    ),
    ("welding", "overlay limits/weld/welding", "overlay limits/limit/welding"),
    ("joining", "overlay limits/join/joining", "overlay limits/limit/joining"),
    ("help", "start/batik --help", "start/python"),
    ("version", "start/batik --version", "start/python"),
    ("compile", "start/batik compile", "start/numpy"),
)
"""Stages, what they take, and the least that they could take."""
NOT_RUN = "the section was not run"
NEAR = 2.0
"""Times the least that is near enough."""


@dataclass(frozen=True)
class Row:
    """One thing asked, in which line, and what was measured; ``passed`` is None where nothing was."""

    line: int
    asked: str
    measured: str
    passed: bool | None

    @property
    def verdict(self) -> str:
        """Return the last column."""
        return "not measured" if self.passed is None else "passed" if self.passed else "**not passed**"


def times(ratio: Spread) -> str:
    """Return a ratio as words."""
    if ratio.median >= 10:
        return f"{ratio.median:.0f}× ({ratio.low:.0f}–{ratio.high:.0f})"
    return f"{ratio.median:.1f}× ({ratio.low:.1f}–{ratio.high:.1f})"


def seconds(value: float) -> str:
    """Return a duration as words."""
    return (
        f"{value:.2f} s"
        if value >= 0.995
        else f"{value * 1000:.0f} ms"
        if value >= 0.01
        else f"{value * 1000:.1f} ms"
    )


class Asked:
    """Makes rows from results; what has not been measured says why."""

    def __init__(self, results: Results) -> None:
        self.results = results

    def missing(self, *names: str) -> str:
        """Return why some runs are missing."""
        for name in names:
            for known, reason in self.results.missing.items():
                if name == known or name.startswith(f"{known}/"):
                    return reason
        return NOT_RUN

    def faster(self, line: int, asked: str, peer: str, own: str, least: float, what: str = "cpu") -> Row:
        """Ask that a peer needs at least so many times as much as we do."""
        ratio = self.results.ratio(peer, own, what)
        theirs, mine = self.results.of(peer, what), self.results.of(own, what)
        if ratio is None or theirs is None or mine is None:
            return Row(line, asked, self.missing(peer, own), None)
        words = f"{times(ratio)}: {seconds(mine.median)} against {seconds(theirs.median)}"
        return Row(line, asked, words, ratio.median >= least)

    def within(self, line: int, asked: str, own: str, other: str, most: float) -> Row:
        """Ask that we need at most so many times as much as something else."""
        ratio = self.results.ratio(own, other)
        mine, least = self.results.of(own), self.results.of(other)
        if ratio is None or mine is None or least is None:
            return Row(line, asked, self.missing(own, other), None)
        words = f"{times(ratio)}: {seconds(mine.median)} against {seconds(least.median)}"
        return Row(line, asked, words, ratio.median <= most)

    def below(self, line: int, asked: str, name: str, most: float) -> Row:
        """Ask that something takes less than so many seconds of CPU."""
        found = self.results.of(name)
        if found is None:
            return Row(line, asked, self.missing(name), None)
        words = f"{seconds(found.median)} ({seconds(found.low)}–{seconds(found.high)})"
        return Row(line, asked, words, found.median < most)

    def fact(self, line: int, asked: str, name: str, key: str, holds: Callable[[object], bool]) -> Row:
        """Ask that a fact holds."""
        value = self.results.facts.get(name, {}).get(key)
        if value is None:
            return Row(line, asked, self.missing(name) if name in self.results.missing else NOT_RUN, None)
        return Row(line, asked, f"{key}: {value}", holds(value))

    def beside(self, line: int, asked: str, own: str, other: str, key: str, most: float) -> Row:
        """Ask that a figure of ours is at most so much, and tell the other's beside it."""
        mine, theirs = (self.results.facts.get(name, {}).get(key) for name in (own, other))
        if mine is None:
            return Row(line, asked, self.missing(own), None)
        against = self.missing(other) if theirs is None else theirs
        return Row(line, asked, f"{key}: {mine} against {against}", mine <= most)


def rows(results: Results, plan: Plan, said: str = "") -> list[Row]:
    """Return the rows of the acceptance list; ``said`` is what the page says by hand."""
    asked = Asked(results)
    parts = (
        _svg,
        _dxf,
        _pdf,
        _three,
        _growth,
        _start,
        _slider,
        _motif,
        _library,
        _sweep,
        _grown,
        _fill,
        _plotted,
        _order,
        _hatch,
        _cut,
        _machines,
        _audit,
    )
    return [*(row for part in parts for row in part(asked, plan)), _explained(results, said)]


def far(results: Results) -> list[str]:
    """Return the stages that take more than twice the least."""
    ratios = ((stage, results.ratio(own, least)) for stage, own, least in LIMITS)
    return [stage for stage, ratio in ratios if ratio and ratio.median > NEAR]


def _explained(results: Results, said: str) -> Row:
    words = "where the least is not reached within a factor of two, the page says why"
    if not any(results.ratio(own, least) for _, own, least in LIMITS):
        return Row(8, words, NOT_RUN, None)
    stages = far(results)
    silent = [stage for stage in stages if f"**{stage}**" not in said]
    told = f"{', '.join(stages) or 'none'} beyond it"
    return Row(8, words, f"{told}; unexplained: {', '.join(silent)}" if silent else told, not silent)


def _svg(asked: Asked, plan: Plan) -> Iterator[Row]:
    own = f"svg alone/{BATIK}"
    for name, words, least in (
        ("vpype_svg", "SVG writer ≥ 100× faster than vpype's", 100),
        ("svgwrite_polygon", "SVG writer ≥ 40× faster than svgwrite per vertex, `polygon`", 40),
        ("svgwrite_push", "SVG writer ≥ 40× faster than svgwrite per vertex, `push`", 40),
        ("matplotlib_svg", "SVG writer ≥ 10× faster than matplotlib's", 10),
    ):
        yield asked.faster(1, words, f"svg alone/{name}", own, least)
    words = "SVG writer ≤ 2× the cost of formatting and writing the same bytes alone"
    yield asked.within(1, words, f"limits/{BATIK}/svg", "limits/limit/svg", 2)
    for name in ("vpype", "vsketch"):
        words = f"recipe to SVG, whole process, ≥ 20× faster than a script of {name}"
        yield asked.faster(1, words, f"svg whole/{name}_svg", f"svg whole/{BATIK}", 20)


def _dxf(asked: Asked, plan: Plan) -> Iterator[Row]:
    words = "DXF writer ≥ 100× faster than adding LWPOLYLINEs through ezdxf and saving"
    yield asked.faster(2, words, "dxf alone/ezdxf_dxf", f"dxf alone/{BATIK}", 100)
    yield asked.fact(2, "the DXF passes ezdxf's audit", "dxf audit", "errors", lambda n: n == 0)
    yield asked.fact(2, "the DXF opens in LibreCAD", "dxf librecad", "opened", lambda opened: opened is True)
    yield asked.fact(
        2, "ezdxf is not imported to write it", "dxf imports", "ezdxf", lambda is_in: is_in is False
    )


def _pdf(asked: Asked, plan: Plan) -> Iterator[Row]:
    own = f"pdf alone/{BATIK}"
    for name, words, least in (
        ("cairosvg_pdf", "PDF writer ≥ 25× faster than cairosvg on the same SVG", 25),
        ("pycairo_pdf", "PDF writer ≥ 8× faster than pycairo", 8),
        ("matplotlib_pdf", "PDF writer ≥ 5× faster than matplotlib", 5),
    ):
        yield asked.faster(3, words, f"pdf alone/{name}", own, least)
    yield asked.fact(
        3, "with a layer for the ink and one for the cloth", "pdf boxes", "layers", lambda n: n == 2
    )
    boxes = ["MediaBox", "BleedBox", "TrimBox"]
    yield asked.fact(3, "with trim and bleed boxes", "pdf boxes", "boxes", lambda found: found == boxes)


def _three(asked: Asked, plan: Plan) -> Iterator[Row]:
    for contest, rings, least in (("three whole", plan.rings, 20), ("three whole, fewer", plan.few, 8)):
        words = (
            f"SVG, PDF and DXF of {rings * RING:,} vertices as a whole process ≥ {least}× faster than by "
            "svgwrite (ready strings), cairosvg and ezdxf"
        )
        yield asked.faster(4, words, f"{contest}/three_files", f"{contest}/{BATIK}", least)
    words = "peak memory under 200 bytes per vertex above the interpreter's"
    peak = asked.results.of(f"three whole/{BATIK}", "mib")
    if peak is None:
        yield Row(4, words, asked.missing(f"three whole/{BATIK}"), None)
        return
    per_vertex = peak.median * MIB / (plan.rings * RING)
    yield Row(4, words, f"{per_vertex:.0f} bytes", per_vertex < 200)


def _growth(asked: Asked, plan: Plan) -> Iterator[Row]:
    for stage in ("generation", "tiling", *FORMATS):
        what = f"writing {stage.upper()}" if stage in FORMATS else stage
        yield _grows(
            asked, f"{what} grows linearly (exponent < {LINEAR})", "growth", stage, plan.growth, False
        )
    for stage in ("welding", "joining"):
        words = f"{stage} grows as n log n (exponent over log n < {LINEAR})"
        yield _grows(asked, words, stage, stage, plan.overlays, True)
    words = "compiling a welded four-square layout at level 4 costs ≤ 5× its level 1"
    for shift in ("", ", overlapping"):
        own = f"levels/{BATIK}"
        yield asked.within(5, f"{words}{shift}", f"{own}/level 4{shift}", f"{own}/level 1{shift}", 5)


def _grows(asked: Asked, words: str, contest: str, stage: str, sizes: tuple[int, ...], sorts: bool) -> Row:
    """Ask for an exponent, over all sizes and over the larger: fixed costs hide growth in the smaller."""
    names = [f"{contest}/{rings}/{stage}" for rings in sizes]
    costs = asked.results.medians(names)
    if costs is None:
        return Row(5, words, asked.missing(*names), None)
    vertices = [rings * RING for rings in sizes]
    if sorts:
        costs = over_log(vertices, costs)
    whole, upper = exponent(vertices, costs), exponent(vertices[-3:], costs[-3:])
    told = f"{whole:.2f} from {vertices[0]:,} to {vertices[-1]:,}, {upper:.2f} over the largest three"
    return Row(5, words, told, max(whole, upper) < LINEAR)


def _start(asked: Asked, plan: Plan) -> Iterator[Row]:
    for option in ("--help", "--version"):
        words = f"`batik-vector {option}` ≥ 8× faster than vpype's"
        yield asked.faster(6, words, f"start/vpype {option}", f"start/batik {option}", 8)
    words = "`compile` of samples/four-square.toml to SVG, process included, < 250 ms of CPU"
    yield asked.below(6, words, "start/batik compile", 0.250)
    words = "and in less time than `vpype --version` takes"
    yield asked.faster(6, words, "start/vpype --version", "start/batik compile", 1, "wall")


def _slider(asked: Asked, plan: Plan) -> Iterator[Row]:
    for knob in SLIDER_KNOBS:
        words = f"recipe to artwork of four-square at 0.3 mm, in process, turning {knob}, < 20 ms"
        yield asked.below(7, words, f"slider/{BATIK}/{knob}", 0.020)


def _motif(asked: Asked, plan: Plan) -> Iterator[Row]:
    segments = f"{plan.few * RING:,}"
    words = f"an SVG of {segments} segments is read ≥ 5× faster than by svgelements"
    yield asked.faster(9, words, "drawing read/svgelements", f"drawing read/{BATIK}", 5)
    words = f"a motif of {segments} segments compiles to a {TIMES} × {TIMES} grid in < 1 s of CPU"
    yield asked.below(9, words, f"drawing in a grid/{BATIK}", 1.0)
    contest = "small drawing in a grid"
    words = f"and one of {VPYPE_RINGS * RING:,} segments ≥ 10× faster than by vpype"
    yield asked.faster(9, words, f"{contest}/vpype", f"{contest}/{BATIK}", 10)


def _library(asked: Asked, plan: Plan) -> Iterator[Row]:
    for way in SEARCHES:
        words = f"{plan.patterns:,} patterns with pictures, {way}, in process, < 50 ms"
        yield asked.below(10, words, f"library/{BATIK}/{way}", 0.050)
    for name, words in (("search", "text and features"), ("like", "likeness")):
        words = f"`batik-vector library search` in them by {words} < 200 ms of CPU"
        yield asked.below(10, words, f"library command/{name}", 0.200)


def _sweep(asked: Asked, plan: Plan) -> Iterator[Row]:
    words = f"{plan.variants} variants of four-square in two processes ≥ 1.8× as fast as in one"
    yield asked.faster(11, words, "sweep/1", "sweep/2", 1.8, "wall")
    yield asked.faster(11, "and ≥ 8× as fast as a shell's loop", "sweep/loop", "sweep/2", 8, "wall")
    same = "and ≥ 25× as fast as vsketch with shapely making the same"
    yield asked.faster(11, same, "sweep/same", "sweep/2", 25, "wall")


def _grown(asked: Asked, plan: Plan) -> Iterator[Row]:
    for name, level in (("hilbert", plan.hilbert), ("dragon", plan.dragon)):
        words = f"{name} at level {level} to one welded stroke ≥ 5× faster than by shapely's buffer"
        yield asked.faster(12, words, f"{name} stroked/shapely", f"{name} stroked/{BATIK}", 5)
    words = f"hilbert at level {plan.hilbert} to its open line ≥ 50× faster than by lsys"
    yield asked.faster(12, words, "hilbert walked/lsys", f"hilbert walked/{BATIK}", 50)
    side = f"{plan.samples:,}"
    words = f"a field of {side} × {side} samples to smooth rings ≥ 2× faster than matplotlib's contours"
    yield asked.faster(12, words, "mandelbrot ringed/matplotlib", f"mandelbrot ringed/{BATIK}", 2)


def _fill(asked: Asked, plan: Plan) -> Iterator[Row]:
    yield asked.below(14, f"a fill of {plan.dots:,} dots < 0.5 s of CPU", f"fill cecek/{BATIK}", 0.5)
    for kind in ("cecek", "galaran"):
        words = f"{kind} ≥ 20× faster than a script of vsketch with shapely"
        yield asked.faster(14, words, f"fill {kind}/vsketch", f"fill {kind}/{BATIK}", 20)
    side = f"{plan.packed} × {plan.packed} mm"
    words = f"twelve leaves packed 1 mm apart on {side} in < 10 s of CPU"
    yield asked.below(14, words, "leaves/pack", 10.0)
    yield asked.fact(
        14, "and cover ≥ 60 %", "leaves/pack drawn", "covers", lambda n: isinstance(n, float) and n >= 60
    )
    yield asked.fact(
        14, "no nearer than 1 mm", "leaves/pack drawn", "gap", lambda n: isinstance(n, float) and n >= 1
    )


def _plotted(asked: Asked, plan: Plan) -> Iterator[Row]:
    segments = f"{4 * plan.plotted**2:,}"
    words = f"{segments} segments drawn once ≥ 300× faster than by vpype's `deduplicate`"
    yield asked.faster(13, words, "plotted/vpype/deduplicate", f"plotted/{BATIK}/once", 300)


def _order(asked: Asked, plan: Plan) -> Iterator[Row]:
    for count in plan.strokes:
        words = f"the way with the pen up between {count:,} strokes ≤ 1.40 times the shortest tree"
        way = f"order {count}/{BATIK} way"
        yield asked.fact(13, words, way, "ratio", lambda ratio: isinstance(ratio, float) and ratio <= 1.40)
        words = f"{count:,} strokes in order ≥ 20× faster than by vpype's `linesort --two-opt --passes 5`"
        yield asked.faster(13, words, f"order {count}/5", f"order {count}/{BATIK}", 20)


def _hatch(asked: Asked, plan: Plan) -> Iterator[Row]:
    vertices = f"{plan.rings * RING:,}"
    for way, own, theirs, plug_in in (
        ("parallel, ink inside and the edge", BATIK, "efill", "vpype-embroidery's `efill`"),
        ("parallel up to the edge", "bare", "efill", "`efill`, which draws no edge either"),
        ("concentric", "concentric", "cfill", "vpype-cfill's `cfill`"),
        ("spiral", "spiral", "cfill", "vpype-cfill's `cfill`, which is concentric"),
    ):
        words = f"areas of {vertices} vertices hatched at 0.5 mm, {way}, ≥ 10× faster than by {plug_in}"
        yield asked.faster(13, words, f"hatch/{theirs}", f"hatch/{own}", 10)


def _cut(asked: Asked, plan: Plan) -> Iterator[Row]:
    for key, words, most in (
        ("corners", "a drag knife cuts the corners of stars within 0.05 mm", 0.05),
        ("area", "and their area within 0.1 %", 0.001),
    ):
        yield asked.beside(13, words, f"cut/{BATIK} off", "cut/plottool off", key, most)


def _machines(asked: Asked, plan: Plan) -> Iterator[Row]:
    for format_, words, theirs in (
        ("hpgl", "HP-GL writer faster than vpype's", "vpype_hpgl"),
        ("gcode", "G-code writer faster than vpype-gcode's `gwrite`", "vpype_gcode"),
    ):
        yield asked.faster(13, words, f"{format_} alone/{theirs}", f"{format_} alone/{BATIK}", 1)


def _audit(asked: Asked, plan: Plan) -> Iterator[Row]:
    vertices = f"{plan.rings * RING:,}"
    for name, says in (("apart", "marks apart"), ("welded", "marks welded to a net")):
        words = (
            f"the audit of {vertices} vertices, {says}, costs ≤ 3× what it takes to compile and write them"
        )
        yield asked.within(13, words, f"audit/{name}/audit", f"audit/{name}/compile", 3)
