"""Whatever a public class or function is given, it makes a valid object of it or says what it expected."""

# mypy: disable-error-code="arg-type"

from __future__ import annotations

import dataclasses
import enum
import io
import math
from collections.abc import Callable, Iterator
from decimal import Decimal
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import batik_vector
from batik_vector import (
    Artwork,
    BatikError,
    BorderSpec,
    Cell,
    Element,
    Flower,
    Ink,
    InkSpec,
    Layer,
    Placement,
    RailSpec,
    Recipe,
    Rosette,
    TileSpec,
    YardageSpec,
    certify,
    compile_cloth,
    compile_recipe,
    load_recipe,
    read_recipe,
    violations,
    write_artwork,
)
from batik_vector.artwork import Overlap, Provenance
from batik_vector.certificate import Asked, Limits
from batik_vector.errors import GeometryError
from batik_vector.export import FORMATS, format_of, render, write_page
from batik_vector.geometry.curves import CURVES, Circle, Curve, FunctionCurve, Polar, Polygon, trace
from batik_vector.geometry.maps import VARIATIONS
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.figures import draw
from batik_vector.recipe.motif import MOTIFS, Core, Dress, Leaf, Petals, Pistil, Treatment
from batik_vector.recipe.outputs import OUTPUTS
from batik_vector.tiling.layouts import LAYOUTS, Lattice, MapSpec, Places, Ring, Spot, Term
from batik_vector.tiling.symmetry.machine_fit import Fit
from tests.thorough import rarely

SQUARE = shapely.box(1, 1, 4, 4)
WRONG: list[Any] = [
    None,
    "",
    "text",
    "3",
    "3 apples",
    5,
    -1,
    1.5,
    10**400,
    math.nan,
    math.inf,
    True,
    2j,
    b"bytes",
    [],
    (),
    {},
    {"kind": "circle"},
    [1, 2],
    ["a", 3],
    [None],
    [[1.0]],
    {1, 2},
    object(),
    object,
    len,
    Decimal("1.5"),
    Fraction(1, 3),
    np.float64(2.5),
    np.int64(3),
    np.bool_(True),
    np.array([1.0, 2.0]),
    np.array([[1, 2], [3, 4]]),
    np.array(["a"]),
    SQUARE,
    [SQUARE],
    Circle(),
    Ring(),
    [Circle()],
    Treatment.LINE,
    range(3),
    iter([1]),
    "x" * 5000,
]


def circle(t: np.ndarray) -> np.ndarray:
    return np.column_stack([np.cos(2 * np.pi * t), np.sin(2 * np.pi * t)])


PLACED = Placement(motif="m", width=40.0)
BY_HAND: dict[type, dict[str, Any]] = {
    Artwork: {"title": "t", "cell": Cell(10_000, 10_000), "layers": (Layer(Ink("wax", "#ffffff")),)},
    Cell: {"columns": 10_000, "rows": 10_000},
    Ink: {"name": "wax", "colour": "#ffffff"},
    Layer: {"ink": Ink("wax", "#ffffff")},
    Element: {"curve": Circle()},
    Rosette: {"elements": (Element(curve=Circle()),)},
    Svg: {"file": "bird.svg"},
    Places: {"at": ((0.0, 0.0),)},
    Placement: {"motif": "m", "width": 40.0},
    TileSpec: {"size": (80.0, 80.0)},
    YardageSpec: {"width": 300.0},
    RailSpec: {"at": 5.0},
    BorderSpec: {"size": (40.0, 20.0), "place": (PLACED,)},
    Recipe: {
        "motif": {"m": Rosette(elements=(Element(curve=Circle()),))},
        "place": (PLACED,),
        "tile": TileSpec(size=(80.0, 80.0)),
    },
    Term: {"variation": VARIATIONS["linear"]()},
    Asked: {"name": "p4m"},
    FunctionCurve: {"function": circle},
    CURVES["path"]: {"d": "M0 0L2 0L1 2Z"},
    CURVES["points"]: {"points": ((0.0, 0.0), (2.0, 0.0), (1.0, 2.0))},
    CURVES["lsystem"]: {"system": "dragon"},
    MOTIFS["lsystem"]: {"system": "koch-snowflake"},
    MOTIFS["path"]: {"d": "M0 0L2 0L1 2Z"},
    LAYOUTS["ifs"]: {"maps": (MapSpec(),)},
}
"""What classes cannot do without."""


def public_classes() -> list[type]:
    named = [getattr(batik_vector, name) for name in batik_vector.__all__]
    catalogues = (CURVES, VARIATIONS, LAYOUTS, OUTPUTS, MOTIFS)
    found = [each for each in named if isinstance(each, type) and not issubclass(each, Exception | enum.Enum)]
    found += [cls for catalogue in catalogues for cls in catalogue.values()]
    found += [kind.options for kind in FORMATS.values()]
    found += [
        FunctionCurve,
        Leaf,
        Petals,
        Pistil,
        Core,
        Dress,
        Spot,
        MapSpec,
        Term,
        Fit,
        Limits,
        Asked,
        Provenance,
    ]
    # Made here, for others to read.
    results = (
        batik_vector.Analysis,
        batik_vector.Certificate,
        batik_vector.Fault,
        batik_vector.Variation,
    )
    return [cls for cls in dict.fromkeys(found) if cls not in results]


