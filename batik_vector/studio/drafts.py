"""Drafts: a recipe's text as it is being worked at. A change makes a new draft, and the old one stays.

    draft = Draft.read("kawung.toml")
    draft = draft.with_value("motif.flower.petal.count", 12)

A path is what ``--set`` takes: ``place[0].layout.dist``. Whatever changes, comments, order and the spelling
of all else stay. A draft may say what no recipe may; :attr:`Draft.faults` tells, and nothing is lost.
"""

from __future__ import annotations

import functools
import os
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

from batik_vector.errors import BatikError, Fault, RecipeError
from batik_vector.fields import OneOf
from batik_vector.recipe.loading import EMPTY, read_recipe
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.field_types import Hint
from batik_vector.recipe.reading.lines import parse_path
from batik_vector.recipe.reading.sources import parted, read_text, scheme_of, stem_of, with_carried
from batik_vector.recipe.reading.tables import tables_of
from batik_vector.recipe.references import Path, dotted
from batik_vector.studio.declared import MISSING, Place, inner, place_at, plain
from batik_vector.studio.offers import kinded, known_keys
from batik_vector.studio.text import rewriting
from batik_vector.studio.text.spelling import as_written
from batik_vector.units import parse_length
from batik_vector.values import frozen

UNSAID = "ink"
"""The ink of a recipe that says none."""
WHOLE = 2**53
"""Whole numbers up to which a recipe takes all."""
Where: TypeAlias = str | Path
"""A path as people write it, or taken apart."""


