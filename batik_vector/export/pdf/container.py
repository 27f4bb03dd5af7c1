"""The file as it grows: numbered objects, a stream compressed as it comes, and the table at the end."""

from __future__ import annotations

import hashlib
import zlib
from typing import BinaryIO

COMPRESSION = 1
"""Level 6 takes six times as long and saves a sixth."""
BLOCK = 1 << 20
"""Bytes compressed at a time."""
HELD_BACK = 1 << 24
"""Compressed bytes up to which a content stream is kept until its length is known; a longer one is written as
it comes, and its length behind it."""
INFO = 6
"""Number of the object that holds the document's information."""


class File:
    """The file as it grows: numbered objects, and at last their table."""

    def __init__(self, sink: BinaryIO) -> None:
        self._sink = sink
        self._starts: dict[int, int] = {}
        self._at = 0
        self._hash = hashlib.sha256()
        self.put(b"%PDF-1.6\n%\xe2\xe3\xcf\xd3\n")

    def put(self, data: bytes) -> None:
        """Write bytes."""
        self._sink.write(data)
        self._hash.update(data)
        self._at += len(data)

    def open(self, number: int) -> None:
        """Begin an object."""
        self._starts[number] = self._at
        self.put(b"%d 0 obj\n" % number)

    def close(self) -> None:
        """End an object."""
        self.put(b"\nendobj\n")

    def whole(self, number: int, body: bytes) -> None:
        """Write an object."""
        self.open(number)
        self.put(body)
        self.close()

    def end(self) -> None:
        """Write the table of all objects, and what says where it is."""
        table, count = self._at, len(self._starts) + 1
        self.put(f"xref\n0 {count}\n0000000000 65535 f \n".encode("ascii"))
        starts = (self._starts[number] for number in range(1, count))
        self.put("".join(f"{start:010d} 00000 n \n" for start in starts).encode("ascii"))
        mark = self._hash.hexdigest()[:32]
        self.put(
            f"trailer\n<< /Size {count} /Root 1 0 R /Info {INFO} 0 R /ID [<{mark}> <{mark}>] >>\n".encode(
                "ascii"
            )
        )
        self.put(f"startxref\n{table}\n%%EOF\n".encode("ascii"))


class Stream:
    """The content stream: compressed in blocks, held back while it is short."""

    def __init__(self, file: File, number: int, length_number: int, entries: bytes = b"") -> None:
        """Begin a stream.

        Args:
            file: into which it goes.
            number: of its object.
            length_number: of the object that holds its length, should it be long.
            entries: of its dictionary, beside length and filter.
        """
        self._file, self._number, self._length_number, self._entries = file, number, length_number, entries
        self._machine = zlib.compressobj(COMPRESSION)
        self._raw: list[bytes] = []
        self._waiting = 0
        self._held: list[bytes] = []
        self._length = 0
        self._written = False

    def put(self, data: bytes) -> None:
        """Add to what the stream holds."""
        self._raw.append(data)
        self._waiting += len(data)
        if self._waiting >= BLOCK:
            raw = b"".join(self._raw)
            whole = len(raw) // BLOCK * BLOCK
            for at in range(0, whole, BLOCK):
                self._keep(self._machine.compress(memoryview(raw)[at : at + BLOCK]))
            self._raw, self._waiting = [raw[whole:]], len(raw) - whole

    def _keep(self, packed: bytes) -> None:
        self._length += len(packed)
        self._held.append(packed)
        if self._length > HELD_BACK:
            if not self._written:
                self._head(b"%d 0 R" % self._length_number)
            self._release()

    def _head(self, length: bytes) -> None:
        self._file.open(self._number)
        self._file.put(b"<< %b/Length %b /Filter /FlateDecode >>\nstream\n" % (self._entries, length))
        self._written = True

    def _release(self) -> None:
        for packed in self._held:
            self._file.put(packed)
        self._held.clear()

    def end(self) -> bool:
        """Close the stream; return whether its length is still to be written, as an object of its own."""
        self._keep(self._machine.compress(b"".join(self._raw)) + self._machine.flush())
        behind = self._written
        if not behind:
            self._head(b"%d" % self._length)
        self._release()
        self._file.put(b"\nendstream")
        self._file.close()
        if behind:
            self._file.whole(self._length_number, b"%d" % self._length)
        return behind
