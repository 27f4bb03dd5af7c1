"""The contact sheet: variations of the draft at random, or over one or two of its numbers."""

from __future__ import annotations

import asyncio
from itertools import islice
from typing import TYPE_CHECKING

from nicegui import background_tasks, ui

from batik_vector.errors import BatikError
from batik_vector.studio.changes import variations
from batik_vector.studio.page.dialogs import dialog
from batik_vector.studio.page.parts import complain, group, say, telling, text, word_button
from batik_vector.studio.page.trying import GLANCE, LIMIT, SMALL, TRIAL, lack_of
from batik_vector.studio.parameters import Control, controls

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterator
    from typing import Any

    from batik_vector.studio.asking import View
    from batik_vector.studio.drafts import Draft
    from batik_vector.studio.page.session import Session
    from batik_vector.studio.pictures import Picture

ACROSS, DOWN = 4, 3
RANDOM = "at random"
LOOKED_AT = 5 * ACROSS * DOWN
"""Variations looked at, at most, for a sheet of those that hold."""


def explore(session: Session) -> None:
    """Open the sheet."""
    with dialog("Explore variations", "sheet") as made:
        Exploring(session, made)


class Exploring:
    """A sheet of variations, from one of which one goes on."""

    def __init__(self, session: Session, made: ui.dialog) -> None:
        self.session, self.made = session, made
        self.client = ui.context.client
        self.draft = session.draft
        self.round = 0
        self.numbers = {
            each.path: each
            for each in controls(self.draft).values()
            if each.span is not None and each.kind in ("number", "whole") and (each.is_set or each.useful)
        }
        named = {path: in_words(path) for path in self.numbers}
        with group("sheet-tools"):
            self.across = _choice("Vary", {RANDOM: "all numbers, at random", **named}, RANDOM)
            self.down = _choice("and from row to row", {"": "nothing else", **named}, "")
            self.down.bind_enabled_from(self.across, "value", backward=lambda value: value != RANDOM)
            with group("reach"):
                text("How far from here", "quiet small")
                self.reach = ui.slider(min=0.1, max=1, step=0.05, value=0.5)
                self.reach.props('aria-label="How far from here"')
            self.others = word_button("Others", self._others, icon="casino")
            self.others.bind_visibility_from(self.across, "value", backward=lambda value: value == RANDOM)
        self.wrong = text("", "wrong", "p").props("role=alert")
        self.sheet = group("contact")
        self.seed = 0
        self.lack = ""
        for each in (self.across, self.down):
            each.on_value_change(self._draw)
        self.reach.on("change", self._draw)
        made.on("hide", self._end)
        self._draw()

    def _end(self) -> None:
        self.round += 1

    def _others(self) -> None:
        self.seed += 1
        self._draw()

    def _in_rows(self) -> Iterator[tuple[str, Draft]]:
        """Yield the variations over numbers with what is said below them."""
        path = str(self.across.value)
        other = str(self.down.value or "")
        if not other or other == path:
            for value in _spread(self.numbers[path], ACROSS * DOWN, self.reach.value):
                yield f"{self.numbers[path].label} {value:g}", self.draft.with_value(path, value)
            return
        one, two = self.numbers[path].label, self.numbers[other].label
        for second in _spread(self.numbers[other], DOWN, self.reach.value):
            for value in _spread(self.numbers[path], ACROSS, self.reach.value):
                draft = self.draft.with_values([(path, value), (other, second)])
                yield f"{one} {value:g}, {two} {second:g}", draft

    def _draw(self) -> None:
        self.round += 1
        say(self.wrong, "")
        self.sheet.clear()
        with self.sheet:
            cards = [Card(number + 1, self._take) for number in range(ACROSS * DOWN)]
        fill = self._fill_rows if self.across.value != RANDOM else self._fill_at_random
        background_tasks.create(self._filled(fill(cards, self.round)))

    async def _filled(self, filling: Awaitable[None]) -> None:
        try:
            await filling
        except BatikError as error:
            say(self.wrong, str(error))
            self.sheet.clear()

    async def _fill_rows(self, cards: list[Card], mine: int) -> None:
        """Draw one variation after the other; of what leaves nothing to draw the place in the rows stays."""
        found = await asyncio.to_thread(lambda: list(self._in_rows()))
        for card, (words, draft) in zip(cards, found, strict=False):
            card.expect()
            picture = await self._look(draft, SMALL, mine)
            if picture is None:
                return
            if picture.svg:
                card.show(draft, words, self.session.keep(picture.svg), held=True)
            else:
                card.miss(f"{words}: nothing to draw")
        for left in cards[len(found) :]:
            left.box.delete()

    async def _fill_at_random(self, cards: list[Card], mine: int) -> None:
        """Show at once what looks as if it held; then try each, and draw others where one does not."""
        drafts = islice(variations(self.draft, self.seed, float(self.reach.value or 0.5)), LOOKED_AT)
        shown = [card for card in cards if await self._show_next(drafts, card, mine)]
        for card in shown:
            while not await self._holds(card, mine) and await self._show_next(drafts, card, mine):
                pass
        kept = sum(card.held for card in cards)
        if kept < len(cards) and not self._gone(mine):
            words = f"Of {LOOKED_AT} variations {kept} hold on cloth, of the others the last lacks: "
            say(self.wrong, f"{words}{self.lack}. Nearer to here more hold.")

    async def _show_next(self, drafts: Iterator[Draft], card: Card, mine: int) -> bool:
        """Show the next variation that looks well; return whether there is one, and anybody to look at it."""
        card.expect()
        while (draft := await asyncio.to_thread(next, drafts, None)) is not None:
            picture = await self._look(draft, GLANCE, mine)
            if picture is None:
                return False
            if not (lack := lack_of(picture)):
                card.show(draft, f"Variation {card.number}", self.session.keep(picture.svg))
                return True
            self.lack = lack
        if not self._gone(mine):
            card.box.delete()
        return False

    async def _holds(self, card: Card, mine: int) -> bool:
        """Try what a card shows; what nobody looks at any more need not be tried."""
        if card.draft is None or card.held or (picture := await self._look(card.draft, TRIAL, mine)) is None:
            return True
        lack = lack_of(picture)
        self.lack, card.held = lack or self.lack, not lack
        return card.held

    async def _look(self, draft: Draft, view: View, mine: int) -> Picture | None:
        """Return the picture of a variation, or None where nobody looks at the sheet any more."""
        if self._gone(mine):
            return None
        lane = f"\0sheet-{self.client.id}"
        found = await self.session.images.ask(draft, view, lane=lane, background=True, limit=LIMIT)
        return None if self._gone(mine) else found

    def _gone(self, mine: int) -> bool:
        return mine != self.round or self.client.is_deleted or self.sheet.is_deleted

    async def _take(self, card: Card) -> None:
        """Go on from a variation; one that was not tried yet is tried first."""
        if (draft := card.draft) is None:
            return
        if not card.held:
            picture = await self.session.images.ask(draft, TRIAL, lane="\0variation", limit=LIMIT)
            if picture is None:
                return
            if lack := lack_of(picture):
                # Another one will stand in its place once its turn comes.
                complain(f"This one does not hold on cloth: {lack}")
                return
        self.session.alter("variation taken", lambda _: draft)
        self.made.close()


