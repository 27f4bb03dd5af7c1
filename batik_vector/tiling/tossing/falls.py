"""Falls: where the marks of tosses came to lie, kept for sketches of the recipe while it is being changed.

    falls = Falls()
    with falls.kept():
        compile_recipe(recipe)                  # exact, and its falls are noted
    with falls.sketched():
        compile_recipe(replace(recipe, ...))    # marks stay where they fell, in their new shapes

To throw and settle takes most of the time of a toss, and the least change of a mark makes all fall
otherwise: who drags a slider would see nothing for a second, and then another cloth at every step. In a
sketch marks of a toss that is asked for in the same words stay where they lie; those that would run into
what they keep clear of are left out. A toss that is asked for otherwise is thrown, and not settled. What is
made without a sketch is exact.
"""

from __future__ import annotations

import contextlib
import contextvars
from collections.abc import Hashable, Iterator

from batik_vector.tiling.tossing.marks import Poses
from batik_vector.tiling.tossing.report import TossReport

_open: contextvars.ContextVar[Falls | None] = contextvars.ContextVar("falls", default=None)


class Falls:
    """How the tosses of the recipe that was compiled last fell, in their order."""

    def __init__(self) -> None:
        self._noted: list[tuple[Hashable, Poses, TossReport]] = []
        self._next = 0
        self.sketching = False
        """Whether marks may stay where they fell."""

    @contextlib.contextmanager
    def kept(self) -> Iterator[None]:
        """Note how the tosses of one compilation fall, in place of those before."""
        with self._begun(sketching=False):
            yield

    @contextlib.contextmanager
    def sketched(self) -> Iterator[None]:
        """Let the marks of one compilation stay where they fell."""
        with self._begun(sketching=True):
            yield

    @contextlib.contextmanager
    def _begun(self, *, sketching: bool) -> Iterator[None]:
        self._next, self.sketching = 0, sketching
        token = _open.set(self)
        try:
            yield
        finally:
            _open.reset(token)

    def known(self, asked: Hashable) -> tuple[Poses, TossReport] | None:
        """Return how the next toss fell when it was asked for in the same words."""
        number, self._next = self._next, self._next + 1
        if number < len(self._noted) and self._noted[number][0] == asked:
            return self._noted[number][1:]
        return None

    def note(self, asked: Hashable, poses: Poses, report: TossReport) -> None:
        """Note how a toss fell."""
        self._noted[self._next :] = [(asked, poses, report)]
        self._next += 1


def opened() -> Falls | None:
    """Return the falls of the compilation that is under way, where any are kept."""
    return _open.get()
