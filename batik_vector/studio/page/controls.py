"""The panels of parameters, made from the declarations that make the schema and the help.

What is not opened is not made: a recipe has hundreds of controls, and few are looked at at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from nicegui import ui

from batik_vector.errors import BatikError
from batik_vector.studio.page.dialogs import scale
from batik_vector.studio.page.fields import Row
from batik_vector.studio.page.parts import group, icon_button, menu_row, say, telling, text, told, word_button
from batik_vector.studio.parameters import ABOUT, Control, Group, Panel, panels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from batik_vector.studio.offers import Offer
    from batik_vector.studio.page.session import Session

MOST_PLAIN = 6
"""Controls of a table past which those that are not often set stand behind a button."""
CALLED = {
    "place": "placement",
    "corner place": "corner placement",
    "fill with": "fill",
    "elements": "element",
    "output": "file",
}
"""What members of lists are called on buttons, whose key is another word."""
HEADED = {"tile": "size and repeat", "cloth": "dye", "": "title and precision"}
"""What stands over groups whose key is also the word for their panel, or which have none."""
NO_FILES = "The recipe asks for no files of its own: Export makes any."


def is_plain(control: Control) -> bool:
    """Whether a control is shown at once: it is set, or belongs to the shape that one designs."""
    return control.is_set or bool(control.symbol or control.useful or control.fault or control.needed)


class Controls:
    """The right of the page."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.open: set[str] = set()
        self.more: set[str] = set()
        self._stem: str | None = None
        self._sections: dict[str, Section] = {}
        with group("scroll") as self.box:
            self.wrong = text("", "pad fault small", "p").props("role=alert")
            self.wrong.set_visibility(False)
            self.rows = group("panels")

    def refresh(self) -> None:
        """Show the parameters as they are now."""
        try:
            found = panels(self.session.draft, self.session.faults)
        except BatikError:
            # There is nothing to show of what is no TOML; the panels stay as they were.
            say(self.wrong, "The recipe's text cannot be read: mend it under Recipe, or undo.")
            self.wrong.set_visibility(True)
            return
        self.wrong.set_visibility(False)
        if self._stem != self.session.draft.stem:
            self._stem = self.session.draft.stem
            self.open.update(_opened(found))
        for panel in found:
            mine = Group(
                f"panel:{panel.name}", panel.name.capitalize(), ABOUT[panel.name], groups=panel.groups
            )
            self.section(mine, self.rows, 0, len(found))

    def reveal(self, *paths: str) -> None:
        """Open sections, the outermost first, and bring the last one into sight."""
        self.open.update(paths)
        for path in paths:
            section = self._sections.get(path)
            if section is not None and not section.is_open:
                section.toggle()
        self.refresh()
        last = self._sections.get(paths[-1])
        if last is not None:
            ui.run_javascript(
                f"getHtmlElement({last.box.id})?.scrollIntoView({{block: 'center', behavior: 'smooth'}})"
            )

    def section(self, shown: Group, around: ui.element, depth: int, siblings: int) -> None:
        """Show a group: one that is there already is brought up to date."""
        section = self._sections.get(shown.path)
        if section is None or section.box.is_deleted:
            with around:
                section = self._sections[shown.path] = Section(self, shown, depth)
        section.update(shown, siblings)


def _opened(found: Sequence[Panel]) -> Iterator[str]:
    """Yield what is open at first: the pattern, and the motif that has most of the paper's parameters.

    Of panels that are opened later, what one would look for.
    """
    yield from ("panel:pattern", "motif", "tile", "cloth", "yardage")
    motifs = [
        motif for each in found for whole in each.groups if whole.path == "motif" for motif in whole.groups
    ]
    if not motifs:
        return
    first = max(motifs, key=_paper)
    yield first.path
    parts = [part for part in first.groups if sum(each.is_set for each in part.all_controls())]
    for part in (parts or list(first.groups))[:2]:
        yield part.path
        if part.groups:
            yield part.groups[0].path
            yield from (inner.path for inner in part.groups[0].groups)


def _paper(motif: Group) -> tuple[bool, int]:
    kinds = [each.value for each in motif.controls if each.path == f"{motif.path}.kind"]
    return "flower" in kinds, sum(bool(each.symbol) for each in motif.all_controls())


