"""vpype-gcode: a document of line collections, and ``gwrite`` in millimetres."""

from __future__ import annotations

import sys
from pathlib import Path

import vpype
import vpype_cli

from benchmarks.peers.drawn import Drawing, main
from benchmarks.peers.vpype_svg import prepare


def write(drawing: Drawing, document: vpype.Document) -> None:
    """Write the document."""
    vpype_cli.execute(f"gwrite -p gcodemm {drawing.path('.gcode')}", document)


if __name__ == "__main__":
    # The plug-ins lie apart, so that vpype starts without them everywhere else.
    sys.path.append(str(Path(sys.prefix) / "plug-ins"))
    main(".gcode", write, prepare)
