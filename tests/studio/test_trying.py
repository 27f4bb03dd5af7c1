"""Variations are tried as the command tries them: those that one goes on from hold on cloth."""

from __future__ import annotations

import asyncio

import pytest

from batik_vector.errors import RecipeError
from batik_vector.studio.changes import variations
from batik_vector.studio.drafts import Draft
from batik_vector.studio.page.trying import GLANCE, TRIAL, held, lack_of
from batik_vector.studio.pictures import Picture, Pictures
from batik_vector.studio.views import Looker
from tests.studio.test_changes import SAMPLES
from tests.thorough import slow

KAWUNG = Draft.read(SAMPLES / "kawung.toml")
SLIT = """
title = "Squares that nearly meet"
[cloth]
colour = "#1d2f5f"
[ink.wax]
colour = "#7d9cc0"
[motif.square]
kind = "path"
d = "M-10 -10H10V10H-10Z"
[[place]]
motif = "square"
scale = 1
at = [10.02, 30]
[[place]]
motif = "square"
scale = 1
at = [50, 30]
[tile]
size = [60, 60]
"""
"""Across the seam two squares leave a slit between them."""
SAID = "a slit of bare ground 0.02 mm wide runs 20 mm along the left edge"


def tried(draft: Draft, *, trial: bool = True) -> str:
    view = TRIAL if trial else GLANCE
    shown = Looker().look(draft, view)
    return lack_of(Picture(draft, view, shown.svg.encode(), shown.facts, shown.verdict, shown.faults))


def test_what_a_variation_lacks_is_told_at_a_glance() -> None:
    assert tried(KAWUNG) == tried(KAWUNG, trial=False) == ""
    poor = next(variations(KAWUNG, 0))
    assert tried(poor) == "covers 87% of the tile, expected 12% to 85%"
    assert tried(poor, trial=False)


def test_a_seam_that_fails_and_what_does_not_compile_are_lacks_too() -> None:
    assert tried(Draft(SLIT)).endswith(SAID)
    assert tried(Draft("title = 3"))


def test_the_first_variation_that_holds_is_gone_on_from() -> None:
    async def twice() -> list[Draft | None]:
        async with Pictures() as pictures:
            return [await held(pictures, KAWUNG, 0) for _ in range(2)]

    one, again = asyncio.run(twice())
    assert one is not None
    assert one == again
    assert one not in (KAWUNG, next(variations(KAWUNG, 0)))
    assert tried(one) == ""


@slow
def test_where_none_holds_that_is_said() -> None:
    scales = [(f"place[{number}].scale", 0.01) for number in range(len(KAWUNG.tables["place"]))]

    async def ask() -> None:
        async with Pictures() as pictures:
            await held(pictures, KAWUNG.with_values(scales), 0)

    with pytest.raises(RecipeError, match="none holds on cloth"):
        asyncio.run(ask())
