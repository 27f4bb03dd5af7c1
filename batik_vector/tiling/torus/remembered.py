"""Overlays remembered: what was made of the very same shapes before is not made again.

Who turns one knob, or sweeps over one key, compiles a hundred tiles in which most shapes are those of the
tile before, bit for bit. GEOS makes the same of the same, and so what it made is kept, by the bytes of what
went in. The work is counted each time as it was the first: a recipe is refused everywhere or nowhere.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from batik_vector.artwork import Geometries
from batik_vector.geometry import work

KEPT, KEPT_VERTICES = 32, 20_000
"""How many results are kept, and of how many vertices the shapes may be that they were made of."""

Arrays = tuple[NDArray[Any], ...]

_known: dict[tuple[object, ...], tuple[work.Share, Arrays]] = {}


def remembered(how: tuple[object, ...], shapes: Geometries, make: Callable[[], Arrays]) -> Arrays:
    """Return what is made of shapes: arrays, each caller's own.

    Args:
        how: what is made of them, and all that it hangs on beside the shapes.
        shapes: what it is made of.
        make: makes it, and counts its work.

    Raises:
        TooLargeError: where the work comes to too much.
    """
    before = work.counted()
    if before is None or not len(shapes) or shapely.get_num_coordinates(shapes).sum() > KEPT_VERTICES:
        return make()
    # In WKB a shape says itself how long it is.
    key = (*how, b"".join(shapely.to_wkb(shapes)))
    if key in _known:
        share, found = _known[key]
        work.spend_again(share)
        return _copies(found)
    found = make()
    spent, vertices, crossings, pairs = np.subtract(work.counted() or before, before).tolist()
    _known[key] = (spent, vertices, crossings, pairs), _copies(found)
    while len(_known) > KEPT:
        _known.pop(next(iter(_known)), None)
    return found


def _copies(arrays: Arrays) -> Arrays:
    """Return copies: shapely before 2.2 takes nothing apart that may not be written."""
    return tuple(each.copy() for each in arrays)
