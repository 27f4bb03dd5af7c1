"""The slider of a number: see ``slide.js`` and :mod:`~batik_vector.studio.page.live`."""

from __future__ import annotations

from collections.abc import Callable

from nicegui import ui


class Slide(ui.element, component="slide.js"):
    """A slider that moves in the browser by itself, and tells its values as often as pictures can follow."""

    def __init__(
        self,
        ends: tuple[float, float, float],
        value: float,
        said: str,
        whole: bool,
        label: str,
        moved: Callable[[float, bool], None],
    ) -> None:
        """Draw it.

        Args:
            ends: the least, the most, and the step between two values.
            value: that it stands at.
            said: what the field beside it says, which may be a value past its ends.
            whole: whether it has whole numbers.
            label: what it is called, read out.
            moved: told its values, and with the last one that it was let go.
        """
        super().__init__()
        self.moved = moved
        self._at = value, said
        for name, each in zip(("min", "max", "step"), ends, strict=True):
            self._props[name] = each
        self._props.update({"value": value, "said": said, "turn": 0, "whole": whole, "label": label})

    def told(self, value: float, let_go: bool) -> None:
        """Take note of where a hand has moved it."""
        self._at = value, ""
        self.moved(value, let_go)

    def ends(self, low: float, high: float, step: float) -> None:
        """Set the ends, and the step between two values."""
        for name, value in (("min", low), ("max", high), ("step", step)):
            if self._props[name] != value:
                self._props[name] = value

    def set_value(self, value: float, said: str) -> None:
        """Move it from here, and have the field beside it say something."""
        if self._at != (value, said):
            self._at = value, said
            with self._props.suspend_updates():
                self._props.update({"value": value, "said": said})
            # The browser may know these values, and have moved on since: that it is told anew is what counts.
            self._props["turn"] += 1
