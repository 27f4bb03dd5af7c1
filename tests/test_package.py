"""The house stands as STYLE says: imports run downward, catalogues are whole, imports are cheap."""

from __future__ import annotations

import ast
import importlib.util
import inspect
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from graphlib import TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

from batik_vector.export import FORMATS
from batik_vector.geometry.curves import CURVES, Curve
from batik_vector.geometry.maps import VARIATIONS, Variation
from batik_vector.motif import MOTIFS
from batik_vector.tiling.layouts import LAYOUTS

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "batik_vector"

FLOORS: tuple[frozenset[str], ...] = tuple(
    frozenset(rooms.split())
    for rooms in (
        "_version values patterns",
        "errors",
        "units",
        "fields references outlines",
        "geometry artwork",
        "motif tiling export",
        "outputs importing certificate",
        "placement",
        "borderspec grounds spreading",
        "model",
        "placing",
        "bordering",
        "reading",
        "compiler recipe",
        "schema starting starters",
        "jobs promises telling",
        "checking",
        "cli",
        "__main__ __init__",
    )
)
"""Rooms of the package, the ground floor first: each may look at those below it, and at nothing else. So
rooms on one floor never meet: tiling and export, geometry and artwork."""

DOORBELLS = {("artwork", "export")}
"""Imports that run upward on purpose, inside a function: a notebook asks an artwork for its picture."""

MODULES = sorted(PACKAGE.rglob("*.py"))


def name_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 2 else parts)


def room_of(module: str) -> str:
    """``batik_vector.export.svg`` → export; the package's own front door is ``__init__``."""
    return module.split(".")[1] if "." in module else "__init__"


