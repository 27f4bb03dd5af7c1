"""Extensions → Render → Batik tile: a pattern in the open document, in true size, a layer for each ink.

Inkscape runs this with a Python of its own; the pattern is made by the program batik-vector.
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

import inkex
from lxml import etree

LABEL, MODE = inkex.addNS("label", "inkscape"), inkex.addNS("groupmode", "inkscape")
CLOTH = "%99 cloth"
SECONDS = 600


class BatikTile(inkex.EffectExtension):
    """Puts a compiled tile into the document."""

    def add_arguments(self, pars):
        """Say what the dialogue asks for."""
        pars.add_argument("--tab", default="starter")
        pars.add_argument("--kind", default="kawung")
        pars.add_argument("--recipe", default="")
        pars.add_argument("--overrides", default="")
        pars.add_argument("--percent", type=float, default=100.0)
        pars.add_argument("--cloth", type=inkex.Boolean, default=True)
        pars.add_argument("--program", default="batik-vector")

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

    def told(self, *words):
        """Return what the program writes; where it fails, say so in a dialogue and end."""
        try:
            call = [self.options.program, *words]
            done = subprocess.run(call, capture_output=True, timeout=SECONDS, stdin=subprocess.DEVNULL)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise inkex.AbortExtension(
                f"{self.options.program} could not be run: {error}.\n"
                "Install it with: pipx install batik-vector, or give its path under Program."
            ) from error
        if done.returncode:
            raise inkex.AbortExtension(done.stderr.decode("utf-8", "replace"))
        return done.stdout

    def put(self, tile):
        """Put the layers of a tile into the document."""
        _, _, width, height = (float(each) for each in tile.get("viewBox").split())
        # The document's units to a millimetre, whatever its viewBox makes of them.
        scale = self.svg.unittouu("1mm") * self.options.percent / 100
        middle = self.middle()
        layer = inkex.Layer.new(tile.findtext("{http://www.w3.org/2000/svg}title") or "Batik")
        left, top = middle.x - width * scale / 2, middle.y - height * scale / 2
        layer.transform = inkex.Transform(f"translate({left:.6f} {top:.6f}) scale({scale:.9g})")
        taken = set(self.svg.get_ids())
        layer.set("id", free("batik", taken))
        self.svg.append(layer)
        for each in tile.findall("{http://www.w3.org/2000/svg}g"):
            if each.get(LABEL) == CLOTH and not self.options.cloth:
                continue
            for part in each.iter():
                if part.get("id"):
                    part.set("id", free(part.get("id"), taken))
            layer.append(each)

    def middle(self):
        """Return the middle of what is seen, or of the page where the document does not say."""
        view, seen = self.svg.namedview, inkex.addNS("cx", "inkscape")
        if view.get(seen) is not None:
            return view.center
        left, top, width, height = self.svg.get_viewbox()
        # Without a viewBox a unit is a pixel.
        width, height = width or self.svg.viewport_width, height or self.svg.viewport_height
        return inkex.Vector2d(left + width / 2, top + height / 2)


def free(name, taken):
    """Return an id that no element has, as like a name as can be, and note it."""
    number, new = 1, name
    while new in taken:
        number += 1
        new = f"{name}{number}"
    taken.add(new)
    return new


if __name__ == "__main__":
    BatikTile().run()
