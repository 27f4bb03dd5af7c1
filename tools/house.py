"""The house: which room stands on which floor, measured from the imports.

``python -m tools.house`` writes docs/architecture.md and its drawing, ``--check`` tells whether they are
stale. The floors stand here, once; the tests hold the package to them.
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

import svgwrite

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "batik_vector"
PAGE, PICTURE = ROOT / "docs" / "architecture.md", ROOT / "docs" / "architecture.svg"
PROSE = ROOT / "tools" / "architecture.md"
"""What the page says before it lists the rooms."""

Floors: TypeAlias = tuple[tuple[str, ...], ...]


def _floors(*rooms: str) -> Floors:
    return tuple(tuple(each.split()) for each in rooms)


FLOORS: Floors = _floors(
    "_version values patterns",
    "errors units",
    "fields",
    "geometry machines",
    "artwork",
    "processes",
    "tiling export",
    "importing",
    "recipe certificate",
    "compiling drafting analysis audit",
    "making",
    "__init__",
    "library",
    "studio",
    "command notebook",
    "__main__",
)
"""Rooms of the package, the ground floor first: each may look at those below it, and at nothing else. So
rooms on one floor never meet: tiling and export, geometry and artwork."""

STRANGERS = ("library",)
"""Rooms that see the public names alone, ``__init__``'s, as a stranger's program would."""

WINGS: dict[str, Floors] = {
    "tiling": _floors("layouts", "torus", "welding tossing", "symmetry cloth borders"),
    "geometry": _floors(
        "sampling outlines edge_snap lettering",
        "known work paths arc_fitting congruence nearness",
        "regions nesting",
        "lsystems",
        "generators",
        "ragged curves stretches inside nets",
        "arrangement",
        "bezier continuations maps",
        "coincidence fills",
        "ifs",
    ),
}
"""The rooms within a room, likewise."""

DOORBELLS = (
    ("batik_vector.artwork.page", "batik_vector.export.svg"),
    ("batik_vector.recipe.model", "batik_vector.compiling.compiler"),
)
"""The imports that run upward, inside a function: a notebook asks artworks and recipes for pictures."""


def modules() -> list[Path]:
    """Return the files of the package."""
    return sorted(PACKAGE.rglob("*.py"))


def name_of(path: Path) -> str:
    """``batik_vector/export/svg.py`` → batik_vector.export.svg; a room's own file has the room's name."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 2 else parts)


def room_of(module: str, wing: str = "") -> str:
    """``batik_vector.export.svg`` → export; the front door of the package, or of a wing, is ``__init__``."""
    parts = module.split(".")[2 if wing else 1 :]
    return parts[0] if parts else "__init__"


def is_module(name: str) -> bool:
    """Whether a dotted name is a file or a folder of ours."""
    path = ROOT.joinpath(*name.split("."))
    return path.with_suffix(".py").exists() or (path / "__init__.py").exists()


def imports(path: Path) -> Iterator[str]:
    """Yield the modules of ours that a file imports, inside functions too.

    Raises:
        ValueError: where an import is relative.
    """
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.startswith("batik_vector"))
        elif isinstance(node, ast.ImportFrom):
            if node.level:
                raise ValueError(f"{path.name} line {node.lineno}: imports are absolute here")
            if node.module and node.module.startswith("batik_vector"):
                for alias in node.names:
                    whole = f"{node.module}.{alias.name}"
                    yield whole if is_module(whole) else node.module


def sentence(path: Path) -> str:
    """Return the first sentence of a file's docstring, or nothing."""
    words = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    first = " ".join(words.partition("\n\n")[0].split())
    first = re.sub(r":\w+:`~?(?:[\w.]+\.)?(\w+)`", r"`\1`", first).replace("``", "`")
    return first if first.endswith(".") else first + "."


def looks(wing: str = "") -> Counter[tuple[str, str]]:
    """Return how often a room imports from another, within the package or within a wing of it."""
    found = Counter[tuple[str, str]]()
    for path in modules():
        module = name_of(path)
        if wing and (room_of(module) != wing or room_of(module, wing) == "__init__"):
            continue
        for other in imports(path):
            if (module, other) in DOORBELLS or (wing and room_of(other) != wing):
                continue
            pair = room_of(module, wing), room_of(other, wing)
            if pair[0] != pair[1] and pair[1] != "__init__":
                found[pair] += 1
    return found


def _nearest(looked: Mapping[tuple[str, str], int]) -> dict[tuple[str, str], int]:
    """Return the looks that no chain of others stands for."""
    below: dict[str, set[str]] = {}
    for above, room in looked:
        below.setdefault(above, set()).add(room)

    def reached(room: str) -> set[str]:
        return set().union(*({each} | reached(each) for each in below.get(room, ())))

    return {
        (above, room): times
        for (above, room), times in looked.items()
        if not any(room in reached(each) for each in below[above] - {room})
    }


# The drawing.
WIDTH, ROW, BOX, HIGH, TOP = 1000, 92, 148, 46, 44
PAPER, LINE, FILL, TEXT = "#fbf7ec", "#7d8db8", "#1d2f5f", "#f4efe2"


