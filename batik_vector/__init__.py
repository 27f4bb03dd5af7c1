"""batik_vector: a vector pattern compiler for textile production.

    from batik_vector import load_recipe, compile_recipe, write_artwork

    artwork = compile_recipe(load_recipe("kawung.toml"))
    write_artwork(artwork, "kawung.svg")

Names are imported when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from batik_vector._version import __version__

if TYPE_CHECKING:
    from batik_vector.analysis import Analysis as Analysis
    from batik_vector.analysis import analyse as analyse
    from batik_vector.artwork import Artwork as Artwork
    from batik_vector.artwork import Cell as Cell
    from batik_vector.artwork import Ink as Ink
    from batik_vector.artwork import Layer as Layer
    from batik_vector.artwork import violations as violations
    from batik_vector.certificate import Certificate as Certificate
    from batik_vector.certificate import certify as certify
    from batik_vector.compiling.compiler import compile_cloth as compile_cloth
    from batik_vector.compiling.compiler import compile_recipe as compile_recipe
    from batik_vector.errors import BatikError as BatikError
    from batik_vector.errors import ExportError as ExportError
    from batik_vector.errors import Fault as Fault
    from batik_vector.errors import GeometryError as GeometryError
    from batik_vector.errors import LibraryError as LibraryError
    from batik_vector.errors import MachineProfileError as MachineProfileError
    from batik_vector.errors import MissingLibraryError as MissingLibraryError
    from batik_vector.errors import RecipeError as RecipeError
    from batik_vector.errors import SeamError as SeamError
    from batik_vector.errors import TooLargeError as TooLargeError
    from batik_vector.errors import TornRingError as TornRingError
    from batik_vector.errors import UnknownNameError as UnknownNameError
    from batik_vector.errors import UnsupportedByFormatError as UnsupportedByFormatError
    from batik_vector.export import PngOptions as PngOptions
    from batik_vector.export import Profile as Profile
    from batik_vector.export import SvgOptions as SvgOptions
    from batik_vector.export import render as render
    from batik_vector.export import write_all_whole as write_all_whole
    from batik_vector.export import write_artwork as write_artwork
    from batik_vector.making.sweeping import Variation as Variation
    from batik_vector.making.sweeping import sweep as sweep
    from batik_vector.recipe.border import BorderSpec as BorderSpec
    from batik_vector.recipe.border import RailSpec as RailSpec
    from batik_vector.recipe.loading import load_recipe as load_recipe
    from batik_vector.recipe.loading import read_recipe as read_recipe
    from batik_vector.recipe.model import ClothSpec as ClothSpec
    from batik_vector.recipe.model import InkSpec as InkSpec
    from batik_vector.recipe.model import Placement as Placement
    from batik_vector.recipe.model import Recipe as Recipe
    from batik_vector.recipe.model import TileSpec as TileSpec
    from batik_vector.recipe.model import YardageSpec as YardageSpec
    from batik_vector.recipe.motif import Element as Element
    from batik_vector.recipe.motif import Flower as Flower
    from batik_vector.recipe.motif import Rosette as Rosette

_HOMES = {
    "batik_vector.analysis": ("Analysis", "analyse"),
    "batik_vector.artwork": ("Artwork", "Cell", "Ink", "Layer", "violations"),
    "batik_vector.recipe.border": ("BorderSpec", "RailSpec"),
    "batik_vector.certificate": ("Certificate", "certify"),
    "batik_vector.compiling.compiler": ("compile_cloth", "compile_recipe"),
    "batik_vector.errors": (
        "BatikError",
        "ExportError",
        "Fault",
        "GeometryError",
        "LibraryError",
        "MachineProfileError",
        "MissingLibraryError",
        "RecipeError",
        "SeamError",
        "TooLargeError",
        "TornRingError",
        "UnknownNameError",
        "UnsupportedByFormatError",
    ),
    "batik_vector.export": (
        "PngOptions",
        "Profile",
        "SvgOptions",
        "render",
        "write_all_whole",
        "write_artwork",
    ),
    "batik_vector.making.sweeping": ("Variation", "sweep"),
    "batik_vector.recipe.model": ("ClothSpec", "InkSpec", "Placement", "Recipe", "TileSpec", "YardageSpec"),
    "batik_vector.recipe.motif": ("Element", "Flower", "Rosette"),
    "batik_vector.recipe.loading": ("load_recipe", "read_recipe"),
}
_HOME = {name: home for home, names in _HOMES.items() for name in names}

__all__ = ["__version__", *_HOME]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_HOME[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME})
