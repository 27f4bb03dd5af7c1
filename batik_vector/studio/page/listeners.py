"""Everyone who is to be told when something changes."""

from __future__ import annotations

import logging
from collections.abc import Callable


def added(listeners: list[Callable[[], None]], callback: Callable[[], None]) -> Callable[[], None]:
    """Add one to those who are called; return what takes it out again."""
    listeners.append(callback)

    def forget() -> None:
        if callback in listeners:
            listeners.remove(callback)

    return forget


def call(listeners: list[Callable[[], None]]) -> None:
    """Call all of them."""
    for each in list(listeners):
        try:
            each()
        except Exception:  # a tab that has gone must not keep the others from being told
            logging.getLogger(__name__).exception("a tab could not be told")