def used(made: Any) -> None:
    """Do what a user would do next."""
    if isinstance(made, Artwork):
        render(made, "svg")
    elif isinstance(made, Layer):
        render(Artwork("t", Cell(10_000, 10_000), (made,)), "svg")
    elif isinstance(made, Ink):
        render(
            Artwork(
                "t", Cell(10_000, 10_000), (Layer(made, [SQUARE], [shapely.LineString([(1, 1), (4, 4)])]),)
            ),
            "pdf",
        )
    elif isinstance(made, FunctionCurve) and made.function is not circle:
        pass  # what it raises is its own
    elif isinstance(made, Curve):
        trace(made, 0.05)
    elif isinstance(made, TileSpec):
        made.cell()
    elif isinstance(made, Element):
        draw(Rosette(elements=(made,)), 0.1)
    elif isinstance(made, Rosette | Flower):
        draw(made, 0.1)
    else:
        repr(made)


def refusal(work: Callable[[], Any]) -> str:
    """What a piece of work is refused with, or nothing; any other error is a defect, and raised."""
    try:
        work()
    except BatikError as error:
        return str(error)
    return ""


def trials() -> Iterator[Any]:
    for cls in public_classes():
        for field in dataclasses.fields(cls):
            yield pytest.param(cls, field.name, id=f"{cls.__name__}.{field.name}")


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize(("cls", "name"), rarely(list(trials()), 3))
def test_a_class_takes_what_it_is_given_or_says_what_it_expected(cls: Any, name: str) -> None:
    sound = BY_HAND.get(cls, {})
    used(cls(**sound))
    for wrong in WRONG:
        assert " at 0x" not in refusal(lambda wrong=wrong: used(cls(**{**sound, name: wrong})))  # type: ignore[misc]


SOUND = Artwork("t", Cell(10_000, 10_000), (Layer(Ink("wax", "#ffffff"), [SQUARE]),))
RECIPE = Recipe(**BY_HAND[Recipe])
CALLS: dict[str, Callable[[Any], Any]] = {
    "load_recipe": load_recipe,
    "load_recipe(overrides)": lambda wrong: load_recipe("samples/kawung.toml", wrong),
    "read_recipe": read_recipe,
    "read_recipe(source)": lambda wrong: read_recipe("a = 1", wrong),
    "read_recipe(overrides)": lambda wrong: read_recipe("a = 1", overrides=wrong),
    "compile_recipe": compile_recipe,
    "compile_cloth": compile_cloth,
    "compile_cloth(tile)": lambda wrong: compile_cloth(RECIPE, tile=wrong),
    "violations": violations,
    "certify": certify,
    "certify(asked)": lambda wrong: certify(SOUND, asked=wrong),
    "certify(limits)": lambda wrong: certify(SOUND, limits=wrong),
    "render": lambda wrong: render(wrong, "svg"),
    "render(format)": lambda wrong: render(SOUND, wrong),
    "render(options)": lambda wrong: render(SOUND, "svg", wrong),
    "write_page": lambda wrong: write_page(wrong, io.BytesIO(), "svg", check=False),
    "write_artwork": lambda wrong: write_artwork(wrong, "nowhere.svg"),
    "write_artwork(options)": lambda wrong: write_artwork(SOUND, "nowhere/nowhere.svg", options=wrong),
    "format_of": format_of,
    "Curve.from_function": Curve.from_function,
    "Curve.from_function(closed)": lambda wrong: Curve.from_function(circle, closed=wrong),
    "Curve.from_function(corners)": lambda wrong: Curve.from_function(circle, corners=wrong),
    "Curve.from_points": Curve.from_points,
    "Curve.from_points(smooth)": lambda wrong: Curve.from_points([(0, 0), (1, 0), (0, 1)], smooth=wrong),
    "Curve.from_points(corners)": lambda wrong: Curve.from_points([(0, 0), (1, 0), (0, 1)], corners=wrong),
    "Curve.from_path": Curve.from_path,
    "Curve.from_path(y)": lambda wrong: Curve.from_path("M0 0L1 0L1 1Z", y=wrong),
    "Curve.from_path(centre)": lambda wrong: Curve.from_path("M0 0L1 0L1 1Z", centre=wrong),
    "Element.from_geometry": Element.from_geometry,
    "trace": lambda wrong: trace(wrong, 0.1),
    "trace(tolerance)": lambda wrong: None if callable(wrong) else trace(Circle(), wrong),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_a_function_takes_what_it_is_given_or_says_what_it_expected(
    call: Callable[[Any], Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for wrong in WRONG:
        assert " at 0x" not in refusal(partial(call, wrong))


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: Circle(radius="3"), 'radius = "3", expected a number from 0.001 to 1000'),
        (lambda: Circle(radius=None), "radius = None, expected a number from 0.001 to 1000"),
        (lambda: Circle(radius=True), "radius = True, expected a number from 0.001 to 1000"),
        (lambda: Element(curve=Circle(), count=1.5), "count = 1.5, expected a whole number from 1 to 1000"),
        (lambda: Element(curve=5), "curve = 5, expected a curve, such as Superellipse(…)"),
        (lambda: Element(curve=Circle), "curve = the class Circle, expected a curve"),
        (lambda: Element(curve=Circle(), mirror="yes"), 'mirror = "yes", expected True or False'),
        (lambda: Element(curve=Circle(), fill="evenod"), 'unknown fill "evenod": did you mean "evenodd"?'),
        (lambda: Cell(50.5, 50), "columns = 50.5, expected a whole number from 1 to"),
        (lambda: Cell(0, 50), "columns = 0, expected 1 to"),
        (lambda: Cell(50, 50, "a half"), 'drop = "a half", expected a fraction such as 1/2'),
        (lambda: Layer(Ink("a", "#fff"), areas=[5]), "areas = a list of 1, expected a list of shapely"),
        (lambda: Layer("wax"), 'ink = "wax", expected an Ink'),
        (lambda: TileSpec(size=("80 mm", "wide")), 'size = "wide", expected a length such as "280 mm"'),
        (lambda: TileSpec(size=80), "size = 80, expected a list of 2"),
        (lambda: TileSpec(size=(80, 80, 80)), "size = a tuple of 3, expected 2 of them"),
        (lambda: TileSpec(size=("80 mm", "30 m")), "size = 30000.0, expected 0.1 to 20000"),
        (lambda: Rosette(elements="abc"), 'elements = "abc", expected a list'),
        (lambda: Rosette(elements=[Circle()]), "elements = a value of type Circle, expected an Element"),
        (lambda: Recipe(motif=[]), "motif = a list of 0, expected a dict by name"),
        (lambda: InkSpec(colour=5), "colour = 5, expected #rrggbb or #rgb"),
        (lambda: Asked(5), "name = 5, expected text"),
        (lambda: compile_recipe("title = 1"), 'recipe = "title = 1", expected a Recipe: load_recipe(path)'),
        (lambda: read_recipe(b"title = 1"), "text = b'title = 1', expected text"),
        (lambda: load_recipe(5), "path = 5, expected a str or a PathLike"),
        (lambda: render(5, "svg"), "artwork = 5, expected an Artwork: compile_recipe(recipe) makes one"),
        (lambda: certify("kawung.toml"), 'artwork = "kawung.toml", expected an Artwork'),
    ],
)
def test_an_error_names_the_argument_its_value_and_what_was_expected(
    build: Callable[[], Any], words: str
) -> None:
    with pytest.raises(GeometryError) as raised:
        build()
    assert str(raised.value).startswith(words)


