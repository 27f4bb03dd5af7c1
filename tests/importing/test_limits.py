"""No file, however it is made, takes the reader more time or memory than a drawing of its size is worth."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from batik_vector.importing import polylines, walk
from batik_vector.importing.svg import DrawingError, read_svg, read_tile
from tests.importing.drawings import DISC, svg

BARE_BOMB = (
    "".join(f'<g id="b{i}">' + f'<use href="#b{i + 1}"/>' * 10 + "</g>" for i in range(9))
    + '<g id="b9"><path d="M0 0" fill="none"/></g>'
)
ENDLESS = {
    "url": f'<rect width="3" height="3" fill="url({" " * 2000}x"/>',
    "arc": f'<path d="M0 0A{"2" * 400}"/>',
    "points": f'<polygon points="{"1" * 100_000}"/>',
    "length": f'<rect width="{"1" * 60_000}m" height="1"/>',
    "transform": f'<g transform="translate(1){" " * 60_000}x"/>',
    "selector": f"<style>{'g ' * 30}rect{{fill:red}}</style>{'<g>' * 150}<rect/>{'</g>' * 150}",
}


def test_uses_of_what_is_not_painted_come_to_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(walk, "MAX_WORK", 5000)
    with pytest.raises(DrawingError, match="more than 5,000 elements, once every use in it is followed"):
        read_tile(svg(f"<defs>{BARE_BOMB}</defs><use href='#b0'/>{DISC}"))


def test_no_text_takes_the_reader_for_ever(tmp_path: Path) -> None:
    """In a process of its own, since a regular expression that goes astray cannot be interrupted."""
    paths = []
    for name, inner in ENDLESS.items():
        paths.append(tmp_path / f"{name}.svg")
        paths[-1].write_bytes(svg(inner + DISC))
    script = (
        "import contextlib, sys\n"
        "from batik_vector.importing.svg import DrawingError, read_tile\n"
        "for path in sys.argv[1:]:\n"
        "    print(path, flush=True)\n"
        "    with contextlib.suppress(DrawingError):\n"
        "        read_tile(path)\n"
    )
    subprocess.run([sys.executable, "-c", script, *map(str, paths)], check=True, timeout=60)


@pytest.mark.parametrize(
    ("rule", "kept"),
    [
        ("g > g > g > g > circle", True),
        ("g g g g g circle", False),
        (":is(g g g, a) :not(g g, a) circle", False),
        ('circle[class="a b c d e f g h"], circle', True),
    ],
)
def test_selectors_of_many_steps_are_passed_over_and_told(rule: str, kept: bool) -> None:
    style = f"<style>{rule.replace('>', '&gt;')} {{ fill: red }}</style>"
    reading = read_svg(svg(style + "<g>" * 5 + DISC + "</g>" * 5))
    assert (reading.artwork.layers[0].ink.colour == "#ff0000") == kept
    assert any("steps" in note for note in reading.notes) != kept


def test_selectors_that_many_elements_would_try_are_passed_over() -> None:
    style = "<style>g ~ g ~ circle { fill: red }</style>"
    reading = read_svg(svg(style + "<g/>" * 1500 + DISC * 200))
    assert any("too long to match" in note for note in reading.notes)


def test_curves_of_too_many_points_are_refused_beforehand(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(polylines, "MAX_CURVED", 1000)
    assert read_tile(svg(DISC)).layers
    with pytest.raises(DrawingError, match=r"curves come to [\d,]+ points, expected at most 1,000"):
        read_tile(svg(DISC * 20))


def test_a_drawing_of_hundreds_of_colours_is_a_tracing() -> None:
    discs = [f'<circle cx="{i % 20 * 5}" cy="{i // 20 * 5}" r="1" fill="#{i:06x}"/>' for i in range(301)]
    assert len(read_tile(svg("".join(discs[:-1]))).layers) == 300
    with pytest.raises(DrawingError, match=r"a drawing of 301 inks .* is a tracing"):
        read_tile(svg("".join(discs)))
