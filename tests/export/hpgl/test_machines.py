"""The machines that speak HP-GL: what their profiles say, and what the docs say of them."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from batik_vector.errors import GeometryError
from batik_vector.machines import MACHINES, shipped_text
from batik_vector.machines.hpgl import HpglPage
from batik_vector.machines.profile import Machine
from batik_vector.recipe.reading.machines import read_machine

SPEAKING = [name for name in MACHINES if "hpgl" in tomllib.loads(shipped_text(name))]
PAGE = (Path(__file__).parents[3] / "docs" / "machines.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", SPEAKING)
def test_every_number_has_a_source(name: str) -> None:
    written = tomllib.loads(shipped_text(name))
    sources = written["sources"]
    assert "hpgl.unit" in sources
    for key in ("page", "force"):
        if written["hpgl"].get(key):
            assert f"hpgl.{key}" in sources or "hpgl.speed" in sources
    assert not written["hpgl"].get("speed") or "hpgl.speed" in sources


@pytest.mark.parametrize("name", SPEAKING)
def test_the_docs_say_what_the_profile_says(name: str) -> None:
    (row,) = re.findall(rf"^\| `{name}`[^|]*\|(.*)\|$", PAGE, re.M)
    unit, counts, sheets, pens = (cell.strip() for cell in row.split("|"))
    device = read_machine(name).hpgl
    assert unit == f"{device.unit:g} mm"
    assert ("middle" in counts) == (device.origin == "centre")
    assert int(pens) == device.pens
    told = set(re.findall(r"\b(a\d|letter|roll|arch d)\b", sheets))
    assert told <= {page.name for page in device.page}


@pytest.mark.parametrize("name", [name for name in SPEAKING if name not in ("hpgl",)])
def test_what_it_reaches_is_its_largest_sheet(name: str) -> None:
    machine = read_machine(name)
    assert machine.size is not None
    longest = max(
        max(high - low for low, high in zip(page.low, page.high, strict=True)) for page in machine.hpgl.page
    )
    assert max(machine.size) == pytest.approx(longest * machine.hpgl.unit, rel=0.03)


def test_the_profile_in_the_docs_is_right(tmp_path: Path) -> None:
    (text,) = re.findall(r"```toml\n(# my-7580b.toml.*?)```", PAGE, re.S)
    (tmp_path / "mine.toml").write_text(text)
    device = read_machine(str(tmp_path / "mine.toml")).hpgl_device
    assert [page.name for page in device.page] == ["70 x 50"]
    assert device.unit == read_machine("hp7580b").hpgl.unit


def test_a_machine_without_sheets_has_one_of_its_size() -> None:
    (page,) = Machine(size=(420, 297)).hpgl_device.page
    assert page.high == (16800, 11880)
    (page,) = read_machine("pen-plotter").hpgl_device.page
    assert page.high == (16800, 11880)


def test_a_sheet_of_no_size_is_refused() -> None:
    with pytest.raises(GeometryError, match=r'page "x": high = \(0, 5\), expected more than low'):
        HpglPage(name="x", high=(0, 5))
