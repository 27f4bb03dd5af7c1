"""The menu: a draft turned, scaled, reset, duplicated, varied at random, or with something pasted in.

Each is a function from a draft to a draft. What is changed is a placement, a motif or the whole design, as
the path says.
"""

from __future__ import annotations

import copy
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from batik_vector.errors import Fault, RecipeError
from batik_vector.making.exploring import Knob, candidates, knobs
from batik_vector.recipe.reading.field_types import members
from batik_vector.recipe.reading.overrides import parse_override
from batik_vector.recipe.references import INK_KEYS, Path, dotted, ink_names, places, quoted
from batik_vector.studio.declared import MISSING, Place, class_of, inner, root
from batik_vector.studio.drafts import Draft, Where, parsed
from batik_vector.studio.offers import free_name
from batik_vector.studio.text.spelling import spelled_key
from batik_vector.units import parse_length

FILLING = ("toss", "pack", "stripes")
"""Layouts that fill the repeat, which no placement turns."""
SCALED = ("tile", "place", "motif", "ink", "border")
"""What of a design grows with it; the cloth's size and the tolerance stay."""
NEVER_RESET = frozenset({"motif", "name", "kind", "format", "file", "title", *INK_KEYS})
"""Keys that say what something is, not how it looks."""
NAMED = ("motif", "ink")


def turned(draft: Draft, degrees: float, path: Where = ()) -> Draft:
    """Return a draft with a placement turned about its own place; with all of them where none is named.

    Tosses and stripes stay: they fill the repeat.
    """
    for place in _placements(draft, path):
        table = draft.value(place)
        if not _fills(table):
            before = table.get("turn", 0)
            angle = (before if isinstance(before, int | float) else 0) + degrees
            draft = draft.with_value((*place, "turn"), math.remainder(angle, 360) or 0)
    return draft


def scaled(draft: Draft, factor: float, path: Where = ()) -> Draft:
    """Return a draft with a placement scaled about its own place; without one, all with the tile.

    Raises:
        RecipeError: where the factor is none, or nothing is there.
    """
    if not (math.isfinite(factor) and 1e-3 <= factor <= 1e3):
        raise RecipeError([Fault(f"scaled by {factor:g}, expected 0.001 to 1000")])
    where = parsed(path) if path else ()
    if where:
        for place in _placements(draft, where):
            for key in ("width", "scale"):
                if (value := _length(draft.value((*place, key)))) is not None:
                    draft = draft.with_value((*place, key), value * factor)
        return draft
    lengths = [
        (each, value)
        for key in SCALED
        for each, value in _lengths(inner(root(draft.tables), key), (key,))
        if each[:2] != ("tile", "fit")
    ]
    return draft.with_values([(each, value * factor) for each, value in lengths])


def _lengths(place: Place | None, path: Path) -> Iterator[tuple[Path, float]]:
    """Yield the lengths that a recipe says, in mm."""
    if place is None or place.said is MISSING:
        return
    if isinstance(place.said, dict | list):
        for key in place.said if isinstance(place.said, dict) else range(len(place.said)):
            yield from _lengths(inner(place, key), (*path, key))
    elif place.hint.length and (value := _length(place.said)) is not None:
        yield path, value


def _length(said: Any) -> float | None:
    try:
        return None if said is None else parse_length(said)
    except ValueError:
        return None


def reset(draft: Draft, path: Where) -> Draft:
    """Return a draft with the numbers of a table as they are by default, which of a flower is the paper's.

    Names, inks, kinds and what is locked stay; so do tables that a recipe must have.
    """
    where = parsed(path)
    place: Place | None = root(draft.tables)
    for part in where:
        place = inner(place, part) if place is not None else None
    if place is None or place.said is MISSING:
        return draft
    for each in list(_resettable(place, where)):
        if not draft.is_locked(each):
            draft = draft.without(each)
    return draft


