"""What can be chosen of a cut, in words. Importing it costs nothing heavy."""

from __future__ import annotations

import enum


class LineBodies(enum.StrEnum):
    """What becomes of lines."""

    BODY = "body"
    """They are areas as broad as their ink is, and cut round."""
    SKIP = "skip"
    """They are not cut."""
    REFUSE = "refuse"
    """Closed ones are the outlines of areas; open ones are refused."""


class Inks(enum.StrEnum):
    """What is cut out of one sheet."""

    TOGETHER = "together"
    """All inks, as they show: one tool, and edges that they share are cut once."""
    APART = "apart"
    """Each ink out of a sheet of its own, in a layer of its own."""


class Keep(enum.StrEnum):
    """Which side of a contour keeps its measure."""

    INK = "ink"
    """What is drawn stays: outer contours grow by half the kerf, holes shrink."""
    GROUND = "ground"
    """What is around it stays, as of a stencil: outer contours shrink, holes grow."""


class Start(enum.StrEnum):
    """Where contours begin."""

    NEAREST = "nearest"
    """Where it saves most way."""
    CORNER = "corner"
    """On a corner, the nearest."""
    STRAIGHT = "straight"
    """In the middle of a longest side, the nearest."""


class Turns(enum.StrEnum):
    """How pieces may be turned when they are nested on a sheet."""

    NONE = "none"
    """Not at all, as nap and pattern ask."""
    HALF = "half"
    """By half a turn, as the grain of cloth allows."""
    QUARTER = "quarter"
    """By quarters of a turn."""


class Narrow(enum.StrEnum):
    """What becomes of places that are narrower than the kerf."""

    REFUSE = "refuse"
    """Nothing is cut, and the place is named."""
    ACCEPT = "accept"
    """What is too narrow for the beam stays shut, and what it takes whole is lost; the rest is cut."""
