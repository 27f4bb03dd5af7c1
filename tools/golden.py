"""Draws the pictures of samples and starters, the gallery and the table of ways, or tells what is stale.

    python -m tools.golden            draw what is out of date
    python -m tools.golden --check    only tell, and exit 1 where something is

A picture shows several repeats, so that one sees the pattern and not the tile. Pictures count as the
same where no small patch of one differs from the other's to the eye: cairo and Pillow change an edge's
grey from version to version.
"""

from __future__ import annotations

import ast
import io
import math
import re
import runpy
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from PIL import Image, ImageChops

from batik_vector import Artwork, Recipe, compile_cloth, compile_recipe, load_recipe
from batik_vector.artwork import Page
from batik_vector.export import PngOptions, render
from batik_vector.library import included
from batik_vector.library.measuring import measured
from batik_vector.making.pages import Latest, done_to_tile, prepared
from batik_vector.recipe.outputs import OutputSpec, PngOutput
from batik_vector.tiling.cloth.field import repeated
from batik_vector.tiling.cloth.yardage import Yardage
from batik_vector.units import STEPS_PER_MM, format_mm
from tools import thumbnails, travel
from tools.starters_sheet import SHEET, sheet

SAMPLES = Path(__file__).resolve().parents[1] / "samples"
GALLERY, FIGURES, DRAWINGS = "README.md", "FIGURES.md", "DRAWINGS.md"
"""Pages of designs, of figures and of machines' ways: the last two prove, they do not please."""
WIDTH, HEIGHT = 900, 720
"""Pixels of a picture at most."""
SHAPE = 3 / 2
"""Breadth to height that a picture comes as close to as whole repeats allow."""
MOST_REPEATS = 3
FINER = 2
"""Drawn so much larger first: cairo's edges are coarse."""
MOST_BYTES = 150_000
PATCH = 6
"""Pixels in the side of a patch by which pictures are compared."""
VISIBLE = 20
"""Levels of 255 by which a patch must differ to be called another."""


@dataclass(frozen=True)
class Sample:
    """A recipe of the samples' folder, in TOML or in Python."""

    path: Path
    recipe: Recipe
    page: Artwork | Yardage

    @property
    def picture_path(self) -> Path:
        """Where its picture is kept."""
        return self.path.with_suffix(".png")

    @property
    def stands_on(self) -> str:
        """Return the page that shows it: a picture of a tool's ways is no cloth."""
        if section(self.path) in PROOFS:
            return FIGURES
        ways = (each.travel for each in self.recipe.output if isinstance(each, PngOutput))
        return DRAWINGS if any(ways) else GALLERY

    def picture(self) -> bytes:
        """Return its picture as a PNG file."""
        page: Page = self.page
        if isinstance(page, Artwork):
            own = next((each for each in self.recipe.output if isinstance(each, PngOutput)), None)
            left: OutputSpec | None = own
            if own is not None:
                made, left, _ = done_to_tile(page, page, own, Latest(), lambda tile: tile)
                assert isinstance(made, Artwork)
                page = made
            page = repeated(page, *own.repeat if own else repeats(page.cell.width / page.cell.height))
            if left is not None:
                page = prepared(page, left)[0]
        around = page.margins
        width = page.cell.width + (around.left + around.right) / STEPS_PER_MM
        height = page.cell.height + (around.bottom + around.top) / STEPS_PER_MM
        per_mm = min(WIDTH / width, HEIGHT / height)
        drawn = Image.open(io.BytesIO(render(page, "png", PngOptions(dpi=FINER * per_mm * 25.4))))
        size = (min(WIDTH, round(width * per_mm)), min(HEIGHT, round(height * per_mm)))
        small = drawn.convert("RGB").resize(size, Image.Resampling.BOX)
        return next(data for data in _packed(small) if len(data) <= MOST_BYTES)

    def caption(self) -> str:
        """Return its section of the gallery."""
        recipe = self.recipe
        inks = ", ".join(f"{plate.ink.name} {plate.ink.colour}" for plate in self.page.plates)
        facts = f"{self._size()}; {inks} on {recipe.cloth.colour}"
        name, story = self.path.stem, self.path.read_text(encoding="utf-8")
        told = ast.get_docstring(ast.parse(story)) if self.path.suffix == ".py" else None
        return "\n\n".join(
            [
                f"### {recipe.title}",
                f"![{recipe.title}]({name}.png)",
                *(
                    words
                    for words in (paragraphs(told) if told else leading_comment(story))
                    if words != recipe.title
                ),
                f"[{self.path.name}]({self.path.name}): {facts}.",
            ]
        )

    def _size(self) -> str:
        if self.recipe.tile is None or isinstance(self.page, Yardage):
            return f"{format_mm(self.page.cell.width)} × {format_mm(self.page.cell.height)} mm of cloth"
        size = " × ".join(format_mm(side) for side in self.recipe.tile.size)
        return f"{size} mm, {self.recipe.tile.repeat}"


