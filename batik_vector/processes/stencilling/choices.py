"""What can be chosen of a stencil, in words. Importing it costs nothing heavy."""

from __future__ import annotations

import enum


class Backing(enum.StrEnum):
    """What holds the sheet of a stencil together."""

    NONE = "none"
    """Nothing but the sheet: islands are held by bridges."""
    NET = "net"
    """Silk thread or a net glued to the sheet, as on katagami: islands are legal, and no bridges are made."""
