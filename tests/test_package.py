"""The house stands as STYLE says: imports run downward, catalogues are whole, imports are cheap."""

from __future__ import annotations

import ast
import importlib.util
import inspect
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from importlib import import_module
from pathlib import Path

import pytest

from batik_vector.export import FORMATS
from batik_vector.geometry.curves import CURVES, Curve
from batik_vector.geometry.maps import VARIATIONS, Variation
from batik_vector.recipe.motif import MOTIFS
from batik_vector.tiling.layouts import LAYOUTS
from tools.house import (
    DOORBELLS,
    FLOORS,
    PACKAGE,
    ROOT,
    STRANGERS,
    WINGS,
    imports,
    is_module,
    modules,
    name_of,
    room_of,
)

MOST_FILES, MOST_ROOMS, FULL = 10, 19, 26
"""How many files and rooms the package's top may hold, and how many files a room."""

MODULES = modules()


def upward(module: str, imported: Iterator[str], wing: str = "") -> list[str]:
    """Return the imports that break the rules: of the whole package, or those within a wing of it."""
    heights = {room: height for height, rooms in enumerate(WINGS[wing] if wing else FLOORS) for room in rooms}
    mine = room_of(module, wing)
    return [
        f"{module} imports {other}"
        for other in imported
        if (not wing or room_of(other) == wing)
        and (room := room_of(other, wing)) not in (mine, "__init__" if wing else "")
        and heights[room] >= heights[mine]
        and (module, other) not in DOORBELLS
    ]


def in_wing(wing: str) -> list[Path]:
    return [path for path in MODULES if room_of(name_of(path)) == wing]


def test_every_room_has_a_floor() -> None:
    for wing, known in (("", FLOORS), *WINGS.items()):
        paths = in_wing(wing) if wing else MODULES
        rooms = {room_of(name_of(path), wing) for path in paths} - ({"__init__"} if wing else set())
        assert rooms <= set().union(*known), f"give these a floor in {Path(__file__).name}"
        assert rooms >= set().union(*known), "a floor without a room"
    assert len(FLOORS) <= 16


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_run_downward(path: Path) -> None:
    module = name_of(path)
    assert not upward(module, imports(path))
    wing = room_of(module)
    if wing in WINGS and room_of(module, wing) != "__init__":
        assert not upward(module, imports(path), wing)


def test_an_upward_import_is_told() -> None:
    assert upward("batik_vector.export.svg", iter(["batik_vector.tiling.torus.seams"]))
    assert upward("batik_vector.geometry.ifs", iter(["batik_vector.artwork"]))
    assert upward("batik_vector.units", iter(["batik_vector.command.cli"]))
    assert not upward("batik_vector.export.svg", iter(["batik_vector.artwork", "batik_vector.export.walk"]))
    assert upward("batik_vector.tiling.torus.torus", iter(["batik_vector.tiling.welding.weld"]), "tiling")
    assert not upward(
        "batik_vector.tiling.cloth.filling", iter(["batik_vector.tiling.welding.weld"]), "tiling"
    )


@pytest.mark.parametrize("room", STRANGERS)
def test_strangers_see_the_public_names_alone(room: str) -> None:
    seen = {other for path in in_wing(room) for other in imports(path)}
    assert {other for other in seen if room_of(other) != room} == {"batik_vector"}


def circle_in(graph: Mapping[str, set[str]]) -> list[str]:
    """Return the files of a circle of imports, or nothing."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_no_files_import_each_other_in_a_circle_inside_functions_neither() -> None:
    graph = {name_of(path): set(imports(path)) - {name_of(path)} for path in MODULES}
    assert circle_in(graph)
    for asks, answers in DOORBELLS:
        graph[asks].remove(answers)
    assert circle_in(graph) == []


def test_no_room_is_a_warren() -> None:
    tops = [path for path in PACKAGE.iterdir() if not path.name.startswith("__pycache__")]
    assert sum(path.is_file() for path in tops) <= MOST_FILES
    assert sum(path.is_dir() for path in tops) <= MOST_ROOMS
    for folder in (PACKAGE, *(path for path in PACKAGE.rglob("*") if path.is_dir())):
        # Pictures of the library are as many as its recipes.
        held = [path for path in folder.iterdir() if path.is_file() and path.suffix not in (".pyc", ".png")]
        assert len(held) <= FULL, f"{folder.relative_to(ROOT)} holds {len(held)} files"


def test_every_room_says_what_it_is_for() -> None:
    for path in PACKAGE.rglob("__init__.py"):
        words = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
        assert words.partition("\n")[0].endswith((".", ":")), f"{path.relative_to(ROOT)} has no sentence"


def test_tests_stand_where_what_they_test_stands() -> None:
    rooms = {path.parent.relative_to(PACKAGE) for path in MODULES}
    beside = {Path("clients"), Path("pages")}  # real programs, and what is written, which are of no room
    for path in (ROOT / "tests").rglob("test_*.py"):
        room = path.parent.relative_to(ROOT / "tests")
        assert room in rooms | beside, f"{path.relative_to(ROOT)}: there is no room {room}"


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
    known = set(CURVES.values())
    for name, curves in classes("curves", Curve).items():
        if name in ("__init__.py", "base.py", "function.py", "polar_function.py", "tracing.py"):
            continue
        assert curves, f"curves/{name} holds no curve"
        # What others of the catalogue are kinds of need not stand there itself.
        bases = {cls for cls in curves if any(issubclass(each, cls) for each in known - {cls})}
        assert curves - bases <= known, f"a curve of {name} stands in no line of CURVES"


def test_no_map_is_forgotten() -> None:
    for name, maps in classes("maps", Variation).items():
        assert maps <= set(VARIATIONS.values()), f"a map of {name} stands in no line of VARIATIONS"


@pytest.mark.parametrize(
    "statement",
    ["import batik_vector", "import batik_vector.export.options", "import batik_vector.command.cli"],
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
    "numpy.ma pydantic annotated_types tomlkit tqdm cairosvg ezdxf pikepdf svgwrite.data.svgparser",
    # Cloths, borders, grounds and reports of a recipe that has none.
    "batik_vector.compiling.borders batik_vector.tiling.borders.bands",
    "batik_vector.tiling.cloth.yardage batik_vector.tiling.cloth.field",
    "batik_vector.tiling.tossing.toss batik_vector.tiling.torus.stripes",
    "batik_vector.geometry.maps.images.areas batik_vector.certificate batik_vector.command.checks",
    "batik_vector.export.pdf batik_vector.export.dxf batik_vector.export.png",
    "batik_vector.recipe.reading.validator batik_vector.recipe.reading.lines",
    "batik_vector.recipe.reading.overrides batik_vector.recipe.schema",
    "batik_vector.recipe.reading.drawings batik_vector.importing.walk",
    # Kinds of motifs that it has not.
    "batik_vector.recipe.motifs.butterfly batik_vector.recipe.motifs.vine",
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
        "from batik_vector.command.cli import main; main()"
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
