"""What the page for newcomers and README's first recipe say can be typed, and shows what they show."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest
import shapely

from batik_vector import certify, compile_recipe, load_recipe
from batik_vector.command.cli import cli
from tests.calling import runner
from tests.clients.programs import run

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "first-five-minutes.md").read_text("utf-8")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def plain(words: str) -> str:
    """Return words without what differs from machine to machine and from one version to the next."""
    return re.sub(r"[\d.,]+ (kB|s|vertices)", r"N \1", words)


def typed(folder: Path) -> Iterator[tuple[str, str]]:
    """Do what the page says, and yield what it shows next to what was told."""
    told = ""
    for kind, text in BLOCK.findall(PAGE):
        if kind == "toml":
            with (folder / "mine.toml").open("a", encoding="utf-8") as file:
                file.write("\n" + text)
        elif kind == "text":
            yield text, told
        else:
            told = "".join(call(line) for line in text.splitlines() if line.startswith("batik-vector"))


def call(line: str) -> str:
    words = shlex.split(line, comments=True)
    result = runner().invoke(cli, words[1:])
    assert result.exit_code == (2 if "# fails" in line else 0), (line, result.stderr)
    return result.stdout + result.stderr


def test_the_first_five_minutes_go_as_the_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    shown = list(typed(tmp_path))
    assert len(shown) == 3
    for text, told in shown:
        for line in text.splitlines():
            assert plain(line) in plain(told).splitlines()
    assert (tmp_path / "again" / "mine.svg").read_bytes() == (tmp_path / "mine.svg").read_bytes()
    svg = (tmp_path / "mine.svg").read_text("utf-8")
    for name in ('"1 soga"', '"2 cotton"', '"%99 cloth"', '"kawungFruit1"', '"60mm"'):
        assert name in svg


@pytest.mark.clients
def test_its_file_opens_in_inkscape(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for line in ("batik-vector new mine --kind kawung", "batik-vector compile mine.toml"):
        assert line in PAGE
        call(line)
    objects = run("inkscape", "--query-all", tmp_path / "mine.svg", home=tmp_path)
    assert "\nsoga,0,0,226.772,226.772" in objects, "60 mm, in pixels of 96 to the inch"
    assert "\nkawungFruit1," in objects


def test_the_recipe_that_the_readme_shows_is_a_cloth(tmp_path: Path) -> None:
    text = next(
        text
        for kind, text in BLOCK.findall((ROOT / "README.md").read_text("utf-8"))
        if kind == "toml" and text.startswith("title")
    )
    (tmp_path / "readme.toml").write_text(text, "utf-8")
    artwork = compile_recipe(load_recipe(tmp_path / "readme.toml"))
    certificate = certify(artwork)
    assert certificate.passed, certificate.faults
    covered = sum(shapely.area(layer.areas).sum() for layer in artwork.layers)
    assert 0.4 < covered / (artwork.cell.width * artwork.cell.height) < 0.7
