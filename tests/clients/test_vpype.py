"""The command ``batik`` in the real vpype and in vsketch: layers, colours, pens, sizes, faults."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from batik_vector.processes.hatching.options import HATCHES
from tests.clients import programs
from tests.clients.programs import ROOT

pytestmark = pytest.mark.clients

SAMPLES = ROOT / "samples"
PX = 96 / 25.4
DUMP = """
import json, sys, click, vpype_cli

def told(pipeline):
    try:
        document = vpype_cli.execute(pipeline)
    except click.ClickException as error:
        return error.format_message()
    return {
        "page": document.page_size,
        "layers": [
            [number, layer.property("vp_name"), str(layer.property("vp_color")),
             layer.property("vp_pen_width"), len(layer), layer.length(), layer.bounds()]
            for number, layer in document.layers.items()
        ],
    }

print("FOUND" + json.dumps([told(each) for each in sys.argv[1:]]))
"""
KAWUNG, FOUR_SQUARE = (f"batik {SAMPLES}/{name}.toml" for name in ("kawung", "four-square"))
PIPELINES = {
    "plain": KAWUNG,
    "four-square": FOUR_SQUARE,
    "twice": f"{KAWUNG} {KAWUNG}",
    "both": f"{KAWUNG} {FOUR_SQUARE}",
    "hatched": f"{KAWUNG} --hatch parallel",
    "wider": f"batik --repeat 2 1 {SAMPLES}/kawung.toml --set=tolerance=0.1mm linesort",
}
WRONG = {
    f"batik {SAMPLES}/four-sqare.toml": 'did you mean "',
    f"{KAWUNG} --set inks=3": "inks",
    f"{KAWUNG} --piece yardage": "the recipe has none",
    f"{KAWUNG} --hatch spiral --process plot": "plot hatch.kind=spiral",
    f"{KAWUNG} --process plott": 'did you mean "plot"',
}


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What vpype holds at the end of each pipeline, or what it says is wrong."""
    words = programs.run(
        programs.VPYPE_PYTHON, "-c", DUMP, *PIPELINES.values(), *WRONG, home=tmp_path_factory.mktemp("vpype")
    )
    (found,) = re.findall(r"^FOUND(.*)$", words, re.MULTILINE)
    return dict(zip([*PIPELINES, *WRONG], json.loads(found), strict=True))


def test_inks_are_layers_with_names_colours_and_pens(seen: dict[str, Any]) -> None:
    found = seen["four-square"]
    assert found["page"] == pytest.approx([320 * PX, 320 * PX], abs=1e-9)
    assert [layer[:3] for layer in found["layers"]] == [[1, "light", "#7d9cc0"], [2, "wax", "#f4efe2"]]
    assert [layer[3] for layer in found["layers"]] == pytest.approx([1.4 * PX, 1.4 * PX])
    for *_, bounds in found["layers"]:
        assert bounds == pytest.approx([0, 0, 320 * PX, 320 * PX], abs=1e-6)


def test_a_second_pattern_gets_layers_of_its_own_and_the_same_ink_its_layer(seen: dict[str, Any]) -> None:
    once, twice, both = seen["plain"], seen["twice"], seen["both"]
    assert [layer[:2] for layer in twice["layers"]] == [layer[:2] for layer in once["layers"]]
    assert [layer[4] for layer in twice["layers"]] == [2 * layer[4] for layer in once["layers"]]
    assert [layer[:2] for layer in both["layers"]] == [[1, "soga"], [2, "cotton"], [3, "light"], [4, "wax"]]
    assert both["page"] == pytest.approx([320 * PX, 320 * PX])


def test_areas_are_hatched_and_values_set(seen: dict[str, Any]) -> None:
    plain, filled = (sum(layer[5] for layer in seen[name]["layers"]) for name in ("plain", "hatched"))
    assert filled > 2 * plain
    width, height = seen["plain"]["page"]
    assert seen["wider"]["page"] == pytest.approx([2 * width, height])


@pytest.mark.parametrize("pipeline", WRONG)
def test_what_is_wrong_is_told(seen: dict[str, Any], pipeline: str) -> None:
    assert WRONG[pipeline] in seen[pipeline]


def test_the_pipeline_of_the_readme_writes_hpgl(tmp_path: Path) -> None:
    out = tmp_path / "out.hpgl"
    words = f"batik {SAMPLES}/four-square.toml linesort layout --fit-to-margins 1cm a3 write --device hp7475a"
    programs.run(programs.VPYPE, *words.split(), out, home=tmp_path)
    pens = re.findall(r"SP(\d)", out.read_text())
    assert [pen for pen in pens if pen != "0"] == ["1", "2"]


def test_help_names_every_hatch(tmp_path: Path) -> None:
    words = programs.run(programs.VPYPE, "batik", "--help", home=tmp_path)
    assert f"[{'|'.join(HATCHES)}]" in words


def test_vpype_starts_without_what_compiles(tmp_path: Path) -> None:
    """The plug-in is loaded whenever vpype runs: it brings nothing heavy."""
    code = (
        "import sys, vpype_cli; known = set(sys.modules); import batik_vector.command.plugins.vpype; "
        "print('NEW', *sorted({name for name in set(sys.modules) - known}))"
    )
    (new,) = re.findall(r"NEW (.*)", programs.run(programs.VPYPE_PYTHON, "-c", code, home=tmp_path))
    assert set(new.split()) == {
        "batik_vector",
        "batik_vector._version",
        "batik_vector.command",
        "batik_vector.command.plugins",
        "batik_vector.command.plugins.vpype",
    }


SKETCH = """
import sys, vsketch

class Sketch(vsketch.SketchClass):
    def draw(self, vsk):
        vsk.size("a3", center=False)
        vsk.vpype("batik " + sys.argv[1])
        vsk.circle(100, 100, 50)

    def finalize(self, vsk):
        vsk.vpype("linesort")

document = Sketch.execute().vsk.document
print("LAYERS", *(layer.property("vp_name") for layer in document.layers.values()))
"""


def test_vsketch_draws_a_pattern(tmp_path: Path) -> None:
    words = programs.run(programs.VPYPE_PYTHON, "-c", SKETCH, SAMPLES / "kawung.toml", home=tmp_path)
    assert "LAYERS soga cotton" in words
