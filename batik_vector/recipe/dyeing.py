"""Baths in a recipe: the order of dyeing, which baths each ink's cloth sees, and what contradicts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from typing import Annotated, TypeAlias

from batik_vector.artwork.dyeing import Bath, Dyeing, Seen
from batik_vector.artwork.overdyeing import difference
from batik_vector.errors import Fault, unknown_name
from batik_vector.fields import Colour, Says, Unset, check
from batik_vector.recipe.references import dotted, quoted
from batik_vector.values import frozen

MOST = 12
"""Baths that a recipe may have: what they give together grows by powers of two."""

WORKED_OUT = 8
"""Baths up to which a message works out which of them would give a colour."""


@frozen(kw_only=True)
class BathSpec:
    """A dye bath. The order of the baths in the recipe is that of dyeing."""

    name: Annotated[str, Says("what it is called")]
    colour: Annotated[Colour, Says("colour that it alone gives undyed cloth")]

    def __post_init__(self) -> None:
        check(self)


@frozen
class Dyed:
    """A colour of the cloth, an ink or the ground: the key of its table, its baths, its colour as written."""

    key: str
    baths: tuple[str, ...] | None
    colour: str

    @property
    def named(self) -> bool:
        """Whether the recipe says the colour, and does not leave it to the baths."""
        return not isinstance(self.colour, Unset)


Inks: TypeAlias = Mapping[str, Dyed]


def faults_of(baths: Sequence[BathSpec], undyed: str, inks: Inks, ground: Dyed) -> list[Fault]:
    """Return what is wrong with the baths of a recipe and with what sees them."""
    if not baths:
        words = "the recipe has no baths: expected [[bath]] tables, each with a name and a colour"
        return [Fault(words, f"{each.key}.baths") for each in (*inks.values(), ground) if each.baths]
    if found := [*_wrong_baths(baths), *_wrong_names(baths, [*inks.values(), ground])]:
        return found
    if missing := [_missing(each, baths, undyed) for each in inks.values() if each.baths is None]:
        return missing
    everything = [*inks.values(), _of_ground(baths, ground)]
    return [*_seen_by_nothing(baths, everything), *_contradictions(baths, undyed, everything)]


def _of_ground(baths: Sequence[BathSpec], ground: Dyed) -> Dyed:
    """Return the ground, which sees all the baths unless it is told otherwise."""
    seen = ground.baths if ground.baths is not None else tuple(bath.name for bath in baths)
    return Dyed(ground.key, seen, ground.colour)


def _wrong_baths(baths: Sequence[BathSpec]) -> Iterator[Fault]:
    if len(baths) > MOST:
        yield Fault(f"{len(baths)} baths, expected at most {MOST}", "bath")
    before: dict[str, int] = {}
    for number, bath in enumerate(baths):
        key = f"bath[{number}].name"
        if not (0 < len(bath.name) <= 80 and bath.name.isprintable()):
            yield Fault("expected a name of 1 to 80 printable characters", key)
        elif bath.name in before:
            words = f'is a bath already, bath[{before[bath.name]}]: call a second one "{bath.name} 2"'
            yield Fault(f'"{bath.name}" {words}', key)
        before.setdefault(bath.name, number)


def _wrong_names(baths: Sequence[BathSpec], dyed: Sequence[Dyed]) -> Iterator[Fault]:
    known = [bath.name for bath in baths]
    for each in dyed:
        counted = Counter(each.baths or ())
        for number, name in enumerate(each.baths or ()):
            if name not in known:
                yield Fault(unknown_name(name, known, "bath"), f"{each.key}.baths[{number}]")
        for name, times in counted.items():
            if times > 1:
                yield Fault(f'"{name}" {times} times, expected each bath once', f"{each.key}.baths")


def _missing(dyed: Dyed, baths: Sequence[BathSpec], undyed: str) -> Fault:
    example = [bath.name for bath in baths[:1]]
    words = f"missing: the recipe has baths, expected those that this cloth sees, such as {_list(example)}"
    if dyed.named and len(baths) <= WORKED_OUT:
        near = _nearest(dyed.colour, baths, undyed)
        words += f"; nearest to {dyed.colour} comes {_list(near)}"
    else:
        words += ", or [] for cloth that stays undyed"
    return Fault(words, f"{dyed.key}.baths")


def _nearest(colour: str, baths: Sequence[BathSpec], undyed: str) -> tuple[str, ...]:
    """Return which baths together give a colour best."""
    plan = _plan(baths, undyed)
    sets = [each for count in range(len(baths) + 1) for each in combinations(plan.names, count)]
    return min(sets, key=lambda each: (round(difference(plan.colour(frozenset(each)), colour), 6), len(each)))


def _seen_by_nothing(baths: Sequence[BathSpec], dyed: Sequence[Dyed]) -> Iterator[Fault]:
    seen = {name for each in dyed for name in each.baths or ()}
    for number, bath in enumerate(baths):
        if bath.name not in seen:
            words = f'"{bath.name}" dyes nothing: expected it among the baths of an ink or of the cloth'
            yield Fault(words, f"bath[{number}].name")


def _contradictions(baths: Sequence[BathSpec], undyed: str, dyed: Sequence[Dyed]) -> Iterator[Fault]:
    """Yield colours that cannot both be, as they have seen the same baths."""
    said: dict[Seen, tuple[str, str]] = {}
    if not isinstance(undyed, Unset):
        said[frozenset()] = ("cloth.undyed", undyed)
    for number, bath in enumerate(baths):
        said[frozenset([bath.name])] = (f"bath[{number}].colour", bath.colour)
    for each in dyed:
        if not each.named:
            continue
        seen = frozenset(each.baths or ())
        where, colour = said.setdefault(seen, (f"{each.key}.colour", each.colour))
        if colour != each.colour:
            what = f"sees {_list(each.baths or ())}" if seen else "sees no bath"
            words = f"{each.colour}, expected {colour} as {where} says, or no colour: it {what} too"
            yield Fault(words, f"{each.key}.colour")


def dyeing_of(baths: Sequence[BathSpec], undyed: str, inks: Inks, ground: Dyed) -> Dyeing:
    """Return how a cloth is dyed, of a recipe without faults."""
    ground = _of_ground(baths, ground)
    seen = {name: frozenset(each.baths or ()) for name, each in inks.items()}
    said = {frozenset(each.baths or ()): str(each.colour) for each in (*inks.values(), ground) if each.named}
    undyed = said.get(frozenset(), undyed)
    return Dyeing(_plan(baths, undyed).baths, str(undyed), frozenset(ground.baths or ()), seen, said)


def _plan(baths: Sequence[BathSpec], undyed: str) -> Dyeing:
    known = tuple(Bath(bath.name, bath.colour) for bath in baths)
    return Dyeing(known, str(undyed), frozenset(), {})


def _list(names: Sequence[str]) -> str:
    return "[" + ", ".join(map(quoted, names)) + "]"


def ink_key(name: str) -> str:
    """Return the key of an ink's table."""
    return dotted(("ink", name))
