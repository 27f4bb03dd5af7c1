"""The normal form: what every recipe compiles to and every exporter writes.

An :class:`~batik_vector.artwork.page.Artwork` is a page of ink layers. What holds for each of them, and need
not be asked again:

* coordinates are millimetres on cloth, y upwards, the cell's lower left corner at (0, 0);
* every coordinate is finite and lies on the 1 µm grid (it is the float ``k / 1000``);
* areas are valid, non-empty polygons, outer rings anticlockwise, holes clockwise;
* lines are polylines of at least two distinct points, no step of length zero; a closed line repeats its
  first point at its end;
* nothing lies outside the cell grown by ``bleed``;
* nothing is drawn twice: no two areas of a layer overlap unless its ink says ``overlay``, and no two
  lines of a layer share a stretch;
* layer order is painting order, the first layer at the bottom; ink names are unique.

:func:`violations` lists whatever breaks these rules. Writers refuse what is on the list, and no certificate
passes it.
"""

from __future__ import annotations

from batik_vector.artwork.dyeing import Bath, Dyeing, Seen
from batik_vector.artwork.normal_form import Breach, breaches, violations
from batik_vector.artwork.page import (
    PIECE,
    Artwork,
    Cell,
    Cmyk,
    DropAxis,
    Geometries,
    Ink,
    Lab,
    Layer,
    Margins,
    Overlap,
    Page,
    Plate,
    Provenance,
    RawArtwork,
    dyeing_of,
)

__all__ = [
    "PIECE",
    "Artwork",
    "Bath",
    "Breach",
    "Cell",
    "Cmyk",
    "DropAxis",
    "Dyeing",
    "Geometries",
    "Ink",
    "Lab",
    "Layer",
    "Margins",
    "Overlap",
    "Page",
    "Plate",
    "Provenance",
    "RawArtwork",
    "Seen",
    "breaches",
    "dyeing_of",
    "violations",
]
