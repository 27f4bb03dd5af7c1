"""Curves: the catalogue. A new curve is a file beside this one and a line in ``CURVES``."""

from __future__ import annotations

from batik_vector.fields import Catalogue
from batik_vector.geometry.curves.attractor import Attractor, AttractorMap
from batik_vector.geometry.curves.base import Curve, FunctionCurve, OutlineCurve
from batik_vector.geometry.curves.blade import Blade
from batik_vector.geometry.curves.butterfly import Butterfly
from batik_vector.geometry.curves.cells import Automaton, Kronecker
from batik_vector.geometry.curves.circle import Circle
from batik_vector.geometry.curves.escape import Julia, Mandelbrot
from batik_vector.geometry.curves.fourier import Fourier
from batik_vector.geometry.curves.fractal import Fractal, FractalName, ShapeGrammar
from batik_vector.geometry.curves.harmonic import Parametric, Polar
from batik_vector.geometry.curves.hypocycloid import Hypocycloid
from batik_vector.geometry.curves.lsystem import LSystem, Origin
from batik_vector.geometry.curves.path import PathCurve, YAxis
from batik_vector.geometry.curves.points import PointsCurve
from batik_vector.geometry.curves.polar_function import polar
from batik_vector.geometry.curves.polygon import Polygon, Star
from batik_vector.geometry.curves.rose import Petal, Rose
from batik_vector.geometry.curves.segment import Segment
from batik_vector.geometry.curves.spiral import Spiral
from batik_vector.geometry.curves.superellipse import Superellipse
from batik_vector.geometry.curves.tracing import Trace, trace
from batik_vector.geometry.curves.wave import Wave

CURVES: Catalogue[type[Curve]] = Catalogue(
    "curves",
    {
        "superellipse": Superellipse,
        "rose": Rose,
        "petal": Petal,
        "hypocycloid": Hypocycloid,
        "circle": Circle,
        "blade": Blade,
        "butterfly": Butterfly,
        "polygon": Polygon,
        "star": Star,
        "polar": Polar,
        "parametric": Parametric,
        "spiral": Spiral,
        "segment": Segment,
        "wave": Wave,
        "path": PathCurve,
        "points": PointsCurve,
        "lsystem": LSystem,
        "fractal": Fractal,
        "kronecker": Kronecker,
        "automaton": Automaton,
        "fourier": Fourier,
        "attractor": Attractor,
        "julia": Julia,
        "mandelbrot": Mandelbrot,
        "shape-grammar": ShapeGrammar,
    },
    lambda: Curve,
)

__all__ = [
    "CURVES",
    "Attractor",
    "AttractorMap",
    "Automaton",
    "Blade",
    "Butterfly",
    "Circle",
    "Curve",
    "Fourier",
    "Fractal",
    "FractalName",
    "FunctionCurve",
    "Hypocycloid",
    "Julia",
    "Kronecker",
    "LSystem",
    "Mandelbrot",
    "Origin",
    "OutlineCurve",
    "Parametric",
    "PathCurve",
    "Petal",
    "PointsCurve",
    "Polar",
    "Polygon",
    "Rose",
    "Segment",
    "ShapeGrammar",
    "Spiral",
    "Star",
    "Superellipse",
    "Trace",
    "Wave",
    "YAxis",
    "polar",
    "trace",
]
