"""Draws the small pictures of samples and starters that the studio's shelf shows at its first start.

    python -m tools.thumbnails            draw what is out of date
    python -m tools.thumbnails --check    only tell, and exit 1 where something is

Each carries the digest of its recipe: what was drawn of another text is drawn anew, and never shown.
`make golden` does the same.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Mapping
from pathlib import Path

from PIL import Image, PngImagePlugin

from batik_vector import Artwork, load_recipe
from batik_vector.library import included
from batik_vector.library.measuring import measured

COLOURS = 24
"""Few inks, and the edges between them."""


def picture(path: Path, tile: Artwork | None = None) -> bytes:
    """Return the small picture of a recipe, as a PNG that says of what it is."""
    drawn = Image.open(io.BytesIO(measured(load_recipe(path), tile).png)).convert("RGB")
    about = PngImagePlugin.PngInfo()
    about.add_text(included.DIGEST, included.digest(path))
    out = io.BytesIO()
    few = drawn.quantize(COLOURS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    few.save(out, "PNG", optimize=True, pnginfo=about)
    return out.getvalue()


def drawn_anew(tiles: Mapping[Path, Artwork], *, only_check: bool) -> int:
    """Draw what is out of date, or tell of it; return how many were.

    Args:
        tiles: those that have been compiled already, by the files of their recipes.
        only_check: whether nothing is drawn.
    """
    wrong, wanted = 0, set()
    for name, path in included.paths():
        kept = included.thumbnail_path(name)
        wanted.add(kept)
        if included.thumbnail(name):
            continue
        wrong += 1
        print(f"{name:<32} {'stale' if only_check else 'drawn small'}", flush=True)
        if not only_check:
            kept.parent.mkdir(parents=True, exist_ok=True)
            kept.write_bytes(picture(path, tiles.get(path)))
    for kept in sorted({*included.THUMBNAILS.rglob("*.png")} - wanted):
        wrong += 1
        print(f"{kept.name:<32} {'belongs to no recipe' if only_check else 'removed'}")
        if not only_check:
            kept.unlink()
    return wrong


if __name__ == "__main__":
    check = "--check" in sys.argv[1:]
    raise SystemExit(1 if drawn_anew({}, only_check=check) and check else 0)
