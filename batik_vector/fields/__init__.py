"""Fields of values: their bounds, units and help, and whether what they are given fits."""

from __future__ import annotations

from batik_vector.fields.catalogues import Catalogue, brought_by, installed, named
from batik_vector.fields.fitting import belongs, bound, check, given, shown
from batik_vector.fields.marks import (
    HIDDEN,
    TAG,
    Alone,
    Between,
    Colour,
    Converted,
    Instead,
    Length,
    LengthUnit,
    Names,
    OneOf,
    Says,
    Several,
    Text,
    Unset,
    Useful,
    hint_of,
    parse_colour,
)

__all__ = [
    "HIDDEN",
    "TAG",
    "Alone",
    "Between",
    "Catalogue",
    "Colour",
    "Converted",
    "Instead",
    "Length",
    "LengthUnit",
    "Names",
    "OneOf",
    "Says",
    "Several",
    "Text",
    "Unset",
    "Useful",
    "belongs",
    "bound",
    "brought_by",
    "check",
    "given",
    "hint_of",
    "installed",
    "named",
    "parse_colour",
    "shown",
]