@frozen
class Draft:
    """A recipe's text as it is being worked at.

    Args:
        text: the page of TOML, without drawings that it carries.
        folder: where the files stand that it names; None where it stands nowhere.
        locked: keys, or tables with all in them, that stay when values are made up; as ``--lock`` takes them.
        drawings: SVGs by the names of their files, that it carries.
        stem: what files of it are called.
    """

    text: str
    folder: str | None = None
    locked: tuple[str, ...] = ()
    drawings: tuple[tuple[str, str], ...] = ()
    stem: str = "untitled"

    @staticmethod
    def read(path: str | os.PathLike[str]) -> Draft:
        """Return the draft of a file: a recipe, one compiled from it, or ``library:NAME``.

        Raises:
            RecipeError: where there is no text to be had.
            LibraryError: where the library has no such pattern.
        """
        source = os.fspath(path)
        own, drawings = parted(read_text(path))
        folder = None if scheme_of(source)[0] else os.path.dirname(os.path.abspath(source))
        return Draft(own, folder, drawings=tuple(drawings.items()), stem=stem_of(source))

    @staticmethod
    def of_text(text: str, stem: str = "untitled", folder: str | None = None) -> Draft:
        """Return the draft of a text, as it is pasted or dropped; drawings behind it are taken off."""
        own, drawings = parted(text.replace("\r\n", "\n"))
        return Draft(own, folder, drawings=tuple(drawings.items()), stem=stem)

    @functools.cached_property
    def tables(self) -> dict[str, Any]:
        """What the text says, as plain tables; not to be changed.

        Raises:
            RecipeError: where it is no TOML.
        """
        return tables_of(self.text, self.stem, EMPTY)

    @functools.cached_property
    def recipe(self) -> Recipe:
        """The recipe, read as the command reads it.

        Raises:
            RecipeError: with everything that is wrong.
        """
        return read_recipe(self.text, self.stem, folder=self.folder, drawings=dict(self.drawings))

    @functools.cached_property
    def faults(self) -> tuple[Fault, ...]:
        """What is wrong with the recipe before it is compiled, with keys and lines."""
        try:
            self.recipe  # noqa: B018
        except RecipeError as error:
            return error.faults
        except BatikError as error:
            return (Fault(str(error)),)
        return ()

    @property
    def whole(self) -> str:
        """The text with the drawings behind it, so that it compiles from itself alone."""
        return with_carried(self.text, dict(self.drawings))

    @property
    def title(self) -> str:
        """What the design is called; the stem where it does not say."""
        try:
            said = self.tables.get("title")
        except RecipeError:
            said = None
        return said if isinstance(said, str) and said else self.stem

    # Values.

    def value(self, path: Where) -> Any:
        """Return what the text says at a path, or None where it says nothing."""
        node: Any = self.tables
        for part in self._actual(path):
            try:
                node = node[part]
            except (LookupError, TypeError):
                return None
        return node

    def with_text(self, text: str) -> Draft:
        """Return the draft with another page of TOML, whatever it says."""
        own, drawings = parted(text.replace("\r\n", "\n"))
        return replace(self, text=own, drawings=tuple((dict(self.drawings) | drawings).items()))

    def with_value(self, path: Where, value: Any) -> Draft:
        """Return the draft with a value set, spelled as the one before: lengths keep their unit.

        What stands around it and was left out is written with its defaults, so that nothing else changes. A
        kind that is set takes along what it knows of the one before.

        Args:
            path: of the value.
            value: a number (lengths in mm), a word, a list or a table; None takes it out.

        Raises:
            RecipeError: where the text is no TOML, or the path leads nowhere.
        """
        where = self._actual(path)
        if value is None:
            return self.without(where)
        if (draft := self._exchanged([(where, value)])) is not None:
            return draft
        around = place_at(self.tables, where[:-1])
        one_of = around.hint.one_of if around is not None else None
        if around is not None and one_of is not None and where[-1] == one_of.tag and isinstance(value, str):
            return self._with_kind(where, one_of, value, known_keys(around.hint, value))
        return self._rewritten(where, lambda: self._set(where, value))

    def with_values(self, values: Mapping[Where, Any] | Sequence[tuple[Where, Any]]) -> Draft:
        """Return the draft with several values set, one after the other."""
        pairs = list(values.items() if isinstance(values, Mapping) else values)
        if (draft := self._exchanged(pairs)) is not None:
            return draft
        draft = self
        for path, value in pairs:
            draft = draft.with_value(path, value)
        return draft

    def _exchanged(self, values: Sequence[tuple[Where, Any]]) -> Draft | None:
        """Return the draft with numbers set where others stand, all at once; None where that is not all.

        The text is read once for it, where :meth:`with_value` reads it four times for each: a sheet of
        variations has a thousand, and a slider one for every picture.
        """
        written: dict[Path, Any] = {}
        for path, value in values:
            where = self._actual(path)
            place = place_at(self.tables, where)
            number = isinstance(value, int | float) and not isinstance(value, bool)
            if not number or place is None or place.said is MISSING:
                return None
            written[where] = as_written(place.hint, value, place.said)
        try:
            found = rewriting.exchanged(self.text, self.tables, written)
        except ValueError:
            return None
        if found is None:
            return None
        draft = replace(self, text=found[0])
        if all(not isinstance(each, int) or abs(each) < WHOLE for each in written.values()):
            # What the text says is known by now; of larger numbers reading it has something to say.
            draft.__dict__["tables"] = found[1]
        return draft

    def _with_kind(self, where: Path, one_of: OneOf, kind: str, known: set[str]) -> Draft:
        """Return the draft with a table of another kind; what that does not know of the old one goes."""
        table, tag = where[:-1], one_of.tag
        old = self.value(table) or {}
        draft = self._rewritten(where, lambda: self._set(where, kind))
        if not isinstance(old, dict) or not known:
            return draft
        for key in old:
            if key != tag and key not in known:
                draft = draft.without((*table, key))
        for key, value in kinded(kind, one_of).items():
            if draft.value((*table, key)) is None:
                draft = draft.with_value((*table, key), value)
        # A key of one name may be of two kinds.
        before = {fault.key for fault in self.faults}
        wrong = {fault.key for fault in draft.faults} - before
        for key in old:
            if key != tag and any(each.startswith(dotted((*table, key))) for each in wrong):
                draft = draft.without((*table, key))
        return draft

    def _set(self, where: Path, value: Any) -> str:
        place = place_at(self.tables, where)
        if place is not None:
            value = as_written(place.hint, value, None if place.said is MISSING else place.said)
        for depth in range(1, len(where)):
            around = place_at(self.tables, where[:depth])
            if around is not None and around.said is MISSING and _is_known(around.default):
                # The first that is not written is written with what it was by default.
                table = plain(around.hint, around.default)
                _put(table, around, where[depth:], value)
                if around.hint.items:
                    table = as_written(around.hint, table)
                return rewriting.with_value(self.text, where[:depth], table)
            if around is not None and around.said is MISSING and around.hint.items:
                numbers: list[Any] = list(middle_of(self.tables) if where[depth - 1] == "at" else ())
                numbers = numbers or [0] * len(around.hint.items)
                numbers[int(where[depth])] = value
                return rewriting.with_value(self.text, where[:depth], as_written(around.hint, numbers))
        return rewriting.with_value(self.text, where, value)

    def without(self, path: Where) -> Draft:
        """Return the draft with a key taken out, so that it is what it is by default; or a member of a list.

        A key that is not there is no fault.
        """
        where = self._actual(path)
        around = self.value(where[:-1]) if len(where) > 1 else self.tables
        there = where[-1] in around if isinstance(around, dict) else self.value(where) is not None
        return self._rewritten(where, lambda: rewriting.without(self.text, where)) if there else self

    # Lists: elements, placements, outputs; and tables by name: motifs, inks.

    def inserted(self, path: Where, value: Any, index: int | None = None, written: str = "") -> Draft:
        """Return the draft with another member of a list, or a table by name, at a place among the others.

        Args:
            path: of the list, or of the new table: ``place``, ``motif.flower.elements``, ``ink.indigo``.
            value: of the member.
            index: its place; the end when left out.
            written: how it is written, where that is known; see :meth:`copied`.

        Raises:
            RecipeError: where there is no such list, or the name is taken.
        """
        where = self._actual(path)
        bare = self.value(where)
        by_name = len(where) == 2 and where[0] in ("motif", "ink", "drawing")
        if by_name and self.value(where) is not None:
            raise RecipeError([Fault("is there already: expected another name", dotted(where))])
        if not by_name and isinstance(bare, dict):
            # A table that stands for a list of one.
            several = [value, bare] if index == 0 else [bare, value]
            return self._rewritten(where, lambda: rewriting.with_value(self.text, where, several))
        if not by_name:
            return self._rewritten(where, lambda: rewriting.inserted(self.text, where, value, index, written))
        draft = self
        if where[0] == "ink" and "ink" not in self.tables:
            # The one ink that there was without a word.
            draft = draft.with_value(("ink", UNSAID), {})
        text, inks = draft.text, draft.tables.get("ink")
        draft = draft._rewritten(where, lambda: rewriting.with_table(text, where, value, written))
        if index is not None:
            draft = draft.moved(where, index)
        alone = where[0] == "ink" and isinstance(inks, dict) and len(inks) == 1
        return draft._inked(next(iter(inks))) if alone and inks else draft

    def _inked(self, first: str) -> Draft:
        """Return the draft with an ink said by all that said none, as there was but this one until now."""
        draft = self
        for fault in self.faults:
            if fault.key.endswith(".ink") and fault.message.startswith("missing"):
                draft = draft.with_value(fault.key, first)
        return draft

    def removed(self, path: Where) -> Draft:
        """Return the draft without a member: ``place[1]``, ``ink.wax``, ``motif.flower.elements[0]``."""
        return self.without(path)

    def moved(self, path: Where, to: int) -> Draft:
        """Return the draft with a member at another place among its like: of inks, that paints it earlier."""
        where = self._actual(path)
        return self._rewritten(where, lambda: rewriting.moved(self.text, where, to))

    def copied(self, path: Where = ()) -> str:
        """Return a part of the recipe as text, to be pasted elsewhere: a member, or all of it."""
        where = self._actual(path) if path else ()
        return rewriting.member_text(self.text, where) if where else self.whole

    # What else a draft has.

    def locking(self, path: Where, locked: bool = True) -> Draft:
        """Return the draft with a key locked, or set free: values that are made up leave it alone."""
        key = dotted(parsed(path))
        kept = tuple(each for each in self.locked if each != key)
        return replace(self, locked=(*kept, key) if locked else kept)

    def is_locked(self, path: Where) -> bool:
        """Return whether a key, or a table around it, is locked."""
        where = parsed(path)
        keys = {dotted(where[:depth]) for depth in range(1, len(where) + 1)}
        return not keys.isdisjoint(self.locked)

    def with_drawing(self, file: str, svg: str) -> Draft:
        """Return the draft with an SVG that it carries, by the name that a motif's ``file`` has."""
        return replace(self, drawings=tuple((dict(self.drawings) | {file: svg}).items()))

    def _actual(self, path: Where) -> Path:
        """Return a path as the text has it: a table that stands for a list of one has no place in it."""
        node: Any = self.tables
        found: list[str | int] = []
        for part in parsed(path):
            if isinstance(node, dict) and part == 0:
                continue
            found.append(part)
            held = isinstance(node, dict) or (isinstance(node, list) and isinstance(part, int))
            try:
                node = node[part] if held else None
            except LookupError:
                node = None
        return tuple(found)

    def _rewritten(self, where: Path, change: Any) -> Draft:
        self.tables  # noqa: B018  (raises where the text is no TOML)
        try:
            return replace(self, text=change())
        except (rewriting.CannotRewriteError, tomllib.TOMLDecodeError, LookupError, TypeError) as error:
            raise RecipeError([Fault(str(error) or "leads nowhere", dotted(where))]) from error


