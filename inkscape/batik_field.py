"""Extensions → Batik → Make a seamless field: the page repeated, and welded where its repeats meet.

Tiles laid side by side show hairlines in every program; a welded field has no edges there. The page is the
tile. Inkscape runs this with a Python of its own; batik-vector does the work.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import inkex
from batik_program import CLOTH, LABEL, SVG, BatikExtension
from lxml import etree


class BatikField(BatikExtension):
    """Puts the repeated tile into the document, from the page's upper left corner on."""

    def add_arguments(self, pars):
        """Say what the dialogue asks for."""
        super().add_arguments(pars)
        pars.add_argument("--repeat", default="grid")
        pars.add_argument("--columns", type=int, default=3)
        pars.add_argument("--rows", type=int, default=3)
        pars.add_argument("--hide", type=inkex.Boolean, default=True)

    def effect(self):
        """Take the tile over as a recipe, compile it as often as asked, and hide what it was made of."""
        # What lies in no layer is of the tile, too.
        before = [each for each in self.svg if isinstance(each, inkex.ShapeElement)]
        with tempfile.TemporaryDirectory() as folder:
            path, recipe = Path(folder) / "tile.svg", Path(folder) / "tile.toml"
            path.write_bytes(etree.tostring(self.svg))
            repeat = self.options.repeat.strip() or "grid"
            self.told("import", str(path), "-o", str(recipe), "--repeat", repeat)
            output = f'output=[{{format="svg", repeat=[{self.options.columns}, {self.options.rows}]}}]'
            data = self.told("compile", str(recipe), "-f", "svg", "-o", "-", "--set", output)
        left, top, _, _ = self.page()
        layer = inkex.Layer.new(f"Field {self.options.columns} × {self.options.rows}")
        scale = self.to_a_mm()
        layer.transform = inkex.Transform(f"translate({left:.6f} {top:.6f}) scale({scale:.9g})")
        tile = etree.fromstring(data)
        # Where the drawing has no ground of its own the page shows through the field as through the tile.
        white = tile.find(f"{SVG}g[@fill='#ffffff']")
        bare = white is not None and white.get(LABEL) == CLOTH
        self.fill(layer, tile, leave=CLOTH if bare else "")
        for each in before if self.options.hide else ():
            each.style["display"] = "none"


if __name__ == "__main__":
    BatikField().run()
