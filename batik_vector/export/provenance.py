"""Where a file comes from: written into every format, and read back from it.

SVG and PDF hold it as XML under our namespace, readable to people; DXF, PNG, TIFF and G-code as one line of
ASCII (JSON, in base64 where a format gives characters meanings of its own). The recipe comes back as it was,
to the character.

Files to read come from strangers. XML with a DOCTYPE is refused, and with it every entity; sizes are
bounded; nothing is run, and nothing else is opened.
"""

from __future__ import annotations

import base64
import binascii
import json
import re
import struct
import zlib
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path
from typing import Any
from xml.parsers import expat

from batik_vector.artwork import Provenance
from batik_vector.errors import Fault, RecipeError
from batik_vector.export.palette import xml_safe

NAMESPACE = "urn:x-batik-vector:provenance"
BASE64 = "-base64"
DXF_MARK = "BATIK_VECTOR PROVENANCE 1"
HPGL_MARK = b'CO"BATIK_VECTOR '
PNG_KEYWORD = b"batik_vector"
TIFF_DESCRIPTION = 270
MAX_FILE = 1 << 30
MAX_RECIPE = 16 << 20
"""Bytes of a file, and of the provenance in it, past which it is refused."""
DXF_CHUNK = 240
"""Characters in one DXF string; AutoCAD allows 255."""
GCODE_CHUNK = 68
"""Characters in one comment of G-code: grbl's lines have room for 80, and senders count them in."""
HEAD = 4096
"""Bytes of an HPGL file within which its comments begin."""


class _FoundError(Exception):
    """Stops the parser once it has all it came for."""


def xml_fields(provenance: Provenance) -> Iterator[tuple[str, str]]:
    """Yield (element, text) for the XML formats; what XML cannot hold is base64 and named so."""
    for name, value in (
        *(("process", each) for each in provenance.processes),
        *(("plugin", each) for each in provenance.plugins),
        ("version", provenance.version),
        ("seed", str(provenance.seed)),
        ("recipe", provenance.recipe),
    ):
        if xml_safe(value):
            yield name, value
        else:
            yield name + BASE64, base64.b64encode(value.encode("utf-8", "surrogatepass")).decode("ascii")


def ascii_line(provenance: Provenance) -> str:
    """Return a provenance as one line of ASCII."""
    values: dict[str, Any] = {
        "version": provenance.version,
        "seed": provenance.seed,
        "recipe": provenance.recipe,
    }
    if provenance.processes:
        values["processes"] = provenance.processes
    if provenance.plugins:
        values["plugins"] = provenance.plugins
    return json.dumps(values, ensure_ascii=True)


def ascii_chunks(provenance: Provenance, longest: int = DXF_CHUNK) -> list[str]:
    """Return a provenance as strings without blanks, the first of them the mark to know it by."""
    line = base64.b64encode(ascii_line(provenance).encode("ascii")).decode("ascii")
    return [DXF_MARK, *(line[at : at + longest] for at in range(0, len(line), longest))]


def hpgl_comments(provenance: Provenance) -> bytes:
    """Return a provenance as comments of HP-GL/2, one to a line."""
    line = base64.b64encode(ascii_line(provenance).encode("ascii"))
    chunks = (line[at : at + DXF_CHUNK] for at in range(0, len(line), DXF_CHUNK))
    return b"".join(b'%b%b";\n' % (HPGL_MARK, chunk) for chunk in chunks)


def read_provenance(path: str | Path) -> Provenance:
    """Return the recipe, seed and version that an SVG, PDF, DXF, PNG, TIFF, HPGL or G-code of ours carries.

    Raises:
        RecipeError: where the file cannot be read, or carries none.
    """
    path = Path(path)
    try:
        size = path.stat().st_size
        if size > MAX_FILE:
            raise _fault(path, f"{size:,} bytes is more than a compiled file has")
        data = path.read_bytes()
    except OSError as error:
        raise _fault(path, error.strerror or str(error)) from error
    return provenance_in(data, path)


