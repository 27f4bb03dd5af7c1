"""Inkscape's extension, run by the system's inkex as Inkscape runs it, and what Inkscape finds then."""

from __future__ import annotations

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


def extended(source: Path, *words: str) -> Path:
    """Return the document that the extension makes of one."""
    out = source.with_name(f"done-{source.name}")
    code = f"import sys, runpy; sys.path.insert(0, {EXTENSIONS!r}); sys.argv = sys.argv[1:]; "
    code += "runpy.run_path(sys.argv[0], run_name='__main__')"
    script = ROOT / "inkscape" / "batik_tile.py"
    options = (f"--program={PROGRAM}", f"--output={out}", *words)
    programs.run("/usr/bin/python3", "-c", code, script, *options, source, home=source.parent)
    return out


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


def test_what_is_wrong_is_told(tmp_path: Path) -> None:
    with pytest.raises(AssertionError, match="colour"):
        extended(document(tmp_path, "mm"), "--overrides=cloth.color=#102030")


def test_inkscape_takes_the_dialogue(tmp_path: Path) -> None:
    folder = tmp_path / "home" / "inkscape" / "extensions"
    folder.mkdir(parents=True)
    packed = tmp_path / "packed.zip"
    with zipfile.ZipFile(packed, "w") as file:
        for each in (ROOT / "inkscape").glob("batik_tile.*"):
            file.write(each, each.name)
    zipfile.ZipFile(packed).extractall(folder)
    (tmp_path / "home").chmod(0o700)
    programs.run("inkscape", "--query-all", document(tmp_path, "mm"), home=tmp_path)
    log = tmp_path / "home" / "inkscape" / "extension-errors.log"
    assert log.exists()
    assert "batik" not in log.read_text("utf-8", "replace").lower()