class Section:
    """A group of controls that opens and closes."""

    def __init__(self, controls: Controls, shown: Group, depth: int) -> None:
        self.controls, self.session, self.depth = controls, controls.session, depth
        self.shown = shown
        self._rows: dict[str, Row] = {}
        self._shape: tuple[object, ...] = ()
        self.dot: ui.element | None = None
        # A list among the panel's own headings says nothing that its members do not say.
        self.flat = depth == 1 and shown.path in ("motif", "place", "ink", "output", "palette")
        kind = " flat" if self.flat else " member" if shown.member else ""
        self.box = group(f"section depth-{depth}{kind}")
        with self.box:
            if not self.flat:
                self.head = group("section-head")
            self.body = group("section-body")
            self.foot = group("section-foot")
        self.is_open = self.flat or shown.path in controls.open

    @property
    def bare(self) -> bool:
        """Whether there is nothing of it yet but what can be added: that is said in one line."""
        shown = self.shown
        return bool(shown.offers) and not (self.flat or shown.controls or shown.groups or shown.fault)

    def toggle(self) -> None:
        """Open it, or close it."""
        self.is_open = not self.is_open
        known = self.controls.open
        known.add(self.shown.path) if self.is_open else known.discard(self.shown.path)
        self._shape = ()
        self.update(self.shown, self._siblings)

    def update(self, shown: Group, siblings: int) -> None:
        """Show a group as it is now."""
        self.shown, self._siblings = shown, siblings
        # What comes in where there was nothing is looked at.
        self.is_open = self.is_open or self.bare
        more = shown.path in self.controls.more
        shape = (
            self.is_open,
            self.bare,
            more,
            siblings,
            shown.label,
            shown.fault,
            tuple((each.path, each.kind, each.span is None, is_plain(each)) for each in shown.controls),
            tuple(each.path for each in shown.groups),
            tuple((each.path, each.label) for each in shown.offers),
            tuple((each.label, each.is_set) for each in shown.groups),
        )
        if shape != self._shape:
            self._shape = shape
            self._build(more)
        else:
            self._dye()
        for control in shown.controls:
            if control.path in self._rows:
                self._rows[control.path].update(control)
        if self.is_open:
            for each in shown.groups:
                if each.is_set or each.controls or each.groups or each.offers:
                    self.controls.section(each, self.body, self.depth + 1, len(shown.groups))

    def _build(self, more: bool) -> None:
        if not self.flat:
            self.head.clear()
            self.head.set_visibility(not self.bare)
            self.box.classes(add="bare" if self.bare else "", remove="" if self.bare else "bare")
            with self.head:
                self._heading()
        self.body.clear()
        self._rows = {}
        self.body.set_visibility(self.is_open)
        self.foot.set_visibility(self.is_open)
        if not self.is_open:
            return
        with self.body:
            if self.shown.fault:
                text(self.shown.fault, "fault").props("role=alert")
            if self.shown.path == "output" and not self.shown.groups:
                text(NO_FILES, "quiet small empty", "p")
            few = len(self.shown.controls) <= MOST_PLAIN
            plain = [each for each in self.shown.controls if few or more or is_plain(each)]
            for control in plain:
                self._rows[control.path] = Row(self.session, control)
            if not few and (more or len(plain) < len(self.shown.controls)):
                count = len(self.shown.controls) - len(plain)
                label = "Fewer settings" if more else f"{count} more setting{'s' if count > 1 else ''}"
                word_button(label, self._more).classes("more")
        self.foot.clear()
        if self.shown.offers and (self.flat or not self.shown.member):
            self._adding()
        if self.shown.path == "tile":
            # Who wants the whole larger looks here first, where the repeat alone grows.
            with self.foot:
                word_button("Scale the whole pattern …", lambda: scale(self.session)).classes("more")

    def _heading(self) -> None:
        with ui.element("button").classes("section-name").props("type=button") as name:
            name.props(f"aria-expanded={'true' if self.is_open else 'false'}")
            ui.icon("expand_more" if self.is_open else "chevron_right", size="18px").props("aria-hidden=true")
            text(HEADED.get(self.shown.path, self.shown.label), "label")
            self.dot = group("dot") if self._colour() else None
            if self.depth == 0:
                text(self.shown.help, "about quiet small")
            if not self.is_open and any(each.fault for each in self.shown.all_controls()):
                ui.icon("error", size="16px").classes("fault")
        name.on("click", self.toggle)
        self._dye()
        path = self.shown.path
        if self.shown.member and self._siblings > 1:
            up, down = (telling(lambda by=by: self.session.move(path, by)) for by in (-1, 1))
            icon_button("arrow_upward", f"Move {self.shown.label} up", up)
            icon_button("arrow_downward", f"Move {self.shown.label} down", down)
        if self.shown.member:
            icon_button(
                "content_copy", f"Copy {self.shown.label}", telling(lambda: self.session.copy_of(path))
            )
        if self.shown.member or (self.shown.optional and self.shown.is_set and self.depth > 1):
            icon_button("close", f"Remove {self.shown.label}", telling(lambda: self.session.remove(path)))

    def _colour(self) -> str:
        """Return the colour that the section is about, or nothing."""
        path = f"{self.shown.path}.colour"
        found = (each.value for each in self.shown.controls if each.path == path and each.kind == "colour")
        return str(next(found, None) or "")

    def _dye(self) -> None:
        """Show that colour beside its name."""
        if self.dot is not None:
            self.dot.style(f"background: {self._colour()}")

    def _adding(self) -> None:
        offers = self.shown.offers
        what = CALLED.get(self.shown.label, self.shown.label)
        with self.foot:
            if len(offers) == 1:
                label = f"Add {CALLED.get(offers[0].label, offers[0].label)}"
                word_button(label, lambda: self._add(offers[0]), icon="add").classes("more")
                return
            with (
                word_button(f"Add {what}", icon="add").props("aria-haspopup=menu").classes("more"),
                ui.menu(),
            ):
                for offer in offers:
                    menu_row(offer.label, partial(self._add, offer))

    def _add(self, offer: Offer) -> None:
        self.controls.open.update((self.shown.path, offer.path))
        with told():
            self.session.add(offer)

    def _more(self) -> None:
        known = self.controls.more
        known.symmetric_difference_update({self.shown.path})
        self.update(self.shown, self._siblings)
