"""What the pages say of vpype and of notebooks is done by these."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from tests.clients import programs
from tests.pages.doing import NEEDS, done, stage
from tests.pages.reading import PAGES, bare, blocks, calls

pytestmark = pytest.mark.clients


@pytest.mark.parametrize(
    "page", [page for page in PAGES if any("vpype batik " in line for line in calls(page))]
)
def test_vpype_does_what_a_page_says(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    stage(page)
    for line in calls(page):
        if line.startswith("batik-vector new ") and "mine" in line:
            done(line)
        elif line.startswith("vpype batik "):
            words = shlex.split(bare(line))
            programs.run(programs.VPYPE, *words[1:], home=tmp_path)
            assert Path(words[-1]).stat().st_size > 1000


def test_a_notebook_does_what_a_page_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (needs,) = NEEDS
    (page,) = (each for each in PAGES if any(needs in block.text for block in blocks(each)))
    stage(page)
    (text,) = (block.text for block in blocks(page) if needs in block.text)
    shown = re.sub(r"\n(.+)\n$", r"\nprint(type(\1).__name__, \1.artwork.vertex_count)\n", text)
    told = programs.run(programs.VPYPE_PYTHON, "-c", shown, home=tmp_path)
    assert re.search(r"^\w+ \d+$", told, re.M)
