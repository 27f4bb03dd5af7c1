"""The manifest of a sweep: what has been made of its variants, noted line by line as it is done."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, BinaryIO

from batik_vector.errors import ExportError
from batik_vector.export.files import write_whole
from batik_vector.making.thumbnails import Thumbnail
from batik_vector.making.variants import Variant
from batik_vector.values import frozen


@frozen
class Made:
    """A variant that is made: its files with the digests of their bytes, a report, and its picture."""

    variant: Variant
    files: tuple[tuple[str, str], ...]
    report: dict[str, Any]
    picture: Thumbnail | None = None
    fresh: bool = True


def digest_of(path: Path) -> str:
    """Return the digest of a file's bytes."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


class Manifest:
    """The file that says what a sweep has made: a line of JSON for each variant, found again by its key.

    The lines stay on the disk, for pictures are large and variants many.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._places: dict[str, tuple[int, int]] = {}
        self._end = 0
        if path.is_file():
            with path.open("rb") as file:
                for text in file:
                    if (key := _key_of(text)) is not None:
                        self._places[key] = self._end, len(text)
                    self._end += len(text)

    def line(self, key: str) -> dict[str, Any] | None:
        """Return the line with a key."""
        if key not in self._places:
            return None
        found: dict[str, Any] = json.loads(self._text(key))
        return found

    def _text(self, key: str) -> bytes:
        start, length = self._places[key]
        with self.path.open("rb") as file:
            file.seek(start)
            return file.read(length)

    def made(self, variant: Variant, key: str, pictures: bool) -> Made | None:
        """Return a variant that has been made, if its files are still what they were."""
        line = self.line(key)
        if line is None or (pictures and "picture" not in line):
            return None
        files = tuple((str(name), str(digest)) for name, digest in line["files"])
        for name, digest in files:
            place = self.path.parent / name
            if not place.is_file() or digest_of(place) != digest:
                return None
        return Made(variant, files, line["report"], picture_in(line), fresh=False)

    def add(self, made: Made, key: str) -> None:
        """Note a variant as it is done.

        Raises:
            ExportError: where that cannot be written.
        """
        text = (json.dumps(_line(made, key)) + "\n").encode()
        try:
            with self.path.open("ab") as file:
                # What a kill cut short is ended, and passed over.
                if self._end and self._last() != b"\n":
                    self._end += file.write(b"\n")
                self._places[key] = self._end, len(text)
                self._end += file.write(text)
        except OSError as error:
            raise ExportError(f"{self.path} could not be written: {error.strerror or error}") from error

    def _last(self) -> bytes:
        with self.path.open("rb") as file:
            file.seek(self._end - 1)
            return file.read()

    def settle(self, keys: Sequence[str]) -> None:
        """Write the lines of a whole sweep in the order of its variants: the same bytes however it went."""

        def write(sink: BinaryIO) -> None:
            for key in keys:
                if key in self._places:
                    sink.write(self._text(key))

        if any(key in self._places for key in keys):
            write_whole(self.path, write)


def _key_of(text: bytes) -> str | None:
    """Return the key of a line that is whole."""
    try:
        line = json.loads(text)
    except ValueError:
        return None
    whole = isinstance(line, dict) and {"key", "files", "report"} <= line.keys()
    return str(line["key"]) if whole else None


def picture_in(line: Mapping[str, Any]) -> Thumbnail | None:
    """Return the picture that a line of a manifest holds."""
    return Thumbnail(**line["picture"]) if "picture" in line else None


def _line(made: Made, key: str) -> dict[str, Any]:
    variant, picture = made.variant, made.picture
    line: dict[str, Any] = {
        "key": key,
        "name": variant.name,
        "changes": list(variant.changes),
        "files": [list(each) for each in made.files],
        "report": {name: made.report[name] for name in ("cell_mm", "vertices") if name in made.report},
    }
    if picture is not None:
        line["picture"] = {name: getattr(picture, name) for name in ("width", "height", "cloth", "marks")}
    return line
