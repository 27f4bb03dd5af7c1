"""What is timed inside a running program: a slider's steps, the levels of a layout, metres of cloth.

    python -m benchmarks.sliding slider RECIPE         recipe to artwork, a knob turned before each
    python -m benchmarks.sliding knobs RECIPE          the same, every number of the recipe turned by itself
    python -m benchmarks.sliding levels                the four-square layout at levels 1 and 4, welded
    python -m benchmarks.sliding cloth METRES FOLDER   a cloth 1.5 m wide

Every step is another recipe, so that no result kept from the step before can answer.
"""

from __future__ import annotations

import contextlib
import sys
import tempfile
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import MappingProxyType

from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_cloth, compile_recipe
from batik_vector.errors import BatikError
from batik_vector.export import write_artwork
from batik_vector.making import exploring
from batik_vector.recipe.loading import load_recipe, read_recipe
from batik_vector.recipe.model import Recipe, YardageSpec
from benchmarks.contests.compiling import SLIDER_KNOBS
from benchmarks.contests.writing import FORMATS
from benchmarks.peers.drawn import Part, middle, tell, timed

SCREEN_MM = 0.3
"""Tolerance at which a screen shows a tile of 320 mm without a visible corner."""
STEPS, KNOB_STEPS = 15, 5

KNOBS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    dict(
        zip(
            SLIDER_KNOBS,
            (
                ("motif.flower.petal.length={0}",),
                ("motif.flower.pistil.length={0}",),
                tuple(f"motif.under.elements[{i}].curve.b={{1}}" for i in (0, 1)),
                tuple(f"place[{i}].scale='{{2}} mm'" for i in range(5)),
            ),
            strict=True,
        )
    )
)
"""The settings that each knob turns; {0} lies near 1, {1} near 20, {2} near 60."""

LEVEL = """\
title = "Four-square layout at level {level}"
tolerance = "0.02 mm"

[motif.flower]
kind = "flower"

[ink.wax]
colour = "#f4efe2"

[[place]]
motif = "flower"
layout = {{ kind = "julian", power = 4, dist = 4, level = {level}, shift = [{shift}, {shift}] }}
scale = "{scale} mm"

[tile]
size = ["960 mm", "960 mm"]
"""
SHIFTS: Mapping[str, float] = MappingProxyType({"": 4 / 3, ", overlapping": 1.1})
"""How far flowers are moved before each spreading: as in the paper, and so that their leaves overlap."""

CLOTH = Path(__file__).resolve().parents[1] / "samples" / "chrysanthemum-line.toml"
WIDTH_MM = 1500.0


def turned(path: str, knob: str) -> Iterator[Recipe]:
    """Yield a recipe again and again, one knob turned a little each time."""
    for step in range(STEPS):
        near = 0.93 + step * 0.0037
        yield at_screen(path, *(each.format(near, 20 * near, 60 * near) for each in KNOBS[knob]))


def at_screen(path: str, *settings: str) -> Recipe:
    """Return a recipe, as coarse as a screen."""
    return load_recipe(path, (*settings, f"tolerance='{SCREEN_MM} mm'"))


def slider(path: str) -> dict[str, Part]:
    """Time the first compilation of a process, then one for each turn of each knob, then unchanged ones."""
    recipe = at_screen(path)
    parts = {"cold": timed(partial(compile_recipe, recipe))[0]}
    for knob in KNOBS:
        parts[knob] = middle([timed(partial(compile_recipe, each))[0] for each in turned(path, knob)])
    same = [at_screen(path) for _ in range(STEPS)]
    parts["unchanged"] = middle([timed(partial(compile_recipe, each))[0] for each in same])
    text = Path(path).read_text(encoding="utf-8")
    parts["reading"] = middle([timed(partial(read_recipe, text))[0] for _ in range(STEPS)])
    return parts


def knobs(path: str) -> dict[str, Part]:
    """Time reading and compiling while each number of the recipe's motifs is turned; "all" is their median.

    What is refused is left out.
    """
    text = Path(path).read_text(encoding="utf-8")
    parts: dict[str, Part] = {}
    compile_recipe(at_screen(path))
    for knob in exploring.knobs(tomllib.loads(text)):
        steps = [f"{knob.keys[0]}={value!r}" for value in _near(knob)]
        with contextlib.suppress(BatikError):
            parts[knob.keys[0]] = middle([timed(partial(_at_screen, text, each))[0] for each in steps])
    return {"all": middle(list(parts.values())), **parts}


def _near(knob: exploring.Knob) -> list[float]:
    """Return values near that of a knob, within its bounds."""
    step = 1.0 if knob.whole else 0.004 * (knob.value or 1.0)
    values = [knob.value + step * number for number in range(1, KNOB_STEPS + 1)]
    values = [min(max(each, knob.bounds.low), knob.bounds.high) for each in values]
    return [int(each) if knob.whole else round(each, 6) for each in values]


def _at_screen(text: str, setting: str) -> None:
    compile_recipe(replace(read_recipe(text, overrides=(setting,)), tolerance=SCREEN_MM))


def levels() -> dict[str, Part]:
    """Time both levels in turn, each time a little larger, and the writing of the higher one."""
    parts: dict[str, list[Part]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for step in range(6):
            for number, (name, shift) in enumerate(SHIFTS.items()):
                for level in (1, 4):
                    # Each is drawn in a size of its own, so that none finds its flower drawn already.
                    scale = 59 + step / 4 + number / 10 + level / 100
                    recipe = read_recipe(LEVEL.format(level=level, shift=shift, scale=scale))
                    part, artwork = timed(partial(compile_recipe, recipe))
                    parts.setdefault(f"level {level}{name}", []).append(part)
                part, _ = timed(partial(write_artwork, artwork, Path(folder) / "level.svg"))
                parts.setdefault(f"writing{name}", []).append(part)
    # The first step warms up.
    return {name: middle(each[1:]) for name, each in parts.items()}


def cloth(metres: str, folder: str) -> dict[str, Part]:
    """Time a cloth in every format; its tile, which costs the same for any length, is not counted."""
    spec = YardageSpec(
        width=WIDTH_MM, length=float(metres) * 1000, selvedge=15.0, marks=True, limit=400_000_000
    )
    read = replace(load_recipe(str(CLOTH)), yardage=spec)
    tile = compile_recipe(read)
    page = compile_cloth(read, tile=tile)
    parts = {}
    for format_ in FORMATS:
        path = Path(folder) / f"cloth.{format_}"
        part, _ = timed(partial(_cloth, read, tile, path), path)
        parts[format_] = part | {"vertices": page.vertex_count}
        path.unlink()
    return parts


def _cloth(recipe: Recipe, tile: Artwork, path: Path) -> None:
    write_artwork(compile_cloth(recipe, tile=tile), path)


TASKS: dict[str, Callable[..., dict[str, Part]]] = {
    "slider": slider,
    "knobs": knobs,
    "levels": levels,
    "cloth": cloth,
}

if __name__ == "__main__":
    tell(TASKS[sys.argv[1]](*sys.argv[2:]))
