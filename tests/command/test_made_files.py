"""What a call of ``compile`` sets for all files: machines, processes, pages and the room around."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import Result

from batik_vector.command.cli import cli
from tests.calling import runner

RECIPE = """
[motif.square]
kind = "flower"
petal = { count = 8, length = 1.0 }

[ink.wax]

[[place]]
motif = "square"
ink = "wax"
width = "60 mm"

[tile]
size = ["80 mm", "80 mm"]
"""


def _compiled(folder: Path, *more: str, text: str = RECIPE) -> Result:
    (folder / "r.toml").write_text(text, "utf-8")
    return runner().invoke(cli, ["compile", str(folder / "r.toml"), "-o", str(folder / "out"), *more])


def _files(folder: Path) -> list[str]:
    return sorted(path.name for path in (folder / "out").glob("*"))


def test_a_drawing_larger_than_the_page_is_divided_where_the_call_says_so(tmp_path: Path) -> None:
    large = RECIPE.replace("80 mm", "700 mm")
    calls = ("-f", "hpgl", "--machine", "hp7475a")
    refused = _compiled(tmp_path, *calls, text=large)
    assert refused.exit_code != 0
    assert 'pages = "tile"' in refused.stderr
    assert _compiled(tmp_path, *calls, "--pages", "tile", text=large).exit_code == 0
    assert "r-p1x1.hpgl" in _files(tmp_path)
    assert len(_files(tmp_path)) > 4


def test_what_is_cut_beside_the_drawing_asks_for_a_margin_that_the_call_can_give(tmp_path: Path) -> None:
    calls = ("-f", "hpgl,svg", "--machine", "vinyl-cutter", "--process", "cut")
    filling = RECIPE.replace("60 mm", "79 mm")
    refused = _compiled(tmp_path, *calls, text=filling)
    assert refused.exit_code != 0
    assert "beyond the origin" in refused.stderr
    assert not _files(tmp_path)
    margin = refused.stderr.split('margin = "')[1].split('"')[0]
    assert _compiled(tmp_path, *calls, "--margin", margin, text=filling).exit_code == 0
    words = (tmp_path / "out" / "r.hpgl").read_text("ascii")
    assert "-" not in words.split("SP1;")[1]


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (("--pages", "tile"), "--pages: no file that is made has it"),
        (("--margin", "2mm"), "--margin: no file that is made has it"),
        (("-f", "hpgl", "--margin", "wide"), "--margin: margin"),
        (("-f", "hpgl", "--margin", "-1 mm"), "--margin: margin"),
        (
            ("--machine", "vinyl-cutter", "--process", "cut blade_offset=0 swivel=90"),
            "process.swivel: 90, expected blade_offset, or a machine with a drag knife, beside it",
        ),
    ],
)
def test_what_does_nothing_is_told(tmp_path: Path, more: tuple[str, ...], words: str) -> None:
    done = _compiled(tmp_path, *more)
    assert done.exit_code != 0
    assert words in done.stderr
    assert not _files(tmp_path)


def test_a_profile_that_is_no_text_is_told_as_a_profile(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_bytes(b'base = "pen-plotter"\nsays = "caf\xe9"\n')
    done = _compiled(tmp_path, "--machine", str(tmp_path / "mine.toml"))
    assert "mine.toml:2: is no text in UTF-8, expected a machine's profile in TOML" in done.stderr
