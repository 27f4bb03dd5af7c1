"""The chunks of a PNG that say where it comes from and how large it is. PNG, third edition (W3C 2025)."""

from __future__ import annotations

import zlib

from batik_vector.artwork import Provenance
from batik_vector.export.provenance import PNG_KEYWORD, ascii_line

SIGNATURE = b"\x89PNG\r\n\x1a\n"


def chunk(kind: bytes, body: bytes) -> bytes:
    """Return a chunk with its length and its check."""
    return len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")


def per_metre(dpi: float) -> int:
    """Return the pixels in a metre, of which a PNG counts whole ones."""
    return round(dpi / 0.0254)


def physical(dpi: float) -> bytes:
    """Return the chunk that says the resolution."""
    count = per_metre(dpi).to_bytes(4, "big")
    return chunk(b"pHYs", count + count + b"\1")


def text(provenance: Provenance) -> bytes:
    """Return the chunk that carries recipe, seed and version."""
    return chunk(b"tEXt", PNG_KEYWORD + b"\0" + ascii_line(provenance).encode("ascii"))
