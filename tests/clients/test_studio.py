"""The studio in a real browser, as somebody works with it who knows no command."""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="make test-clients installs the studio")

from tests.clients.studio import Page, browser, studio

pytestmark = pytest.mark.clients

ROOT = Path(__file__).parents[2]
PICTURES = ROOT / "docs" / "pictures"
PETAL = "motif.flower.petal.length"
LEAF = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 40">'
    '<path d="M20 2C34 12 34 28 20 38C6 28 6 12 20 2Z"/></svg>'
)


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    with browser() as found:
        yield found


def compiled(recipe: Path, out: Path, formats: str) -> dict[str, bytes]:
    """Return the files that the command makes of a recipe."""
    call = [sys.executable, "-m", "batik_vector", "compile", str(recipe), "-o", str(out), "-f", formats]
    subprocess.run(call, check=True, capture_output=True)
    return {path.name: path.read_bytes() for path in out.iterdir()}


def test_a_pattern_is_designed_saved_and_exported(chromium: Any, tmp_path: Path) -> None:
    with studio(tmp_path / "own") as made:
        page = Page(chromium, made.address)
        begun = page.picture()
        page.choose("sample/four-square", "Four-square flower")
        first = page.settled(begun)
        page.slider(PETAL).wait_for()

        # A slider, with the keyboard alone.
        page.slider(PETAL).locator("[tabindex='0']").focus()
        for _ in range(8):
            page.page.keyboard.press("ArrowLeft")
        moved = page.settled(first)
        page.page.wait_for_timeout(800)
        assert float(page.field(PETAL).input_value()) < 1
        page.page.get_by_role("button", name="Undo").click()
        page.settled(moved)
        page.says(PETAL, 1)

        # The text: what is typed is drawn, and comments stay.
        page.tab("Recipe")
        before = page.picture()
        editor = page.page.locator(".cm-content")
        editor.click()
        page.page.keyboard.press("Control+Home")
        page.page.keyboard.insert_text("# Mine, all mine.\n")
        page.page.wait_for_timeout(1500)
        page.tab("Parameters")
        field = page.field(PETAL)
        field.fill("0.9")
        field.press("Enter")
        changed = page.settled(before)

        # Saved, found, changed, saved again, and the first one had back.
        page.menu("File", "Save as")
        page.page.get_by_label("Name", exact=True).fill("my-flower")
        page.page.get_by_role("button", name="Save", exact=True).click()
        page.page.locator(".chip", has_text="my-flower@1").wait_for()
        field.fill("0.7")
        field.press("Enter")
        second = page.settled(changed)
        page.page.get_by_role("button", name="Save to the library").click()
        page.page.locator(".chip", has_text="my-flower@2").wait_for()
        page.page.get_by_label("Search the library").fill("my-flower")
        page.page.locator(".left .pattern").first.wait_for()
        page.tab("Versions")
        page.page.get_by_role("button", name="Restore").first.click()
        page.page.locator(".chip", has_text="my-flower@3").wait_for()
        assert page.settled(second) == changed

        # A drawing of one's own.
        page.drop("leaf.svg", LEAF)
        with_leaf = page.settled(changed)
        page.page.get_by_role("tab", name="Recipe").click()
        assert "leaf.svg" in page.page.locator(".cm-content").inner_text() or with_leaf != changed

        data = zipfile.ZipFile(io.BytesIO(page.download("svg", "dxf", "recipe (toml)").read_bytes()))
        files = {name: data.read(name) for name in data.namelist()}
        (recipe,) = (name for name in files if name.endswith(".toml"))
        assert b"# Mine, all mine." in files[recipe]
        (tmp_path / recipe).write_bytes(files.pop(recipe))
        assert files == compiled(tmp_path / recipe, tmp_path / "out", "svg,dxf")
        assert not page.errors


def test_what_was_open_is_there_again_after_kill_9(chromium: Any, tmp_path: Path) -> None:
    with studio(tmp_path / "own", str(ROOT / "samples" / "four-square.toml")) as made:
        page = Page(chromium, made.address)
        page.slider(PETAL).wait_for()
        first = page.picture()
        page.field(PETAL).fill("0.8")
        page.field(PETAL).press("Enter")
        left = page.settled(first)
        made.end(signal.SIGKILL)
    with studio(tmp_path / "own") as again:
        page = Page(chromium, again.address)
        page.page.locator(".bar .title", has_text="Four-square flower").wait_for()
        assert page.settled() == left
        page.page.get_by_role("button", name="Undo").click()
        assert page.settled(left) == first


def test_what_does_not_compile_is_told_and_nothing_is_lost(chromium: Any, tmp_path: Path) -> None:
    with studio(tmp_path / "own", str(ROOT / "samples" / "four-square.toml")) as made:
        page = Page(chromium, made.address)
        page.slider(PETAL).wait_for()
        before = page.picture()
        page.field(PETAL).fill("5000")
        page.field(PETAL).press("Enter")
        page.page.locator(".faults", has_text="expected").wait_for()
        page.page.locator(f'[data-path="{PETAL}"] .fault', has_text="expected").wait_for()
        assert page.picture() == before
        page.page.get_by_role("button", name="Undo").click()
        page.page.locator(".faults").wait_for(state="hidden")
        page.drop("bomb.svg", '<!DOCTYPE s [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><svg>&b;</svg>')
        page.page.locator(".q-notification").wait_for()
        assert page.picture() == before


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("size", [(1440, 900), (1024, 700)], ids=["1440", "1024"])
def test_nothing_is_clipped_and_everything_has_a_name(
    chromium: Any, tmp_path: Path, size: tuple[int, int], dark: bool
) -> None:
    with studio(tmp_path / "own", str(ROOT / "samples" / "four-square.toml")) as made:
        page = Page(chromium, made.address, size, dark)
        page.slider(PETAL).wait_for()
        page.page.locator(".status .good").wait_for()
        page.page.wait_for_function(
            "[...document.querySelectorAll('.left img')].slice(0, 12).every(e => e.complete)"
        )
        # What moves for ever takes the time that pictures need.
        page.page.wait_for_function(
            "document.getAnimations().every(e => e.effect.getTiming().iterations !== Infinity)"
        )
        page.page.mouse.move(size[0] / 2, size[1] / 2)
        page.page.wait_for_timeout(500)
        folder = PICTURES if os.environ.get("BATIK_PICTURES") else tmp_path
        name = f"studio-{size[0]}-{'dark' if dark else 'light'}.png"
        page.page.screenshot(path=folder / name)
        assert page.page.evaluate(CLIPPED) == []
        assert page.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        assert serious(page.page) == []


CLIPPED = """
[...document.querySelectorAll('.bar *, .tools *, .status *, .control > .name')]
  .filter(each => each.offsetParent && getComputedStyle(each).visibility === 'visible')
  .filter(each => !each.closest('.title') && !each.closest('svg') && !each.closest('.q-icon'))
  .filter(each => { const box = each.getBoundingClientRect();
    const cut = each.scrollWidth > each.clientWidth + 2 && each.clientWidth > 0
      && getComputedStyle(each).display !== 'inline';
    return box.right > innerWidth + 1 || box.left < -1 || cut; })
  .map(each => each.className + ': ' + each.textContent.slice(0, 40))
"""


def serious(page: Any) -> list[str]:
    """Return what axe finds that keeps somebody from using the page."""
    axe = pytest.importorskip("axe_core_python.sync_playwright").Axe()
    found = axe.run(page)
    return [
        f"{each['id']}: {json.dumps(each['nodes'][0]['html'])[:160]}"
        for each in found["violations"]
        if each["impact"] in ("serious", "critical")
    ]