SECTIONS = {
    "": "Designs",
    "own": "Drawings of one's own",
    "ground": "Grounds that flow behind motifs",
    "toss": "Tossed",
    "lsystem": "Grown by L-systems",
    "group": "The seventeen wallpaper groups",
    "border": "Borders and cloths: the seven friezes",
    "machine": "For machines: a recipe and all its files",
    "figure": "The paper's figures",
    "fractal": "Fractals, automata and other generators",
}
"""What the first word of a sample's name says of it, in the order of the gallery."""
PROOFS = ("figure", "fractal")
"""Sections of figures: they show mathematics, and no buyer is asked to judge them as cloth."""


def section(path: Path) -> str:
    """Return the section of the gallery that a sample stands in."""
    word = path.stem.split("-")[0]
    return word if word in SECTIONS else ""


def samples() -> list[Path]:
    """Return the recipes of the samples' folder, section by section."""
    order = list(SECTIONS)
    found = [*SAMPLES.glob("*.toml"), *SAMPLES.glob("*.py")]
    return sorted(found, key=lambda path: (order.index(section(path)), path.stem))


def recipe_of(path: Path) -> Recipe:
    """Return the recipe of a sample: a page of TOML, or what a page of Python calls ``recipe``."""
    if path.suffix != ".py":
        return load_recipe(path)
    recipe = runpy.run_path(str(path))["recipe"]
    assert isinstance(recipe, Recipe)
    return recipe


def sample(path: Path) -> Sample:
    """Compile one of them."""
    recipe = recipe_of(path)
    return Sample(path, recipe, compile_cloth(recipe) if recipe.yardage else compile_recipe(recipe))


def repeats(shape: float) -> tuple[int, int]:
    """Return how many tiles across and up, at least two, make a picture of a pleasant shape."""
    counts = range(1, MOST_REPEATS + 1)
    choices = [(across, up) for across in counts for up in counts if across * up > 1]
    return min(choices, key=lambda n: (abs(math.log(shape * n[0] / n[1] / SHAPE)), n))


def leading_comment(text: str) -> list[str]:
    """Return the paragraphs of the comment with which a recipe begins."""
    lines = []
    for line in text.splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.removeprefix("#").strip())
    return paragraphs("\n".join(lines))


def paragraphs(text: str) -> list[str]:
    """Return the paragraphs of a text, each on one line."""
    return [" ".join(part.split("\n")) for part in re.split(r"\n{2,}", text.strip()) if part]


def gallery(found: list[Sample]) -> str:
    """Return the page that shows the designs."""
    parts = [
        "# Samples\n\nEach picture shows several repeats of the tile. `make golden` draws them and writes "
        f"this page.\nThe figures of the paper and of fractals have [a page of their own]({FIGURES}), "
        f"and so have [working drawings]({DRAWINGS}), which show the ways of a tool."
    ]
    for word, title in SECTIONS.items():
        mine = [each for each in found if section(each.path) == word and each.stands_on == GALLERY]
        parts += [f"## {title}", *(each.caption() for each in mine)] if mine else []
    return "\n\n".join(parts) + "\n"


def figures(found: list[Sample]) -> str:
    """Return the page of the figures."""
    parts = [
        "# Figures\n\nWhat shows the mathematics and is not meant for cloth: the figures of Tian et al. "
        "2019, one repeat\neach, and what fractals, automata and grammars draw. "
        f"[The designs]({GALLERY}) are made of the same curves."
    ]
    for word in PROOFS:
        mine = [each.caption() for each in found if section(each.path) == word]
        parts += [f"## {SECTIONS[word]}", *mine]
    return "\n\n".join(parts) + "\n"