class _Panel:
    """One house or wing: floors as rows, rooms as boxes, imports as arrows."""

    def __init__(self, drawing: svgwrite.Drawing, floors: Floors, top: int, title: str) -> None:
        self.drawing, self.floors, self.top = drawing, floors, top
        label = drawing.text(title, insert=(30, top + 24), fill=FILL, font_size=18, font_weight="bold")
        drawing.add(label)
        self.places: dict[str, tuple[float, float]] = {}
        for height, rooms in enumerate(reversed(floors)):
            for number, room in enumerate(rooms):
                x = WIDTH * (number + 1) / (len(rooms) + 1)
                self.places[room] = x, top + TOP + ROW * height + HIGH / 2

    @property
    def bottom(self) -> int:
        return self.top + TOP + ROW * len(self.floors)

    def draw(self, looked: Mapping[tuple[str, str], int], files: Mapping[str, int]) -> None:
        for (above, below), times in sorted(_nearest(looked).items()):
            if above in self.places and below in self.places:
                self._arrow(self.places[above], self.places[below], times)
        for room, (x, y) in self.places.items():
            corner = (x - BOX / 2, y - HIGH / 2)
            self.drawing.add(self.drawing.rect(corner, (BOX, HIGH), rx=6, fill=FILL))
            words = f"{files[room]} files" if files.get(room, 1) > 1 else "1 file"
            for text, dy, size in ((room, -3, 16), (words, 15, 11)):
                self.drawing.add(
                    self.drawing.text(text, (x, y + dy), fill=TEXT, font_size=size, text_anchor="middle")
                )

    def _arrow(self, begin: tuple[float, float], end: tuple[float, float], times: int) -> None:
        (x1, y1), (x2, y2) = begin, end
        y1, y2 = y1 + HIGH / 2, y2 - HIGH / 2
        # Past whole floors an arrow swings out, so that it runs behind no box it does not mean.
        swing = 0.0 if y2 - y1 < ROW else (90 if x1 + x2 >= WIDTH else -90)
        bend = (y2 - y1) / 2
        first, second = f"{x1 + swing:.1f} {y1 + bend:.1f}", f"{x2 + swing:.1f} {y2 - bend:.1f}"
        path = f"M{x1:.1f} {y1:.1f}C{first} {second} {x2:.1f} {y2:.1f}"
        width = min(1 + times**0.5 / 2, 5)
        self.drawing.add(
            self.drawing.path(path, fill="none", stroke=LINE, stroke_width=f"{width:.2f}", opacity=0.75)
        )
        self.drawing.add(self.drawing.circle((x2, f"{y2 - 1:.1f}"), r=3.5, fill=LINE))


def picture() -> str:
    """Return the drawing of the house and its two wings, as SVG."""
    house = tuple(tuple(room for room in floor if room != "__main__") for floor in FLOORS[3:])
    panels = (("The house", "", house), *((f"Inside {wing}", wing, WINGS[wing]) for wing in WINGS))
    height = sum(TOP + ROW * len(floors) + 20 for _, _, floors in panels)
    drawing = svgwrite.Drawing(
        size=(WIDTH, height), viewBox=f"0 0 {WIDTH} {height}", font_family="sans-serif"
    )
    drawing.add(drawing.rect((0, 0), (WIDTH, height), fill=PAPER))
    top = 0
    for title, wing, floors in panels:
        of_wing = [name_of(path) for path in modules() if not wing or room_of(name_of(path)) == wing]
        files = Counter(room_of(name, wing) for name in of_wing)
        panel = _Panel(drawing, floors, top, title)
        panel.draw(looks(wing), files)
        top = panel.bottom + 20
    return f"{drawing.tostring()}\n"


def page() -> str:
    """Return the page."""
    ground = ", ".join(f"`{room}`" for floor in FLOORS[:3] for room in floor)
    parts = [PROSE.read_text(encoding="utf-8").format(ground=ground)]
    for height in range(len(FLOORS), 0, -1):
        for room in FLOORS[height - 1]:
            folder = PACKAGE / room
            if folder.is_dir():
                parts.append(
                    f"\n### {height} · `{room}/`\n\n{sentence(folder / '__init__.py')}\n\n{_listed(folder)}"
                )
            else:
                path = folder.with_suffix(".py")
                parts.append(f"\n### {height} · `{room}.py`\n\n{sentence(path)}\n")
    return "".join(parts)


def _listed(folder: Path, depth: int = 0) -> str:
    """Return a line for each file and folder within a folder."""
    lines = []
    for path in sorted(folder.iterdir(), key=lambda path: (path.is_dir(), path.name)):
        if path.is_dir() and (path / "__init__.py").exists():
            lines.append(f"{'  ' * depth}- **`{path.name}/`** {sentence(path / '__init__.py')}\n")
            lines.append(_listed(path, depth + 1))
        elif path.suffix == ".py" and path.name != "__init__.py":
            lines.append(f"{'  ' * depth}- `{path.name}` {sentence(path)}\n")
    return "".join(lines)


def main() -> int:
    """Write the page and its drawing, or tell whether they are stale."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true")
    made = {PAGE: page(), PICTURE: picture()}
    if parser.parse_args().check:
        stale = [path.name for path, text in made.items() if path.read_text(encoding="utf-8") != text]
        print(*(f"{name} is stale: run make docs" for name in stale), sep="\n")
        return 1 if stale else 0
    for path, text in made.items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
