"""The audit beside what it costs to compile the tile: both inside one process, one line of JSON.

python -m benchmarks.auditing RINGS apart      marks apart from one another
python -m benchmarks.auditing RINGS welded     marks that meet, all of them one net
"""

from __future__ import annotations

import sys
from functools import partial

from batik_vector.artwork import Artwork
from batik_vector.audit import audit
from batik_vector.compiling.compiler import compile_recipe
from batik_vector.export import render
from batik_vector.recipe.loading import read_recipe
from batik_vector.recipe.reading.machines import read_machine
from benchmarks.drawing import OVERLAPPING_MM, SCALE_MM, recipe
from benchmarks.peers.drawn import WARM, let_go, tell, timed

MACHINE = "laser"
"""The machine with the most limits."""


def compiled(text: str) -> Artwork:
    """Return the tile, once it has been written, too."""
    tile = compile_recipe(read_recipe(text))
    render(tile, "svg")
    return tile


def main(rings: int, scale: float) -> None:
    """Time both, once warm."""
    machine = read_machine(MACHINE)
    audit(compiled(recipe(WARM, scale=scale)), machine)
    let_go()
    first, tile = timed(partial(compiled, recipe(rings, scale=scale)))
    second, found = timed(partial(audit, tile, machine))
    assert found.measured
    tell({"compile": first, "audit": second})


if __name__ == "__main__":
    main(int(sys.argv[1]), OVERLAPPING_MM if sys.argv[2] == "welded" else SCALE_MM)
