"""Plug-ins of vpype that fill the drawing at 0.5 mm: what they take, and what they draw.

python -m benchmarks.peers.vpype_hatch cfill RINGS         rings within rings
python -m benchmarks.peers.vpype_hatch efill RINGS drawn   parallel strokes, joined along the outline
"""

from __future__ import annotations

import json
import sys
from functools import partial
from pathlib import Path

import vpype
import vpype_cli

from benchmarks.drawing import evaluated
from benchmarks.peers.drawn import tell, timed

PX = 96 / 25.4
COMMANDS = {"cfill": "cfill --pen-width 0.5mm", "efill": "efill --distance 0.5mm"}


def document(rings: int) -> vpype.Document:
    """Return the drawing as a document."""
    lines = [ring[:, 0] + 1j * ring[:, 1] for ring in evaluated(rings) * PX]
    page = vpype.Document()
    page.add(vpype.LineCollection([[*line, line[0]] for line in lines]), 1)
    return page


def main(name: str, rings: int, drawn: bool) -> None:
    """Fill the drawing, and tell what it took or what is drawn."""
    # The plug-ins lie apart, so that vpype starts without them everywhere else.
    sys.path.append(str(Path(sys.prefix) / "plug-ins"))
    vpype_cli.execute(COMMANDS[name], document(4))
    part, page = timed(partial(vpype_cli.execute, COMMANDS[name], document(rings)))
    if drawn:
        # efill puts its strokes into a layer of their own and keeps the outlines, cfill adds to them.
        lines = page.layers[max(page.layers)]
        print(json.dumps({"strokes": len(lines), "metres": lines.length() / PX / 1000}))
    else:
        tell({"": part})


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3:] == ["drawn"])
