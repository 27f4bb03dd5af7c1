"""The documentation site in a browser."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.clients.studio import browser

pytestmark = pytest.mark.clients

SITE = Path(__file__).resolve().parents[2] / "out" / "site"
DESK = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    if not (SITE / "index.html").exists():
        pytest.fail("the site is not there: make site writes it")
    with browser() as found:
        yield found


def test_a_stranger_finds_how_to_cut_vinyl_in_two_clicks(chromium: Any) -> None:
    page = chromium.new_page(viewport=DESK)
    page.goto((SITE / "index.html").as_uri())
    row = page.locator("article tr", has_text="vinyl")
    # A row has its picture, which is a link too, and the page's name.
    row.get_by_role("link", name="For the cutter").click()
    page.locator(".toc-tree a", has_text="Vinyl").click()
    assert page.url.endswith("#vinyl")
    assert "--machine vinyl-cutter" in page.locator("section#vinyl pre").first.inner_text()


@pytest.mark.parametrize("name", ["index", "howto/cutter", "mathematics", "gallery", "recipe"])
def test_a_page_is_whole_on_a_phone(chromium: Any, name: str) -> None:
    page = chromium.new_page(viewport=PHONE)
    failed = list[str]()
    page.on("requestfailed", lambda request: failed.append(request.url))
    page.on("pageerror", lambda error: failed.append(str(error)))
    page.goto((SITE / f"{name}.html").as_uri())
    assert failed == []
    assert page.evaluate("[...document.images].every(each => !each.complete || each.naturalWidth > 0)")
    # Tables and code scroll in themselves; the page does not.
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
