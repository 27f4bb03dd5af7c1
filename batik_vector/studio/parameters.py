"""Panels of parameters, made from the very declarations that make the schema, the help and the docs.

    for panel in panels(draft):
        for group in panel.groups:
            for control in group.controls: ...

A :class:`Control` is one value: bounds, unit, help and the paper's symbol come from its declaration, what is
wrong with it stands beside it. A :class:`Group` is a table; where it is one of a list it can be moved and
removed, and where it holds a list more can be added. What a control gives goes to
:meth:`~batik_vector.studio.drafts.Draft.with_value` under its path, and None resets it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from batik_vector.errors import Fault
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.reading.faults import keyed
from batik_vector.recipe.reading.field_types import Hint, members
from batik_vector.recipe.references import INK_KEYS, Path, dotted
from batik_vector.studio.changes import worn
from batik_vector.studio.declared import (
    MISSING,
    Place,
    class_of,
    inner,
    is_scalar,
    kind_of,
    label_of,
    number_of,
    plain_list,
    root,
    sort_of,
    symbol_of,
)
from batik_vector.studio.drafts import Draft, middle_of
from batik_vector.studio.offers import Offer, offers, suggestions
from batik_vector.studio.sliders import span_of, step_of
from batik_vector.values import frozen

PANELS: Mapping[str, tuple[str, ...]] = {
    "pattern": ("motif",),
    "layout": ("place",),
    "tile": ("tile", ""),
    "inks": ("palette", "ink", "colourway"),
    "cloth": ("cloth", "yardage", "border"),
    "outputs": ("output",),
}
"""The panels in their order, the paper's two first, and what of the recipe each shows; "" is its own keys."""
ABOUT: Mapping[str, str] = {
    "pattern": "motifs and their shapes",
    "layout": "where motifs lie",
    "tile": "what repeats, and how",
    "inks": "colours, in their order",
    "cloth": "what is dyed, how large, its borders",
    "outputs": "files, and their options",
}
"""What each panel is about, in a few words."""
ASIDE = ("palette",)
"""Keys of the recipe's own that stand in another panel than the rest."""


@frozen
class Control:
    """One value of a recipe, as a person sets it.

    Args:
        path: what ``Draft.with_value`` takes.
        kind: ``number``, ``whole``, ``switch``, ``choice`` (one of ``choices``), ``text`` (``choices`` are
            offered), ``colour``, ``names`` (one or several of ``choices``), ``list`` (numbers or words).
        label: the key, in words; of a key that is none, the word for it.
        symbol: the paper's, or nothing.
        help: one line.
        unit: ``mm``, ``°`` or nothing.
        least, most: what a recipe may say.
        useful: where the values lie that please most, where that is known.
        span: the ends of a slider: the useful ones, or such as suit the value.
        step: of a slider.
        choices: words to choose from.
        default: what it is when left out; None where it then is nothing.
        value: what it is now, lengths in mm; None where it is nothing.
        is_set: whether the recipe says it.
        locked: whether it stays when values are made up.
        fault: what is wrong with it, or nothing.
        needed: whether it must be said.
    """

    path: str
    kind: str
    label: str
    symbol: str = ""
    help: str = ""
    unit: str = ""
    least: float | None = None
    most: float | None = None
    useful: tuple[float, float] | None = None
    span: tuple[float, float] | None = None
    step: float | None = None
    choices: tuple[str, ...] = ()
    default: Any = None
    value: Any = None
    is_set: bool = False
    locked: bool = False
    fault: str = ""
    needed: bool = False


@frozen
class Group:
    """A table of a recipe, or a list of tables.

    Args:
        path: of the table or the list.
        label: what it is called.
        help: one line.
        controls: its values.
        groups: the tables in it, or the members of the list.
        offers: what can be added to the list; see :class:`~batik_vector.studio.offers.Offer`.
        member: whether it is one of several, to be moved, removed, copied.
        is_set: whether the recipe says it.
        optional: whether a recipe may do without it.
        fault: what is wrong with it as a whole, or nothing.
    """

    path: str
    label: str
    help: str = ""
    controls: tuple[Control, ...] = ()
    groups: tuple[Group, ...] = ()
    offers: tuple[Offer, ...] = ()
    member: bool = False
    is_set: bool = True
    optional: bool = False
    fault: str = ""

    def all_controls(self) -> Iterator[Control]:
        """Yield its controls and those of all groups in it."""
        yield from self.controls
        for group in self.groups:
            yield from group.all_controls()


@frozen
class Panel:
    """What is shown together. ``faults`` are those that no control and no group of it has."""

    name: str
    groups: tuple[Group, ...]