def parsed(path: Where) -> Path:
    """Return a path taken apart.

    Raises:
        RecipeError: where it is none.
    """
    if isinstance(path, tuple):
        return path
    try:
        return parse_path(path)
    except ValueError as error:
        raise RecipeError([Fault(str(error), source=path[:80])]) from None


def middle_of(tables: Mapping[str, Any]) -> tuple[float, float]:
    """Return the middle of a recipe's repeat in mm, where a placement lies that says no place."""
    try:
        width, height = map(parse_length, tables["tile"]["size"])
    except (LookupError, TypeError, ValueError):
        return 0.0, 0.0
    return width / 2, height / 2


def _is_known(default: Any) -> bool:
    return default is not MISSING and default is not None and not isinstance(default, int | float | str)


def _put(table: Any, place: Place, rest: Path, value: Any) -> None:
    """Set a value in a table of defaults; what is missing on the way is written with its own."""
    for depth, part in enumerate(rest):
        if depth == len(rest) - 1:
            table[part] = value
            return
        found = inner(place, part)
        held = table.get(part) if isinstance(table, dict) else table[part]
        if held is None:
            held = plain(found.hint, found.default) if found and _is_known(found.default) else {}
            table[part] = held
        table, place = held, found or Place(Hint(object), MISSING, MISSING)


def changes_between(before: Draft, after: Draft) -> Iterator[str]:
    """Yield the keys of values that two drafts say differently, for the name of an undo step."""
    try:
        yield from _differences(before.tables, after.tables, ())
    except RecipeError:
        return


def _differences(one: Any, other: Any, path: Path) -> Iterator[str]:
    if isinstance(one, dict) and isinstance(other, dict):
        for key in [*one, *(key for key in other if key not in one)]:
            yield from _differences(one.get(key, MISSING), other.get(key, MISSING), (*path, key))
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for index, (mine, its) in enumerate(zip(one, other, strict=True)):
            yield from _differences(mine, its, (*path, index))
    elif one != other or type(one) is not type(other):
        yield dotted(path)
