"""batik_vector's own part: what is timed inside its process, one line of JSON for each call.

python -m benchmarks.own prepare RINGS FOLDER      the drawing as coordinates and SVG, for the peers
python -m benchmarks.own write RINGS FOLDER svg    a writer alone
python -m benchmarks.own read RINGS FOLDER         an SVG of curves, read
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from types import MappingProxyType

import numpy as np
import shapely

from batik_vector.artwork import Artwork
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import DxfOptions, GcodeOptions, HpglOptions, write_artwork
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.loading import read_recipe
from benchmarks.drawing import RING, curves_recipe, curves_svg, recipe
from benchmarks.peers.drawn import WARM, let_go, tell, timed

IN_TURN: Mapping[str, object] = MappingProxyType(
    {
        "dxf": DxfOptions(order=False),
        "hpgl": HpglOptions(order=False),
        "gcode": GcodeOptions(order=False),
    }
)
"""Options of formats that bring contours into order, without doing so."""


def compiled(rings: int) -> Artwork:
    """Return the drawing."""
    return compile_recipe(read_recipe(recipe(rings)))


def prepare(rings: int, folder: Path) -> None:
    """Leave in the folder what peers draw: recipe, coordinates, and SVG for those that convert it."""
    (folder / "drawing.toml").write_text(recipe(rings), encoding="utf-8")
    (folder / "tiny.toml").write_text(recipe(WARM), encoding="utf-8")
    artwork = compiled(rings)
    (layer,) = artwork.layers
    points = shapely.get_coordinates(layer.areas).reshape(rings, RING + 1, 2)
    np.save(folder / "drawing.npy", points[:, :-1])
    write_artwork(artwork, folder / "drawing.svg")
    write_artwork(compiled(WARM), folder / "warm.svg")
    (folder / "curves.svg").write_text(curves_svg(rings), encoding="utf-8")
    (folder / "curves.toml").write_text(curves_recipe(rings), encoding="utf-8")
    (folder / "warm-curves.svg").write_text(curves_svg(WARM), encoding="utf-8")


def write(rings: int, folder: Path, format_: str) -> None:
    """Time a writer, once warm."""
    write_artwork(compiled(WARM), folder / f"warm.own.{format_}")
    artwork, path = compiled(rings), folder / f"own.{format_}"
    let_go()
    # To bring contours into order is no part of writing, and the peers do not.
    options = IN_TURN.get(format_)
    part, _ = timed(partial(write_artwork, artwork, path, options=options), path)
    tell({"": part})


def read(folder: Path) -> None:
    """Time the reading of an SVG of curves to marks, once warm."""
    Svg.read(folder / "warm-curves.svg")
    let_go()
    part, _ = timed(partial(Svg.read, folder / "curves.svg"))
    tell({"": part})


if __name__ == "__main__":
    if sys.argv[1] == "prepare":
        prepare(int(sys.argv[2]), Path(sys.argv[3]))
    elif sys.argv[1] == "read":
        read(Path(sys.argv[3]))
    else:
        write(int(sys.argv[2]), Path(sys.argv[3]), sys.argv[4])