def provenance_in(data: bytes, path: Path) -> Provenance:
    """Return what the bytes of a file carry; faults call it by its path; see :func:`read_provenance`."""
    try:
        found = _read(data)
    except ValueError as error:
        raise _fault(path, str(error)) from error
    if found is None:
        where = (
            "HPGL does where comment = true asked for it"
            if path.suffix.lower() == ".hpgl"
            else "it is no file of this program, or another program saved it since"
        )
        raise _fault(path, f"carries no recipe: {where}")
    return found


def is_made(head: bytes) -> bool:
    """Return whether bytes begin as a file of a format that carries its recipe, which no TOML does."""
    text = head.lstrip(b"\xef\xbb\xbf \t\r\n")
    known = (b"%PDF-", b"\x89PNG\r\n\x1a\n", b"II*\0", b"<")
    return text.startswith(known) or HPGL_MARK in head or DXF_MARK.encode("ascii") in head


def _fault(path: Path, words: str) -> RecipeError:
    return RecipeError([Fault(words, source=str(path))])


def _read(data: bytes) -> Provenance | None:
    if data.startswith(b"%PDF-"):
        return _from_pdf(data)
    if data.startswith(b"\x89PNG\r\n\x1a\n"):
        return _from_png(data)
    if data.startswith(b"II*\0"):
        return _from_tiff(data)
    if data[:200].lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        return _from_xml(data)
    if HPGL_MARK in data[:HEAD]:
        return _from_hpgl(data)
    return _from_text(data)


def _from_line(line: str) -> Provenance:
    try:
        values = json.loads(line)
        recipe, seed, version = values["recipe"], values["seed"], values["version"]
    except (ValueError, TypeError, KeyError, RecursionError):
        raise ValueError("its provenance is damaged") from None
    if not (isinstance(recipe, str) and isinstance(version, str) and isinstance(seed, int)):
        raise ValueError("its provenance is damaged")
    listed = [values.get(name, []) for name in ("processes", "plugins")]
    if not all(isinstance(each, list) and all(isinstance(word, str) for word in each) for each in listed):
        raise ValueError("its provenance is damaged")
    return Provenance(recipe, seed, version, *map(tuple, listed))


class _XmlReader:
    """Collects the elements of our namespace."""

    def __init__(self) -> None:
        self.values: dict[str, str] = {}
        self.listed: dict[str, list[str]] = {"process": [], "plugin": []}
        self._name = ""
        self._parts: list[str] = []
        self._length = 0

    def parse(self, data: bytes) -> None:
        parser = expat.ParserCreate(namespace_separator=" ")
        parser.buffer_text = True
        parser.StartDoctypeDeclHandler = self._doctype
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        try:
            parser.Parse(data, True)
        except _FoundError:
            pass
        except expat.ExpatError as error:
            raise ValueError(f"is no well-formed XML: {error}") from None

    def _doctype(self, *_: object) -> None:
        raise ValueError("has a DOCTYPE, which no compiled file has")

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        space, _, local = name.rpartition(" ")
        if space == NAMESPACE and local.removesuffix(BASE64) in (
            "recipe",
            "seed",
            "version",
            *self.listed,
        ):
            self._name, self._parts, self._length = local, [], 0

    def _text(self, words: str) -> None:
        if self._name:
            self._length += len(words)
            if self._length > MAX_RECIPE:
                raise ValueError("its recipe is too long")
            self._parts.append(words)

    def _end(self, name: str) -> None:
        if self._name and name == f"{NAMESPACE} {self._name}":
            value = "".join(self._parts)
            if self._name.endswith(BASE64):
                value = base64.b64decode(value, validate=True).decode("utf-8", "surrogatepass")
            name, self._name = self._name.removesuffix(BASE64), ""
            if name in self.listed:
                self.listed[name].append(value)
                return
            self.values[name] = value
            if len(self.values) == 3:
                raise _FoundError


