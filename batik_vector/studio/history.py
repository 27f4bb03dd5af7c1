"""Undo and redo without limit: every draft that there was, each kept as what it changed of the one before."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import field, replace
from typing import Any

from batik_vector.studio.drafts import Draft
from batik_vector.values import frozen

HELD = ("folder", "locked", "drawings", "stem")
"""What a draft has besides its text."""


@frozen
class Patch:
    """From one text to another: what stands between a beginning and an end that both have.

    Args:
        at: characters that both begin with.
        old, new: what stands there in each.
    """

    at: int
    old: str
    new: str

    @staticmethod
    def between(old: str, new: str) -> Patch:
        """Return what makes one text of another."""
        most = min(len(old), len(new))
        at = _common(old, new, most)
        end = _common(old[at:][::-1], new[at:][::-1], most - at)
        return Patch(at, old[at : len(old) - end], new[at : len(new) - end])

    def on(self, old: str) -> str:
        """Return the newer text."""
        return old[: self.at] + self.new + old[self.at + len(self.old) :]

    def off(self, new: str) -> str:
        """Return the older text."""
        return new[: self.at] + self.old + new[self.at + len(self.new) :]


def _common(one: str, other: str, most: int) -> int:
    """Return how many characters two texts begin with alike, at most so many, by halving."""
    low, high = 0, most
    while low < high:
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low


@frozen
class Step:
    """A change: the text's, what else became of the draft, what it is called and what it belongs to."""

    patch: Patch
    label: str
    merge: str = ""
    before: Mapping[str, Any] = field(default_factory=dict)
    after: Mapping[str, Any] = field(default_factory=dict)


class History:
    """A draft and all that came before it, and after it where steps were taken back."""

    def __init__(self, draft: Draft) -> None:
        self.now = draft
        self._done: list[Step] = []
        self._undone: list[Step] = []

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to take back."""
        return bool(self._done)

    @property
    def can_redo(self) -> bool:
        """Whether there is a step that was taken back."""
        return bool(self._undone)

    @property
    def undo_label(self) -> str:
        """What the step that would be taken back is called."""
        return self._done[-1].label if self._done else ""

    @property
    def redo_label(self) -> str:
        """What the step that would be done again is called."""
        return self._undone[-1].label if self._undone else ""

    def __len__(self) -> int:
        return len(self._done) + len(self._undone)

    def did(self, draft: Draft, label: str, merge: str = "") -> Draft:
        """Take up a change; what was taken back before is gone.

        Args:
            draft: as it is now.
            label: what the step is called.
            merge: of a slider that is dragged, its path: steps that follow one another with the same word are
                one. :meth:`settle` ends that.

        Returns:
            The draft.
        """
        if draft == self.now:
            return draft
        first = self.now
        if merge and self._done and self._done[-1].merge == merge:
            first = self._back(self._done.pop(), first)
        self._undone.clear()
        self.now = draft
        if first != draft:
            self._done.append(_step(first, draft, label, merge))
        return draft

    def settle(self) -> None:
        """End the step that is under way: the slider is let go."""
        if self._done and self._done[-1].merge:
            self._done[-1] = replace(self._done[-1], merge="")

    def undo(self) -> Draft:
        """Take a step back, where there is one; return the draft."""
        self.settle()
        if self._done:
            self._undone.append(self._done.pop())
            # No later change joins a step that one has come back to.
            self.settle()
            self.now = self._back(self._undone[-1], self.now)
        return self.now

    def redo(self) -> Draft:
        """Do a step again that was taken back, where there is one; return the draft."""
        self.settle()
        if self._undone:
            self._done.append(self._undone.pop())
            step = self._done[-1]
            self.now = replace(self.now, text=step.patch.on(self.now.text), **step.after)
        return self.now

    @staticmethod
    def _back(step: Step, draft: Draft) -> Draft:
        return replace(draft, text=step.patch.off(draft.text), **step.before)

    def unrolled(self) -> tuple[Draft, list[Step], list[Step]]:
        """Return the first draft, the steps that are done, and those that were taken back, in their order."""
        first = self.now
        for step in reversed(self._done):
            first = self._back(step, first)
        return first, list(self._done), list(reversed(self._undone))

    def steps(self) -> Iterator[tuple[str, bool]]:
        """Yield all steps, the first one first: what each is called, and whether it is done."""
        yield from ((step.label, True) for step in self._done)
        yield from ((step.label, False) for step in reversed(self._undone))


def _step(first: Draft, last: Draft, label: str, merge: str) -> Step:
    differ = [name for name in HELD if getattr(first, name) != getattr(last, name)]
    return Step(
        Patch.between(first.text, last.text),
        label,
        merge,
        {name: getattr(first, name) for name in differ},
        {name: getattr(last, name) for name in differ},
    )
