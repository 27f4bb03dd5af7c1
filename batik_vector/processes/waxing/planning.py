"""The order of work: what is waxed, scraped off, dyed and boiled out, for cloth of some sets of baths.

Cloth that is not to see a bath needs wax in it. In the Javanese order, of two baths: *nglowong* draws what
will be scraped off again and *nembok* fills with a stronger wax what stays white; first bath, indigo;
*ngerok* scrapes off the wax of nglowong; *mbironi* waxes the blues; second bath, soga; *lorod* boils all wax
out (the Winotosastro workshop, Yogyakarta). More baths go on with ngerok and mbironi.
"""

from __future__ import annotations

import enum
from collections.abc import Iterable, Iterator, Sequence

from batik_vector.artwork import Dyeing, Seen
from batik_vector.processes.waxing.choices import Plates, Removal
from batik_vector.values import frozen


class Doing(enum.StrEnum):
    """What is done to the cloth."""

    WAX = "wax"
    SCRAPE = "scrape"
    DYE = "dye"
    BOIL = "boil"


@frozen
class Step:
    """A step of the work, on cloth that is to see one of some sets of baths in the end.

    ``bath`` is the bath, or the one that the wax is for. ``stays`` tells wax that is on the cloth to the last
    bath from wax that is scraped off before.
    """

    name: str
    doing: Doing
    bath: str = ""
    sets: frozenset[Seen] = frozenset()
    stays: bool = True


@frozen
class Plate:
    """One plate: its name as files have it, what it is for, and on which cloth it lies."""

    name: str
    step: Step


def planned(dyeing: Dyeing, sets: Iterable[Seen], removal: Removal) -> tuple[Step, ...]:
    """Return the steps of a dyeing.

    Args:
        dyeing: whose baths are dyed in their order.
        sets: the sets of baths that there is cloth of.
        removal: whether wax is scraped off between baths; without it all sets must begin that order.
    """
    return tuple(_steps(dyeing.names, sorted(set(sets), key=sorted), removal))


def _steps(baths: Sequence[str], sets: Sequence[Seen], removal: Removal) -> Iterator[Step]:
    waxed: frozenset[Seen] = frozenset()
    for number, bath in enumerate(baths):
        needed = frozenset(each for each in sets if bath not in each)
        if removal is Removal.JAVANESE and waxed - needed:
            yield Step("ngerok", Doing.SCRAPE, bath, waxed - needed)
        later = frozenset(each for each in needed - waxed if each & set(baths[number + 1 :]))
        yield from _waxed(number, bath, later, needed - waxed - later, removal)
        yield Step(bath, Doing.DYE, bath, frozenset(sets) - needed)
        waxed = needed
    yield Step("lorod", Doing.BOIL)


def _waxed(
    number: int, bath: str, later: frozenset[Seen], ever: frozenset[Seen], removal: Removal
) -> Iterator[Step]:
    """Yield how cloth is waxed before a bath: what takes a later one, and what takes none."""
    if removal is Removal.ADD_ONLY:
        names = (f"before {bath}", f"before {bath}")
    else:
        names = ("nglowong", "mbironi" if number else "nembok")
    if later:
        yield Step(names[0], Doing.WAX, bath, later, stays=False)
    if ever:
        yield Step(names[1], Doing.WAX, bath, ever)


def plates(dyeing: Dyeing, sets: Iterable[Seen], removal: Removal, of: Plates) -> tuple[Plate, ...]:
    """Return the plates of a dyeing in the order in which they are used, numbered in their names."""
    sets = list(sets)
    if of is Plates.BATHS:
        without = [(bath, frozenset(each for each in sets if bath not in each)) for bath in dyeing.names]
        found = [Step(bath, Doing.WAX, bath, waxed) for bath, waxed in without if waxed]
    else:
        steps = planned(dyeing, sets, removal)
        found = [each for each in steps if each.doing in (Doing.WAX, Doing.SCRAPE)]
    return tuple(Plate(f"{number} {each.name}", each) for number, each in enumerate(found, start=1))
