"""The catalogue of palettes, read from the page of TOML beside this file when it is first asked for.

Names such as *kelengan* say which baths a cloth has seen: indigo alone, *bangbangan* red alone, *bang biru*
red and blue, *tiga negeri* ("three lands") red, blue and soga brown; others are called after a place.
"""

from __future__ import annotations

import functools
import tomllib
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path

from batik_vector.values import frozen

_PAGE = Path(__file__).with_name("palettes.toml")


@frozen
class Palette:
    """Colours that go together, the lightest first.

    ``words`` has a word for each of the ``colours`` (``#rrggbb``). ``baths`` are the dyes in the order of
    dyeing, each with the colour that it alone gives; palettes that are no dyer's have none. ``home`` is
    "tradition" or "market".
    """

    name: str
    title: str
    home: str
    words: tuple[str, ...]
    colours: tuple[str, ...]
    source: str
    baths: tuple[tuple[str, str], ...] = ()


class _Catalogue(Mapping[str, Palette]):
    """The palettes by name; recipes without one do not wait for them."""

    @functools.cached_property
    def _known(self) -> dict[str, Palette]:
        with open(_PAGE, "rb") as file:
            tables = tomllib.load(file)
        return {
            name: Palette(
                name,
                table["title"],
                table["home"],
                tuple(table["colours"]),
                tuple(table["colours"].values()),
                table["source"],
                tuple(table.get("baths", {}).items()),
            )
            for name, table in tables.items()
        }

    def __getitem__(self, name: str) -> Palette:
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._known)

    def __len__(self) -> int:
        return len(self._known)


PALETTES: Mapping[str, Palette] = _Catalogue()
"""Those that come with the program."""


def lightness(colour: str) -> float:
    """Return the relative luminance of a colour ``#rrggbb``. WCAG 2.1."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def spread(colours: Collection[str], palette: Palette) -> dict[str, str]:
    """Return which colour of a palette each of some colours becomes.

    What is light stays light: they take those of the palette in the order of their lightness, spread over its
    whole range; equal colours stay equal.
    """
    ranked = sorted(set(colours), key=lambda colour: (-lightness(colour), colour))
    last = max(len(ranked) - 1, 1)
    return {
        colour: palette.colours[round(place * (len(palette.colours) - 1) / last)]
        for place, colour in enumerate(ranked)
    }
