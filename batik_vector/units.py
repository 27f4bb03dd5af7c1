"""Lengths on cloth and the grid they are kept on.

Inside the program every coordinate and every tolerance is in millimetres on cloth, y upwards. Finished
geometry lies on a grid of whole micrometres: the coordinate k µm is always the float ``k / 1000``, so
that equal places are equal bits.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

STEPS_PER_MM = 1000
"""Grid steps in a millimetre: finished geometry lies on whole micrometres."""

GRID_MM = 1 / STEPS_PER_MM

MM_PER_UNIT = {
    "mm": 1.0,
    "cm": 10.0,
    "m": 1000.0,
    "um": 0.001,
    "µm": 0.001,
    "in": 25.4,
    '"': 25.4,
    "ft": 304.8,
    "yd": 914.4,
    "pt": 25.4 / 72,
    "pc": 25.4 / 6,
}
"""Millimetres in one of each unit that a recipe may write. Pixels are left out: they have no length."""

_LENGTH = re.compile(r"^\s*+([+-]?(?:\d++\.?+\d*+|\.\d++)(?:[eE][+-]?\d{1,3})?)\s*+([a-zA-Zµ\"]*+)\s*+$")


def parse_length(value: str | float | int) -> float:
    """Return a length in millimetres: ``"28 cm"`` → 280.0; a bare number is millimetres.

    Raises:
        ValueError: with what was expected, when the text is no length or its unit is unknown.
    """
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        raise ValueError('expected a length such as "280 mm"')
    if not isinstance(value, str):
        return float(value)
    match = _LENGTH.match(value)
    if match is None:
        raise ValueError('expected a length such as "280 mm"')
    number, unit = match.groups()
    if unit and unit not in MM_PER_UNIT:
        known = ", ".join(name for name in MM_PER_UNIT if name not in ('"', "µm"))
        hint = " (pixels have no length on cloth)" if unit == "px" else ""
        raise ValueError(f'unknown unit "{unit}"{hint}: expected one of {known}')
    return float(number) * MM_PER_UNIT[unit or "mm"]


def format_mm(value: float) -> str:
    """Return a length as people read it: at most three decimals, none that are zero."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def to_steps(mm: float) -> int:
    """Return the whole number of grid steps nearest to a length in millimetres."""
    return round(mm * STEPS_PER_MM)


def nearest_steps(mm: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the whole numbers of grid steps, as floats, nearest to coordinates in mm."""
    import numpy as np

    return np.rint(mm * STEPS_PER_MM)


def on_grid(mm: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return coordinates in mm moved to the nearest grid point, each the float ``k / 1000``."""
    return nearest_steps(mm) / STEPS_PER_MM
