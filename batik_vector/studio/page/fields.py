"""One row of a panel: a control with its name, symbol, field, reset and lock."""

from __future__ import annotations

import contextlib
import math
import tomllib
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from nicegui import ui

from batik_vector.studio.offers import offered_colours
from batik_vector.studio.page.parts import group, icon_button, offering, say, text, told
from batik_vector.studio.page.slide import Slide
from batik_vector.studio.text.spelling import spelled

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session
    from batik_vector.studio.parameters import Control


def shown(value: Any) -> str:
    """Return a value as a field shows it: numbers with no more figures than they have."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        # Millions are read better by their figures, and fit into the field: 1e7.
        short = f"{value:.6g}".replace("e+0", "e").replace("e+", "e")
        return short if float(short) == value else str(value)
    if isinstance(value, float):
        return f"{value:.6g}" if math.isfinite(value) else ""
    if isinstance(value, list) and value and all(isinstance(each, str) for each in value):
        words = ", ".join(value)
        return words if read(words) == value else spelled(value)
    return value if isinstance(value, str) else spelled(value)


def read(words: str) -> Any:
    """Return what is typed into a field for lists: as a recipe has it, or words with commas between."""
    words = words.strip()
    if not words:
        return None
    for spelling in (words, f"[{words}]"):
        with contextlib.suppress(tomllib.TOMLDecodeError):
            return tomllib.loads(f"x = {spelling}")["x"]
    bare = words[1:-1] if words[0] + words[-1] == "[]" and words.count("[") == 1 else words
    return [each.strip().strip("\"'") for each in bare.split(",")]


class Row:
    """A control on the page."""

    def __init__(self, session: Session, control: Control) -> None:
        self.session, self.control = session, control
        self._setting = False
        sliding = control.span is not None
        shape = "control" if sliding else "control wide long" if control.kind == "list" else "control wide"
        with group(shape).props(f'data-path="{control.path}"') as self.box:
            self._name()
            self.slider = self._slide() if sliding else None
            self.field = self._field()
            self.reset = icon_button("restart_alt", f"Reset {self.words}", self._reset, tip=self._usual())
            self.lock = icon_button(
                "lock_open", f"Lock {self.words}", self._lock, tip="Lock: variations leave it"
            )
            self.lock.classes("lock")
            self.fault = text("", "fault").props("role=alert")
        self.update(control, force=True)

    @property
    def words(self) -> str:
        """What the control is called, read out."""
        around = self.control.path.rsplit(".", 2)
        return f"{self.control.label} of {around[-2]}" if len(around) > 1 else self.control.label

    def _usual(self) -> str:
        usual = shown(self.control.default)
        return f"Reset to {usual}" if usual else "Reset"

    def _name(self) -> None:
        with group("name", "span") as self.name:
            text(self.control.label)
            if self.control.symbol and self.control.symbol != self.control.label:
                text(self.control.symbol, "", "i")
            if self.control.help:
                ui.tooltip(self._help()).props("delay=400 max-width=280px aria-hidden=true")

    def _help(self) -> str:
        bounds = (self.control.least, self.control.most)
        told = f"; {shown(bounds[0])} to {shown(bounds[1])}" if None not in bounds else ""
        return f"{self.control.help}{told} {self.control.unit}".strip()

    def _spoken(self) -> str:
        return f"{self.words} in mm" if self.control.unit == "mm" else self.words

    def _labelled(self, element: ui.element) -> ui.element:
        element._props["aria-label"] = self._spoken()
        return element

    def _slide(self) -> Slide:
        low, high = self.control.span or (0, 1)
        whole = self.control.kind == "whole"
        ends = low, high, self.control.step or 0.01
        said = shown(self.control.value)
        return Slide(ends, self._within(low, high), said, whole, self._spoken(), self._slid)

    def _within(self, low: float, high: float) -> float:
        value = self.control.value
        number = value if isinstance(value, int | float) and not isinstance(value, bool) else low
        return min(max(float(number), low), high)

    def _field(self) -> ui.element:
        control = self.control
        made: Any
        if control.kind == "switch":
            made = ui.switch(value=bool(control.value)).props("dense size=sm")
            made.on_value_change(lambda event: self._set(event.value))
        elif control.kind in ("choice", "names"):
            made = self._select()
        else:
            made = ui.input(value=shown(control.value)).props("dense outlined hide-bottom-space")
            # Of a field of several lines, too, Enter takes what it says.
            made.on("blur", self._typed).on("keydown.enter.prevent", self._typed)
            if control.unit:
                made.props(f'suffix="{control.unit}"')
            if control.kind == "list":
                made.props('placeholder="none" type=textarea autogrow')
            if control.kind == "text" and not control.default:
                made.props('placeholder="none"')
            if control.kind == "text" and control.choices:
                offering(made, f"Choose {self.words}", control.choices, self._set)
            if control.kind == "colour":
                self._picker(made)
        return self._labelled(made)

    def _select(self) -> ui.select:
        several = self.control.kind == "names"
        made = ui.select(self._options(self.control.choices), multiple=several, value=self._chosen())
        made.props("dense outlined options-dense hide-bottom-space").on_value_change(
            lambda event: self._set(event.value)
        )
        return made

    def _options(self, choices: Sequence[str]) -> dict[str, str]:
        held = self.control.value
        more = held if isinstance(held, list) else [held] if isinstance(held, str) else []
        return {each: each or "inherited" for each in dict.fromkeys([*choices, *map(str, more)])}

    def _chosen(self) -> Any:
        value = self.control.value
        if self.control.kind == "names":
            return list(value) if isinstance(value, list) else [] if value is None else [value]
        return value if isinstance(value, str) else None

    def _picker(self, field: ui.input) -> None:
        with field.add_slot("prepend"):
            button = (
                ui.button(color=None).props(f'flat dense aria-label="Choose {self.words}"').classes("swatch")
            )
            with button, ui.color_picker(on_pick=lambda event: self._set(event.color)) as picker:
                picker.q_color.props(
                    f"default-view=palette :palette={offered_colours()!r} format-model=hex no-header"
                )
        self.swatch = button

    # What is done to it.

    def _slid(self, value: float, let_go: bool) -> None:
        value = round(value) if self.control.kind == "whole" else float(f"{value:.6g}")
        with told():
            self.session.slide(self.control.path, value, let_go)

    def _typed(self) -> None:
        assert isinstance(self.field, ui.input)
        words = str(self.field.value or "").strip()
        if words == shown(self.control.value):
            return
        value: Any = words or None
        if words and self.control.kind in ("number", "whole"):
            try:
                value = float(words.replace(",", "."))
                value = int(value) if self.control.kind == "whole" and value == int(value) else value
            except (ValueError, OverflowError):
                # Lengths may be said in other units; what is no number at all is told as a fault.
                value = words
        elif words and self.control.kind == "list":
            value = read(words)
        self._set(value)

    def _set(self, value: Any, merge: str = "") -> None:
        if not self._setting:
            with told():
                self.session.set_value(self.control.path, value, merge)

    def _reset(self) -> None:
        self._set(None)

    def _lock(self) -> None:
        with told():
            self.session.lock(self.control.path, not self.control.locked)

    def _quietly(self, action: Callable[[], Any]) -> None:
        self._setting = True
        try:
            action()
        finally:
            self._setting = False

    # What is shown of it.

    def update(self, control: Control, *, force: bool = False) -> None:
        """Show a control as it is now."""
        if control == self.control and not force:
            return
        self.control = control
        self._quietly(self._show)
        self.name.classes(add="" if control.is_set else "unset", remove="unset" if control.is_set else "")
        gone = not control.is_set or control.needed
        self.reset.classes(add="gone" if gone else "", remove="" if gone else "gone")
        self.lock.classes(add="locked" if control.locked else "", remove="" if control.locked else "locked")
        icon = "lock" if control.locked else "lock_open"
        if self.lock._props.get("icon") != icon:
            self.lock.props(f"icon={icon} aria-pressed={'true' if control.locked else 'false'}")
        say(self.fault, control.fault)
        self.fault.set_visibility(bool(control.fault))

    def _show(self) -> None:
        control = self.control
        if self.slider is not None and control.span is not None:
            self.slider.ends(*control.span, control.step or 0.01)
            self.slider.set_value(self._within(*control.span), shown(control.value))
        field: Any = self.field
        value: Any = self._chosen() if isinstance(field, ui.select) else shown(control.value)
        if isinstance(field, ui.select):
            options = self._options(control.choices)
            if field.options != options:
                field.set_options(options)
            if control.kind == "choice":
                self._say_none(field, value)
        elif control.kind == "switch":
            value = bool(control.value)
        if field.value != value:
            field.set_value(value)
        if control.kind == "colour":
            self.swatch.style(f"background: {shown(control.value)} !important")

    def _say_none(self, field: ui.select, value: Any) -> None:
        """Say so where nothing is chosen."""
        words = "none" if value is None else None
        if field._props.get("display-value") != words:
            field.props('display-value="none"') if words else field.props(remove="display-value")
