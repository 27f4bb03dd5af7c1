"""vsketch: many sketches of the four-square flower, each with a pistil of another length.

python -m benchmarks.peers.vsketch_sweep COUNT FOLDER

What vsketch has no words for is left out: nothing is cut, united, gapped or filled; only curves are drawn. In
``vsketch_whole`` shapely does that.
That costs it what our finished outlines would: nearly all of its time goes into its document and its file.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from benchmarks.peers.flower import four_square
from benchmarks.peers.vsketch_svg import page

SIDE = 280.0


def main(count: int, folder: Path) -> None:
    """Draw and save all sketches."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, pistil in enumerate(np.linspace(0.55, 0.85, count)):
        sketch = page(SIDE, SIDE)
        for curve in four_square(float(pistil), SIDE):
            sketch.polygon(curve, close=True)
        sketch.save(str(folder / f"{number}.svg"))


if __name__ == "__main__":
    main(int(sys.argv[1]), Path(sys.argv[2]) / "vsketch")