class Card:
    """A place of the sheet: empty until its variation is drawn."""

    def __init__(self, number: int, take: Callable[[Card], Any]) -> None:
        self.number = number
        self.draft: Draft | None = None
        self.held = False
        """Whether it may be gone on from without a trial."""
        self.box = ui.element("button").classes("pattern").props("type=button disabled")
        with self.box:
            self._picture = ui.element("img").props('alt=""')
            self._words = text("", "name")
        self.box.on("click", telling(lambda: take(self)))

    def expect(self) -> None:
        """Show that it is being drawn."""
        self.draft = None
        self.box.props("disabled")
        self._picture.classes("drawing").props(remove="src")

    def show(self, draft: Draft, words: str, number: int, *, held: bool = False) -> None:
        """Show a variation, from which one may go on."""
        self.draft, self.held = draft, held
        say(self._words, words)
        self._picture.classes(remove="drawing").props(f'src="/studio/picture/{number}"')
        self.box.props(remove="disabled")

    def miss(self, words: str) -> None:
        """Say why there is none."""
        say(self._words, words)
        self._picture.classes(remove="drawing")


def _choice(label: str, names: dict[str, str], value: str) -> ui.select:
    """Return a list to choose from, in which one may look for words: recipes have a hundred numbers."""
    return ui.select(names, value=value, label=label, with_input=True).props("outlined dense options-dense")


def in_words(path: str) -> str:
    """Return a path as it is read: ``motif.flower.petal.length`` is the length of flower, petal."""
    *around, last = path.removeprefix("motif.").replace("_", " ").split(".")
    return f"{last} of {', '.join(around)}" if around else last


def _spread(control: Control, count: int, reach: float | None) -> list[float]:
    """Return values of a control from end to end of its slider, or as near to its own as the reach says."""
    low, high = control.span or (0.0, 1.0)
    value = float(control.value) if isinstance(control.value, int | float) else (low + high) / 2
    share = float(reach or 1)
    first, last = value + (low - value) * share, value + (high - value) * share
    found = [first + (last - first) * number / max(count - 1, 1) for number in range(count)]
    if control.kind == "whole":
        return list(dict.fromkeys(round(each) for each in found))
    return [float(f"{each:.3g}") for each in found]
