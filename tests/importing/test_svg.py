"""Any program's SVG as a tile: true size, true outlines, and the inks that a printer would make."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Artwork, Layer, Overlap
from batik_vector.export import render
from batik_vector.importing.svg import read_svg, read_tile
from tests.clients.pictures import differing, reference
from tests.importing.drawings import DISC, MIXED, svg


def covered(artwork: Artwork) -> dict[str, float]:
    """Area in mm² of every ink that fills."""
    found = {
        layer.ink.colour: float(shapely.area(shapely.union_all(layer.areas))) for layer in artwork.layers
    }
    return {colour: area for colour, area in found.items() if area}


def only(inner: str, **options: float) -> Layer:
    (layer,) = read_tile(svg(inner), **options).layers  # type: ignore[arg-type]
    return layer


@pytest.mark.parametrize(
    ("head", "size", "guessed"),
    [
        ('width="100mm" height="50mm" viewBox="0 0 100 50"', (100, 50), False),
        ('width="10cm" height="5cm"', (100, 50), False),
        ('width="2in" height="1in" viewBox="0 0 2 1"', (50.8, 25.4), False),
        ('width="144pt" height="6pc"', (50.8, 25.4), False),
        ('width="96px" height="192"', (25.4, 50.8), False),
        ('viewBox="-20 -30 96 192"', (25.4, 50.8), True),
        ('width="100%" height="100%" viewBox="0 0 96 192"', (25.4, 50.8), True),
        ('width="10mm" viewBox="0 0 96 192"', (10, 20), True),
        ('height="10mm" viewBox="0 0 192 96"', (20, 10), True),
        ("width='1.5e1mm' height=' +20 mm '", (15, 20), False),
    ],
)
def test_the_page_is_in_true_millimetres(head: str, size: tuple[float, float], guessed: bool) -> None:
    reading = read_svg(svg('<circle cx="50%" cy="50%" r="10%"/>', head))
    cell = reading.artwork.cell
    assert (cell.width, cell.height) == pytest.approx(size, abs=1e-9)
    assert any("guessed" in note for note in reading.notes) == guessed


@pytest.mark.parametrize(
    ("head", "expected"),
    [
        # Scale, and a viewBox that begins elsewhere; y turns upwards.
        ('width="50mm" height="50mm" viewBox="100 200 100 100"', (5, 40, 10, 45)),
        # A viewBox of another shape lies in the middle, or where it is told to.
        ('width="100mm" height="50mm" viewBox="100 200 100 100"', (30, 40, 35, 45)),
        (
            'width="100mm" height="50mm" viewBox="100 200 100 100" preserveAspectRatio="xMinYMid"',
            (5, 40, 10, 45),
        ),
        (
            'width="100mm" height="50mm" viewBox="100 200 100 100" preserveAspectRatio="none"',
            (10, 40, 20, 45),
        ),
        (
            'width="100mm" height="50mm" viewBox="100 200 100 100" preserveAspectRatio="xMidYMin slice"',
            (10, 30, 20, 40),
        ),
    ],
)
def test_the_view_box_lies_in_its_page(head: str, expected: tuple[float, ...]) -> None:
    (layer,) = read_tile(svg('<rect x="110" y="210" width="10" height="10"/>', head)).layers
    assert shapely.total_bounds(layer.areas) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    ("inner", "area"),
    [
        ('<rect x="10" y="10" width="30" height="20"/>', 600),
        ('<rect x="10" y="10" width="30" height="20" rx="5"/>', 600 - (4 - math.pi) * 25),
        ('<rect x="10" y="10" width="30" height="20" rx="99" ry="5"/>', 600 - (4 - math.pi) * 75),
        (DISC, math.pi * 400),
        ('<ellipse cx="50%" cy="50" rx="20" ry="10"/>', math.pi * 200),
        ('<polygon points="0,0 30,0 30,40"/>', 600),
        ('<polyline points="0 0,30 0,30 40"/>', 600),
        ('<path d="M10 10h30v20h-30z"/>', 600),
        ('<path d="m10,10 30,0 0,20-30,0"/>', 600),
        ('<path d="M10 10H40V30H10Z m5 5v10h10v-10z" fill-rule="evenodd"/>', 500),
        ('<path d="M10 10H40V30H10Z m5 5v10h10v-10z"/>', 500),
        ('<path d="M10 10H40V30H10Z m5 5h10v10h-10z"/>', 600),
        ('<path d="M10 10H40V30H10Z m5 5h10v10h-10z" style="fill-rule:evenodd"/>', 500),
        # Rings that cross one another, and one that crosses itself.
        ('<path d="M10 10h20v20h-20zM20 20h20v20h-20z"/>', 700),
        ('<path d="M10 10h20v20h-20zM20 20h20v20h-20z" fill-rule="evenodd"/>', 600),
        ('<path d="M10 10L30 30V10L10 30z"/>', 200),
        # Half a disc by an arc with packed flags, a parabola by Q and T.
        ('<path d="M30 50a20 20 0 0140 0z"/>', math.pi * 200),
        ('<path d="M30 50A20 20 0 1 1 70 50z"/>', math.pi * 200),
        ('<path d="M0 50Q25 0 50 50T100 50Z"/>', 2 * 2 / 3 * 50 * 25),
        # The four arcs of one pair of radii, and one of a leaning ellipse.
        ('<path d="M50 50V30A20 20 0 0 1 70 50z"/>', math.pi * 100),
        ('<path d="M50 50V30A20 20 0 1 0 70 50z"/>', math.pi * 300),
        ('<path d="M50 50V30A20 20 0 0 0 70 50z"/>', 400 - math.pi * 100),
        ('<path d="M50 50V30A20 20 0 1 1 70 50z"/>', 400 + math.pi * 300),
        ('<path d="M50 30A20 10 90 0 1 50 70z"/>', math.pi * 100),
        # Radii that are too small grow until they reach.
        ('<path d="M30 50A1 1 0 0 1 70 50z"/>', math.pi * 200),
    ],
)
def test_shapes_cover_what_they_ought_to(inner: str, area: float) -> None:
    layer = only(inner)
    assert shapely.is_valid(layer.areas).all()
    assert shapely.area(layer.areas).sum() == pytest.approx(area, rel=2e-3)


def test_curves_stay_within_the_tolerance() -> None:
    for tolerance in (0.5, 0.05, 0.005):
        layer = only(DISC + '<path fill="none"/>', tolerance=tolerance)
        away = np.hypot(*(shapely.get_coordinates(layer.areas) - 50).T)
        assert away == pytest.approx(20, abs=1e-5)
        chords = shapely.line_interpolate_point(
            shapely.get_exterior_ring(layer.areas[0]), np.linspace(0, 1, 2000), normalized=True
        )
        off = 20 - np.hypot(*(shapely.get_coordinates(chords) - 50).T)
        assert 0.05 * tolerance < off.max() <= tolerance


@pytest.mark.parametrize(
    "transform",
    [
        "translate(20 -10)",
        "translate(20,-10) scale(2)",
        "translate(20 90),scale(1 -0.5) rotate(30)",
        "rotate(90 50 50) skewX(20)",
        "matrix(0 1 -1 0 100 0) skewY(-10)",
    ],
)
def test_transforms_nest(transform: str) -> None:
    """Once on a group of groups, and once as cairosvg understands it."""
    inner = '<path d="M30 40h30l-10 15z" fill="#123456"/>'
    parts = transform.replace("),", ") ").replace(") ", ")\0").split("\0")
    nested = inner
    for part in reversed(parts):
        nested = f'<g transform="{part}">{nested}</g>'
    one, other = (only(each) for each in (f'<g transform="{transform}">{inner}</g>', nested))
    assert shapely.get_coordinates(one.areas) == pytest.approx(shapely.get_coordinates(other.areas), abs=1e-9)
    alike(svg(f'<g transform="{transform}">{inner}</g>'))


def alike(data: bytes, per_mm: float = 4.0, limit: float = 2e-3) -> None:
    """The drawing as read looks as cairosvg draws the file."""
    mine = render(read_tile(data), "svg", check=False)
    assert differing(reference(mine, per_mm), reference(data, per_mm)) < limit


def test_a_drawing_of_all_sorts_looks_as_cairosvg_draws_it() -> None:
    alike(svg(MIXED), limit=4e-3)


def test_the_colour_that_css_decides() -> None:
    found = covered(read_tile(svg(MIXED)))
    assert found["#008080"] == pytest.approx(135 - (4 - math.pi) * 9, rel=1e-3)
    assert set(found) == {"#8c2f2b", "#a86f3a", "#008080", "#161b30", "#008000", "#333333"}


RULES = "path.b, path { fill: blue } #a { fill: red } .b { fill: lime } .b { fill: teal }"


@pytest.mark.parametrize(
    ("mark", "colour"),
    [
        ('id="a" class="b"', "#ff0000"),
        ('class="b"', "#0000ff"),
        ('class="c" fill="lime"', "#0000ff"),
        ('id="a" style="fill: #123"', "#112233"),
    ],
)
def test_the_weightier_rule_wins(mark: str, colour: str) -> None:
    assert only(f'<style>{RULES}</style><path {mark} d="M1 1h5v5z"/>').ink.colour == colour


def test_an_ink_is_a_colour_as_area_or_as_line_of_one_breadth() -> None:
    artwork = read_tile(
        svg(
            '<path d="M10 10h10v10z" fill="#ff0000" stroke="#00f" stroke-width="2"/>'
            '<g transform="scale(2)"><path d="M10 30h10" stroke="#0000ff"/></g>'
            '<path d="M10 80h10" stroke="blue" stroke-width="3"/><path d="M50 10h10v10z" fill="red"/>'
        )
    )
    found = [(each.ink.name, each.ink.width, len(each.areas), len(each.lines)) for each in artwork.layers]
    assert found == [("#ff0000", 1.0, 2, 0), ("#0000ff 2 mm", 2.0, 0, 2), ("#0000ff 3 mm", 3.0, 0, 1)]
    assert {each.ink.overlap for each in artwork.layers} == {Overlap.OVERLAY}
    assert artwork.layers[1].lines[0].is_closed
    assert not artwork.layers[1].lines[1].is_closed


def test_a_layer_of_one_ink_lends_it_its_name() -> None:
    layers = (
        '<g inkscape:groupmode="layer" inkscape:label="1 first  wax"><g id="x"><path d="M0 0h9v9z"/></g></g>'
        '<g id="second_x20_dye"><path d="M20 0h9v9z" fill="red"/></g>'
        '<g id="both"><path d="M40 0h9v9z" fill="lime"/><path d="M50 0h9v9z" fill="blue"/></g>'
    )
    names = [layer.ink.name for layer in read_tile(svg(layers)).layers]
    assert names == ["1 first wax", "second dye", "#00ff00", "#0000ff"]


@pytest.mark.parametrize(
    ("ground", "cloth"),
    [
        ('<rect width="100" height="100" fill="#1d2f5f"/>', "#1d2f5f"),
        ('<path d="M-5-5h110v110h-110z" fill="#1d2f5f"/>', "#1d2f5f"),
        ('<g id="Cloth"><rect width="99" height="99" fill="#1d2f5f"/></g>', "#1d2f5f"),
        (
            '<g id="g1" inkscape:label="%99 cloth"><polygon points="0 0 9 0 9 9" fill="#1d2f5f"/></g>',
            "#1d2f5f",
        ),
        ('<g id="g1" inkscape:label="%cloth"><path d="M0 0 9 0 9 9Z" fill="#1d2f5f"/></g>', "#1d2f5f"),
        ('<rect width="100" height="99.9" fill="#1d2f5f"/>', "#ffffff"),
        ('<rect width="100" height="100" fill="none"/>', "#ffffff"),
        ("", "#ffffff"),
    ],
)
def test_a_ground_as_large_as_the_page_is_the_cloth(ground: str, cloth: str) -> None:
    artwork = read_tile(svg(ground + DISC))
    assert artwork.cloth == cloth
    assert len(artwork.layers) == (2 if "99.9" in ground else 1)


def test_a_page_painted_over_is_no_cloth() -> None:
    artwork = read_tile(svg(DISC + '<rect width="100" height="100" fill="red"/>'))
    assert [layer.ink.colour for layer in artwork.layers] == ["#000000", "#ff0000"]


def test_a_page_off_the_grid_takes_its_drawing_along() -> None:
    reading = read_svg(svg('<path d="M0 10h100v20h-100z"/>', 'width="100" height="100"'))
    artwork = reading.artwork
    assert (artwork.cell.columns, artwork.cell.rows) == (26458, 26458)
    assert shapely.total_bounds(artwork.layers[0].areas)[[0, 2]].tolist() == [0.0, 26.458]
    assert any("26.458333" in note for note in reading.notes)


def test_what_all_but_lies_on_an_edge_lies_on_it() -> None:
    """Files of six decimals miss an edge that is no decimal number of their units."""
    layer = only('<path d="M0.0000008 10H99.9999994v20H0z"/>')
    assert shapely.total_bounds(layer.areas)[[0, 2]].tolist() == [0.0, 100.0]


def test_curves_that_cross_an_edge_are_divided_more_finely() -> None:
    arcs = '<path d="M{0} 30c30 0 30 40 0 40" fill="none" stroke="red"/>'
    inside, across = only(arcs.format(50)), only(arcs.format(90))
    assert len(across.lines[0].coords) > 2 * len(inside.lines[0].coords)


def test_a_drop_lands_on_whole_steps() -> None:
    cell = read_tile(svg(DISC, 'width="100mm" height="100mm" viewBox="0 0 100 100"'), "drop 1/3").cell
    assert (cell.columns, cell.rows) == (100_000, 99_999)
    assert cell.lattice[0] == (100_000, 33_333)


STEM = "M{0} 40C{1} 20 {2} 70 {3} 60"


@settings(derandomize=True, max_examples=40, deadline=None)
@given(st.floats(-9, -1), st.floats(1, 20), st.floats(-30, 30), st.floats(0.3, 3))
@example(-1.0, 1.0, 0.0, 1.0)  # crosses in its middle, where it is looked at
@example(-9.0, 9.0, 18.0, 1.0)
def test_a_curve_and_its_twin_cross_the_seam_at_the_same_place(
    left: float, right: float, lean: float, scale: float
) -> None:
    places = [left, left + lean, right - lean / 2, right]
    stems = [STEM.format(*[x + shift for x in places]) for shift in (0, 100)]
    head = f'width="{100 * scale}mm" height="{100 * scale}mm" viewBox="0 0 100 100"'
    artwork = read_tile(svg("".join(f'<path fill="none" stroke="red" d="{stem}"/>' for stem in stems), head))
    width = artwork.cell.width
    one, other = (shapely.get_coordinates(line) for line in artwork.layers[0].lines)
    here, there = one[one[:, 0] == 0.0][:, 1], other[other[:, 0] == width][:, 1]
    assert len(here)
    assert here == pytest.approx(there, abs=1e-9)


def test_a_curve_cut_by_hand_meets_its_twin() -> None:
    """De Casteljau's halves against the whole curve that runs over the edge."""
    whole = np.array([[-10.0, 30.0], [4.0, 35.0], [-3.0, 60.0], [12.0, 70.0]])
    x = bezier(whole, np.linspace(0, 1, 4))[:, 0]
    (t,) = (each.real for each in np.roots(np.polyfit(np.linspace(0, 1, 4), x, 3)) if abs(each.imag) < 1e-9)
    rows = [whole]
    while len(rows[-1]) > 1:
        rows.append(rows[-1][:-1] * (1 - t) + rows[-1][1:] * t)
    right = np.array([row[-1] for row in reversed(rows)])
    right[0, 0] = 0.0
    words = " ".join(f"{x!r},{y!r}" for x, y in (whole + [100, 0]).tolist()[1:])
    cut = " ".join(f"{x!r},{y!r}" for x, y in right.tolist()[1:])
    (layer,) = read_tile(
        svg(
            f'<g fill="none" stroke="red"><path d="M90,30C{words}"/>'
            f'<path d="M{float(right[0, 0])!r},{float(right[0, 1])!r}C{cut}"/></g>'
        )
    ).layers
    across, begins = (shapely.get_coordinates(line) for line in layer.lines)
    assert begins[0] == pytest.approx(across[across[:, 0] == 100.0][0] - [100, 0], abs=1e-9)