def panels(draft: Draft, faults: Sequence[Fault] | None = None) -> tuple[Panel, ...]:
    """Return the panels of a draft.

    Args:
        draft: whose text is TOML.
        faults: that compiling it found; those of reading it when left out.

    Raises:
        RecipeError: where the text is no TOML, and so there is nothing to show; its faults have lines.
    """
    told = _Faults(draft.faults if faults is None else faults)
    walk = _Walk(draft, draft.tables, told)
    whole = root(draft.tables)
    shown = []
    for name, keys in PANELS.items():
        groups = [
            walk.scalars(whole, key) if key in ("", *ASIDE) else walk.member(whole, (), key) for key in keys
        ]
        shown.append(Panel(name, tuple(group for group in groups if group is not None)))
    return tuple(shown)


def controls(draft: Draft, faults: Sequence[Fault] | None = None) -> dict[str, Control]:
    """Return all controls of a draft by their paths; see :func:`panels`."""
    groups = [group for panel in panels(draft, faults) for group in panel.groups]
    return {control.path: control for group in groups for control in group.all_controls()}


class _Faults:
    """What is wrong, by path; of what stands deeper than any control, the nearest table is told."""

    def __init__(self, faults: Sequence[Fault]) -> None:
        self._at: dict[Path, list[str]] = {}
        for fault in faults:
            if path := keyed(fault.key):
                self._at.setdefault(path, []).append(fault.message)

    def at(self, path: Path, *, deep: bool = False) -> str:
        """Return what is wrong at a path, or also within it."""
        if not self._at:
            return ""
        found = [
            words
            for where, told in self._at.items()
            if where == path or (deep and where[: len(path)] == path)
            for words in told
        ]
        return "; ".join(found)


