"""What can be chosen of traps, in words. Importing it costs nothing heavy."""

from __future__ import annotations

import enum


class By(enum.StrEnum):
    """Which of two inks that meet spreads under the other."""

    LIGHTNESS = "lightness"
    """The lighter one: the darker one's edge is the one that is seen, and it stays where it is."""
    ORDER = "order"
    """The one that is printed first."""


class Covered(enum.StrEnum):
    """What becomes of marks that a trap would cover whole."""

    REFUSE = "refuse"
    """Nothing is trapped, and the mark is named."""
    ACCEPT = "accept"
    """They are covered, and counted."""
