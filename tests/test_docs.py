"""The pages are made from the program, and the README's claims can be typed."""

from __future__ import annotations

from pathlib import Path

from tools import house, reference

ROOT = Path(__file__).resolve().parent.parent


def test_the_page_on_recipes_is_up_to_date() -> None:
    assert reference.PAGE.read_text(encoding="utf-8") == reference.page(), "run make docs"


def test_the_page_on_the_house_is_up_to_date() -> None:
    assert house.PAGE.read_text(encoding="utf-8") == house.page(), "run make docs"
    assert house.PICTURE.read_text(encoding="utf-8") == house.picture(), "run make docs"


def test_pictures_and_pages_that_the_readme_names_exist() -> None:
    import re

    text = (ROOT / "README.md").read_text(encoding="utf-8")
    named = re.findall(r"\]\(([^)#:]+)\)|src=\"([^\"]+)\"", text)
    assert named
    for link in (a or b for a, b in named):
        assert (ROOT / link).exists(), link


def test_the_readme_shows_its_two_commands_in_the_first_screen() -> None:
    first = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()[:40]
    assert "make demo" in "\n".join(first)
    assert "make test" in "\n".join(first)
