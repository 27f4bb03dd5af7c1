"""What the extensions share: batik-vector is called, and what it draws is put into the document."""

from __future__ import annotations

import subprocess

import inkex

LABEL, MODE = inkex.addNS("label", "inkscape"), inkex.addNS("groupmode", "inkscape")
CLOTH = "%99 cloth"
SVG = "{http://www.w3.org/2000/svg}"
SECONDS = 600
PIXELS_TO_A_MM = 96 / 25.4


class BatikExtension(inkex.EffectExtension):
    """An extension that the program does the work of."""

    def add_arguments(self, pars):
        """Say what every dialogue asks for."""
        pars.add_argument("--program", default="batik-vector")

    def told(self, *words, faults=False):
        """Return what the program writes; where it fails, say so in a dialogue and end.

        With ``faults`` it may end with 1, which says that what was looked at has faults.
        """
        try:
            call = [self.options.program, *words]
            done = subprocess.run(call, capture_output=True, timeout=SECONDS, stdin=subprocess.DEVNULL)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise inkex.AbortExtension(
                f"{self.options.program} could not be run: {error}.\n"
                "Install it with: pipx install batik-vector, or give its path under Program."
            ) from error
        if done.returncode not in ((0, 1) if faults else (0,)):
            raise inkex.AbortExtension(done.stderr.decode("utf-8", "replace"))
        return done.stdout

    def fill(self, layer, tile, *, leave=""):
        """Put the layers of a compiled tile into a layer, but for one; ids that are taken are made free."""
        taken = set(self.svg.get_ids())
        layer.set("id", free("batik", taken))
        self.svg.append(layer)
        for each in tile.findall(f"{SVG}g"):
            if leave and each.get(LABEL) == leave:
                continue
            for part in each.iter():
                if part.get("id"):
                    part.set("id", free(part.get("id"), taken))
            layer.append(each)

    def to_a_mm(self):
        """Return how many of the document's units are a millimetre.

        inkex's own unittouu knows documents whose unit has a name, and takes pixels for any other.
        """
        return self.page()[2] / self.svg.viewport_width * PIXELS_TO_A_MM

    def page(self):
        """Return left and top edge, width and height of the page, in the document's units."""
        left, top, width, height = self.svg.get_viewbox()
        # Without a viewBox a unit is a pixel.
        return left, top, width or self.svg.viewport_width, height or self.svg.viewport_height


def free(name, taken):
    """Return an id that no element has, as like a name as can be, and note it."""
    number, new = 1, name
    while new in taken:
        number += 1
        new = f"{name}{number}"
    taken.add(new)
    return new
