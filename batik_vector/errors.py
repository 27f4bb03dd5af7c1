"""What can go wrong, as one tree.

    BatikError
    ├ RecipeError (ValueError)        kawung.toml:12: motif.curve.n = 0, expected 1 to 48
    │ ├ UnknownNameError              "rosee": did you mean "rose"?
    │ └ MachineProfileError           the profile of a machine where a recipe was expected
    ├ GeometryError (ValueError)      a shape that cannot be built, in geometry's own words
    │ ├ TornRingError                 a map would tear a ring at a branch cut or a pole
    │ └ TooLargeError                 the work would not fit: says how large it would be
    ├ SeamError                       opposite edges of a tile would not meet
    ├ LibraryError                    a library that cannot be opened, read or changed as asked
    └ ExportError
      ├ UnsupportedByFormatError      the format cannot hold what was asked
      └ MissingLibraryError           the format needs what this system lacks

Faces (the command, the notebook) catch ``BatikError`` and nothing else: any other exception is a
defect of this program and shows its traceback.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import takewhile

from batik_vector.values import frozen


class BatikError(Exception):
    """Base of every error this package raises on purpose."""

    exit_code = 2


@frozen
class Fault:
    """One thing wrong with a recipe: where it stands, what it says and what was expected."""

    message: str
    key: str = ""
    source: str = ""
    line: int | None = None

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.source, self.line) if part not in ("", None))
        return ": ".join(part for part in (place, self.key, self.message) if part)


class RecipeError(BatikError, ValueError):
    """A recipe that cannot be compiled; ``faults`` lists everything found wrong in one go."""

    def __init__(self, faults: str | Sequence[Fault]) -> None:
        self.faults: tuple[Fault, ...] = (Fault(faults),) if isinstance(faults, str) else tuple(faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))


class UnknownNameError(RecipeError):
    """A name that no catalogue knows; the message offers the nearest one that is known."""

    def __init__(self, name: str, known: Sequence[str], what: str = "name") -> None:
        super().__init__(unknown_name(name, known, what))


class MachineProfileError(RecipeError):
    """The profile of a machine where a recipe was expected: both are pages of TOML."""


class GeometryError(BatikError, ValueError):
    """A shape, a map or another value that cannot be built from what is given."""


class TornRingError(GeometryError):
    """A map that would tear a ring, or send a region to infinity."""


class TooLargeError(GeometryError):
    """Work refused before it is begun, because its estimate is past the limit."""


class SeamError(BatikError):
    """Opposite edges of a tile that would not meet."""

    exit_code = 1


class LibraryError(BatikError):
    """A library of patterns that cannot be opened, read or changed as asked."""


class ExportError(BatikError):
    """A file that could not be written."""


class UnsupportedByFormatError(ExportError):
    """Something the chosen format cannot hold."""


class MissingLibraryError(ExportError):
    """A format that needs a library which this system lacks; says how to install it."""


def unknown_name(name: str, known: Sequence[str], what: str = "name") -> str:
    """Return ``unknown WHAT "NAME"`` with the nearest known name, or all of them when none is near."""
    near = nearest(name, known)
    if near is not None:
        return f'unknown {what} "{shortened(name)}": did you mean "{shortened(near)}"?'
    return f'unknown {what} "{shortened(name)}": expected one of {", ".join(map(shortened, sorted(known)))}'


LONGEST = 80
"""Characters of a text that a message echoes: those of the longest name."""


def shortened(text: str) -> str:
    """Return as much of a text as a message has room for."""
    return text if len(text) <= LONGEST else text[:60] + "…"


def nearest(name: str, known: Sequence[str]) -> str | None:
    """Return the known name most like another, or None where none is like it.

    Of equally near ones the one of the same letters wins: who writes dfx has swapped those of dxf.
    """
    from difflib import SequenceMatcher, get_close_matches

    small = name.lower()
    likely = get_close_matches(small, [each.lower() for each in known], n=5, cutoff=0.55)

    def likeness(each: str) -> tuple[float, bool, int]:
        ratio = SequenceMatcher(None, each, small).ratio()
        return (
            ratio,
            sorted(each) == sorted(small),
            sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(each, small, strict=False))),
        )

    best = max(likely, key=likeness, default=None)
    return next((each for each in known if each.lower() == best), None)


@contextmanager
def blame(key: str) -> Iterator[None]:
    """Name the recipe key on whose behalf the work inside is done, in any geometry error it raises."""
    try:
        yield
    except RecipeError as error:
        raise RecipeError(
            [Fault(f.message, ".".join(filter(None, (key, f.key))), f.source, f.line) for f in error.faults]
        ) from error
    except GeometryError as error:
        raise RecipeError([Fault(str(error), key)]) from error
