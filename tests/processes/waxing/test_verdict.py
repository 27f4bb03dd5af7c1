"""Which colours can be dyed by adding wax alone, why others cannot, and what is offered instead."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.artwork import Bath, Dyeing, Seen
from batik_vector.processes.waxing.choices import Plates, Removal
from batik_vector.processes.waxing.planning import Doing, planned, plates
from batik_vector.processes.waxing.verdict import applied, colours_of, nearest, refusal, why_not

NAMES = ("indigo", "soga", "madder")
COLOURS = ("#2b4a8b", "#9a6233", "#a8322b")

seen = st.frozensets(st.sampled_from(NAMES))


@st.composite
def dyeings(draw: st.DrawFn) -> Dyeing:
    order = draw(st.permutations(NAMES))
    baths = tuple(Bath(name, COLOURS[NAMES.index(name)]) for name in order)
    inks = {f"ink{number}": each for number, each in enumerate(draw(st.lists(seen, min_size=1, max_size=4)))}
    return Dyeing(baths, "#f4efe2", draw(seen), inks)


def colours(dyeing: Dyeing) -> dict[str, Seen]:
    return colours_of(dyeing, list(dyeing.inks))


def replayed(dyeing: Dyeing, removal: Removal) -> dict[Seen, Seen]:
    """Return what cloth of each set has seen when the steps are done: wax by wax, bath by bath."""
    sets = set(colours(dyeing).values())
    got = {each: frozenset[str]() for each in sets}
    waxed: set[Seen] = set()
    for step in planned(dyeing, sets, removal):
        if step.doing is Doing.WAX:
            assert removal is Removal.ADD_ONLY or not waxed & step.sets, "waxed twice"
            waxed |= step.sets
        elif step.doing is Doing.SCRAPE:
            assert removal is Removal.JAVANESE
            assert waxed >= step.sets, "scraped where no wax is"
            waxed -= step.sets
        elif step.doing is Doing.DYE:
            got |= {each: got[each] | {step.bath} for each in sets - waxed}
    return got


@settings(deadline=None, derandomize=True, max_examples=60)
@given(dyeings())
def test_the_javanese_order_dyes_any_colours(dyeing: Dyeing) -> None:
    assert all(each == got for each, got in replayed(dyeing, Removal.JAVANESE).items())


@settings(deadline=None, derandomize=True, max_examples=100)
@given(dyeings())
def test_adding_alone_dyes_what_is_not_refused_and_what_is_offered(dyeing: Dyeing) -> None:
    dyed = all(each == got for each, got in replayed(dyeing, Removal.ADD_ONLY).items())
    assert dyed == (not why_not(dyeing, colours(dyeing)))
    offered = applied(dyeing, nearest(dyeing, colours(dyeing)))
    assert not why_not(offered, colours(offered))
    assert all(each == got for each, got in replayed(offered, Removal.ADD_ONLY).items())
    if dyed:
        assert colours(offered) == colours(dyeing)


def two(ground: Seen, **inks: Seen) -> Dyeing:
    baths = tuple(Bath(name, colour) for name, colour in zip(NAMES[:2], COLOURS, strict=False))
    return Dyeing(baths, "#f4efe2", ground, inks)


INDIGO, SOGA = (frozenset({name}) for name in NAMES[:2])


def test_reasons_name_two_colours_or_the_bath_that_comes_before() -> None:
    beside = two(INDIGO | SOGA, blue=INDIGO, brown=SOGA)
    words = refusal(beside, colours(beside))
    assert words.startswith("ink.blue sees indigo and not soga, ink.brown the other way round")
    assert 'removal = "javanese" can, or ' in words
    turned = two(INDIGO | SOGA, brown=SOGA)
    assert refusal(turned, colours(turned)).endswith("or [[bath]] in the order soga, indigo")
    assert refusal(two(INDIGO | SOGA, blue=INDIGO), {}) == ""


def test_steps_have_the_workshop_s_names() -> None:
    dyeing = two(INDIGO | SOGA, white=frozenset(), blue=INDIGO, brown=SOGA)
    steps = planned(dyeing, colours(dyeing).values(), Removal.JAVANESE)
    assert [each.name for each in steps] == [
        "nglowong",
        "nembok",
        "indigo",
        "ngerok",
        "mbironi",
        "soga",
        "lorod",
    ]
    assert [each.stays for each in steps[:2]] == [False, True]
    made = plates(dyeing, colours(dyeing).values(), Removal.JAVANESE, Plates.BATHS)
    assert [(each.name, each.step.sets) for each in made] == [
        ("1 indigo", frozenset({frozenset(), SOGA})),
        ("2 soga", frozenset({frozenset(), INDIGO})),
    ]
