"""What a toss has put down, in numbers."""

from __future__ import annotations

from batik_vector.values import frozen


@frozen
class TossReport:
    """What a toss has put down on one repeat.

    Attributes:
        motifs: their names, and ``counts`` how many there are of each, images under the symmetry included.
        covers: share of the repeat that the marks cover.
        per_m2: marks per square metre of cloth.
        distance: the least gap in mm between two marks of it, or one and what it keeps clear of, measured
            across the seam as well. A little more than asked for, as outlines are rounded outwards.
        darts: how many were thrown, or places tried of a packing.
    """

    motifs: tuple[str, ...]
    counts: tuple[int, ...]
    covers: float
    per_m2: float
    distance: float
    darts: int
