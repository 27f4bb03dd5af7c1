"""Draws the pictures and the gallery of the samples, or tells which of them are out of date.

    python tools/golden.py            draw what is out of date
    python tools/golden.py --check    only tell, and exit 1 where something is

A picture shows several repeats, so that one sees the pattern and not the tile. Pictures count as the
same where no small patch of one differs from the other's to the eye: cairo and Pillow change an edge's
grey from version to version.
"""

from __future__ import annotations

import io
import math
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from PIL import Image, ImageChops

from batik_vector import Artwork, Recipe, compile_recipe, load_recipe
from batik_vector.export import PngOptions, render
from batik_vector.outputs import PngOutput
from batik_vector.tiling.field import repeated
from batik_vector.units import format_mm

SAMPLES = Path(__file__).resolve().parents[1] / "samples"
GALLERY = "README.md"
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
    """A recipe of the samples' folder."""

    path: Path
    recipe: Recipe
    artwork: Artwork

    @property
    def picture_path(self) -> Path:
        """Where its picture is kept."""
        return self.path.with_suffix(".png")

    def picture(self) -> bytes:
        """Return its picture as a PNG file."""
        own = next((each.repeat for each in self.recipe.output if isinstance(each, PngOutput)), None)
        field = repeated(self.artwork, *own or repeats(self.artwork.cell.width / self.artwork.cell.height))
        width, height = field.cell.width, field.cell.height
        per_mm = min(WIDTH / width, HEIGHT / height)
        drawn = Image.open(io.BytesIO(render(field, "png", PngOptions(dpi=FINER * per_mm * 25.4))))
        size = (min(WIDTH, round(width * per_mm)), min(HEIGHT, round(height * per_mm)))
        small = drawn.convert("RGB").resize(size, Image.Resampling.BOX)
        return next(data for data in _packed(small) if len(data) <= MOST_BYTES)

    def caption(self) -> str:
        """Return its section of the gallery."""
        recipe = self.recipe
        size = " × ".join(format_mm(side) for side in recipe.tile.size)
        inks = ", ".join(f"{ink.ink.name} {ink.ink.colour}" for ink in self.artwork.layers)
        facts = f"{size} mm, {recipe.tile.repeat}; {inks} on {recipe.cloth.colour}"
        name = self.path.stem
        return "\n\n".join(
            [
                f"## {recipe.title}",
                f"![{recipe.title}]({name}.png)",
                *(words for words in leading_comment(recipe.source) if words != recipe.title),
                f"[{name}.toml]({name}.toml): {facts}.",
            ]
        )


def samples() -> list[Path]:
    """Return the recipes of the samples' folder: our own designs, then the paper's figures."""
    return sorted(SAMPLES.glob("*.toml"), key=lambda path: (path.stem.startswith("figure-"), path.stem))


def sample(path: Path) -> Sample:
    """Compile one of them."""
    recipe = load_recipe(path)
    return Sample(path, recipe, compile_recipe(recipe))


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
    return [" ".join(part.split("\n")) for part in re.split(r"\n{2,}", "\n".join(lines).strip()) if part]


def gallery(found: list[Sample]) -> str:
    """Return the page that shows all samples."""
    head = (
        "# Samples\n\nEach picture shows several repeats of the tile, those of the paper's figures one. "
        "`make golden` draws them\nand writes this page."
    )
    return "\n\n".join([head, *(each.caption() for each in found)]) + "\n"


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


def gallery_is_stale(found: list[Sample]) -> bool:
    """Return whether the gallery says something else than the recipes."""
    kept = SAMPLES / GALLERY
    return not kept.exists() or kept.read_text(encoding="utf-8") != gallery(found)


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
    if gallery_is_stale(found):
        wrong += 1
        print(f"{GALLERY:<32} {'stale' if only_check else 'written'}")
        if not only_check:
            (SAMPLES / GALLERY).write_text(gallery(found), encoding="utf-8")
    for kept in sorted({*SAMPLES.glob("*.png")} - {each.picture_path for each in found}):
        wrong += 1
        print(f"{kept.name:<32} belongs to no recipe")
    return 1 if only_check and wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
