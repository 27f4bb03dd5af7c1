"""Extensions → Render → Batik tile: a pattern in the open document, in true size, a layer for each ink.

Inkscape runs this with a Python of its own; the pattern is made by the program batik-vector.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import inkex
from batik_program import CLOTH, SVG, BatikExtension
from lxml import etree


class BatikTile(BatikExtension):
    """Puts a compiled tile into the document."""

    def add_arguments(self, pars):
        """Say what the dialogue asks for."""
        super().add_arguments(pars)
        pars.add_argument("--tab", default="starter")
        pars.add_argument("--kind", default="kawung")
        pars.add_argument("--recipe", default="")
        pars.add_argument("--overrides", default="")
        pars.add_argument("--percent", type=float, default=100.0)
        pars.add_argument("--cloth", type=inkex.Boolean, default=True)

    def effect(self):
        """Compile the tile, and put its layers into one of its own in the middle of what is seen."""
        with tempfile.TemporaryDirectory() as folder:
            recipe = self.options.recipe
            if self.options.tab == "starter":
                recipe = str(Path(folder) / f"{self.options.kind}.toml")
                self.told("new", "--kind", self.options.kind, "-o", recipe)
            said = (each.strip() for each in self.options.overrides.split(";"))
            values = [word for each in said if each for word in ("--set", each)]
            data = self.told("compile", recipe, "-f", "svg", "-o", "-", *values)
        self.put(etree.fromstring(data))

    def put(self, tile):
        """Put the layers of a tile into the document."""
        _, _, width, height = (float(each) for each in tile.get("viewBox").split())
        # The document's units to a millimetre, whatever its viewBox makes of them.
        scale = self.to_a_mm() * self.options.percent / 100
        middle = self.middle()
        layer = inkex.Layer.new(tile.findtext(f"{SVG}title") or "Batik")
        left, top = middle.x - width * scale / 2, middle.y - height * scale / 2
        layer.transform = inkex.Transform(f"translate({left:.6f} {top:.6f}) scale({scale:.9g})")
        self.fill(layer, tile, leave="" if self.options.cloth else CLOTH)

    def middle(self):
        """Return the middle of what is seen, or of the page where the document does not say."""
        view, seen = self.svg.namedview, inkex.addNS("cx", "inkscape")
        if view.get(seen) is not None:
            return view.center
        left, top, width, height = self.page()
        return inkex.Vector2d(left + width / 2, top + height / 2)


if __name__ == "__main__":
    BatikTile().run()
