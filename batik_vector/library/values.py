"""What the library hands out, as plain values."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from batik_vector import Recipe


class Page(NamedTuple):
    """What is kept of a recipe: its title, its page of TOML, and its drawings by the names of their files."""

    title: str
    text: str
    drawings: Mapping[str, str]


def page_of(recipe: Recipe) -> Page:
    """Return what is kept of a recipe."""
    return Page(recipe.title, recipe.written, dict(recipe.drawing))


class Saved(NamedTuple):
    """A version that was saved; not ``fresh`` where the newest said the same already."""

    id: int
    name: str
    number: int
    fresh: bool


class Version(NamedTuple):
    """A version of a pattern: its recipe as it was written, and the drawings by the names of their files.

    ``saved`` is a time in UTC, ``origin`` says where it came from, ``program`` is the version of this program
    that saved it.
    """

    id: int
    name: str
    number: int
    title: str
    saved: str
    origin: str
    program: str
    text: str
    drawings: Mapping[str, str]


class Note(NamedTuple):
    """A note on a pattern, and when it was written, in UTC."""

    written: str
    text: str


class Details(NamedTuple):
    """All there is about a version besides its recipe."""

    tags: tuple[str, ...]
    notes: tuple[Note, ...]
    features: Mapping[str, Any]
    svg: bytes
    png: bytes


class Stats(NamedTuple):
    """A library in figures: the bytes of its file and of what SQLite keeps beside it, and what is in it."""

    path: str
    bytes: int
    schema: int
    sqlite: str
    writable: bool
    patterns: int
    included: int
    removed: int
    versions: int
    tags: int
    notes: int
