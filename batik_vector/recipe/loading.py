"""A page of TOML becomes a :class:`~batik_vector.recipe.model.Recipe`, or every fault is told at once.

Text is read by tomllib and built into the dataclasses of :mod:`batik_vector.recipe.model`. Only where that
fails is pydantic asked what is wrong, and the line of each key looked up.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from batik_vector.errors import Fault, MachineProfileError, RecipeError
from batik_vector.fields import brought_by, given
from batik_vector.recipe.drawing import Svg
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.builder import UnsureError, built
from batik_vector.recipe.reading.sources import is_compiled, parted, read_text, scheme_of, with_carried
from batik_vector.recipe.reading.tables import tables_of

if TYPE_CHECKING:
    from batik_vector.recipe.reading.overrides import Override

EMPTY = 'a recipe: "batik-vector new" writes one to begin with'


KEPT_TEXT = 100_000
"""Characters of a text whose tables are remembered: a sweep reads one recipe a thousand times."""


@functools.lru_cache(maxsize=4)
def _tables(text: str, source: str) -> dict[str, Any]:
    return tables_of(text, source, EMPTY)


def load_recipe(path: str | os.PathLike[str], overrides: Sequence[str] = ()) -> Recipe:
    """Read a recipe from its file, from an SVG, PDF, DXF, HPGL or PNG compiled from it, or the library.

    Args:
        path: of the file; or ``library:NAME``, or ``library:NAME@3`` for one of its versions.
        overrides: values to set in it, each as ``KEY=VALUE``.

    Raises:
        RecipeError: with everything that is wrong.
        LibraryError: where the library has no such pattern, or cannot be read.
    """
    given(path, str | os.PathLike, "path")
    source = os.fspath(path)
    folder = None if scheme_of(source)[0] else os.path.dirname(source) or "."
    return read_recipe(read_text(path), source=source, overrides=overrides, folder=folder)


def read_recipe(
    text: str,
    source: str = "recipe",
    overrides: Sequence[str] = (),
    folder: str | os.PathLike[str] | None = None,
    drawings: Mapping[str, str] | None = None,
) -> Recipe:
    """Read a recipe from TOML text.

    Args:
        text: the recipe.
        source: what faults call it.
        overrides: values to set in it, each as ``KEY=VALUE``.
        folder: where the drawings stand that it names; without it those alone are known that it carries.
        drawings: SVGs by the names of their files, for the recipe to carry; see :attr:`Recipe.drawing`.

    Raises:
        RecipeError: with everything that is wrong.
    """
    given(text, str, "text")
    given(source, str, "source")
    given(overrides, tuple[str, ...], "overrides")
    given(folder, str | os.PathLike | None, "folder")
    given(drawings, Mapping[str, str] | None, "drawings")
    text, carried = parted(text.replace("\r\n", "\n"))
    carried |= drawings or {}
    written = text
    # Only what stands at the top is changed below.
    data = dict(_tables(text, source) if len(text) <= KEPT_TEXT else tables_of(text, source, EMPTY))
    changes: list[Override] = []
    if overrides:
        from batik_vector.recipe.reading.overrides import overridden, parse_override

        text, data, changes = overridden(text, data, [parse_override(each) for each in overrides])
    if carried and isinstance(data.setdefault("drawing", {}), dict):
        data["drawing"] = carried | data["drawing"]
        text = with_carried(text, carried)
    try:
        recipe = built(Recipe, data, source=text)
    except UnsureError:
        from batik_vector.recipe.reading.validator import placed, validated

        found_recipe, found = validated(data, Recipe)
        if found_recipe is None:
            _refuse_profile(data, source)
            raise RecipeError(placed(found, source, written, changes)) from None
        recipe = replace(found_recipe, source=text)
    if plugins := brought_by([recipe]):
        recipe = replace(recipe, plugins=plugins)
    return _drawn(recipe, folder, source, written, overrides)


def _refuse_profile(data: Mapping[str, Any], source: str) -> None:
    """Say so where tables are a machine's profile: of its keys a recipe knows none."""
    from batik_vector.recipe.reading.machines import is_profile

    if is_profile(data):
        words = 'is the profile of a machine, expected a recipe: "machine" in its [[output]] names a profile'
        raise MachineProfileError([Fault(words, source=source)])


def _drawn(
    recipe: Recipe,
    folder: str | os.PathLike[str] | None,
    source: str,
    written: str,
    overrides: Sequence[str],
) -> Recipe:
    """Return a recipe with the drawings and the machines that it names."""
    place = None if folder is None else os.fspath(folder)
    try:
        if any(isinstance(motif, Svg) for motif in recipe.motif.values()):
            from batik_vector.recipe.reading.drawings import with_drawings

            recipe = with_drawings(recipe, place)
        if any(output.machine for output in recipe.output):
            from batik_vector.recipe.reading.machines import with_machines

            recipe = with_machines(recipe, place)
        if any(getattr(output, "icc", "") for output in recipe.output):
            from batik_vector.recipe.reading.presses import with_presses

            recipe = with_presses(recipe, None if is_compiled(source) else place)
        if recipe.palette:
            from batik_vector.recipe.recolouring import in_palette

            recipe = in_palette(recipe, recipe.palette)
    except RecipeError as error:
        raise located(error, source, written, overrides) from error
    return recipe


def located(error: RecipeError, source: str, text: str, overrides: Sequence[str] = ()) -> RecipeError:
    """Return an error of a later stage with file and line in the faults that have none yet."""
    from batik_vector.recipe.reading.validator import relocated

    return relocated(error, source, text, overrides)
