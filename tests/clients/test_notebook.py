"""Notebooks: the example is executed by nbconvert, and what sliders do is asked of real widgets."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.clients import programs
from tests.clients.programs import ROOT

pytestmark = pytest.mark.clients

MOVED = """
import json
from batik_vector.errors import BatikError
from batik_vector.notebook import interact

pattern = interact("library:sample/kawung", "motif.kawung.elements[0].curve.b", "cloth.colour", "tolerance")
bend, cloth, tolerance, told = pattern.box.children[0].children
picture = pattern.box.children[1]
seen = {"kinds": [type(each).__name__ for each in (bend, cloth, tolerance)], "value": bend.value}
before, shown = pattern.artwork, picture.value
cloth.value = "#102030"
seen["repainted"] = pattern.artwork.cloth == "#102030" and "#102030" in picture.value != shown
bend.value = 2.0
seen["bent"] = pattern.artwork is not before and "b = 2" in pattern.text
good = pattern.artwork
pattern._setter("tolerance")({"new": -1.0})
seen["told"], seen["kept"] = told.value, pattern.artwork is good
seen["first"] = [each.description for each in interact("library:sample/koi").box.children[0].children[:-1]]
seen["again"] = interact(pattern.recipe, "cloth.colour").box.children[0].children[0].value
try:
    interact("library:sample/kawung", "cloth.color")
except BatikError as error:
    seen["wrong"] = str(error)
print("SEEN" + json.dumps(seen))
"""


def test_sliders_draw_the_tile_anew(tmp_path: Path) -> None:
    words = programs.run(programs.VPYPE_PYTHON, "-c", MOVED, home=tmp_path)
    (found,) = re.findall(r"^SEEN(.*)$", words, re.MULTILINE)
    seen = json.loads(found)
    assert seen["kinds"] == ["FloatSlider", "ColorPicker", "FloatSlider"]
    assert seen["value"] == 1.08
    assert seen["repainted"]
    assert seen["bent"]
    assert "-1 mm" in seen["told"]
    assert seen["kept"]
    assert len(seen["first"]) >= 5
    assert seen["again"] == "#102030"
    assert 'did you mean "cloth.colour"' in seen["wrong"]


def test_the_example_is_executed(tmp_path: Path) -> None:
    words = ("-m", "nbconvert", "--execute", "--to", "notebook", "--output-dir", tmp_path, "--output", "done")
    # It writes beside itself.
    example = tmp_path / "example.ipynb"
    example.write_bytes((ROOT / "docs" / "notebook.ipynb").read_bytes())
    programs.run(programs.VPYPE_PYTHON, *words, example, home=tmp_path)
    cells = json.loads((tmp_path / "done.ipynb").read_text("utf-8"))["cells"]
    kinds = [set(out.get("data", {})) for cell in cells for out in cell.get("outputs", ())]
    assert any("image/svg+xml" in each for each in kinds)
    assert any("application/vnd.jupyter.widget-view+json" in each for each in kinds)
    assert not any(out["output_type"] == "error" for cell in cells for out in cell.get("outputs", ()))
    assert not [cell for cell in json.loads(example.read_text("utf-8"))["cells"] if cell.get("outputs")]
