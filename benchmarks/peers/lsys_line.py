"""lsys: an L-system written out and walked to the coordinates of its line.

python -m benchmarks.peers.lsys_line LEVEL
"""

from __future__ import annotations

import sys
from typing import Any

import lsys

from benchmarks.peers.drawn import let_go, tell, timed


def hilbert(level: int) -> Any:
    """Return the coordinates of Hilbert's curve."""
    rule = "X=-YF+XFX+FY-, Y=+XF-YFY-FX+"
    return lsys.Lsys(axiom="X", rule=rule, depth=level, da=90, memory_check=False).coords


def main() -> None:
    """Time it, once warm."""
    hilbert(3)
    let_go()
    part, _ = timed(lambda: hilbert(int(sys.argv[1])))
    tell({"": part})


if __name__ == "__main__":
    main()
