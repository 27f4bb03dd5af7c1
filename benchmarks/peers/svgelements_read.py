"""svgelements: an SVG read to its shapes, every segment an object; vpype reads by it.

python -m benchmarks.peers.svgelements_read RINGS FOLDER
"""

from __future__ import annotations

import sys
from functools import partial
from pathlib import Path

import svgelements

from benchmarks.peers.drawn import let_go, tell, timed


def main() -> None:
    """Time the reading, once warm."""
    folder = Path(sys.argv[2])
    svgelements.SVG.parse(folder / "warm-curves.svg")
    let_go()
    part, _ = timed(partial(svgelements.SVG.parse, folder / "curves.svg"))
    tell({"": part})


if __name__ == "__main__":
    main()
