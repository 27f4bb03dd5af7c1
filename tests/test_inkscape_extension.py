"""The dialogue of Inkscape's extension offers what the program has."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from batik_vector.command.cli import KINDS

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
