"""Batify: what it writes compiles and passes the certificate; unfit drawings are told."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import shapely

from batik_vector import Artwork, compile_recipe, read_recipe
from batik_vector.artwork import violations
from batik_vector.certificate import certify
from batik_vector.command.cli import cli
from batik_vector.command.drawings import STYLES
from batik_vector.drafting.batik.batify import Batik, batified
from batik_vector.drafting.batik.hands import HANDS
from batik_vector.errors import BatikError, UnknownNameError
from batik_vector.geometry.fills.insets import whole
from batik_vector.importing.document import DrawingError
from batik_vector.recipe.fills import Style
from batik_vector.recipe.fills.isen import RULES, chosen
from batik_vector.recipe.palettes import PALETTES
from tests.calling import runner
from tests.drafting.drawings import BIRD, GOOD, HOUSE, UNFIT, svg
from tests.thorough import examples, long


def without_ground(text: str) -> str:
    """Return a recipe without what fills the ground round the motif, which takes its time."""
    text = re.sub(r"\[\[place\]\] +# what is left.*?(?=\[tile\])", "", text, flags=re.DOTALL)
    return re.sub(r"\[motif\.(sprinkle|cecek)\].*?\n\]\n", "", text, flags=re.DOTALL)


def made(batik: Batik, more: str = "") -> Artwork:
    text = without_ground(batik.text) + more
    return compile_recipe(read_recipe(text, drawings={"motif.svg": batik.drawing}))


@pytest.mark.parametrize(("name", "style"), [("bird", "solo"), ("house", "pesisir"), ("letter", "miao")])
def test_a_plain_drawing_becomes_batik(name: str, style: str) -> None:
    becomes_batik(name, style)


@long
def test_so_do_many() -> None:
    others = [each for each in GOOD if each not in ("bird", "house", "letter")]
    for number, name in enumerate(others[: examples(1, len(others))]):
        becomes_batik(name, STYLES[number % 3])


def becomes_batik(name: str, style: str) -> None:
    batik = batified(GOOD[name], style, width=80)
    tile = made(batik)
    assert not violations(tile)
    assert certify(tile).passed
    # Most of what is large enough has isen, in colours of the palette alone.
    assert batik.filled >= 0.5 * batik.cells or name == "crumbs"
    hand = HANDS[Style(style)]
    palette = PALETTES[hand.palette]
    assert {layer.ink.colour for layer in tile.layers} | {tile.cloth} <= set(palette.colours)
    # Outlines are as broad as the canting that draws them.
    line = next(
        layer for layer in tile.layers if layer.ink.colour == palette.colours[HANDS[Style(style)].line]
    )
    assert line.ink.width == HANDS[Style(style)].canting


def test_the_ground_is_filled_round_the_motif() -> None:
    batik = batified(GOOD["letter"], "miao", width=40)
    bare, strewn = made(batik), compile_recipe(read_recipe(batik.text, drawings={"motif.svg": batik.drawing}))
    assert sum(len(layer.areas) for layer in strewn.layers) > 40 + sum(
        len(layer.areas) for layer in bare.layers
    )


def test_each_style_has_a_ground_of_its_own_where_there_is_room() -> None:
    def ground(style: str, width: float) -> str:
        return batified(GOOD["fish"], style, width=width).text.partition("# what is left of the ground")[2]

    assert "angle = 30" in ground("solo", 90)
    assert 'follow = "scatter"' in ground("solo", 25)
    assert 'follow = "scatter"' in ground("miao", 90)
    assert 'kind = "toss"' in ground("pesisir", 90)
    # Between copies of a square that is so small no dot has room.
    small = batified(svg('<rect width="90" height="90" fill="#333"/>'), "miao", width=14).text
    assert 'kind = "ground"' not in small


def test_isen_are_chosen_by_what_lines_leave_of_a_cell() -> None:
    """Of a deep cell lines may leave so little that what suits its depth has no room."""
    lines = "".join(f"M12 {y}H108" for y in range(15, 110, 5))
    batik = batified(
        svg(
            '<rect x="10" y="10" width="100" height="100" fill="#d9a441"/>'
            f'<path d="{lines}" fill="none" stroke="#000" stroke-width="1"/>'
        ),
        "miao",
        width=60,
    )
    assert certify(made(batik)).passed


def test_lines_that_nearly_meet_close_round_cells() -> None:
    # Two walls' sides of the window cross, a door, a roof, a wall, a chimney.
    assert batified(HOUSE).cells == 8


@pytest.mark.parametrize("width", [60.0, 200.0])
def test_it_is_as_broad_as_asked(width: float) -> None:
    batik = batified(GOOD["fish"], width=width)
    box = re.search(r'viewBox="0 0 (\S+) ', batik.drawing)
    assert box is not None
    # The page has 10 mm round it, and whole millimetres.
    assert float(box[1]) - 20 == pytest.approx(width, abs=3.0)


def test_what_the_drawing_called_so_can_be_dressed_otherwise() -> None:
    batik = batified(BIRD)
    assert 'inkscape:label="wing"' in batik.drawing
    more = '\n[[motif.batik.dress]]\nelements = "wing"\nfill_with = { kind = "hatching", spacing = 4 }\n'
    head, _, rest = without_ground(batik.text).partition("[[place]]")
    recipe = read_recipe(f"{head}{more}[[place]]{rest}", drawings={"motif.svg": batik.drawing})
    fills = {part.name: part.fill_with for part in recipe.motif["batik"].parts()}
    assert getattr(fills["wing"], "kind", None) == "hatching"


def test_colours_that_differ_stay_different() -> None:
    fills = re.findall(r'<path id="([a-z]+)-', batified(GOOD["nested"], "pesisir").drawing)
    assert len(set(fills) - {"line"}) == 4
    # Another palette's colours are the nearest ones of it.
    drawn = batified(GOOD["fish"], palette="madura").drawing
    assert set(re.findall(r'fill="(#\w+)"', drawn)) <= set(PALETTES["madura"].colours)


@pytest.mark.parametrize("name", UNFIT)
def test_an_unfit_drawing_is_told_in_one_clear_message(name: str) -> None:
    data, words = UNFIT[name]
    with pytest.raises(BatikError) as found:
        batified(data)
    assert words in str(found.value)
    assert len(str(found.value).splitlines()) == 1


def test_wrong_names_are_told() -> None:
    with pytest.raises(UnknownNameError, match='unknown style "sola": did you mean "solo"'):
        batified(BIRD, "sola")
    with pytest.raises(UnknownNameError, match='unknown palette "madra": did you mean "madura"'):
        batified(BIRD, palette="madra")
    with pytest.raises(DrawingError, match="no such file"):
        batified("nowhere.svg")


@pytest.mark.parametrize("style", Style)
def test_rules_choose_by_size_and_depth(style: Style) -> None:
    radii = np.array([0.4, 1.4, 3.0, 5.0, 12.0])
    discs = np.asarray(shapely.buffer(shapely.points(np.zeros((5, 2))), radii), dtype=object)
    rule = chosen(style, whole(discs)).rule
    assert rule[0] == -1
    # What is deeper is filled by an earlier rule.
    assert (np.diff(rule[1:]) < 0).all()
    assert [RULES[style][number].depth <= radius for number, radius in zip(rule[1:], radii[1:], strict=True)]
    leaf = shapely.Polygon([(0, 0), (20, 3), (40, 0), (20, -4)])
    pair = whole(np.array([leaf, shapely.transform(leaf, lambda at: at * (1, -1))], dtype=object))
    alike = chosen(style, pair)
    assert alike.fill[0] == alike.fill[1]
    assert RULES[style][alike.rule[0]].long > 0


def test_the_command_writes_a_recipe_and_its_drawing(tmp_path: Path) -> None:
    drawing = tmp_path / "bird.svg"
    drawing.write_bytes(BIRD)
    target = tmp_path / "mine.toml"
    args = ["batify", str(drawing), "-o", str(target), "--style", "pesisir"]
    done = runner().invoke(cli, args)
    assert done.exit_code == 0, done.stderr
    assert "mine-cells.svg written" in done.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bird.svg", "mine-cells.svg", "mine.toml"]
    again = runner().invoke(cli, args)
    assert again.exit_code == 2
    assert "is there already: --force replaces it" in again.stderr
    written = target.read_bytes()
    assert runner().invoke(cli, [*args, "--force"]).exit_code == 0
    assert target.read_bytes() == written
    wrong = runner().invoke(cli, ["batify", str(target)])
    assert wrong.exit_code == 2
    assert "is a recipe, expected a drawing" in wrong.stderr


OWN = """
[motif.own]
kind = "svg"
file = "own.svg"
batik = "miao"
[[place]]
motif = "own"
width = "WIDTH"
[tile]
size = ["130 mm", "130 mm"]
"""


def test_a_drawing_in_a_recipe_is_batik_at_any_size() -> None:
    def holes(width: str, text: str = OWN) -> int:
        recipe = read_recipe(text.replace("WIDTH", width), drawings={"own.svg": GOOD["silhouette"].decode()})
        (layer,) = compile_recipe(recipe).layers
        return int(shapely.get_num_interior_rings(layer.areas).sum() + len(layer.areas))

    plain = holes("100 mm", OWN.replace('batik = "miao"\n', ""))
    # Isen are as large as a canting draws them: on a larger motif there are more.
    assert plain < holes("40 mm") < holes("110 mm")
