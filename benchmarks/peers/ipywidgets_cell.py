"""ipywidgets: a slider, and the four-square flower by matplotlib below it; the one cell of a notebook."""

from __future__ import annotations

import ipywidgets
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

from benchmarks.peers.flower import four_square

SIDE = 280.0


def draw(petal: float) -> None:
    """Draw the flower that the slider asks for."""
    _, axes = plt.subplots(figsize=(8, 8), facecolor="#1d2f5f")
    axes.add_collection(
        PolyCollection(four_square(0.7, SIDE, petal), facecolor="#f4efe2", edgecolor="#1d2f5f")
    )
    axes.set(xlim=(0, SIDE), ylim=(0, SIDE), aspect="equal")
    axes.axis("off")
    plt.show()


ipywidgets.interact(draw, petal=ipywidgets.FloatSlider(value=0.9, min=0.7, max=1.1, step=0.002))
