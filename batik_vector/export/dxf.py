"""DXF: one closed LWPOLYLINE per contour, one layer per ink, declared and true millimetres.

Only the dullest parts of the format are used, since those are what every cutter, CAM and CAD reads: no
splines, hatches, blocks or comments. Areas and lines are both drawn as outlines and centre lines: DXF has
no fill that all readers share. Everything around the entities comes from a skeleton kept as data (see
:mod:`batik_vector.export.dxf_skeleton`); ezdxf is not needed to write.

Recipe, seed and version stand in an XRECORD in the named-object dictionary (R2000), or in the extended
data of the model-space block (R12, which has no dictionaries), where they must fit ``R12_PROVENANCE``
characters: a longer recipe is left out of an R12 file.
"""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from batik_vector.artwork import Artwork, Ink
from batik_vector.export.numbers import WORD, Style, Words, beside, digit_words, digits, headed, put, word
from batik_vector.export.options import DxfOptions, DxfVersion
from batik_vector.export.palette import distinct_aci, dxf_names
from batik_vector.export.provenance import ascii_chunks
from batik_vector.export.walk import Outlines, walk
from batik_vector.units import STEPS_PER_MM

R2000_SKELETON = "dxf_r2000.txt"
R12_SKELETON = "dxf_r12.txt"
DICTIONARY = "BATIK_VECTOR"
DICTIONARY_HANDLE, XRECORD_HANDLE = "80", "81"
FIRST_LAYER = 0x100
FIRST_ENTITY = 0x100000
"""Handles: the skeleton's own are below 80, then the provenance, the layers, the entities."""
VIEW_ASPECT = 1.34
"""Breadth of the skeleton's viewport over its height."""
R12_PROVENANCE = 15_000
"""AutoCAD allows 16,383 bytes of extended data on an entity."""
R12_LEFT_OUT = "BATIK_VECTOR: THE RECIPE IS TOO LONG FOR R12"

DEFAULTS = DxfOptions()


def render(artwork: Artwork, options: DxfOptions = DEFAULTS) -> bytes:
    """Return an artwork as a DXF file. Coordinates are the artwork's own: the cell's corner is (0, 0).

    Raises:
        ExportError: where the artwork holds what cannot be written.
    """
    surface = _R12Surface() if options.version is DxfVersion.R12 else _DxfSurface()
    walk(artwork, surface)
    return surface.data


@functools.cache
def _skeleton(name: str) -> str:
    return (Path(__file__).parent / name).read_text(encoding="ascii")


class _DxfSurface:
    """Collects entities, then puts them into the R2000 skeleton."""

    skeleton = R2000_SKELETON

    def __init__(self) -> None:
        self._entities: list[bytes] = []
        self._layers: list[bytes] = []
        self._handle = FIRST_ENTITY
        self.data = b""

    def begin(self, artwork: Artwork) -> None:
        self._artwork = artwork
        names = dxf_names(layer.ink.name for layer in artwork.layers)
        self._names = [name.encode("ascii") for name in names]
        self._colours = distinct_aci(layer.ink.colour for layer in artwork.layers)

    def ink(self, ink: Ink, pen: int) -> None:
        self._name = self._names[pen - 1]
        self._layers.append(self._layer(pen))

    def areas(self, outlines: Outlines) -> None:
        self._entities.append(self._polylines(outlines))
        self._handle += len(outlines.closed)

    def lines(self, outlines: Outlines) -> None:
        self.areas(outlines)

    def end(self) -> None:
        out = _skeleton(self.skeleton)
        for mark, value in self._values().items():
            out = out.replace(f"@{mark}@", value)
        layers, entities = b"".join(self._layers), b"".join(self._entities)
        data = out.encode("ascii").replace(b"@LAYERS@\n", layers).replace(b"@ENTITIES@\n", b"@ENTITIES@")
        before, after = data.split(b"@ENTITIES@")
        self.data = b"".join((before, entities, after))

    def _layer(self, pen: int) -> bytes:
        handle = f"{FIRST_LAYER + pen - 1:X}".encode("ascii")
        return (
            b"  0\nLAYER\n  5\n%b\n330\n1\n100\nAcDbSymbolTableRecord\n100\nAcDbLayerTableRecord\n"
            b"  2\n%b\n 70\n0\n 62\n%d\n  6\nContinuous\n370\n-3\n390\n13\n"
        ) % (handle, self._name, self._colours[pen - 1])

    def _polylines(self, outlines: Outlines) -> bytes:
        count = len(outlines.closed)
        handles = digits(np.arange(self._handle, self._handle + count), base=16)
        heads = beside(
            count,
            b"0\nLWPOLYLINE\n5\n",
            handles,
            # 17 is the model space's block record, which owns every entity.
            b"\n330\n17\n100\nAcDbEntity\n8\n%b\n100\nAcDbPolyline\n90\n" % self._name,
            digits(np.diff(outlines.rings)),
            b"\n70\n",
            _flags(outlines),
            b"\n",
        )
        return headed(heads, _vertices(outlines, b"", b""), outlines.rings)

    def _values(self) -> dict[str, str]:
        cell, bleed = self._artwork.cell, round(self._artwork.bleed * STEPS_PER_MM)
        left, right, top = -bleed, cell.columns + bleed, cell.rows + bleed
        height = max(top + bleed, (right + bleed) / VIEW_ASPECT)
        corners = {
            "LEFT": left,
            "BOTTOM": left,
            "RIGHT": right,
            "TOP": top,
            "BLEED": bleed,
            "MIDDLE_X": cell.columns / 2,
            "MIDDLE_Y": cell.rows / 2,
            "VIEW": height * 1.05,
        }
        return {
            **{mark: repr(round(steps / STEPS_PER_MM, 6)) for mark, steps in corners.items()},
            "LAYER_COUNT": str(len(self._layers) + 2),
            "HANDSEED": f"{self._handle:X}",
            **self._provenance(),
        }

    def _provenance(self) -> dict[str, str]:
        chunks = ascii_chunks(self._artwork.provenance)
        return {"PROVENANCE": "\n".join(f"  1\n{chunk}" for chunk in chunks)}