def bezier(control: np.ndarray, t: np.ndarray) -> np.ndarray:
    s = 1 - t[:, None]
    u = t[:, None]
    return np.asarray(
        s**3 * control[0] + 3 * s * s * u * control[1] + 3 * s * u * u * control[2] + u**3 * control[3]
    )


@pytest.mark.parametrize(
    ("mark", "cap", "area"),
    [
        ('<path d="M50 50h0"', "round", math.pi * 4),
        ('<path d="M50 50z"', "square", 16),
        ('<line x1="50" y1="50" x2="50" y2="50"', "round", math.pi * 4),
        ('<polyline points="50 50 50 50"', "square", 16),
        ('<path transform="scale(2 1)" d="M20 50l0 0m9 9c0 0 0 0 0 0"', "square", 64),
        ('<path vector-effect="non-scaling-stroke" transform="scale(2)" d="M20 20h0"', "square", 16),
        ('<path d="M50 50h0"', "butt", 0),
        ('<path d="M50 50"', "round", 0),
    ],
)
def test_strokes_of_no_length_are_dots(mark: str, cap: str, area: float) -> None:
    line = f'{mark} stroke="red" stroke-width="4" stroke-linecap="{cap}" fill="none"/>'
    found = covered(read_tile(svg(DISC + line))).get("#ff0000", 0.0)
    assert found == pytest.approx(area, rel=1e-2)


