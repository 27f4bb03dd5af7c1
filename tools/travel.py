"""Measures how far a pen travels lifted for each sample, before and after ordering, for docs/plotting.md.

    python -m tools.travel            write the table anew

``make golden`` does it too, with the samples that it has compiled anyway.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain
from pathlib import Path

from batik_vector import Artwork
from batik_vector.artwork.page import Page
from batik_vector.geometry.outlines import Outlines, together
from batik_vector.processes.order import contours, ordered, travel
from batik_vector.tiling.cloth.yardage import Yardage

PAGE = Path(__file__).resolve().parents[1] / "docs" / "plotting.md"
MARK = "<!-- travel: written by `make golden`, not by hand -->\n"
HEAD = "| sample | strokes | as drawn, m | in order, m | of it |\n| --- | --: | --: | --: | --: |\n"
MM_PER_M = 1000


def row(name: str, page: Artwork | Yardage) -> str:
    """Return a sample's row of the table: strokes, and the ways between those of one ink."""
    strokes, before, after = 0, 0.0, 0.0
    for number in range(len(page.plates)):
        given = together(list(contours(_marks(page, number))))
        strokes += len(given)
        before += travel(given)
        after += travel(together(list(ordered(contours(_marks(page, number)), join=True))))
    share = f"{after / before:.0%}" if before else ""
    return f"| {name} | {strokes:,} | {before / MM_PER_M:.2f} | {after / MM_PER_M:.2f} | {share} |\n"


def _marks(page: Page, number: int) -> Iterable[Outlines]:
    return chain(page.areas(number), page.lines(number))


def written(pages: Iterable[tuple[str, Artwork | Yardage]]) -> str:
    """Return the page with the table of these samples."""
    words, _ = PAGE.read_text(encoding="utf-8").split(MARK)
    return words + MARK + "\n" + HEAD + "".join(row(name, page) for name, page in pages)


if __name__ == "__main__":
    from tools.golden import sample, samples

    PAGE.write_text(written((path.stem, sample(path).page) for path in samples()), encoding="utf-8")