class _R12Surface(_DxfSurface):
    """The same in R12: a POLYLINE, its VERTEX entities and a SEQEND for each contour; no handles."""

    skeleton = R12_SKELETON

    def _layer(self, pen: int) -> bytes:
        return b"  0\nLAYER\n  2\n%b\n 70\n0\n 62\n%d\n  6\nCONTINUOUS\n" % (
            self._name,
            self._colours[pen - 1],
        )

    def _polylines(self, outlines: Outlines) -> bytes:
        layer = b"8\n%b\n" % self._name
        count = len(outlines.closed)
        seqend = b"0\nSEQEND\n" + layer
        ends = beside(count, seqend)
        # A head ends the polyline before it, so that all rows between two heads are vertices.
        ends[0] = 0
        start = b"0\nPOLYLINE\n" + layer + b"66\n1\n70\n"
        heads = beside(count, ends, start, _flags(outlines), b"\n10\n0.0\n20\n0.0\n30\n0.0\n")
        return (
            headed(heads, _vertices(outlines, b"0\nVERTEX\n" + layer, b"30\n0.0\n"), outlines.rings) + seqend
        )

    def _provenance(self) -> dict[str, str]:
        provenance = self._artwork.provenance
        chunks = ascii_chunks(provenance)
        if sum(map(len, chunks)) > R12_PROVENANCE:
            return {"PROVENANCE": f"1000\n{R12_LEFT_OUT}"}
        return {"PROVENANCE": "\n".join(f"1000\n{chunk}" for chunk in chunks)}


def _flags(outlines: Outlines) -> NDArray[np.uint8]:
    """Return the polylines' flags as a column of characters: 1 is closed."""
    return np.where(outlines.closed, np.uint8(ord("1")), np.uint8(ord("0")))[:, None]


def _vertices(outlines: Outlines, before: bytes, after: bytes) -> Words:
    """Return one row for each vertex: its coordinates, between what stands around them."""
    points = outlines.points
    size = digit_words(points)
    head, tail = beside(1, before).view(WORD), beside(1, b"\n" + after).view(WORD)
    middle = head.shape[1] + 1 + size
    rows: Words = np.zeros((len(points), middle + 2 + size + tail.shape[1]), WORD)
    rows[:, : head.shape[1]] = head
    put(rows, head.shape[1], points[:, 0], Style.REAL, size, word("10\n"))
    rows[:, middle] = word("\n20\n")
    put(rows, middle + 1, points[:, 1], Style.REAL, size, word("\0"))
    rows[:, middle + 2 + size :] = tail
    return rows