class _Walk:
    def __init__(self, draft: Draft, tables: Mapping[str, Any], faults: _Faults) -> None:
        self._draft, self._tables, self._faults = draft, tables, faults
        self._worn = worn(draft)

    def scalars(self, whole: Place, key: str = "") -> Group:
        """Return the recipe's own keys: its title, tolerance and so on; or one that stands elsewhere."""
        found: list[Control] = []
        for name, member in members(Recipe).items():
            meant = name == key if key else name not in ASIDE
            if meant and is_scalar(member.hint) and (place := inner(whole, name)) is not None:
                found += self._controls(place, (name,))
        return Group(key, key or "design", "the recipe as a whole", tuple(found))

    def member(self, around: Place, path: Path, name: str) -> Group | None:
        """Return the group of a key that holds a table or tables."""
        place = inner(around, name)
        return None if place is None else self._group(place, (*path, name), optional=True)

    def _group(self, place: Place, path: Path, *, member: bool = False, optional: bool = False) -> Group:
        hint = place.hint
        label = str(path[-1]) if isinstance(path[-1], str) else self._named(place, path)
        is_set = place.said is not MISSING
        says = hint.says.text if hint.says else ""
        parts: dict[str, Any] = {"controls": (), "groups": (), "offers": ()}
        if hint.item is not None and is_scalar(hint.item):
            held = place.said if isinstance(place.said, dict) else {}
            inside = ((key, inner(place, key)) for key in held)
            parts["controls"] = tuple(self._control(each, (*path, key)) for key, each in inside if each)
        elif hint.item is not None:
            parts["groups"] = tuple(self._members(place, path))
            parts["offers"] = offers(hint, path, self._tables)
        elif hint.one_of is not None or class_of(place) is not None:
            if is_set or place.default is not None:
                parts = self._table(place, path)
            else:
                # What need not be is shown once it is there.
                parts["offers"] = offers(hint, path, self._tables)
        fault = self._faults.at(path)
        return Group(
            dotted(path),
            label.replace("_", " "),
            says,
            member=member,
            is_set=is_set,
            optional=optional,
            fault=fault,
            **parts,
        )

    def _named(self, place: Place, path: Path) -> str:
        """Return what a member of a list is called: by its name or motif, or by its kind."""
        said = place.said if isinstance(place.said, dict) else {}
        number = int(path[-1]) + 1
        for key in ("name", "motif", "kind", "format", "frieze"):
            word = said.get(key)
            if isinstance(word, list) and word:
                word = word[0]
            if isinstance(word, str) and word:
                return f"{number} {word}"
        for key in ("curve", "layout"):
            kind = said[key].get("kind") if isinstance(said.get(key), dict) else None
            if isinstance(kind, str):
                return f"{number} {kind}"
        return f"{number} {said['ink']}" if isinstance(said.get("ink"), str) else str(number)

    def _members(self, place: Place, path: Path) -> Iterator[Group]:
        held = place.said if place.said is not MISSING else place.default
        if place.hint.alone and isinstance(held, dict):
            held = [held]
        keys: Sequence[Any] = ()
        if isinstance(held, dict):
            keys = list(held)
        elif isinstance(held, list | tuple):
            keys = range(len(held))
        for key in keys:
            found = inner(place, key)
            if found is not None:
                yield self._group(found, (*path, key), member=True)

    def _table(self, place: Place, path: Path) -> dict[str, Any]:
        found: list[Control] = []
        groups: list[Group] = []
        if place.hint.one_of is not None:
            found.append(self._kind(place, path))
        cls = class_of(place)
        for name, member in members(cls).items() if cls is not None else ():
            inside = inner(place, name)
            if inside is None:
                continue
            if is_scalar(member.hint):
                found += self._controls(inside, (*path, name))
            elif member.hint.item is None or not plain_list(member.hint):
                groups.append(self._group(inside, (*path, name), optional=not member.required))
            else:
                found.append(self._list(inside, (*path, name)))
        return {"controls": tuple(found), "groups": tuple(groups), "offers": ()}

    def _kind(self, place: Place, path: Path) -> Control:
        """Return the control that chooses a class of a catalogue."""
        one_of = place.hint.one_of
        assert one_of is not None
        where = (*path, one_of.tag)
        known = tuple(one_of.load())
        usual = kind_of(place.hint, type(place.default)) if dataclasses.is_dataclass(place.default) else None
        said = place.said.get(one_of.tag) if isinstance(place.said, dict) else None
        return Control(
            dotted(where),
            "choice",
            one_of.what if one_of.tag == "kind" else one_of.tag,
            help=f"what {one_of.what} it is",
            choices=known,
            default=usual,
            value=said if said is not None else usual,
            is_set=said is not None,
            locked=self._draft.is_locked(where),
            fault=self._faults.at(where),
            needed=True,
        )

    def _controls(self, place: Place, path: Path) -> Iterator[Control]:
        """Yield the controls of a value: of a pair, one for each of its numbers."""
        if not place.hint.items:
            yield self._control(place, path)
            return
        for number in range(len(place.hint.items)):
            part = inner(place, number)
            assert part is not None
            yield self._control(part, (*path, number), around=place)

    def _list(self, place: Place, path: Path) -> Control:
        return self._control(place, path, kind="list")

    def _control(self, place: Place, path: Path, *, kind: str = "", around: Place | None = None) -> Control:
        hint = place.hint
        says = (around or place).hint.says
        is_set = place.said is not MISSING
        default = self._default(place, path)
        value = self._worn.get(path, number_of(hint, place.said) if is_set else default)
        angle = says is not None and says.text.startswith("degrees")
        choices = self._choices(hint, path)
        kind = kind or ("choice" if path[-1] in INK_KEYS else sort_of(hint, bool(choices)))
        least, most = (hint.bounds.low, hint.bounds.high) if hint.bounds else (None, None)
        useful = (hint.useful.low, hint.useful.high) if hint.useful else None
        span = span_of(hint, useful, value, default, angle) if kind in ("number", "whole") else None
        return Control(
            dotted(path),
            kind,
            label_of(path, around, says.called if says else ""),
            symbol_of(says.symbol if says else "", path, around),
            says.text if says else "",
            "mm" if hint.length else "°" if angle else "",
            least,
            most,
            useful,
            span,
            step_of(hint, span) if span else None,
            choices,
            default,
            value,
            is_set,
            self._draft.is_locked(path),
            self._faults.at(path, deep=True),
            default is None and not is_set and _is_needed(around or place),
        )

    def _default(self, place: Place, path: Path) -> Any:
        if place.default is MISSING or place.default is None:
            if len(path) > 1 and path[-2] == "at" and isinstance(path[-1], int):
                return middle_of(self._tables)[path[-1]]
            return None
        if isinstance(place.default, tuple):
            return list(place.default)
        return str(place.default) if isinstance(place.default, str) else place.default

    def _choices(self, hint: Hint, path: Path) -> tuple[str, ...]:
        if hint.names:
            return tuple(hint.names)
        key = next((part for part in reversed(path) if isinstance(part, str)), "")
        if key in INK_KEYS:
            return ("", *self._names("ink"))
        if key == "motif" and path[0] in ("place", "border"):
            return tuple(self._names("motif"))
        return suggestions(path, self._draft.drawings)

    def _names(self, key: str) -> Sequence[str]:
        held = self._tables.get(key)
        return list(held) if isinstance(held, dict) else []


def _is_needed(place: Place) -> bool:
    return place.default is MISSING
