from __future__ import annotations

import re

import pytest

from batik_vector.errors import Fault, RecipeError
from batik_vector.studio.drafts import Draft
from batik_vector.studio.parameters import PANELS, Control, Group, controls, panels
from tests.studio.test_changes import SAMPLES
from tests.studio.test_drafts import FLOWER
from tests.studio.text.test_rewriting import TEXTS


def test_a_control_says_what_is_declared() -> None:
    found = controls(Draft(FLOWER))["motif.a.pistil.count"]
    assert found.kind == "whole"
    assert (found.symbol, found.unit, found.least, found.most, found.useful) == ("m", "", 0, 96, (5, 24))
    assert (found.default, found.value, found.is_set) == (16, 16, False)
    assert found.help.startswith("cusps")
    width = controls(Draft(FLOWER))["place[0].width"]
    assert (width.unit, width.value, width.is_set, width.default) == ("mm", 280.0, True, None)
    turn = controls(Draft(FLOWER))["place[0].turn"]
    assert (turn.unit, turn.span) == ("°", (-180, 180))


def test_kinds_are_those_of_the_values() -> None:
    known = controls(Draft(FLOWER + "[cloth]\n[[output]]\nformat = 'hpgl'\n"))
    kinds = {
        "motif.a.kind": "choice",
        "motif.a.petal.ink": "choice",
        "motif.a.petal.whole": "switch",
        "motif.a.order": "list",
        "place[0].motif": "names",
        "tile.repeat": "text",
        "tile.size[0]": "number",
        "cloth.colour": "colour",
        "ink.wax.overlap": "choice",
        "title": "text",
        "output[0].format": "choice",
        "output[0].pens": "list",
        "output[0].sheet[0]": "whole",
    }
    assert {path: known[path].kind for path in kinds} == kinds
    assert known["motif.a.petal.ink"].choices == ("", "wax")
    assert known["place[0].motif"].choices == ("a",)
    assert {"grid", "half-drop", "p4m"} <= set(known["tile.repeat"].choices)


def test_panels_stand_in_the_papers_order() -> None:
    assert [panel.name for panel in panels(Draft(FLOWER))] == list(PANELS)
    assert list(PANELS)[:2] == ["pattern", "layout"]


def test_a_fault_stands_at_its_control() -> None:
    draft = Draft(FLOWER).with_value("motif.a.petal.count", 999)
    known = controls(draft)
    assert known["motif.a.petal.count"].fault == "999, expected 0 to 360"
    assert known["motif.a.petal.length"].fault == ""
    pair = controls(Draft(FLOWER).with_value("tile.size[0]", -3))
    assert "expected 0.1 to 20000 mm" in pair["tile.size[0]"].fault
    late = panels(Draft(FLOWER), [Fault("too much", "place[0]"), Fault("and this", "motif.a.petal")])
    group = next(each for each in groups(late[1].groups) if each.path == "place[0]")
    assert group.fault == "too much"
    with pytest.raises(RecipeError):
        panels(Draft("[oh"))


def groups(some: tuple[Group, ...]) -> list[Group]:
    return [inner for group in some for inner in (group, *groups(group.groups))]


def test_what_is_locked_shows() -> None:
    known = controls(Draft(FLOWER).locking("motif.a.petal"))
    assert known["motif.a.petal.count"].locked
    assert not known["motif.a.leaf.count"].locked


@pytest.mark.parametrize("name", sorted(TEXTS)[::4])
def test_every_control_holds_its_value_within_its_slider(name: str) -> None:
    for control in controls(Draft(TEXTS[name]), ()).values():
        check(control)


def test_a_value_next_to_nothing_has_a_slider() -> None:
    path = "motif.flower.vein.gap"
    check(controls(Draft(TEXTS["bird"]).with_value(path, 5e-324), ())[path])


def test_what_is_drawn_in_millimetres_can_be_made_larger_still() -> None:
    long = controls(Draft.read(SAMPLES / "kawung.toml"))["motif.kawung.elements[0].curve.length"]
    assert long.useful is None
    assert long.span is not None
    assert long.span[1] >= 1.4 * long.value


def test_a_key_that_is_no_word_is_called_by_one() -> None:
    found = controls(Draft(FLOWER))
    assert (found["motif.a.petal.n"].label, found["motif.a.petal.n"].symbol) == ("slimness", "n")
    letters = {each.label for each in found.values() if len(each.label) == 1}
    assert not letters


def check(control: Control) -> None:
    if control.kind not in ("number", "whole"):
        return
    assert control.span is not None
    low, high = control.span
    assert control.least is None or control.least <= low
    assert control.most is None or high <= control.most
    assert low < high, control
    assert control.step is not None
    assert 0 < control.step <= (high - low)
    if isinstance(control.value, int | float):
        assert low <= control.value <= high, control


@pytest.mark.parametrize("name", sorted(TEXTS)[::4])
def test_every_value_of_a_recipe_has_a_control(name: str) -> None:
    draft = Draft(TEXTS[name])
    known = controls(draft, ())
    said = {path for path, control in known.items() if control.is_set}
    for path in said:
        control = known[path]
        if control.kind in ("choice", "switch", "text", "colour"):
            assert draft.value(path) == control.value, path
    for key in leaves(draft.tables):
        # Of a list of one the table may stand bare.
        named = re.sub(r"\bprocess\.", "process[0].", key)
        held = any(named == path or named.startswith(f"{path}[") for path in said)
        assert held or key.startswith("drawing"), key


def leaves(node: object, at: str = "") -> list[str]:
    if isinstance(node, dict):
        return [each for key, held in node.items() for each in leaves(held, f"{at}.{key}" if at else key)]
    if isinstance(node, list):
        return [each for number, held in enumerate(node) for each in leaves(held, f"{at}[{number}]")]
    return [at]


BORDER = "[[border]]\nsize = [40, 40]\ncorner = 'motif'\nrails = [{ at = 4, width = 2 }]\n"
OFFERED = Draft(FLOWER + "[yardage]\nwidth = 500\n" + BORDER + "[[output]]\nformat = 'gcode'\n")
OFFERS = {
    f"{offer.path} {offer.label}": offer
    for panel in panels(OFFERED, ())
    for group in groups(panel.groups)
    for offer in group.offers
}


@pytest.mark.parametrize("name", sorted(OFFERS))
def test_what_is_offered_reads_at_once(name: str) -> None:
    offer = OFFERS[name]
    add = OFFERED.with_value if offer.single else OFFERED.inserted
    draft = add(offer.path, offer.value)
    if offer.value.get("kind") == "svg":
        draft = draft.with_drawing(
            "drawing.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h9v9z"/></svg>'
        )
    assert draft.faults == ()


KINDS = [control for control in controls(Draft(FLOWER), ()).values() if control.path.endswith(".kind")]


@pytest.mark.parametrize("control", KINDS, ids=lambda control: control.path)
def test_every_kind_that_can_be_chosen_reads_at_once(control: Control) -> None:
    for kind in control.choices:
        # One needs a drawing; the other has no motif, but marks that fill it.
        if kind in ("svg", "ground"):
            continue
        draft = Draft(FLOWER).with_value(control.path, kind)
        assert draft.value(control.path) == kind
        assert draft.faults == (), kind
