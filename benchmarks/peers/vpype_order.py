"""vpype's order of strokes: what it takes, and the way that is left with the pen up.

python -m benchmarks.peers.vpype_order 5 COUNT       linesort with so many passes of 2-opt, or none
python -m benchmarks.peers.vpype_order 5 COUNT way
"""

from __future__ import annotations

import json
import sys
from functools import partial

import vpype
import vpype_cli

from benchmarks.peers.drawn import often, tell
from benchmarks.peers.strokes import spanning_tree, strokes


def document(count: int) -> vpype.Document:
    """Return the strokes as a document."""
    page = vpype.Document()
    page.add(vpype.LineCollection([line[:, 0] + 1j * line[:, 1] for line in strokes(count)]), 1)
    return page


def main() -> None:
    """Sort, and tell what it took or what it gave."""
    passes, count = int(sys.argv[1]), int(sys.argv[2])
    command = f"linesort --two-opt --passes {passes}" if passes else "linesort"
    vpype_cli.execute(command, document(200))
    if sys.argv[3:] == ["way"]:
        page = vpype_cli.execute(command, document(count))
        left = page.layers[1].pen_up_length()[0] / spanning_tree(strokes(count))
        print(json.dumps({"ratio": round(left, 4)}))
        return
    part, _ = often(partial(document, count), partial(vpype_cli.execute, command))
    tell({"": part})


if __name__ == "__main__":
    main()
