"""Tiles that Inkscape has saved are certified as before: whole ones pass, broken ones fail where they did."""

from __future__ import annotations

from pathlib import Path

import pytest

from batik_vector.artwork import Artwork
from batik_vector.command.checks import Found, Wishes, check_source
from batik_vector.export import SvgOptions, render
from batik_vector.importing.svg import read_tile
from tests.clients import programs
from tests.clients.drawings import shared_out

TILES = Path(__file__).parents[1] / "certificate" / "broken"
SAVED = {
    "plain": ["--export-plain-svg"],
    "its own": ["--export-type=svg"],
    "as paths": ["--actions=select-all:all;object-to-path;export-plain-svg"],
    "turned": ["--actions=select-all:all;transform-rotate:90;export-plain-svg"],
}
"""Ways of saving. The tile has a centre of fourfold rotation in the middle of its page."""


def saved(svg: Path, folder: Path, way: str) -> Path:
    """Return a drawing as Inkscape saves it."""
    out = folder / "saved.svg"
    arguments = list(SAVED[way])
    if arguments[0].startswith("--actions"):
        arguments = [f"{arguments[0]};export-filename:{out};export-do"]
    else:
        arguments.append(f"--export-filename={out}")
    programs.run("inkscape", *arguments, svg, home=folder)
    return out


def found(path: Path) -> Found:
    return check_source(str(path), (), Wishes(group="p4", limits={"double": 0.005}))


@pytest.mark.clients
@pytest.mark.parametrize("way", SAVED)
def test_a_whole_tile_passes_as_inkscape_saves_it(tmp_path: Path, way: str) -> None:
    facts = found(saved(TILES / "good.svg", tmp_path, way))
    assert facts.passed, facts.certificate.faults
    assert facts.certificate.worst.crossings == 12


@pytest.mark.clients
@pytest.mark.parametrize("name", ["edge-moved", "gap", "short-line", "wrong-ink", "duplicate"])
def test_a_broken_tile_fails_as_inkscape_saves_it(tmp_path: Path, name: str) -> None:
    before, after = found(TILES / f"{name}.svg"), found(saved(TILES / f"{name}.svg", tmp_path, "as paths"))
    told = [[(fault.kind, fault.ink) for fault in each.certificate.faults] for each in (before, after)]
    assert told[0] == told[1]
    assert not after.passed


@pytest.mark.clients
@pytest.mark.parametrize(("drawing", "way"), shared_out(["plain", "its own"]), indirect=["drawing"])
def test_our_own_drawings_come_back_to_the_bit(drawing: Artwork, tmp_path: Path, way: str) -> None:
    svg = tmp_path / "drawing.svg"
    svg.write_bytes(render(drawing, "svg", SvgOptions()))
    ours, theirs = read_tile(svg), read_tile(saved(svg, tmp_path, way))
    assert ours.cell == theirs.cell
    for one, other in zip(ours.layers, theirs.layers, strict=True):
        assert one.ink.colour == other.ink.colour
        assert [each.wkb for each in one.areas] == [each.wkb for each in other.areas]
        assert [each.wkb for each in one.lines] == [each.wkb for each in other.lines]
