"""DXF: one closed LWPOLYLINE per contour, one layer per ink, declared and true millimetres.

Only the dullest parts of the format are used, since those are what every cutter, CAM and CAD reads: no
splines, hatches, blocks or comments. Areas and lines are both drawn as outlines and centre lines: DXF has
no fill that all readers share. Contours come in the order in which a tool should follow them, the inner
before the outer (see :mod:`batik_vector.processes.order`). Everything around the entities comes from a
skeleton kept as data (see :mod:`batik_vector.export.dxf.skeleton`); ezdxf is not needed to write.

Recipe, seed and version stand in an XRECORD in the named-object dictionary (R2000), or in the extended
data of the model-space block (R12, which has no dictionaries), where they must fit ``R12_PROVENANCE``
characters: a longer recipe is left out of an R12 file.
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import BinaryIO

import numpy as np

from batik_vector.artwork import Ink, Page
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export.numbers import (
    WORD,
    Characters,
    Room,
    Style,
    Words,
    beside,
    digits,
    hexadecimals,
    room_for,
    spelling,
    text,
    word,
)
from batik_vector.export.options import DxfOptions, DxfVersion
from batik_vector.export.palette import distinct_aci, dxf_names, r12_names
from batik_vector.export.provenance import ascii_chunks
from batik_vector.export.walk import Order, Outlines, in_memory, walk
from batik_vector.units import STEPS_PER_MM

R2000_SKELETON = "r2000.txt"
R12_SKELETON = "r12.txt"
DICTIONARY = "BATIK_VECTOR"
DICTIONARY_HANDLE, XRECORD_HANDLE = "80", "81"
FIRST_LAYER = 0x100
FIRST_ENTITY = 0x100000
"""Handles: the skeleton's own are below 80, then the provenance, the layers, the entities."""
LAST_HANDLE = 0xFFFFFF
"""So that all seeds for further handles have six figures, and the file can be written in one go."""
VIEW_ASPECT = 1.34
"""Breadth of the skeleton's viewport over its height."""
R12_PROVENANCE = 15_000
"""AutoCAD allows 16,383 bytes of extended data on an entity."""
R12_LEFT_OUT = "BATIK_VECTOR: THE RECIPE IS TOO LONG FOR R12"

DEFAULTS = DxfOptions()


def render(page: Page, options: DxfOptions = DEFAULTS) -> bytes:
    """Return a page as a DXF file; see :func:`write`."""
    return in_memory(lambda sink: write(page, sink, options))


def write(page: Page, sink: BinaryIO, options: DxfOptions = DEFAULTS) -> None:
    """Write a page as a DXF file. Coordinates are the page's own: the cell's corner is (0, 0).

    Args:
        page: what to write.
        sink: open for writing and seeking.
        options: which DXF.

    Raises:
        ExportError: where the page holds what cannot be written.
    """
    surface = _R12Surface(sink) if options.version is DxfVersion.R12 else _DxfSurface(sink)
    walk(page, surface, Order.CONTOURS if options.order else Order.GIVEN)


@functools.cache
def _skeleton(name: str) -> str:
    return (Path(__file__).parent / name).read_text(encoding="ascii")