def _resettable(place: Place, path: Path) -> Iterator[Path]:
    """Yield the keys that may be left out; the deepest first, so that none is lost with what holds it."""
    cls = class_of(place)
    if cls is None:
        members_of = place.said if isinstance(place.said, dict) else range(len(place.said or ()))
        for key in members_of if isinstance(place.said, dict | list) else ():
            if (found := inner(place, key)) is not None and isinstance(found.said, dict):
                yield from _resettable(found, (*path, key))
        return
    for name, member in members(cls).items():
        found = inner(place, name)
        if found is None or found.said is MISSING or name in NEVER_RESET:
            continue
        if _holds_tables(found.said):
            yield from _resettable(found, (*path, name))
        elif not member.required and not _sized(path, name):
            yield (*path, name)


def _holds_tables(said: Any) -> bool:
    if isinstance(said, list):
        return any(isinstance(each, dict) for each in said)
    return isinstance(said, dict)


def _sized(path: Path, name: str) -> bool:
    """Return whether a key is one of a pair of which a placement needs either."""
    return bool(path) and isinstance(path[-1], int) and name in ("width", "scale")


def duplicated(draft: Draft, path: Where) -> tuple[Draft, str]:
    """Return a draft with a member of a list, or a motif or an ink, twice; and the path of the second one."""
    where = parsed(path)
    value = draft.value(where)
    if value is None:
        raise RecipeError([Fault("nothing stands there", dotted(where))])
    if isinstance(where[-1], int):
        written = draft.copied(where)
        fresh: Path = (*where[:-1], where[-1] + 1)
        return draft.inserted(where[:-1], value, where[-1] + 1, written), dotted(fresh)
    around = draft.value(where[:-1])
    fresh = (*where[:-1], free_name(str(where[-1]), around))
    place = list(around).index(where[-1]) + 1
    written = _retitled(draft.copied(where), where, str(fresh[-1]))
    return draft.inserted(fresh, value, place, written), dotted(fresh)


def variations(draft: Draft, seed: int, reach: float = 0.5) -> Iterator[Draft]:
    """Yield variations of a draft without end; whether they hold on cloth the certificate tells.

    Raises:
        RecipeError: where there is no number to vary.
    """
    moving = [free for knob in knobs(draft.tables) if (free := _unlocked(draft, knob)) is not None]
    if not moving:
        raise RecipeError("there is no number to vary: all are locked, or the motifs say none")
    for variant in candidates(moving, draft.stem, seed=seed, reach=reach):
        changes = [parse_override(change) for change in variant.changes]
        yield draft.with_values([(change.path, change.value) for change in changes])


def _unlocked(draft: Draft, knob: Knob) -> Knob | None:
    paths = tuple(path for path in knob.paths if not draft.is_locked(path))
    return replace(knob, paths=paths) if paths else None


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


def pasted(draft: Draft, text: str) -> tuple[Draft, tuple[str, ...]]:
    """Return a draft with what a text says put in: motifs, inks, placements, outputs and so on.

    Names that are taken are changed, where the text refers to them too. A whole recipe takes the draft's
    place.

    Returns:
        The draft, and the paths of what is new; none where all is.

    Raises:
        RecipeError: where the text is no TOML, or there is nothing in it.
    """
    other = Draft.of_text(text, draft.stem, draft.folder)
    tables = other.tables
    if "tile" in tables and "place" in tables:
        return replace(other, locked=draft.locked), ()
    names = {key: _fresh_names(tables.get(key), draft.tables.get(key)) for key in NAMED}
    renamed = _renamed(tables, names)
    fresh: list[str] = []
    for key, value in renamed.items():
        if key in NAMED and isinstance(value, dict):
            for name, table in value.items():
                draft = draft.inserted((key, name), table)
                fresh.append(dotted((key, name)))
        elif isinstance(value, list):
            for table in value:
                draft = draft.inserted((key,), table)
                fresh.append(dotted((key, len(draft.tables[key]) - 1)))
        else:
            draft = draft.with_value((key,), value)
            fresh.append(key)
    return replace(draft, drawings=tuple((dict(draft.drawings) | dict(other.drawings)).items())), tuple(fresh)