def imports(path: Path, everywhere: bool = True) -> Iterator[str]:
    """Yield the modules of ours that a file imports; only at its top unless ``everywhere``."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree) if everywhere else tree.body:
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.startswith("batik_vector"))
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path.name} line {node.lineno}: imports are absolute here"
            if node.module and node.module.startswith("batik_vector"):
                for alias in node.names:
                    whole = f"{node.module}.{alias.name}"
                    yield whole if is_module(whole) else node.module


def is_module(name: str) -> bool:
    path = ROOT.joinpath(*name.split("."))
    return path.with_suffix(".py").exists() or (path / "__init__.py").exists()


def upward(module: str, imported: Iterator[str]) -> list[str]:
    """Return the imports that break the rules."""
    heights = {room: height for height, rooms in enumerate(FLOORS) for room in rooms}
    mine = room_of(module)
    return [
        f"{module} imports {other}"
        for other in imported
        if (room := room_of(other)) != mine
        and heights[room] >= heights[mine]
        and (mine, room) not in DOORBELLS
    ]


def test_every_room_has_a_floor() -> None:
    rooms = {room_of(name_of(path)) for path in MODULES}
    known = frozenset().union(*FLOORS)
    assert rooms <= known, f"give these a floor in {Path(__file__).name}: {sorted(rooms - known)}"


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_run_downward(path: Path) -> None:
    assert not upward(name_of(path), imports(path))


def test_an_upward_import_is_told() -> None:
    assert upward("batik_vector.export.svg", iter(["batik_vector.tiling.seams"]))
    assert upward("batik_vector.geometry.ifs", iter(["batik_vector.artwork"]))
    assert upward("batik_vector.units", iter(["batik_vector.cli"]))
    assert not upward("batik_vector.export.svg", iter(["batik_vector.artwork", "batik_vector.export.walk"]))


def test_no_modules_import_each_other_in_a_circle() -> None:
    graph = {name_of(path): set(imports(path, everywhere=False)) - {name_of(path)} for path in MODULES}
    TopologicalSorter(graph).prepare()


CATALOGUES: dict[str, Mapping[str, type]] = {
    "curve": CURVES,
    "map": VARIATIONS,
    "layout": LAYOUTS,
    "motif": MOTIFS,
}


@pytest.mark.parametrize(
    ("what", "name"), [(what, name) for what, catalogue in CATALOGUES.items() for name in catalogue]
)
def test_everything_in_a_catalogue_says_what_it_is(what: str, name: str) -> None:
    cls = CATALOGUES[what][name]
    words = cls.__dict__.get("__doc__") or ""
    # A dataclass without a docstring is given its signature for one.
    assert words, f"{what} {name} has no docstring"
    assert not words.startswith(f"{cls.__name__}("), f"{what} {name} has no docstring"


@pytest.mark.parametrize("name", FORMATS)
def test_every_format_has_a_module_that_writes_it(name: str) -> None:
    known = FORMATS[name]
    module = import_module(known.module)
    assert known.says
    assert inspect.getdoc(module)
    assert callable(module.render)
    assert known.options.__doc__


def classes(folder: str, kind: type) -> dict[str, set[type]]:
    """Return the classes of a kind that each file of a folder under geometry offers."""
    found = {}
    for path in (PACKAGE / "geometry" / folder).glob("*.py"):
        module = import_module(f"batik_vector.geometry.{folder}.{path.stem}")
        offered = [value for name, value in vars(module).items() if inspect.isclass(value) and name[0] != "_"]
        mine = {cls for cls in offered if cls.__module__ == module.__name__ and issubclass(cls, kind)}
        found[path.name] = mine - {kind}
    return found


def test_no_curve_is_forgotten() -> None:
    for name, curves in classes("curves", Curve).items():
        if name in ("__init__.py", "base.py", "function.py"):
            continue
        assert curves, f"curves/{name} holds no curve"
        assert curves <= set(CURVES.values()), f"a curve of {name} stands in no line of CURVES"


def test_no_map_is_forgotten() -> None:
    for name, maps in classes("maps", Variation).items():
        assert maps <= set(VARIATIONS.values()), f"a map of {name} stands in no line of VARIATIONS"


@pytest.mark.parametrize(
    "statement",
    ["import batik_vector", "import batik_vector.export.options", "import batik_vector.cli"],
)
def test_importing_is_cheap(statement: str) -> None:
    heavy = "('numpy', 'shapely', 'pydantic', 'svgwrite', 'cairosvg', 'ezdxf', 'pikepdf')"
    script = f"import sys; {statement}; print(*[name for name in {heavy} if name in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert done.stdout.split() == []


UNUSED = (
    # The world outside, and what other formats and faulty recipes need.
    "ssl socket http.client urllib.request hashlib secrets tempfile",
    "pydantic annotated_types tomlkit tqdm cairosvg ezdxf pikepdf svgwrite.data.svgparser",
    # Cloths, borders, grounds and reports of a recipe that has none.
    "batik_vector.bordering batik_vector.tiling.yardage batik_vector.tiling.field batik_vector.tiling.bands",
    "batik_vector.tiling.toss batik_vector.tiling.stripes batik_vector.certificate batik_vector.checking",
    "batik_vector.export.pdf batik_vector.export.dxf batik_vector.export.png",
    "batik_vector.reading.slow batik_vector.reading.lines batik_vector.reading.overrides batik_vector.schema",
)


def test_a_tile_is_compiled_to_svg_with_nothing_else_imported(tmp_path: Path) -> None:
    names = " ".join(UNUSED).split()
    call = [
        "batik-vector",
        "compile",
        str(ROOT / "samples" / "four-square.toml"),
        "-o",
        str(tmp_path),
        "-f",
        "svg",
    ]
    script = (
        # What NumPy and shapely bring along is theirs.
        f"import atexit, numpy, shapely, sys; sys.argv = {call}\n"
        f"watched = [name for name in {names} if name not in sys.modules]\n"
        "atexit.register(lambda: print(*[name for name in watched if name in sys.modules]))\n"
        "from batik_vector.cli import main; main()"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert done.stdout.split() == []
    assert (tmp_path / "four-square.svg").exists()
    assert all(importlib.util.find_spec(name.partition(".")[0]) for name in names)
    for name in names:
        assert not name.startswith("batik_vector") or is_module(name), name


PASSED_OVER = {".git", "out", "dist", "__pycache__", "build"}
MACHINE_PATH = re.compile(r"(?<![\w.~-])/(?:home|Users|root|work|mnt)/\w|\b[A-Z]:\\\\?Users\b")


def texts() -> Iterator[tuple[Path, str]]:
    folders = [ROOT]
    while folders:
        for path in folders.pop().iterdir():
            if path.is_symlink() or path.name in PASSED_OVER or path.name.startswith(".venv"):
                continue
            if path.name.endswith("_cache"):
                continue
            if path.is_dir() and path.name != ".hypothesis":
                folders.append(path)
            elif path.is_file() and path.stat().st_size < 4_000_000:
                data = path.read_bytes()
                if b"\0" not in data:
                    yield path, data.decode("utf-8", "replace")


def test_no_file_names_a_place_on_somebodys_machine() -> None:
    found = [
        f"{path.relative_to(ROOT)}: {match[0]}"
        for path, text in texts()
        if (match := MACHINE_PATH.search(text))
    ]
    assert not found
    assert MACHINE_PATH.search("in /" + "home/" + "me")