class _DxfSurface:
    """Puts entities into the R2000 skeleton as they come."""

    skeleton = R2000_SKELETON
    names = staticmethod(dxf_names)

    def __init__(self, sink: BinaryIO) -> None:
        self._sink = sink
        self._handle = FIRST_ENTITY
        self._after = b""
        self._seed_at = -1

    def begin(self, page: Page) -> None:
        self._page = page
        names = self.names(plate.ink.name for plate in page.plates)
        self._names = [name.encode("ascii") for name in names]
        self._colours = distinct_aci(plate.ink.colour for plate in page.plates)
        self._number = -1
        layers = b"".join(self._layer(number) for number in range(len(names)))
        out = _skeleton(self.skeleton)
        for mark, value in self._values().items():
            out = out.replace(f"@{mark}@", value)
        before, self._after = out.encode("ascii").split(b"@ENTITIES@\n")
        # How many handles are given out is known at the end only.
        head, seed, tail = before.partition(b"@HANDSEED@")
        # Last, because the name of a layer may look like any mark.
        head, tail = (part.replace(b"@LAYERS@\n", layers) for part in (head, tail))
        self._sink.write(head)
        if seed:
            self._seed_at = self._sink.tell()
            self._sink.write(b"%X" % FIRST_ENTITY + tail)

    def ink(self, ink: Ink, pen: int) -> None:
        self._number += 1
        self._name = self._names[self._number]

    def areas(self, outlines: Outlines) -> None:
        self._handle += len(outlines.closed)
        if self._handle > LAST_HANDLE:
            raise UnsupportedByFormatError(
                f"a DXF of ours holds {LAST_HANDLE - FIRST_ENTITY:,} contours at most: write less cloth in it"
            )
        self._sink.write(self._polylines(outlines))

    def lines(self, outlines: Outlines) -> None:
        self.areas(outlines)

    def end(self) -> None:
        self._sink.write(self._after)
        if self._seed_at >= 0:
            end = self._sink.tell()
            self._sink.seek(self._seed_at)
            self._sink.write(b"%X" % self._handle)
            self._sink.seek(end)

    def _layer(self, number: int) -> bytes:
        handle = f"{FIRST_LAYER + number:X}".encode("ascii")
        return (
            b"  0\nLAYER\n  5\n%b\n330\n1\n100\nAcDbSymbolTableRecord\n100\nAcDbLayerTableRecord\n"
            b"  2\n%b\n 70\n0\n 62\n%d\n  6\nContinuous\n370\n-3\n390\n13\n"
        ) % (handle, self._names[number], self._colours[number])

    def _polylines(self, outlines: Outlines) -> bytes:
        count = len(outlines.closed)
        heads = beside(
            count,
            b"\n0\nLWPOLYLINE\n5\n",
            hexadecimals(np.arange(self._handle - count, self._handle)),
            # 17 is the model space's block record, which owns every entity.
            b"\n330\n17\n100\nAcDbEntity\n8\n%b\n100\nAcDbPolyline\n90\n" % self._name,
            digits(np.diff(outlines.rings)),
            b"\n70\n",
            _flags(outlines),
        )
        return _entities(outlines, heads, b"\n10\n", b"", b"\n")

    def _values(self) -> dict[str, str]:
        cell, margins = self._page.cell, self._page.margins
        left, bottom = -margins.left, -margins.bottom
        right, top = cell.columns + margins.right, cell.rows + margins.top
        height = max(top - bottom, (right - left) / VIEW_ASPECT)
        corners = {
            "LEFT": left,
            "BOTTOM": bottom,
            "RIGHT": right,
            "TOP": top,
            "BASE_X": margins.left,
            "BASE_Y": margins.bottom,
            "MIDDLE_X": (left + right) / 2,
            "MIDDLE_Y": (bottom + top) / 2,
            "VIEW": height * 1.05,
        }
        return {
            **{mark: repr(round(steps / STEPS_PER_MM, 6)) for mark, steps in corners.items()},
            "LAYER_COUNT": str(len(self._names) + 2),
            **self._provenance(),
        }

    def _provenance(self) -> dict[str, str]:
        chunks = ascii_chunks(self._page.provenance)
        return {"PROVENANCE": "\n".join(f"  1\n{chunk}" for chunk in chunks)}


class _R12Surface(_DxfSurface):
    """The same in R12: a POLYLINE, its VERTEX entities and a SEQEND for each contour; no handles."""

    skeleton = R12_SKELETON
    names = staticmethod(r12_names)

    def _layer(self, number: int) -> bytes:
        return b"  0\nLAYER\n  2\n%b\n 70\n0\n 62\n%d\n  6\nCONTINUOUS\n" % (
            self._names[number],
            self._colours[number],
        )

    def _polylines(self, outlines: Outlines) -> bytes:
        layer = b"\n8\n%b" % self._name
        count = len(outlines.closed)
        seqend = b"\n0\nSEQEND" + layer
        ends = beside(count, seqend)
        # A head ends the polyline before it, so that all rows between two heads are vertices.
        ends[0] = 0
        start = b"\n0\nPOLYLINE" + layer + b"\n66\n1\n70\n"
        heads = beside(count, ends, start, _flags(outlines), b"\n10\n0.0\n20\n0.0\n30\n0.0")
        vertex = b"\n0\nVERTEX" + layer + b"\n10\n"
        return _entities(outlines, heads, vertex, b"\n30\n0.0", seqend + b"\n")

    def _provenance(self) -> dict[str, str]:
        provenance = self._page.provenance
        chunks = ascii_chunks(provenance)
        if sum(map(len, chunks)) > R12_PROVENANCE:
            return {"PROVENANCE": f"1000\n{R12_LEFT_OUT}"}
        return {"PROVENANCE": "\n".join(f"1000\n{chunk}" for chunk in chunks)}


def _flags(outlines: Outlines) -> Characters:
    """Return the polylines' flags as a column of characters: 1 is closed."""
    return np.where(outlines.closed, np.uint8(ord("1")), np.uint8(ord("0")))[:, None]


def _entities(outlines: Outlines, heads: Characters, vertex: bytes, after: bytes, end: bytes) -> bytes:
    """Return a head and its vertices for each contour, each line begun by its line feed.

    Args:
        outlines: the contours.
        heads: what stands before the vertices of each, shape (contours, h); the first begins the text.
        vertex: what stands before the abscissa of each vertex.
        after: what stands behind its ordinate.
        end: what ends the last contour.
    """
    spelled = spelling(outlines.points, Style.REAL)
    before, behind = (_padded(part) for part in (vertex, after))
    middle = len(before) + spelled.words
    width = middle + 1 + spelled.words + len(behind)
    count = len(heads)
    layout = Room(outlines.rings, np.full(count, room_for(heads.shape[1], width)))
    points = outlines.points.take(layout.source, axis=0)
    rows: Words = np.empty((len(points), width), WORD)
    rows[:, : len(before)] = before
    spelled.put(rows, len(before), points[:, 0])
    rows[:, middle] = word("\n20\n")
    spelled.put(rows, middle + 1, points[:, 1])
    rows[:, width - len(behind) :] = behind
    layout.put(rows, np.arange(count), heads)
    return text(rows)[1:] + end


def _padded(part: bytes) -> Words:
    """Return characters as words."""
    return np.frombuffer(part + bytes(-len(part) % 4), WORD)
