"""vpype: a document of line collections, and ``write_hpgl``."""

from __future__ import annotations

import vpype

from benchmarks.peers.drawn import Drawing, main
from benchmarks.peers.vpype_svg import prepare

PLOTTER = {
    "name": "as large as the drawing",
    "plotter_unit_length": "0.025mm",
    "pen_count": 8,
    "paper": [
        {
            "name": "any",
            "y_axis_up": True,
            "origin_location": ["0mm", "0mm"],
            "origin_location_reference": "botleft",
        }
    ],
}
"""A device of one's own: none that vpype knows and can read has paper for a drawing of a metre."""


def write(drawing: Drawing, document: vpype.Document) -> None:
    """Write the document, absolute, as batik_vector does."""
    vpype.config_manager.config.setdefault("device", {})["any"] = PLOTTER
    with open(drawing.path(".hpgl"), "w", encoding="ascii") as sink:
        vpype.write_hpgl(sink, document, "any", False, False, "any", None, absolute=True, quiet=True)


if __name__ == "__main__":
    main(".hpgl", write, prepare)
