"""The dialogue of Inkscape's extension offers what the program has."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from batik_vector import TileSpec
from batik_vector.command.cli import KINDS
from batik_vector.tiling.symmetry.groups import GROUPS

FOLDER = Path(__file__).resolve().parent.parent / "inkscape"
NAMESPACE = "{http://www.inkscape.org/namespace/inkscape/extension}"


def test_every_starter_is_offered_once() -> None:
    (kinds,) = (
        each
        for each in ET.parse(FOLDER / "batik_tile.inx").iter(f"{NAMESPACE}param")
        if each.get("name") == "kind"
    )
    assert sorted(option.get("value", "") for option in kinds) == sorted(KINDS)
    assert all(option.get("value") == option.text for option in kinds)


@pytest.mark.parametrize("name", ["batik_tile", "batik_certify", "batik_field"])
def test_every_question_of_a_dialogue_is_taken(name: str) -> None:
    shared = (FOLDER / "batik_program.py").read_text("utf-8")
    script = (FOLDER / f"{name}.py").read_text("utf-8") + shared
    root = ET.parse(FOLDER / f"{name}.inx").getroot()
    asked = [each.get("name", "") for each in root.iter(f"{NAMESPACE}param")]
    assert len(asked) == script.count("pars.add_argument(")
    assert all(f'"--{name}"' in script for name in asked)
    assert root.findtext(f".//{NAMESPACE}command") == f"{name}.py"


@pytest.mark.parametrize("name", ["batik_certify", "batik_field"])
def test_repeats_and_groups_that_a_dialogue_offers_are_known(name: str) -> None:
    for each in ET.parse(FOLDER / f"{name}.inx").iter(f"{NAMESPACE}param"):
        offered = {option.get("value", "") for option in each} - {""}
        if each.get("name") == "repeat":
            for words in offered:
                assert TileSpec(size=(60.0, 80.0), repeat=words).repeat == words
        elif each.get("name") == "group":
            assert offered == set(GROUPS)
