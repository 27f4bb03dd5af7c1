"""Colours that a palette gives a draft.

They are shown as they look, and the first one that is set by hand takes all of them into the recipe.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from batik_vector.recipe.references import Path
from batik_vector.studio.drafts import Draft, Where, parsed


def worn(draft: Draft) -> Mapping[Path, str]:
    """Return the colours that a palette gives inks and cloth, by their paths; nothing where there is none."""
    if draft.faults or not draft.tables.get("palette"):
        return {}
    recipe = draft.recipe
    given: dict[Path, str] = {("ink", name, "colour"): str(ink.colour) for name, ink in recipe.ink.items()}
    return {("cloth", "colour"): str(recipe.cloth.colour), **given}


def set_by_hand(draft: Draft, path: Where, value: Any) -> Draft:
    """Return a draft with a value set; where a palette gives its colours, all are the recipe's own then.

    Raises:
        RecipeError: where it cannot be set.
    """
    where = parsed(path)
    given = worn(draft)
    if where not in given or value is None:
        return draft.with_value(path, value)
    free = draft.without(("palette",))
    return free.with_values(list({**given, where: value}.items()))
