"""Work that is counted: vertices, calls, elements, steps of our own code; no clock is looked at.

    with counted() as work:
        compile_recipe(recipe)
    BUDGETS.hold("vertices united", work.given("union_all"))

Counts are the same on every machine, and all but the same with every version of the libraries.
"""

from __future__ import annotations

import collections
import contextlib
import functools
import sys
import tracemalloc
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from batik_vector.compiling import placements
from batik_vector.geometry.curves import Circle
from batik_vector.recipe import figures, loading
from batik_vector.recipe.model import InkSpec, Placement, Recipe
from batik_vector.recipe.motif import Element, Motif, Rosette
from batik_vector.recipe.reading import builder
from batik_vector.tiling.layouts import Lattice
from batik_vector.tiling.symmetry.repeats import TileSpec
from batik_vector.tiling.torus import remembered

PACKAGE = str(Path(__file__).resolve().parents[1] / "batik_vector")
ROOM = 1.3
"""What is allowed of what was measured: versions of GEOS and NumPy differ a little, a regression by more."""
LOOSE = 0.7
"""Share of what was measured below which a budget no longer guards what was gained."""

Place = tuple[Any, str]
"""A module or class, and the name of a function in it."""


class LooseBudgetWarning(UserWarning):
    """Less is spent than the table says: the gain is to be written down, lest it be lost again."""


class Budgets:
    """A table of budgets: kinds of work, and for each what was spent when the row was written."""

    def __init__(self, rows: Mapping[str, float]) -> None:
        self.rows = rows

    def hold(self, what: str, spent: float) -> None:
        """Fail where more is spent than a row allows; warn where it is so much less that the row is idle."""
        measured = self.rows[what]
        allowed = measured * ROOM
        assert spent <= allowed, (
            f"{what}: {spent:,.6g} spent, {allowed:,.6g} allowed, {measured:,.6g} when the row was written. "
            "Something is done twice or too early; if it must be, the row may be raised, with the reason."
        )
        if spent < measured * LOOSE:
            words = f"{what}: {spent:,.6g} spent, the row says {measured:,.6g}; lower it to keep the gain"
            warnings.warn(LooseBudgetWarning(words), stacklevel=2)


class Work:
    """What was counted: calls of each function, and what these were given, by any measure."""

    def __init__(self) -> None:
        self._calls = collections.Counter[str]()
        self._given = collections.Counter[str]()

    def add(self, name: str, given: int) -> None:
        """Count one call."""
        self._calls[name] += 1
        self._given[name] += given

    def calls(self, *names: str) -> int:
        """Return how often some functions were called; all, where none is named."""
        return sum(self._calls[name] for name in names or self._calls)

    def given(self, *names: str) -> int:
        """Return what some functions were given; all, where none is named."""
        return sum(self._given[name] for name in names or self._given)


def _functions() -> Iterator[Place]:
    for name, value in vars(shapely).items():
        if callable(value) and not isinstance(value, type) and not name.startswith("_"):
            yield shapely, name
    yield from ((shapely.STRtree, name) for name in ("__init__", "query", "query_nearest"))


SHAPELY = tuple(_functions())
"""All of shapely that takes geometries in bulk. What is a tree's is called "query" and so on."""

_is_geometry, _sizes = shapely.is_geometry, shapely.get_num_coordinates


def vertices(*given: Any) -> int:
    """Return how many vertices the geometries among some arguments have."""
    found = 0
    for each in given:
        if isinstance(each, list | tuple | shapely.Geometry):
            each = np.asarray(each, dtype=object)
        if isinstance(each, np.ndarray) and each.dtype == object:
            found += int(_sizes(each[_is_geometry(each)]).sum())
    return found


def elements(*given: Any) -> int:
    """Return how many elements the arrays among some arguments have, and among lists of arrays."""
    arrays = [part for each in given for part in (each if isinstance(each, list | tuple) else [each])]
    return sum(each.size for each in arrays if isinstance(each, np.ndarray))


@contextlib.contextmanager
def counted(places: Iterable[Place] = SHAPELY, measure: Callable[..., int] = vertices) -> Iterator[Work]:
    """Count the calls of some functions, and measure what each is given; nested calls count too."""
    work = Work()

    def counting(name: str, real: Callable[..., Any]) -> Callable[..., Any]:
        @functools.wraps(real)
        def call(*args: Any, **named: Any) -> Any:
            work.add(name, measure(*args, *named.values()))
            return real(*args, **named)

        return call

    with pytest.MonkeyPatch.context() as patch:
        for owner, name in places:
            patch.setattr(owner, name, counting(name, getattr(owner, name)))
        yield work


def steps_run(call: Callable[[], object]) -> int:
    """Return how many steps of the package's own code a call takes: functions entered, and rounds of loops.

    A loop over marks shows, bulk operations do not. Lines are not counted: how many of them tracing tells for
    a loop written over several differs from one Python to the next, but each round jumps back once.
    """
    counted = 0
    reached: dict[Any, int] = {}

    def local(frame: Any, event: str, argument: Any) -> Any:
        nonlocal counted
        if event == "line":
            counted += frame.f_lasti <= reached.get(frame, -1)
            reached[frame] = frame.f_lasti
        elif event == "return":
            reached.pop(frame, None)
        return local

    def begun(frame: Any, event: str, argument: Any) -> Any:
        nonlocal counted
        if not frame.f_code.co_filename.startswith(PACKAGE):
            return None
        counted += 1
        return local

    before = sys.gettrace()
    sys.settrace(begun)
    try:
        call()
    finally:
        sys.settrace(before)
    return counted


def peak_bytes(call: Callable[[], object]) -> int:
    """Return how many bytes Python and NumPy hold at most during a call; what GEOS holds is not seen."""
    tracemalloc.start()
    try:
        call()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def cold() -> None:
    """Forget what earlier compilations read, drew and overlaid."""
    builder._known.clear()
    loading._tables.cache_clear()
    remembered.clear()
    placements._kept.clear()
    figures._copied.cache_clear()
    figures._alone.cache_clear()
    figures._told.cache_clear()


PITCH_MM = 10.0
DISC = Rosette(elements=(Element(curve=Circle(1.0)),))
CLUSTER = Rosette(elements=(Element(curve=Circle(1.0), count=6, radius=0.8),))
"""Six discs, each over its neighbours."""
RING_OF_GROUND = Rosette(elements=(Element(curve=Circle(0.5), gap=0.3),))
"""A small disc that keeps 0.3 mm bare round itself."""


def rows_of(columns: int, rows: int, *motifs: Motif, scale: float = 2.0, stagger: bool = False) -> Recipe:
    """Return a recipe of motifs, one over another, set out in rows 10 mm apart: at 2 mm none meets others."""
    layout = Lattice(columns=columns, rows=rows, stagger=stagger)
    return Recipe(
        motif={f"m{number}": each for number, each in enumerate(motifs)},
        place=tuple(Placement(motif=f"m{k}", layout=layout, scale=scale) for k in range(len(motifs))),
        tile=TileSpec(size=(columns * PITCH_MM, rows * PITCH_MM)),
        ink={"wax": InkSpec()},
        tolerance=0.02,
    )