def test_lists_words_lengths_and_numbers_of_numpy_are_taken() -> None:
    size = (80.0, 120.0)
    for given in (["80 mm", "12 cm"], [80, 120], np.array([80, 120]), (Fraction(80), Decimal(120))):
        made = TileSpec(size=given)
        assert made == TileSpec(size=size)
        assert hash(made) == hash(TileSpec(size=size))
        assert type(made.size) is tuple
    ring = Element(curve=Circle(np.float64(2.0)), count=np.int64(3), mirror=np.bool_(True), treatment="line")
    assert ring == Element(curve=Circle(2.0), count=3, mirror=True, treatment=Treatment.LINE)
    assert repr(ring) == repr(Element(curve=Circle(2.0), count=3, mirror=True, treatment=Treatment.LINE))
    assert Rosette(elements=[ring]) == Rosette(elements=(ring,))
    assert Cell(40, 40, "1/2") == Cell(40, 40, Fraction(1, 2))
    assert Ink("wax", "#ffffff", overlap="overlay").overlap is Overlap.OVERLAY


def test_lists_of_shapes_make_a_layer() -> None:
    made = Layer(Ink("wax", "#ffffff"), areas=[SQUARE], lines=shapely.LineString([(0, 0), (9, 9)]))
    artwork = Artwork("t", Cell(10_000, 10_000), [made])
    assert artwork.layers == (made,)
    assert violations(artwork) == []
    assert len(render(artwork, "svg", check=False)) > 500


def test_a_value_that_fits_is_the_same_object() -> None:
    names = tuple(f"m.{k}" for k in range(3))
    areas = np.array([SQUARE] * 3, dtype=object)
    layer = Layer(Ink("wax", "#ffffff"), areas, area_names=names)
    assert layer.areas is areas
    assert layer.area_names is names
    waves = ((3, 0.2, 0.0),)
    assert Polar(waves=waves).waves is waves
    assert Polygon(radius=2).radius == 2


def test_a_lattice_of_a_wrong_kind_names_its_number() -> None:
    with pytest.raises(GeometryError, match=r"columns = 2\.5, expected a whole number from 1 to 2000"):
        Lattice(columns=2.5)
