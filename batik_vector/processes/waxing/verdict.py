"""Whether colours can be dyed by adding wax alone, why not, and which near them can.

Wax that never comes off keeps cloth from all later baths: what a colour has seen is a beginning of the order
of dyeing. So of two colours one has seen all that the other has.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations, permutations

from batik_vector.artwork import Dyeing, Seen
from batik_vector.artwork.overdyeing import difference
from batik_vector.values import frozen

MOST_ORDERS = 6
"""Baths of which all orders are tried; of more, the one given alone."""

GROUND = "cloth"
"""What the ground is called beside the inks."""


@frozen
class Nearest:
    """Colours that adding wax alone gives: the order of the baths, and what each colour sees then."""

    order: tuple[str, ...]
    seen: Mapping[str, Seen]
    apart: float
    """How far the colours are from those asked for together, as ΔE*ab."""


def colours_of(dyeing: Dyeing, inks: Sequence[str]) -> dict[str, Seen]:
    """Return what the ground and some inks see, by their keys in a recipe."""
    return {GROUND: dyeing.ground} | {f"ink.{name}": dyeing.inks[name] for name in inks}


def is_prefix(seen: Seen, order: Sequence[str]) -> bool:
    """Return whether some baths are the first of an order."""
    return seen == frozenset(order[: len(seen)])


def why_not(dyeing: Dyeing, colours: Mapping[str, Seen]) -> str:
    """Return why colours cannot be dyed by adding wax alone in the baths' order; nothing if they can."""
    wrong = [name for name, seen in colours.items() if not is_prefix(seen, dyeing.names)]
    if not wrong:
        return ""
    for one, other in combinations(colours, 2):
        if not (colours[one] <= colours[other] or colours[other] <= colours[one]):
            return (
                f"{one} sees {_named(dyeing, colours[one] - colours[other])} and not "
                f"{_named(dyeing, colours[other] - colours[one])}, {other} the other way round: wax that "
                "stays on keeps one of them from its bath"
            )
    missed = next(bath for bath in dyeing.names if bath not in colours[wrong[0]])
    later = next(bath for bath in reversed(dyeing.names) if bath in colours[wrong[0]])
    return f"{wrong[0]} sees {later} and not {missed}, which comes before: its wax would have to come off"


def nearest(dyeing: Dyeing, colours: Mapping[str, Seen]) -> Nearest:
    """Return what colours can be instead: the nearest to each, in the order of baths that suits all best."""
    orders = permutations(dyeing.names) if len(dyeing.names) <= MOST_ORDERS else [dyeing.names]
    found: Nearest | None = None
    for order in orders:
        beginnings = [frozenset(order[:count]) for count in range(len(order) + 1)]
        seen = {name: min(beginnings, key=_Farness(dyeing, has)) for name, has in colours.items()}
        apart = round(sum(_apart(dyeing, seen[name], has) for name, has in colours.items()), 6)
        if found is None or apart < found.apart:
            found = Nearest(order, seen, apart)
    assert found is not None
    return found


class _Farness:
    """How far cloth that has seen some baths is from cloth that has seen others: in colour, then in baths."""

    def __init__(self, dyeing: Dyeing, seen: Seen) -> None:
        self._dyeing, self._seen = dyeing, seen

    def __call__(self, other: Seen) -> tuple[float, int]:
        return round(_apart(self._dyeing, other, self._seen), 6), len(other ^ self._seen)


def _apart(dyeing: Dyeing, one: Seen, other: Seen) -> float:
    return 0.0 if one == other else difference(dyeing.colour(one), dyeing.colour(other))


def applied(dyeing: Dyeing, near: Nearest) -> Dyeing:
    """Return a dyeing with the order and the baths of colours that can be dyed."""
    baths = tuple(next(bath for bath in dyeing.baths if bath.name == name) for name in near.order)
    inks = {name: near.seen.get(f"ink.{name}", seen) for name, seen in dyeing.inks.items()}
    return replace(dyeing, baths=baths, ground=near.seen[GROUND], inks=inks)


def refusal(dyeing: Dyeing, colours: Mapping[str, Seen]) -> str:
    """Return in words why colours cannot be dyed by adding wax alone, and which can; nothing if they can."""
    why = why_not(dyeing, colours)
    if not why:
        return ""
    near = nearest(dyeing, colours)
    changed = [
        f"{name}.baths = {_list(replace(dyeing, baths=applied(dyeing, near).baths), seen)} "
        f"({dyeing.colour(seen)} for {dyeing.colour(colours[name])})"
        for name, seen in near.seen.items()
        if seen != colours[name]
    ]
    order = [] if near.order == dyeing.names else [f"[[bath]] in the order {', '.join(near.order)}"]
    return f'{why}; removal = "javanese" can, or {" and ".join(order + changed)}'


def _named(dyeing: Dyeing, seen: Seen) -> str:
    return " and ".join(dyeing.listed(seen))


def _list(dyeing: Dyeing, seen: Seen) -> str:
    return "[" + ", ".join(f'"{name}"' for name in dyeing.listed(seen)) + "]"
