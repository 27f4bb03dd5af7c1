"""The display: the picture of the draft, its views and what is laid over it, and the line below it."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from nicegui import background_tasks, ui

from batik_vector.errors import BatikError, Fault
from batik_vector.studio.asking import View
from batik_vector.studio.page.colours import Colours
from batik_vector.studio.page.live import Live
from batik_vector.studio.page.parts import Soon, group, icon_button, say, text, toggled, word_button
from batik_vector.studio.page.slide import Slide
from batik_vector.studio.pictures import LIMIT

if TYPE_CHECKING:
    from batik_vector.studio.drafts import Draft
    from batik_vector.studio.page.session import Session
    from batik_vector.studio.pictures import Picture

VIEWS = {
    "tile": "Tile",
    "three": "3 × 3",
    "field": "Field",
    "yardage": "Yardage",
    "cushion": "Cushion",
    "shirt": "Shirt",
}
REPEATS = {"tile": (1, 1), "three": (3, 3), "field": (4, 4)}
"""Tiles across and up of views in which seams can be shown."""
FOLLOWS = 0.15
"""Seconds of work past which a picture is drawn coarser while a slider is dragged."""
SLOW = 0.6
"""Seconds of work from which on it is told, with a way to stop it."""
CALM = 0.7
"""Seconds without a change after which the tile is measured for its verdict."""


def outlook(vertices: int, seconds: float) -> str:
    """Return in words what is foreseen of a picture: how long it will take, and how large it will be."""
    if not vertices:
        return " so far"
    if seconds > LIMIT:
        return (
            f": about {_about(seconds / 60)} min are foreseen, and {LIMIT:g} s is the limit. A smaller tile "
            "or a larger tolerance is sooner there"
        )
    return f" of about {_about(seconds)} s, about {_about(vertices):,} vertices"


def took_words(seconds: float) -> str:
    """Return how long something took, with no more figures than anybody reads."""
    return f"{seconds * 1000:.0f} ms" if seconds < 1 else f"{seconds:.1f} s"


def _about(value: float) -> int:
    """Return a number by its first digit, at least 1."""
    return max(int(float(f"{value:.1g}")), 1)


class Display:
    """The middle of the page."""

    def __init__(self, session: Session, told: Callable[[], None]) -> None:
        """Draw it.

        Args:
            session: whose draft it shows.
            told: called when other faults have been found than before.
        """
        self.session = session
        self.client = ui.context.client
        self.view = "tile"
        self.live = session.tabs[self.client.id] = Live(self._slid)
        self.client.on_delete(lambda: session.tabs.pop(self.client.id, None))
        self._told = told
        self._asked = 0
        self._stage = ""
        self._wanted: tuple[Draft, View, int] | None = None
        self._slow = False
        self._since = 0.0
        self._ahead = 0, 0.0
        self._again = Soon(self._say_busy)
        self._stem = ""
        self._turned = False
        self._certified: Draft | None = None
        self._exact: Draft | None = None
        self._on = {"lines": False, "guides": False, "pins": True}
        self._inks: tuple[tuple[str, str], ...] = ()
        self._hidden: set[str] = set()
        self._verdict: asyncio.Task[None] | None = None
        with group("middle", "main"):
            with group("tools").props('role=toolbar aria-label="Display"'):
                self._tools()
            with group("stage-host"):
                self.stage = group("display")
                self.faults = group("faults").props("role=alert")
                with group("busy").props("role=status") as self.busy:
                    self.stage_words = text("", "small")
                    word_button("Stop", self._stop)
            with group("status", "footer"):
                self._status()
        self.faults.set_visibility(False)
        self.busy.set_visibility(False)
        self._run(f"studio.mount(getHtmlElement({self.stage.id}))")

    def _tools(self) -> None:
        self.views = {}
        for name, label in VIEWS.items():
            self.views[name] = word_button(label, lambda name=name: self.look(name))
        self._mark_view()
        group("space")
        self.colours = Colours(self.session)
        self._switch("lines", "polyline", "Lines instead of cloth and wax")
        self._switch("guides", "grid_4x4", "Seam guides")
        self._switch("pins", "push_pin", "Pointers of the certificate")
        with (
            icon_button("layers", "Layers", lambda: None),
            ui.menu().props("aria-label=Layers") as self.layers,
        ):
            pass

    def _status(self) -> None:
        text("", "said-size")
        text("", "extra said-counted")
        text("", "extra said-seconds")
        text("", "said-verdict").props("role=status")
        group("space")
        icon_button("remove", "Zoom out", lambda: self._run("studio.zoom(0.8)"))
        text("", "zoom")
        icon_button("add", "Zoom in", lambda: self._run("studio.zoom(1.25)"))
        icon_button("fit_screen", "Fit the window", lambda: self._run("studio.fit()"))
        word_button("1:1", lambda: self._run("studio.actual()")).props('aria-label="True size"')

    def _switch(self, name: str, icon: str, label: str) -> None:
        def press() -> None:
            self._on[name] = not self._on[name]
            toggled(button, self._on[name])
            self._run(f"studio.{name}({json.dumps(self._on[name])})")

        button = icon_button(icon, label, press)
        toggled(button, self._on[name])

    def look(self, view: str) -> None:
        """Look at the draft in another way."""
        self.view, self._turned = view, False
        self._mark_view()
        self.refresh()

    def _begin_with(self) -> None:
        """Look at what is opened as a cloth where it has a border, or no tile at all."""
        draft = self.session.draft
        if draft.stem == self._stem or draft.faults:
            return
        self._stem = draft.stem
        self._slow = False
        cloth = draft.recipe.tile is None or bool(draft.recipe.border)
        if cloth and self.view == "tile":
            self.view, self._turned = "yardage", True
        elif not cloth and self._turned:
            self.view, self._turned = "tile", False
        self._mark_view()

    def _mark_view(self) -> None:
        for name, button in self.views.items():
            toggled(button, name == self.view)

    def _slid(self, number: int, value: float, let_go: bool) -> None:
        slider = self.client.elements.get(number)
        if isinstance(slider, Slide):
            with self.client.content:
                slider.told(value, let_go)

    def _run(self, code: str) -> None:
        if not self.client.is_deleted:
            self.client.run_javascript(code)

    # Pictures.

    def refresh(self) -> None:
        """Ask for a picture of what is open now; of several wishes the newest counts."""
        self._begin_with()
        rough = self.session.held and self._slow
        self.colours.refresh()
        draft, view = self.session.draft, View(self.view, rough=rough, colourway=self.session.colourway)
        if self._wanted != (draft, view, self.session.saves):
            self._wanted = draft, view, self.session.saves
            background_tasks.create(self._ask(draft, view))
            if rough and (motif := self.session.motif_held):
                background_tasks.create(self._ask_alone(draft, motif))

    async def _ask_alone(self, draft: Draft, motif: str) -> None:
        """Show the motif whose slider moves by itself: it is there before the pattern is."""
        lane = f"{self.client.id}\0motif"
        view = View(motif=motif, colourway=self.session.colourway)
        picture = await self.session.images.ask(draft, view, lane=lane)
        if picture is None or not picture.svg or self.client.is_deleted:
            return
        # What is drawn exactly by now need not be seen in part.
        if self._exact is not draft:
            self.live.put({"name": motif}, picture.svg, "motif")

    async def _ask(self, draft: Draft, view: View) -> None:
        if not self.busy.visible:
            self._since = time.monotonic()
        self._asked += 1
        mine = self._asked
        self._ahead = 0, 0.0
        alarm = asyncio.get_running_loop().call_later(SLOW, lambda: self._tell_busy(mine, draft, view))
        try:
            picture = await self.session.images.ask(draft, view, lane=self.client.id, tell=self._tell_stage)
        finally:
            alarm.cancel()
        if mine == self._asked:
            self._show_busy(False)
        if self.client.is_deleted:
            return
        if picture is not None:
            self._show(picture)
        elif mine == self._asked:
            self._tell_faults((Fault("cancelled"),))

    def _tell_busy(self, asked: int, draft: Draft, view: View) -> None:
        if asked == self._asked:
            self._show_busy(True)
            background_tasks.create(self._foresee(asked, draft, view))

    async def _foresee(self, asked: int, draft: Draft, view: View) -> None:
        """Find out what is to come while it is on its way."""
        ahead = await self.session.foreseen(draft, view)
        if asked == self._asked:
            self._ahead = ahead
            if self.busy.visible:
                self._say_busy()

    def _tell_stage(self, stage: str) -> None:
        self._stage = stage
        if self.busy.visible:
            self._say_busy()

    def _say_busy(self) -> None:
        """Tell what is done, for how long by now, and what is to come."""
        if not self.busy.visible or self.client.is_deleted:
            return
        words = f"{self._stage or 'waiting'}, {time.monotonic() - self._since:.0f} s"
        say(self.stage_words, words + outlook(*self._ahead))
        self._again(1.0)

    def _show_busy(self, on: bool) -> None:
        if self.busy.visible != on:
            self.busy.set_visibility(on)
        if on:
            self._say_busy()

    def _stop(self) -> None:
        # All tabs show one draft, and wait for one process.
        for lane in list(self.session.tabs):
            self.session.images.cancel(lane)

    def _show(self, picture: Picture) -> None:
        before = self.session.faults
        self.session.compiled(picture)
        if self.session.faults != before:
            self._told()
        self._tell_faults(picture.faults)
        if not picture.svg:
            return
        # What comes after it is waited for from now on.
        self._since = time.monotonic()
        sketch = picture.view.rough
        if not sketch:
            self._exact = picture.draft
            # How long a sketch took says nothing of what it stands for.
            self._slow = picture.seconds > FOLLOWS
            if self._slow:
                background_tasks.create(self.session.images.warm_detail())
        facts = picture.facts
        # Of a cloth that has a size it is the cloth's, of all others the tile's.
        width, height = facts["size_mm" if picture.view.kind == "yardage" else "cell_mm"]
        # Told by the picture's own way, for the page's elements would keep the browser busy.
        words = {
            "size": f"{width:g} × {height:g} mm",
            "counted": f"{facts.get('vertices', 0):,} vertices",
            "seconds": f"{'sketched' if sketch else 'drawn'} in {took_words(picture.seconds)}",
        }
        certified = picture.draft is self._certified
        head = {"guides": self._guides(facts), "words": words, "certified": certified, "sketch": sketch}
        self.live.put(head, picture.svg)
        self._list_layers(facts)
        if self._verdict is not None:
            self._verdict.cancel()
        self._verdict = background_tasks.create(self._certify(picture))

    def _tell_faults(self, told: tuple[Fault, ...]) -> None:
        if self.faults.visible != bool(told):
            self.faults.set_visibility(bool(told))
        if not told:
            return
        self.faults.clear()
        with self.faults:
            for fault in told[:8]:
                line = f"line {fault.line}: " if fault.line else ""
                key = f"{fault.key}: " if fault.key else ""
                text(f"{line}{key}{fault.message}", "fault", "p")
            text("The picture above is the last that could be drawn.", "quiet small", "p")

    def _guides(self, facts: Any) -> list[list[list[float]]]:
        """Return where repeats meet, as lines in mm of the picture, y down."""
        if self.view not in REPEATS:
            return []
        across, up = REPEATS[self.view]
        width, height = facts["cell_mm"]
        drop, by_column = self._drop()
        lines = []
        for column in range(across):
            for row in range(up):
                x, y = column * width, row * height
                if by_column:
                    # Columns stand higher by their share; y points down.
                    y -= float(column * drop % 1) * height
                else:
                    x -= float((up - 1 - row) * drop % 1) * width
                box = [[x, y], [x + width, y], [x + width, y + height], [x, y + height], [x, y]]
                lines.append(box)
        return lines

    def _drop(self) -> tuple[Fraction, bool]:
        try:
            recipe = self.session.draft.recipe
            if recipe.tile is None:
                return Fraction(0), True
            cell = recipe.tiling.cell()
        except BatikError:
            return Fraction(0), True
        return cell.drop, cell.axis == "column"

    def _list_layers(self, facts: Any) -> None:
        inks = tuple((each["ink"], each["colour"]) for each in facts.get("layers", ()))
        inks = (("cloth", str(facts.get("cloth", ""))), *inks)
        if inks == self._inks:
            return
        self._inks = inks
        self.layers.clear()
        with self.layers, group("layers"):
            for name, colour in inks:
                with group("layer"):
                    ui.checkbox(
                        name,
                        value=name not in self._hidden,
                        on_change=lambda event, name=name: self._layer(name, event.value),
                    ).props("dense size=sm")
                    group("dot").style(f"background: {colour}" if colour else "visibility: hidden")

    def _layer(self, name: str, on: bool) -> None:
        self._hidden.discard(name) if on else self._hidden.add(name)
        self._run(f"studio.layer({json.dumps(name)}, {json.dumps(on)})")

    async def _certify(self, picture: Picture) -> None:
        await asyncio.sleep(CALM)
        if picture.draft is not self.session.draft or self.client.is_deleted:
            return
        # Each tab waits for its own: what another one asks for must not drop it.
        # In the same colours, or the tile would be compiled anew.
        view = View("tile", certify=True, colourway=picture.view.colourway)
        lane = f"\0verdict-{self.client.id}"
        found = await self.session.images.ask(picture.draft, view, lane=lane, background=True)
        if found is None or not found.verdict or found.draft is not self.session.draft:
            return
        self._certified = picture.draft
        faults = found.verdict["faults"]
        passed = found.verdict["passed"]
        count = f"{len(faults)} fault{'s' * (len(faults) > 1)}"
        words = "Seam certificate passed" if passed else f"{count} in the certificate"
        height = found.facts["cell_mm"][1]
        pins = [
            {"x": each["where_mm"][0], "y": height - each["where_mm"][1], "text": each["words"]}
            for each in (faults if self.view == "tile" else [])
        ]
        self.live.amend({"verdict": words, "passed": passed, "pins": pins})
