"""Many pages drawn by one program in one call: starting a program costs more than drawing a small page."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

from PIL import Image

from tests.clients import programs
from tests.clients.pictures import load, reference


@dataclass(frozen=True)
class Page:
    """An SVG of so many mm, to be drawn at a resolution."""

    svg: bytes
    width: float
    height: float
    dpi: float

    @property
    def pixels(self) -> tuple[int, int]:
        """Whole pixels that hold the page."""
        return math.ceil(self.width * self.dpi / 25.4), math.ceil(self.height * self.dpi / 25.4)


Renderer = Callable[[Sequence[Page], Path], list[Image.Image]]
"""Draws pages on white, with the help of an empty folder."""


def cairosvg(pages: Sequence[Page], _: Path) -> list[Image.Image]:
    """Return what cairosvg draws."""
    return [reference(page.svg, page.dpi / 25.4) for page in pages]


def resvg(pages: Sequence[Page], _: Path) -> list[Image.Image]:
    """Return what resvg draws."""
    from resvg_py import svg_to_bytes

    return [
        load(svg_to_bytes(svg_string=page.svg.decode(), dpi=page.dpi, skip_system_fonts=True))
        for page in pages
    ]


def inkscape(pages: Sequence[Page], folder: Path) -> list[Image.Image]:
    """Return what Inkscape exports; each file is opened once, however many resolutions it is asked at."""
    actions, opened = ["export-area-page"], b""
    for number, page in enumerate(pages):
        if page.svg != opened:
            source, opened = folder / f"{number}.svg", page.svg
            source.write_bytes(page.svg)
            actions += ["file-close"] * (number > 0) + [f"file-open:{source}"]
        actions += [f"export-dpi:{page.dpi:g}", f"export-filename:{folder / f'{number}.png'}", "export-do"]
    programs.run("inkscape", f"--actions={';'.join(actions)}", home=folder)
    return [load(folder / f"{number}.png") for number in range(len(pages))]


def chromium(pages: Sequence[Page], folder: Path) -> list[Image.Image]:
    """Return what a browser shows of the pages, one below the other in one document."""
    tops = [0, *accumulate(page.pixels[1] for page in pages)]
    width = max(page.pixels[0] for page in pages)
    shown = "".join(_in_line(page, top) for page, top in zip(pages, tops, strict=False))
    document = folder / "pages.xhtml"
    document.write_text(
        f'<html xmlns="http://www.w3.org/1999/xhtml"><body style="margin:0">{shown}</body></html>', "utf-8"
    )
    window = load(programs.chromium(document, width, tops[-1]))
    assert window.size == (width, tops[-1])
    return [
        window.crop((0, top, page.pixels[0], top + page.pixels[1]))
        for page, top in zip(pages, tops, strict=False)
    ]


def _in_line(page: Page, top: int) -> str:
    """Return an SVG as an element of a document in which a CSS pixel is a pixel."""
    size = f"width:{page.width * page.dpi / 25.4}px;height:{page.height * page.dpi / 25.4}px"
    svg = re.sub(r"^<\?xml.*?\?>\s*", "", page.svg.decode())
    return svg.replace("<svg ", f'<svg style="position:absolute;left:0;top:{top}px;{size}" ', 1)


IN_PYTHON: dict[str, Renderer] = {"cairosvg": cairosvg, "resvg": resvg}
PROGRAMS: dict[str, Renderer] = {"inkscape": inkscape, "chromium": chromium}
