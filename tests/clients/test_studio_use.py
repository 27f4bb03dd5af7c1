"""The studio as people use it beside the usual: keys alone, several at once, what takes long, and Firefox."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="make test-clients installs the studio")

from batik_vector.command.cli import cli
from batik_vector.studio.changes import variations
from batik_vector.studio.drafts import Draft
from batik_vector.studio.page.fields import shown
from batik_vector.studio.parameters import controls
from tests.calling import runner
from tests.clients.studio import Page, Studio, browser, studio
from tests.clients.test_studio import PETAL, ROOT, compiled
from tests.studio.test_trying import KAWUNG, SAID, SLIT, tried

pytestmark = pytest.mark.clients

FLOWER = ROOT / "samples" / "four-square.toml"


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    with browser() as found:
        yield found


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """One studio for all that leaves it as it was."""
    with studio(tmp_path_factory.mktemp("studio") / "own", str(FLOWER)) as made:
        yield made


@pytest.fixture
def opened(chromium: Any, shared: Studio) -> Iterator[Page]:
    made = Page(chromium, shared.address)
    yield made
    made.page.context.close()


def test_keys_alone_reach_every_control_and_the_focus_is_seen(opened: Page) -> None:
    page = opened.page
    page.wait_for_selector(".left .pattern")
    # Rings that grow are seen once they have grown.
    page.emulate_media(reduced_motion="reduce")
    page.evaluate(WATCHED)
    for _ in range(400):
        page.keyboard.press("Tab")
        if page.evaluate("seen.round"):
            break
    missed, unseen = page.evaluate(TOLD)
    assert (missed, unseen) == ([], [])


WATCHED = """
() => {
  window.seen = { all: new Set(), dull: [], first: null, round: false };
  const parts = ".q-field__control, .q-checkbox__inner, .q-toggle__inner";
  const ring = (look) => (look.outlineStyle !== "none" && parseFloat(look.outlineWidth) > 0)
    || look.boxShadow !== "none" || (look.content !== "none" && look.borderTopWidth === "2px");
  document.addEventListener("focusin", (event) => {
    const at = event.target;
    if (at === seen.first) seen.round = true;
    seen.first ??= at;
    seen.all.add(at);
    const around = at.closest(".q-field, .q-checkbox, .q-toggle") || at;
    const marked = [at, at.shadowRoot && at.shadowRoot.activeElement, ...around.querySelectorAll(parts)]
      .filter(Boolean)
      .some((each) => ring(getComputedStyle(each)) || ring(getComputedStyle(each, "::after")));
    if (!marked) seen.dull.push(at.outerHTML.slice(0, 160));
  });
}
"""
TOLD = """
() => {
  const able = [...document.querySelectorAll("button, a[href], input, textarea, [tabindex='0']")]
    .filter((each) => each.checkVisibility({ visibilityProperty: true }))
    .filter((each) => !each.disabled && each.tabIndex >= 0 && !seen.all.has(each));
  return [able.map((each) => each.outerHTML.slice(0, 160)), [...new Set(seen.dull)]];
}
"""


def test_two_tabs_and_two_studios_lose_nothing_to_one_another(chromium: Any, tmp_path: Path) -> None:
    library = tmp_path / "library"
    with (
        studio(tmp_path / "one", str(FLOWER), library=library) as mine,
        studio(tmp_path / "other", str(FLOWER), library=library) as other,
    ):
        page, beside = Page(chromium, mine.address), Page(chromium, mine.address)
        begun = page.picture()
        assert beside.picture() == begun
        page.slider(PETAL).wait_for()
        page.set(PETAL, 0.9)
        assert beside.settled(begun) == page.settled(begun)
        page.save_as("ours")
        page.page.locator(".chip", has_text="ours@1").wait_for()
        beside.page.locator(".chip", has_text="ours@1").wait_for()

        away = Page(chromium, other.address)
        away.slider(PETAL).wait_for()
        away.save_as("ours")
        newer = away.page.get_by_role("dialog", name="There is a newer version")
        newer.get_by_text("version 1").wait_for()
        newer.get_by_role("button", name="Cancel").click()
        away.choose("ours", "Four-square flower")
        away.page.locator(".chip", has_text="ours@1").wait_for()
        away.slider(PETAL).wait_for()
        away.set(PETAL, 0.7)
        away.page.locator(".chip", has_text="changed").wait_for()
        away.page.get_by_role("button", name="Save to the library").click()
        away.page.locator(".chip", has_text="ours@2").wait_for()

        before = page.picture()
        page.set(PETAL, 0.8)
        page.settled(before)
        page.page.get_by_role("button", name="Save to the library").click()
        newer = page.page.get_by_role("dialog", name="There is a newer version")
        newer.get_by_text("version 2").wait_for()
        newer.get_by_role("button", name="Save over it").click()
        page.page.locator(".chip", has_text="ours@3").wait_for()
        page.tab("Versions")
        page.page.locator(".versioned").nth(2).wait_for()
        assert page.page.locator(".versioned").count() == 3
        assert not (page.errors + beside.errors + away.errors)


def test_what_takes_minutes_is_stopped_and_the_page_answers_meanwhile(opened: Page) -> None:
    page = opened
    page.slider(PETAL).wait_for()
    before = page.picture()
    slow = Draft.read(ROOT / "samples" / "toss-leaves.toml").with_value("tile.size", ["1200 mm", "1200 mm"])
    page.drop("slow.toml", slow.text)
    page.page.locator(".busy", has_text=re.compile(r"of about \d+ s|\d+ min are foreseen")).wait_for()
    page.tab("Recipe")
    page.page.locator(".cm-content", has_text="Tossed leaves").wait_for()
    assert page.picture() == before
    # Who comes too late, on a machine that has much to do, finds it stopped for taking too long.
    page.page.evaluate("document.querySelector('.busy button').click()")
    page.page.locator(".faults", has_text=re.compile("cancelled|took longer")).wait_for()
    page.page.get_by_role("button", name="Undo").click()
    page.page.locator(".faults").wait_for(state="hidden")
    assert page.settled() == before


def test_variations_over_two_numbers_stand_in_rows_and_one_is_taken(opened: Page) -> None:
    page = opened.page
    opened.slider(PETAL).wait_for()
    before = opened.picture()
    page.get_by_role("button", name="Explore variations").click()
    sheet = page.get_by_role("dialog", name="Explore variations")
    for label, number in (("Vary", "length of flower, petal"), ("and from row to row", "turn of bud, leaf")):
        page.get_by_label(label, exact=True).fill(number)
        page.get_by_role("option", name=number).click()
    cards = sheet.locator(".contact .pattern:has(img[src])")
    cards.nth(11).wait_for()
    said = [tuple(each.split(", ")) for each in sheet.locator(".contact .name").all_inner_texts()]
    assert [len({*column}) for column in zip(*said, strict=True)] == [4, 3]
    assert [len({row for _, row in said[at : at + 4]}) for at in (0, 4, 8)] == [1, 1, 1]
    box = cards.nth(11).bounding_box()
    assert box
    assert box["y"] + box["height"] < 900
    cards.nth(5).click()
    sheet.wait_for(state="detached")
    taken = opened.settled(before)
    page.get_by_role("button", name="Undo").click()
    assert opened.settled(taken) == before


def test_what_is_drawn_at_random_holds_before_it_is_taken(chromium: Any, tmp_path: Path) -> None:
    first = next(variations(KAWUNG, 0))
    assert tried(first)
    wanted = next(each for each in variations(KAWUNG, 0) if not tried(each))
    path, value = next(
        (path, each.value)
        for path, each in controls(wanted).items()
        if each.kind in ("number", "whole") and each.value != controls(KAWUNG)[path].value
    )
    with studio(tmp_path / "own", str(ROOT / "samples" / "kawung.toml")) as made:
        page = Page(chromium, made.address)
        before = page.picture()
        page.page.get_by_role("button", name="Explore variations").click()
        cards = page.page.locator(".contact .pattern:has(img[src])")
        cards.nth(11).wait_for()
        cards.first.click()
        page.page.get_by_role("dialog").wait_for(state="detached")
        page.settled(before)
        page.says(path, shown(value))
        page.page.locator(".status .good", has_text="Seam certificate passed").wait_for()
        assert not page.errors


def test_pointers_of_the_certificate_say_what_they_point_at(chromium: Any, tmp_path: Path) -> None:
    recipe = tmp_path / "squares.toml"
    recipe.write_text(SLIT)
    with studio(tmp_path / "own", str(recipe)) as made:
        page = Page(chromium, made.address).page
        page.locator(".status .bad", has_text="1 fault in the certificate").wait_for()
        pin, words = page.locator(".over .pin"), page.locator(".stage ~ .words li")
        words.get_by_text(SAID).wait_for()
        assert (pin.count(), words.count()) == (1, 1)
        assert SAID in str(pin.locator("title").text_content())
        # It points at the left edge, half way up: 0.01 mm from it, and 30 of 60.
        where, seen = pin.bounding_box(), page.evaluate("studio.view()")
        stage = page.locator(".stage").bounding_box()
        assert where
        assert stage
        at = [where["x"] + where["width"] / 2 - stage["x"], where["y"] + where["height"] / 2 - stage["y"]]
        middle = [stage["width"] / 2, stage["height"] / 2]
        in_mm = [seen["centre"][n] + (at[n] - middle[n]) / seen["scale"] for n in (0, 1)]
        assert in_mm == pytest.approx([0.01, 30], abs=0.5)
        page.get_by_role("button", name="Pointers of the certificate").click()
        pin.wait_for(state="detached")
        words.wait_for(state="hidden")
        page.get_by_role("button", name="Pointers of the certificate").click()
        pin.wait_for()


@pytest.mark.parametrize("format", ["pdf", "dxf"])
def test_a_file_that_was_compiled_is_its_recipe_again(opened: Page, tmp_path: Path, format: str) -> None:
    before = opened.picture()
    ((name, data),) = compiled(ROOT / "samples" / "kawung.toml", tmp_path / "out", format).items()
    opened.drop(name, data)
    opened.page.locator(".bar .title", has_text="Kawung").wait_for()
    after = opened.settled(before)
    opened.page.get_by_role("button", name="Undo").click()
    assert opened.settled(after) == before


def test_what_is_saved_in_an_editor_is_seen_on_the_page_of_watch(chromium: Any, tmp_path: Path) -> None:
    recipe, text = tmp_path / "mine.toml", (ROOT / "samples" / "figure-14a.toml").read_text()
    recipe.write_text(text)
    with studio(tmp_path / "own", str(recipe), "-o", str(tmp_path / "out"), watch=True) as made:
        page = Page(chromium, made.address)
        first = page.picture()
        recipe.write_text(text.replace("petal  = { length = 1.0", "petal  = { length = 0.8"))
        shorter = page.settled(first)
        page.slider(PETAL).wait_for()
        assert float(page.field(PETAL).input_value()) == 0.8
        recipe.write_text(text.replace("petal  = { length = 1.0", "petal  = { length = 5000"))
        page.page.locator(".faults", has_text="expected").wait_for()
        assert page.picture() == shorter
        page.page.get_by_role("button", name="Undo").click()
        page.page.locator(".faults").wait_for(state="hidden")
        assert not page.errors
    assert (tmp_path / "out" / "mine.svg").is_file()


def test_other_colours_are_looked_at_and_exported(chromium: Any, tmp_path: Path) -> None:
    recipe = tmp_path / "mine.toml"
    night = '\n[colourway.night]\ncloth = "#101010"\nink = { wax = "#ffe9b0" }\n'
    recipe.write_text((ROOT / "samples" / "figure-14a.toml").read_text() + night)
    with studio(tmp_path / "own", str(recipe)) as made:
        page = Page(chromium, made.address)
        drawing = page.picture()

        def colours() -> set[str]:
            return set(
                page.page.evaluate(
                    "[...studio.state.host.shadowRoot.querySelectorAll('.stage > svg:not(.over) [fill]')]"
                    ".map(each => each.getAttribute('fill'))"
                )
            )

        def choose(name: str, seen: str) -> None:
            page.page.get_by_role("button", name="Colours:").click()
            page.page.get_by_role("menuitem", name=name, exact=True).click()
            deadline = 200
            while seen not in colours() and deadline:
                page.page.wait_for_timeout(100)
                deadline -= 1
            assert seen in colours()

        choose("night", "#ffe9b0")
        assert page.picture() == drawing
        page.page.get_by_role("button", name="Colours: night").wait_for()
        downloaded = page.download("svg").read_bytes()
        command = ["compile", str(recipe), "--colourway", "night", "-o", str(tmp_path / "out")]
        assert runner().invoke(cli, command).exit_code == 0
        assert downloaded == (tmp_path / "out" / "mine-night.svg").read_bytes()
        choose("as written", "#f4efe2")
        page.page.get_by_role("button", name="Colours: as written").wait_for()
        assert not page.errors
