"""What can be chosen of wax plates, in words. Importing it costs nothing heavy."""

from __future__ import annotations

import enum


class Removal(enum.StrEnum):
    """Whether wax comes off between baths."""

    JAVANESE = "javanese"
    """Some is scraped off after a bath: what it covered takes the next one."""
    ADD_ONLY = "add-only"
    """None does before the last bath: from bath to bath more is covered."""


class Plates(enum.StrEnum):
    """Of what plates are made."""

    STEPS = "steps"
    """Each step of the work: what is waxed anew, or scraped off."""
    BATHS = "baths"
    """Each bath: all wax that is on the cloth while it takes the dye."""


CANTINGS = {"isen": 0.8, "klowong": 1.6, "tembok": 3.0}
"""Spouts in mm. Isen are drawn with 0.5 to 1.5 mm and outlines with 1 to 2.5 mm (infobatik.id); within that,
and for the broad one that fills, these are conventions of this program."""

ALL, CLOTH = "all", "cloth"
"""Instead of the name of one plate: all in one file, or the cloth as it comes out."""
