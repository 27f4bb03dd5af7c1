"""vpype's own commands on lines: duplicates dropped, ends joined, order found.

python -m benchmarks.peers.vpype_lines deduplicate,linemerge,linesort SIDE
"""

from __future__ import annotations

import sys
from copy import deepcopy
from functools import partial
from pathlib import Path

import vpype
import vpype_cli

from benchmarks.peers.drawn import Part, often, tell
from benchmarks.peers.strokes import sides

PX = 96 / 25.4


def document(count: int, twice: bool) -> vpype.Document:
    """Return the sides of squares as a document."""
    lines = [line[:, 0] + 1j * line[:, 1] for line in sides(count, twice=twice) * PX]
    page = vpype.Document()
    page.add(vpype.LineCollection(lines), 1)
    return page


def main() -> None:
    """Run the commands one after another on what the one before left."""
    # The plug-in that drops duplicates lies apart, so that vpype starts without it everywhere else.
    sys.path.append(str(Path(sys.prefix) / "plug-ins"))
    commands, side = sys.argv[1].split(","), int(sys.argv[2])
    twice = "deduplicate" in commands
    small, page = document(3, twice), document(side, twice)
    parts: dict[str, Part] = {}
    for command in commands:
        small = vpype_cli.execute(command, small)
        parts[command], page = often(partial(deepcopy, page), partial(vpype_cli.execute, command))
    tell(parts)


if __name__ == "__main__":
    main()
