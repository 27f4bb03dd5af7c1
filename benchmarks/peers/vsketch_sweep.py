"""vsketch: many sketches of the four-square flower, each with a pistil of another length.

python -m benchmarks.peers.vsketch_sweep COUNT FOLDER

What vsketch has no words for is left out: nothing is cut, united, gapped or filled; only curves are drawn.
That costs it what our finished outlines would: nearly all of its time goes into its document and its file.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import vsketch
from numpy.typing import NDArray

SIDE, SCALE = 280.0, 52.5
POINTS = 200
PLACES = ((1, 1), (-1, 1), (-1, -1), (1, -1))


def flower(pistil: float) -> list[NDArray[np.float64]]:
    """Return the curves of a flower: leaves, petals, pistil, core and its circle, in motif units."""
    t = np.linspace(0, 2 * np.pi, POINTS)
    theta = np.linspace(-np.pi / 4, np.pi / 4, POINTS)
    leaf = np.column_stack(
        [1.2 * np.sign(np.cos(t)) * abs(np.cos(t)) ** 0.2, 0.3 * np.sign(np.sin(t)) * abs(np.sin(t)) ** 20]
    )
    petal = np.cos(2 * theta)[:, None] * np.column_stack([np.cos(theta), np.sin(theta)])
    q, turns = 16 / 5, np.linspace(0, 10 * np.pi, 5 * POINTS)
    star = np.column_stack(
        [(q - 1) * np.cos(turns) + np.cos((q - 1) * turns), (q - 1) * np.sin(turns) - np.sin((q - 1) * turns)]
    )
    core = 0.5 * np.cos(4 * t)[:, None] * np.column_stack([np.cos(t), np.sin(t)])
    circle = 0.1 * np.column_stack([np.cos(t), np.sin(t)])
    leaves = [turned(leaf, 22.5 + 45 * number) for number in range(4)]
    petals = [turned(petal, 45 * number) for number in range(8)]
    return [*leaves, *petals, pistil / q * star, core, circle]


def turned(points: NDArray[np.float64], degrees: float) -> NDArray[np.float64]:
    """Return points turned about the origin."""
    angle = np.radians(degrees)
    matrix = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    return np.asarray(points @ matrix)


def main(count: int, folder: Path) -> None:
    """Draw and save all sketches."""
    folder.mkdir(parents=True, exist_ok=True)
    for number, pistil in enumerate(np.linspace(0.55, 0.85, count)):
        sketch = vsketch.Vsketch()
        sketch.size(f"{SIDE}mm", f"{SIDE}mm", center=False)
        sketch.scale("mm")
        for x, y in PLACES:
            middle = SIDE / 2 + np.array([x, y]) * SCALE * 4 / 3
            for curve in flower(float(pistil)):
                sketch.polygon(curve * SCALE + middle, close=True)
        sketch.save(str(folder / f"{number}.svg"))


if __name__ == "__main__":
    main(int(sys.argv[1]), Path(sys.argv[2]) / "vsketch")