@pytest.mark.parametrize(
    ("size", "told"),
    [
        (("283.465", "283.465"), "100 × 100"),
        (("283.46px", "141.73px"), "100 × 50"),
        (("377.953", "377.953"), ""),
        (("283.465", "300"), ""),
        (("300", "300"), ""),
        (("360", "360"), "127 × 127"),
        (("1440", "1440"), ""),
        (("113.386", "226.772"), ""),
        (("75mm", "75mm"), ""),
    ],
)
def test_sizes_that_72_px_to_the_inch_make_whole_are_told(size: tuple[str, str], told: str) -> None:
    head = f'width="{size[0]}" height="{size[1]}" viewBox="0 0 100 100"'
    notes = [note for note in read_svg(svg(DISC, head)).notes if "72 px" in note]
    words = f"at 72 px to the inch the page would be {told} mm: check that 96 is meant"
    assert notes == ([words] if told else [])


def test_where_a_generator_is_named_it_is_believed() -> None:
    drawing = b"<!-- Generator: Sketch 52 -->" + svg(DISC, 'width="283.465" height="283.465"')
    assert not [note for note in read_svg(drawing).notes if "72 px" in note]


def test_a_ring_that_runs_back_over_its_own_curve_keeps_its_face() -> None:
    ring = '<path d="M0 0C0 0 0 0 0 1S4 4 20 0Q0 0 0 0T1 0z" fill="#ff0000"/>'
    assert covered(read_tile(svg(ring)))["#ff0000"] == pytest.approx(32.8, abs=0.05)
