"""What the pages say can be typed, shows what they show, and leads where they point."""

from __future__ import annotations

import re
from pathlib import Path

import click
import pytest

from tests.pages.doing import OUTSIDE, READ_ALONE, called, do, read
from tests.pages.reading import DOCS, PAGES, ROOT, bare, blocks, calls
from tests.thorough import examples, long
from tools import site

KINDS = {"sh", "console", "text", "toml", "python", "said"}
FIGURES = sorted(path.stem for path in (DOCS / "figures").glob("*.toml"))
DONE = sorted((page for page in PAGES if blocks(page)), key=lambda page: page != "command.md")
"""Pages that show anything; the first is done in the quick suite, too."""


@pytest.mark.parametrize("page", PAGES)
def test_whatever_a_page_shows_is_of_a_kind_that_is_tried(page: str) -> None:
    text = (DOCS / page).read_text(encoding="utf-8")
    fenced = [block for block in blocks(page) if block.kind != "said"]
    assert {block.kind for block in blocks(page)} <= KINDS, "a block of another kind would be passed over"
    assert len(re.findall(r"^\s*(```|~~~)", text, re.M)) == 2 * len(fenced), "a block that is not seen"
    outside = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    assert not re.search(r"\n\n {4,}(?![-*\d|])\S", outside), "a block by indenting would be passed over"


@pytest.mark.parametrize("page", DONE)
def test_what_a_page_calls_is_known(page: str) -> None:
    for line in calls(page):
        for part in re.split(r" \| | && ", bare(line)):
            if part.startswith("batik-vector "):
                try:
                    read(part)
                except click.exceptions.Exit:
                    pass
                except click.ClickException as error:
                    raise AssertionError(f"{page}: {line}: {error.format_message()}") from error


def test_what_is_not_done_stands_on_a_page() -> None:
    said = {bare(line) for page in PAGES for line in calls(page)}
    assert set(OUTSIDE) <= said
    assert all(any(re.match(begins, line) for line in said) for begins in READ_ALONE)


@long
@pytest.mark.parametrize("page", DONE[: examples(1, len(DONE))])
def test_what_a_page_says_can_be_done(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("BATIK_LIBRARY", str(tmp_path / "patterns.batik-library"))
    do(page)


@long
@pytest.mark.parametrize("name", FIGURES[-examples(2, len(FIGURES)) :])
def test_figures_are_what_the_program_draws(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    called(f"batik-vector compile docs/figures/{name}.toml -f svg -o {tmp_path}", {0})
    assert (tmp_path / f"{name}.svg").read_bytes() == (DOCS / "figures" / f"{name}.svg").read_bytes()


def test_vinyl_is_two_clicks_from_the_first_page() -> None:
    first = (DOCS / "index.md").read_text(encoding="utf-8")
    (row,) = (line for line in first.splitlines() if "vinyl" in line)
    (link,) = re.findall(r"\]\(([^)]+)\)", row)
    assert "\n## Vinyl\n" in (DOCS / link).read_text(encoding="utf-8")


@pytest.mark.parametrize("page", PAGES)
def test_links_of_a_page_lead_somewhere(page: str) -> None:
    path = DOCS / page
    text = path.read_text(encoding="utf-8")
    for target in [each[2] for each in site.LINK.findall(text)] + [
        each[1] for each in site.PICTURE.findall(text)
    ]:
        if not re.match(r"[a-z]+:|#", target):
            name, _, anchor = target.partition("#")
            there = path.parent / name
            assert there.exists(), f"{page}: {target}"
            if anchor and there.suffix == ".md":
                heads = re.findall(r"^#+ (.+)$", there.read_text(encoding="utf-8"), re.MULTILINE)
                assert anchor in {slug(head) for head in heads}, f"{page}: {target}"


def slug(head: str) -> str:
    """Return the anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-")
