"""Variations are tried before one goes on from them, as ``batik-vector random`` tries those that it keeps."""

from __future__ import annotations

from itertools import islice

from batik_vector.errors import RecipeError
from batik_vector.studio.asking import View
from batik_vector.studio.changes import variations
from batik_vector.studio.drafts import Draft
from batik_vector.studio.pictures import Picture, Pictures

SMALL = View("tile", tolerance=0.4)
"""How small pictures are looked at."""
GLANCE = View("tile", tolerance=0.4, floor=True)
"""How a variation is looked at first: it costs little more, and nearly all that is left holds."""
TRIAL = View("tile", tolerance=0.0, certify=True, floor=True)
"""How it is tried: as the command does, at the recipe's own tolerance."""
LIMIT = 15.0
"""Seconds that a variation may take."""
TRIES = 20
"""Variations tried for one that holds."""


def lack_of(picture: Picture) -> str:
    """Return in words what a variation lacks that was looked at so, or nothing."""
    if picture.faults:
        return picture.faults[0].message
    told = picture.verdict
    if told.get("lack"):
        return str(told["lack"])
    return "" if told.get("passed", True) else str(told["faults"][0]["words"])


async def held(pictures: Pictures, draft: Draft, seed: int, reach: float = 0.5) -> Draft | None:
    """Return the first of a draft's variations that holds; None where a newer one was asked for meanwhile.

    Raises:
        RecipeError: where there is no number to vary, or none holds.
    """
    lack = ""
    for each in islice(variations(draft, seed, reach), TRIES):
        picture = await pictures.ask(each, TRIAL, lane="\0variation", limit=LIMIT)
        if picture is None:
            return None
        if not (lack := lack_of(picture)):
            return each
    raise RecipeError(f"of {TRIES} variations none holds on cloth, the last one for: {lack}")