def _fresh_names(given: Any, taken: Any) -> dict[str, str]:
    """Return what names become that are pasted in."""
    known = dict.fromkeys(taken if isinstance(taken, dict) else ())
    found: dict[str, str] = {}
    for name in given if isinstance(given, dict) else ():
        found[name] = free_name(name, known)
        known[found[name]] = None
    return found


def _renamed(tables: Mapping[str, Any], names: Mapping[str, Mapping[str, str]]) -> dict[str, Any]:
    """Return tables with motifs and inks under other names, wherever they are named."""
    held: dict[str, Any] = copy.deepcopy(dict(tables))
    for path, name in list(ink_names(held)):
        if name in names["ink"]:
            _put(held, path, names["ink"][name])
    for path, place in places(held):
        motif = place.get("motif") if isinstance(place, dict) else None
        if isinstance(motif, str) and motif in names["motif"]:
            _put(held, (*path, "motif"), names["motif"][motif])
        elif isinstance(motif, list):
            _put(held, (*path, "motif"), [names["motif"].get(each, each) for each in motif])
    for key in NAMED:
        if isinstance(held.get(key), dict):
            held[key] = {names[key].get(name, name): table for name, table in held[key].items()}
    return held


def _put(node: Any, path: Path, value: Any) -> None:
    for part in path[:-1]:
        node = node[part]
    node[path[-1]] = value


def renamed(draft: Draft, path: Where, name: str) -> Draft:
    """Return a draft with a motif or an ink under another name, wherever it is named; its place stays.

    Raises:
        RecipeError: where nothing stands there, or the name is taken.
    """
    where = parsed(path)
    if len(where) != 2 or where[0] not in NAMED or draft.value(where) is None:
        raise RecipeError([Fault("only motifs and inks are renamed", dotted(where))])
    key, old = str(where[0]), str(where[1])
    if name == old:
        return draft
    around = draft.tables[key]
    if name in around or not name.strip():
        raise RecipeError([Fault(f'"{name}" is no free name', dotted(where))])
    tables = draft.tables
    uses: list[Path] = []
    if key == "ink":
        uses = [each for each, used in ink_names(tables) if used == old]
    for each, place in places(tables) if key == "motif" else ():
        uses += [(*each, "motif")] if isinstance(place, dict) and _names(place.get("motif"), old) else []
    for each in uses:
        said = draft.value(each)
        now = [name if one == old else one for one in said] if isinstance(said, list) else name
        draft = draft.with_value(each, now)
    number = list(around).index(old)
    written = draft.copied(where)
    value = draft.value(where)
    return draft.without(where).inserted((key, name), value, number, _retitled(written, where, name))


def _names(said: Any, name: str) -> bool:
    return name in said if isinstance(said, list) else said == name


def _retitled(block: str, path: Path, name: str) -> str:
    """Return a block with another name in its headers."""
    pattern = re.compile(
        rf"^(\s*\[+\s*{re.escape(str(path[0]))}\s*\.\s*)({_spellings(str(path[1]))})(?=[\s.\]])", re.M
    )
    return pattern.sub(lambda found: found[1] + spelled_key(name), block)


def _spellings(name: str) -> str:
    return "|".join(re.escape(each) for each in (name, f'"{name}"', f"'{name}'", quoted(name)))


def _placements(draft: Draft, path: Where) -> list[Path]:
    """Return the placement that a path names, or those of the tile where it names none.

    Raises:
        RecipeError: where it names no placement.
    """
    where = parsed(path) if path else ()
    if not where:
        return [("place", number) for number in range(len(draft.tables.get("place", ())))]
    if not isinstance(draft.value(where), dict) or not isinstance(where[-1], int):
        raise RecipeError([Fault("is no placement: expected one such as place[0]", dotted(where))])
    return [where]


def _fills(table: Any) -> bool:
    layout = table.get("layout") if isinstance(table, dict) else None
    return isinstance(layout, dict) and layout.get("kind") in FILLING
