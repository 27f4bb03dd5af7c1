"""matplotlib: the contours of a field that lies ready, at the same levels; lines are not made smooth.

python -m benchmarks.peers.matplotlib_contour SAMPLES FOLDER
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
from matplotlib import pyplot

from benchmarks.peers.drawn import let_go, tell, timed

LEVELS = (4.5, 8.5, 16.5, 32.5)


def contours(values: Any) -> Any:
    """Return the lines at all levels."""
    _, axes = pyplot.subplots()
    return [path.to_polygons(closed_only=False) for path in axes.contour(values, levels=LEVELS).get_paths()]


def main() -> None:
    """Time it, once warm."""
    values = np.load(Path(sys.argv[2]) / "field.npy")
    contours(values[:50, :50])
    let_go()
    part, _ = timed(lambda: contours(values))
    tell({"": part})


if __name__ == "__main__":
    main()