def drawings(found: list[Sample]) -> str:
    """Return the page of the ways that tools go."""
    head = (
        "# Working drawings\n\nWhat a pen, a knife, a laser or a spout of wax is led along: recipes with all "
        "the files that a machine takes.\nRed hairs are ways with the tool up. "
        f"[The designs]({GALLERY}) are made alike."
    )
    return "\n\n".join([head, *(each.caption() for each in found if each.stands_on == DRAWINGS)]) + "\n"


def same(one: bytes, other: bytes) -> bool:
    """Return whether two pictures look the same."""
    a, b = (Image.open(io.BytesIO(data)).convert("RGB") for data in (one, other))
    if a.size != b.size:
        return False
    apart = ImageChops.difference(*(each.reduce(PATCH) for each in (a, b)))
    return max(high for _, high in apart.getextrema()) < VISIBLE  # type: ignore[misc]


def stale(each: Sample) -> bool:
    """Return whether a sample's picture is missing or shows something else."""
    kept = each.picture_path
    return not kept.exists() or not same(kept.read_bytes(), each.picture())


def sheet_is_stale() -> bool:
    """Return whether the sheet of the starters is missing or shows something else."""
    return not SHEET.exists() or not same(SHEET.read_bytes(), sheet())


def included_line(name: str, path: Path, page: Artwork | Yardage | None = None) -> str:
    """Return what is measured of a sample or starter, for the library to find it by."""
    recipe, tile = load_recipe(path), page if isinstance(page, Artwork) else None
    return included.written({name: (recipe, dict(measured(recipe, tile, pictures=False).features))})


def included_page(found: list[Sample]) -> str:
    """Return what is measured of samples and starters."""
    pages = {each.path: each.page for each in found}
    return "".join(included_line(name, path, pages.get(path)) for name, path in included.paths())


def travel_page(found: list[Sample]) -> str:
    """Return the page that tells how far a pen travels for each sample."""
    return travel.written((each.path.stem, each.page) for each in found)


def pages(found: list[Sample]) -> dict[Path, str]:
    """Return all texts that are written from the samples."""
    return {
        SAMPLES / GALLERY: gallery(found),
        SAMPLES / FIGURES: figures(found),
        SAMPLES / DRAWINGS: drawings(found),
        included.MEASURED: included_page(found),
        travel.PAGE: travel_page(found),
    }


def entries(each: Sample) -> dict[Path, str]:
    """Return what one sample gives to the texts that are written from all."""
    told = {SAMPLES / each.stands_on: each.caption(), travel.PAGE: travel.row(each.path.stem, each.page)}
    if each.path.suffix == ".toml":
        told[included.MEASURED] = included_line(f"sample/{each.path.stem}", each.path, each.page)
    return told


def _packed(picture: Image.Image) -> Iterator[bytes]:
    """Yield the picture as PNG files, the next always smaller than the last."""
    for colours in (128, 64, 32, 16, 8):
        out = io.BytesIO()
        few = picture.quantize(colours, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        few.save(out, "PNG", optimize=True)
        yield out.getvalue()
    while True:
        picture = picture.reduce(2)
        out = io.BytesIO()
        picture.quantize(8).save(out, "PNG", optimize=True)
        yield out.getvalue()


def main() -> int:
    """Draw or check, and return the exit code."""
    only_check = "--check" in sys.argv[1:]
    found, wrong = [], 0
    for path in samples():
        each = sample(path)
        found.append(each)
        old = stale(each)
        wrong += old
        if old and not only_check:
            each.picture_path.write_bytes(each.picture())
        told = ("stale" if only_check else "drawn") if old else "as it was"
        print(f"{each.picture_path.name:<32} {told}", flush=True)
    if sheet_is_stale():
        wrong += 1
        print(f"{SHEET.name:<32} {'stale' if only_check else 'drawn'}")
        if not only_check:
            SHEET.write_bytes(sheet())
    for path, text in pages(found).items():
        if path.exists() and path.read_text(encoding="utf-8") == text:
            continue
        wrong += 1
        print(f"{path.name:<32} {'stale' if only_check else 'written'}")
        if not only_check:
            path.write_text(text, encoding="utf-8")
    tiles = {each.path: each.page for each in found if isinstance(each.page, Artwork)}
    wrong += thumbnails.drawn_anew(tiles, only_check=only_check)
    for kept in sorted({*SAMPLES.glob("*.png")} - {each.picture_path for each in found}):
        wrong += 1
        print(f"{kept.name:<32} belongs to no recipe")
    return 1 if only_check and wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