def _from_xml(data: bytes) -> Provenance | None:
    reader = _XmlReader()
    reader.parse(data)
    values = reader.values
    if "recipe" not in values:
        return None
    seed = values.get("seed", "0")
    if not re.fullmatch(r"-?[0-9]{1,4000}", seed):
        raise ValueError("its seed is no whole number")
    return Provenance(
        values["recipe"], int(seed), values.get("version", ""), *map(tuple, reader.listed.values())
    )


def _from_pdf(data: bytes) -> Provenance | None:
    import io

    import pikepdf

    try:
        with pikepdf.open(io.BytesIO(data)) as pdf:
            stream: Any = pdf.Root.get("/Metadata")
            if not isinstance(stream, pikepdf.Stream):
                return None
            raw, packing = stream.read_raw_bytes(), stream.get("/Filter")
    except (pikepdf.PdfError, pikepdf.PasswordError) as error:
        raise ValueError(f"is no readable PDF: {error}") from None
    if packing == pikepdf.Name.FlateDecode:
        raw = _inflate(raw)
    elif packing is not None:
        return None
    return _from_xml(raw)


def _inflate(raw: bytes) -> bytes:
    machine = zlib.decompressobj()
    try:
        out = machine.decompress(raw, 2 * MAX_RECIPE)
    except zlib.error:
        raise ValueError("its metadata is damaged") from None
    if machine.unconsumed_tail:
        raise ValueError("its recipe is too long")
    return out


def _from_png(data: bytes) -> Provenance | None:
    at = 8
    while at + 12 <= len(data):
        length, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        if kind == b"tEXt" and data[at + 8 : at + 8 + length].startswith(PNG_KEYWORD + b"\0"):
            body = data[at + 8 + len(PNG_KEYWORD) + 1 : at + 8 + length]
            return _from_line(body.decode("latin-1"))
        at += 12 + length
    return None


def _from_tiff(data: bytes) -> Provenance | None:
    """Return what the image description of a TIFF carries; the numbers of ours begin at their ends."""
    at = int.from_bytes(data[4:8], "little")
    for first in range(at + 2, at + 2 + 12 * int.from_bytes(data[at : at + 2], "little"), 12):
        tag, _, count, place = struct.unpack("<HHII", data[first : first + 12].ljust(12, b"\0"))
        if tag == TIFF_DESCRIPTION and data[place : place + 1] == b"{":
            return _from_line(data[place : place + count].rstrip(b"\0").decode("latin-1"))
    return None


def _from_text(data: bytes) -> Provenance | None:
    """Return what a DXF or G-code carries."""
    at = data.find(DXF_MARK.encode("ascii"))
    if at < 0:
        return None
    lines = data[at : at + 2 * MAX_RECIPE].splitlines()
    comment = data[:at].rstrip(b" ")[-1:]
    chunks = _in_comments(lines[1:], comment) if comment in (b";", b"(") else _in_pairs(lines[1:])
    return _from_base64(b"".join(chunks))


def _from_hpgl(data: bytes) -> Provenance:
    chunks = []
    for line in data[data.find(HPGL_MARK) :][: 2 * MAX_RECIPE].splitlines():
        if not line.startswith(HPGL_MARK):
            break
        chunks.append(line.removeprefix(HPGL_MARK).removesuffix(b'";'))
    return _from_base64(b"".join(chunks))


def _from_base64(data: bytes) -> Provenance:
    try:
        line = base64.b64decode(data, validate=True).decode("ascii")
    except (binascii.Error, UnicodeDecodeError):
        raise ValueError("its provenance is damaged") from None
    return _from_line(line)


def _in_pairs(lines: list[bytes]) -> list[bytes]:
    """Return the strings of DXF: a group code, then its value; theirs is 1, or 1000 in extended data."""
    pairs = zip(lines[::2], lines[1::2], strict=False)
    return [value.strip() for _, value in takewhile(lambda pair: pair[0].strip() in (b"1", b"1000"), pairs)]


def _in_comments(lines: list[bytes], begun: bytes) -> list[bytes]:
    """Return the comments of G-code, as long as lines are such."""
    return [line.strip(b";() ") for line in takewhile(lambda line: line.startswith(begun), lines)]
