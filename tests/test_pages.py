"""What the pages say can be typed: calls are made as they stand, Python is run, figures are drawn again."""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path

import click
import pytest

from batik_vector.command.cli import cli
from tests.calling import runner
from tests.thorough import examples, long
from tools import site

ROOT = Path(__file__).resolve().parent.parent
DOCS = ROOT / "docs"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
PAGES = sorted(path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md"))
DONE = ["tutorial.md", *(each for each in PAGES if each.startswith("howto/"))]
"""Pages whose every line is done, in a folder of its own; of the others calls are read, and not made."""
FIGURES = sorted(path.stem for path in (DOCS / "figures").glob("*.toml"))


def calls(page: Path) -> Iterator[str]:
    """Yield the calls of a page, of lines with pipes those behind them too."""
    for kind, text in BLOCK.findall(page.read_text(encoding="utf-8")):
        if kind == "sh":
            for line in re.sub(r"\\\n\s*", " ", text).splitlines():
                for part in re.split(r" \| | && ", line.partition("  #")[0]):
                    if part.strip().startswith("batik-vector "):
                        yield part.strip()


def read(line: str) -> None:
    """Let the command read a call as it would, without making it: its options and its arguments are known."""
    words = list(takewhile(lambda word: word not in ("<", ">"), shlex.split(line, comments=True)))[1:]
    command: click.Command = cli
    context = cli.make_context("batik-vector", words, resilient_parsing=False) if words else None
    while isinstance(command, click.Group):
        known = [word for word in words if word in command.commands]
        if not known:
            return
        at = words.index(known[0])
        command, words = command.commands[known[0]], words[at + 1 :]
        if not isinstance(command, click.Group):
            command.make_context(known[0], words, parent=context)


@pytest.mark.parametrize("page", [each for each in PAGES if each not in DONE])
def test_what_a_page_calls_is_known(page: str) -> None:
    for line in calls(DOCS / page):
        try:
            read(line)
        except click.exceptions.Exit:
            pass
        except click.ClickException as error:
            raise AssertionError(f"{page}: {line}: {error.format_message()}") from error


def at_work(folder: Path, page: str) -> Path:
    """Return a folder with the samples in it, as whoever reads the page has them."""
    folder.mkdir(exist_ok=True)
    shutil.copytree(ROOT / "samples", folder / "samples", ignore=shutil.ignore_patterns("*.png"))
    return folder


@long
@pytest.mark.parametrize("page", DONE[: examples(1, len(DONE))])
def test_what_a_page_says_can_be_typed(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(at_work(tmp_path / "work", page))
    made: dict[str, object] = {}
    told = ""
    for kind, text in BLOCK.findall((DOCS / page).read_text(encoding="utf-8")):
        if kind == "python":
            exec(compile(text, page, "exec"), made)
        elif kind == "text":
            assert text.strip() in told
        elif kind == "toml":
            told += recipe_of(page, text)
        elif kind == "sh":
            told = "".join(done(line) for line in text.splitlines() if line.startswith("batik-vector"))


def recipe_of(page: str, text: str) -> str:
    """Use a recipe that a page shows: added to the one it is about, or compiled by itself."""
    if page == "tutorial.md":
        with Path("cloth.toml").open("a", encoding="utf-8") as file:
            file.write("\n" + text)
        return ""
    if "[[place]]" in text:
        Path("shown.toml").write_text(text, encoding="utf-8")
        return done("batik-vector compile shown.toml") + done("batik-vector check shown.toml")
    # A table by itself: in place of the same in a recipe that has one.
    own = re.sub(
        r"^\[tile\]\n(?:.+\n)*", "", Path("samples/four-square.toml").read_text(encoding="utf-8"), flags=re.M
    )
    Path("shown.toml").write_text(own + "\n" + text, encoding="utf-8")
    return done("batik-vector compile shown.toml --dry-run")


def done(line: str) -> str:
    """Make a call, into a file where it says so, and return what was told of it."""
    words = shlex.split(line, comments=True)[1:]
    target = ""
    if ">" in words:
        at = words.index(">")
        words, target = words[:at], words[at + 1]
    result = runner().invoke(cli, words)
    # What a machine would fail at is told by the audit.
    expected = {2} if "# fails" in line else {0, 1} if "--machine" in words and words[0] == "check" else {0}
    assert result.exit_code in expected, (line, result.stderr)
    if target:
        Path(target).write_bytes(result.stdout_bytes)
    return result.stdout + result.stderr


@long
@pytest.mark.parametrize("name", FIGURES[-examples(2, len(FIGURES)) :])
def test_figures_are_what_the_program_draws(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    done(f"batik-vector compile docs/figures/{name}.toml -f svg -o {tmp_path}")
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
