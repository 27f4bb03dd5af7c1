"""The paper's six flowers, saved again by Inkscape: their rows stay."""

from __future__ import annotations

from pathlib import Path

import pytest

from batik_vector import analyse
from tests.analysis.drawings import TABLE_2, bare_svg, flower
from tests.clients import programs


@pytest.mark.clients
@pytest.mark.parametrize("bezier", [False, True])
@pytest.mark.parametrize("number", TABLE_2)
def test_what_inkscape_saved_has_the_same_row(number: int, bezier: bool, tmp_path: Path) -> None:
    svg = tmp_path / "flower.svg"
    moved = "translate(190 24) rotate(37.3) scale(0.61)"
    svg.write_bytes(bare_svg(flower(number), bezier=bezier, placed=moved, page=400))
    saved = programs.inkscape_saved(svg)
    assert saved.read_bytes() != svg.read_bytes()
    assert str(analyse(saved)) == TABLE_2[number]
