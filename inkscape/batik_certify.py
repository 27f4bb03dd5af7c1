"""Extensions → Batik → Certify this tile: does the page repeat? Faults are pointed at in a layer "check".

The page is the tile. Inkscape runs this with a Python of its own; batik-vector does the work.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

from batik_program import LABEL, MODE, SVG, BatikExtension, free
from lxml import etree

NAME, COLOUR = "check", "#ff00c8"
"""The layer of the pointers, and their colour, which no bath has."""


class BatikCertify(BatikExtension):
    """Measures the open document as a tile."""

    def add_arguments(self, pars):
        """Say what the dialogue asks for."""
        super().add_arguments(pars)
        pars.add_argument("--repeat", default="")
        pars.add_argument("--group", default="")
        pars.add_argument("--machine", default="")

    def effect(self):
        """Measure the document as it stands without earlier pointers, and put pointers into it."""
        for each in self.svg.findall(f".//{SVG}g"):
            if each.get(LABEL) == NAME and each.get(MODE) == "layer" and each.get("stroke") == COLOUR:
                each.getparent().remove(each)
        asked = {name: getattr(self.options, name).strip() for name in ("repeat", "group", "machine")}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "tile.svg"
            path.write_bytes(etree.tostring(self.svg))
            words = [word for name, said in asked.items() if said for word in (f"--{name}", said)]
            report = self.told("check", str(path), "--pointers", folder, *words, faults=True)
            pointed = Path(folder) / "tile-check.svg"
            if pointed.exists():
                self.point(etree.fromstring(pointed.read_bytes()))
            *facts, verdict = report.decode("utf-8", "replace").replace(str(path), "this tile").splitlines()
            # The verdict first: a dialogue shows the beginning of what is long.
            self.msg("\n".join([verdict, "", *facts]))

    def point(self, pointed):
        """Take the layer over that points at faults: it stands in a copy of this document, in its units."""
        for each in pointed.findall(f"{SVG}g"):
            if each.get(LABEL) == NAME and each.get("stroke") == COLOUR:
                each.set("id", free(NAME, set(self.svg.get_ids())))
                self.svg.append(each)


if __name__ == "__main__":
    BatikCertify().run()
