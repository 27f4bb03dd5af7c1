"""The library of patterns: one of many is made, and searched in every way.

python -m benchmarks.library COUNT FOLDER     each way of searching so many patterns, timed within the process
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from types import MappingProxyType

from batik_vector import read_recipe
from batik_vector.library import Library
from batik_vector.library.measuring import Measured, measured
from benchmarks.peers.drawn import let_go, tell, timed

FILE = "patterns.library"
"""What the library is called in the folder."""
RECIPE = """# {story}, drawn for the {season}.
title = "{title}"
[motif.flower]
kind = "rosette"
[[motif.flower.elements]]
curve = {{ kind = "rose", n = {petals} }}
[ink.wax]
colour = "{colour}"
[cloth]
colour = "#1d2f5f"
[[place]]
motif = "flower"
width = "{width} mm"
[tile]
size = [{size}, {size}]
repeat = "{repeat}"
"""
FIRST = (
    "Kawung",
    "Truntum",
    "Parang",
    "Ceplok",
    "Sekar",
    "Lasem",
    "Ngayogyakarta",
    "Semèn",
    "Tambal",
    "Udan",
)
SECOND = ("picis", "prabu", "rusak", "kembang", "liris", "garuda", "buketan", "jagad", "wahyu", "sidomukti")
STORIES = ("A round flower", "Dots in rows", "Leaves that turn", "Stars over waves", "A trellis of buds")
SEASONS = ("harvest", "wedding", "new year", "rain", "dry months")
REPEATS = ("grid", "half-drop", "brick", "p4m", "pgg", "p2")


def make(count: int, path: Path) -> None:
    """Make a library: recipes that all differ, with features as such patterns have, and real pictures."""
    chance = random.Random(14)
    picture = Measured()
    with Library(path) as library, library.together():
        for number in range(count):
            first, second = chance.choice(FIRST), chance.choice(SECOND)
            size = chance.randint(40, 400)
            text = RECIPE.format(
                story=chance.choice(STORIES),
                season=chance.choice(SEASONS),
                title=f"{first} {second}",
                petals=chance.randint(2, 12),
                colour=f"#{chance.randrange(0x1000000):06x}",
                width=chance.randint(20, size),
                size=size,
                repeat=chance.choice(REPEATS),
            )
            recipe = read_recipe(text)
            if number % 500 == 0:
                picture = measured(recipe)
            features = {
                **picture.features,
                "width": float(size),
                "height": float(size),
                "inks": chance.randint(1, 5),
                "coverage": round(chance.uniform(5, 80), 2),
                "vertices": chance.randint(500, 90_000),
                "marks": chance.randint(4, 4_000),
                "motifs": chance.randint(1, 8),
                "repeat": recipe.tiling.repeat,
            }
            made = Measured(features, picture.svg, picture.png)
            name = f"{first.lower()}-{second}-{number}"
            library.add(name, recipe, measured=made, tags=chance.sample(SEASONS[:3], 2), origin="generated")


WAYS: Mapping[str, Callable[[Library], object]] = MappingProxyType(
    {
        "list": lambda library: library.entries(),
        "text": lambda library: library.search("yogya kembang"),
        "text of two letters": lambda library: library.search("yo"),
        "text in all": lambda library: library.search("drawn for", limit=50),
        "tag": lambda library: library.search(tags=["harvest"], limit=50),
        "feature": lambda library: library.search(where="inks <= 3, coverage 20..40, repeat = half-drop"),
        "likeness": lambda library: library.search(like="sample/kawung", limit=50),
        "all together": lambda library: library.search(
            "kawung", tags=["wedding"], where="inks = 2", like="sample/kawung", limit=50
        ),
    }
)


def search(count: int, folder: Path) -> None:
    """Time every way of searching when it is asked again; make the library where it is missing."""
    path = folder / FILE
    if not path.exists():
        make(count, path)
    with Library(path, write=False) as library:
        found = {}
        for name, asked in WAYS.items():
            asked(library)
            let_go()
            found[name], _ = timed(partial(asked, library))
        tell(found)


if __name__ == "__main__":
    search(int(sys.argv[1]), Path(sys.argv[2]))
