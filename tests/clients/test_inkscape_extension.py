"""Inkscape's extension, run by the system's inkex as Inkscape runs it, and what Inkscape finds then."""

from __future__ import annotations

import re
import sys
import zipfile
from pathlib import Path

import pytest

from tests.clients import programs
from tests.clients.programs import ROOT

pytestmark = pytest.mark.clients

EXTENSIONS = "/usr/share/inkscape/extensions"
MM = 96 / 25.4
"""Pixels, in which Inkscape answers."""
SIZES = {
    "mm": ('width="210mm" height="297mm" viewBox="0 0 210 297"', 210, 297),
    "px": ('width="800" height="600"', 800 / MM, 600 / MM),
    "in": ('width="8in" height="10in" viewBox="0 0 8 10"', 8 * 25.4, 10 * 25.4),
}
PROGRAM = str(Path(sys.executable).with_name("batik-vector"))


def document(folder: Path, unit: str) -> Path:
    path = folder / f"{unit}.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
        ' xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" '
        f'{SIZES[unit][0]}><sodipodi:namedview id="v" inkscape:document-units="{unit}"/><g id="soga"/></svg>',
        "utf-8",
    )
    return path


def extended(source: Path, *words: str, name: str = "batik_tile") -> Path:
    """Return the document that an extension makes of one."""
    out = source.with_name(f"done-{source.name}")
    out.unlink(missing_ok=True)
    script = ROOT / "inkscape" / f"{name}.py"
    code = f"import sys, runpy; sys.path[:0] = [{str(script.parent)!r}, {EXTENSIONS!r}]; "
    code += "sys.argv = sys.argv[1:]; runpy.run_path(sys.argv[0], run_name='__main__')"
    options = (f"--program={PROGRAM}", f"--output={out}", *words)
    programs.run("/usr/bin/python3", "-c", code, script, *options, source, home=source.parent)
    # inkex writes nothing where nothing has changed: then there is nothing to take back, either.
    return out if out.exists() else source


@pytest.mark.parametrize("unit", SIZES)
def test_a_tile_lies_in_the_middle_of_the_page_in_true_size(tmp_path: Path, unit: str) -> None:
    boxes = programs.inkscape_boxes(extended(document(tmp_path, unit), "--kind=kawung"))
    _, width, height = SIZES[unit]
    for name in ("batik", "cloth"):
        assert boxes[name] == pytest.approx((width / 2 - 30, height / 2 - 30, 60, 60), abs=0.01)
    # The document has a soga of its own.
    assert {"soga2", "cotton"} <= boxes.keys()


def test_a_recipe_its_values_and_a_size(tmp_path: Path) -> None:
    recipe = ROOT / "samples" / "kawung.toml"
    words = (f"--recipe={recipe}", "--tab=recipe", "--percent=50", "--cloth=false")
    done = extended(document(tmp_path, "in"), *words, "--overrides=ink.soga.colour=#102030; title='Other'")
    boxes = programs.inkscape_boxes(done)
    assert boxes["batik"][2:] == pytest.approx((50, 50), abs=0.01)
    assert "cloth" not in boxes
    text = done.read_text("utf-8")
    assert 'inkscape:label="Other"' in text
    assert 'fill="#102030"' in text


WAYS = {
    "mm": ('width="60mm" height="60mm" viewBox="0 0 60 60"', 1.0),
    "px": (f'width="{60 * MM}" height="{60 * MM}"', MM),
    "in": ('width="60mm" height="60mm" viewBox="0 0 3 3"', 3 / 60),
}
"""A page of 60 mm, and its units to a millimetre."""


def tile(folder: Path, unit: str, right: float) -> Path:
    """Return a tile in a layer: half a mark on the left edge, and on the right its twin, so much lower."""
    page, scale = WAYS[unit]
    path = folder / f"tile-{unit}.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
        f' {page}><g id="check"/><path id="loose" d="M1 1"/>'
        '<g id="layer1" inkscape:groupmode="layer" inkscape:label="soga" fill="#a86f3a">'
        f'<g transform="scale({scale})"><path d="M0 22C6 22 9 30 4 34C2 36 1 38 0 38Z"/>'
        f'<path id="twin" transform="translate(60 {right})" d="M0 38C-6 38 -9 30 -4 26C-2 24 -1 22 0 22Z"/>'
        "</g></g></svg>",
        "utf-8",
    )
    return path


@pytest.mark.parametrize("unit", WAYS)
def test_faults_of_the_open_document_are_pointed_at_where_they_are(tmp_path: Path, unit: str) -> None:
    done = extended(tile(tmp_path, unit, 0.5), name="batik_certify")
    boxes = programs.inkscape_boxes(done)
    # The id is taken: the pointers have one of their own. They stand at both edges, where the twins part.
    left, top, width, height = boxes["check2"]
    assert (left, left + width) == pytest.approx((0, 60), abs=1)
    assert 15 < top < 22 < 38 < top + height < 45
    assert boxes["twin"][3] == pytest.approx(16, abs=0.05), "the drawing is as it was"
    again = extended(done, name="batik_certify")
    assert again.read_text("utf-8").count('stroke="#ff00c8"') == 1
    sound = extended(tile(tmp_path, unit, 0.0), name="batik_certify")
    assert "#ff00c8" not in sound.read_text("utf-8")


@pytest.mark.parametrize("unit", WAYS)
def test_a_field_is_welded_in_true_size_over_the_page(tmp_path: Path, unit: str) -> None:
    words = ("--columns=2", "--rows=3")
    done = extended(tile(tmp_path, unit, 0.0), *words, name="batik_field")
    boxes = programs.inkscape_boxes(done)
    assert boxes["batik"][:2] == pytest.approx((0, 22), abs=0.1)
    assert boxes["batik"][2:] == pytest.approx((120, 136), abs=0.1)
    text = done.read_text("utf-8")
    assert 'inkscape:label="Field 2 ' in text
    for name in ("layer1", "loose"):
        assert re.search(rf'<[^>]*id="{name}"[^>]*display:none', text), "in no layer, and hidden as well"
    # A mark that two tiles meet in is one piece: three on each edge of the field, and three in its middle.
    assert text[text.index('id="batik"') :].count("Z") == 9


def test_what_is_wrong_is_told(tmp_path: Path) -> None:
    with pytest.raises(AssertionError, match="colour"):
        extended(document(tmp_path, "mm"), "--overrides=cloth.color=#102030")


def test_inkscape_takes_the_dialogue(tmp_path: Path) -> None:
    folder = tmp_path / "home" / "inkscape" / "extensions"
    folder.mkdir(parents=True)
    packed = tmp_path / "packed.zip"
    with zipfile.ZipFile(packed, "w") as file:
        for each in (ROOT / "inkscape").glob("batik_*.*"):
            file.write(each, each.name)
    zipfile.ZipFile(packed).extractall(folder)
    (tmp_path / "home").chmod(0o700)
    programs.run("inkscape", "--query-all", document(tmp_path, "mm"), home=tmp_path)
    log = tmp_path / "home" / "inkscape" / "extension-errors.log"
    assert log.exists()
    assert "batik" not in log.read_text("utf-8", "replace").lower()
