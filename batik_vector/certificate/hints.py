"""What would make a tile pass: the limit, the repeat or the page that its faults speak for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from batik_vector.certificate.drawing import Frame
from batik_vector.certificate.picture.bodies import Bodies
from batik_vector.certificate.report import Kind, Limits, Measures, SeamFault


def hints(
    faults: Sequence[SeamFault], worst: Measures, frame: Frame, bodies: Bodies | None, limits: Limits
) -> Iterator[str]:
    """Yield in words what would mend the faults of a tile."""
    apart = [fault.amount for fault in faults if fault.kind == Kind.OFFSET]
    if apart and len(apart) == len(faults):
        yield f"every crossing meets within {_up(max(apart))} mm: --position {_up(max(apart))} lets it pass"


def _up(value: float) -> str:
    """Round up to two digits, so that what is told is enough."""
    digits = 1 - math.floor(math.log10(value))
    return f"{math.ceil(value * 10**digits - 1e-9) / 10**digits:.{max(digits, 0)}f}"
