"""How regular expressions are written here, and the one that all readers share: a number.

What they read comes from strangers, so none may take longer than the text is long:

- Behind a single character, class or escape a repeat is possessive wherever what follows may fail: ``\\d++``,
  ``\\s*+``. It gives nothing back, so a long run of digits or spaces is walked once and not once for every
  way of dividing it.
- Behind a group a repeat is never possessive, and no group is atomic. Python before 3.11.5 forgets where it
  stood when such a group fails half-way (python/cpython#106052): an exponent written
  ``(?:[eE]\\d++)?+`` swallows the "e" of "3em". A plain repeat is as quick where the group cannot match the
  same text in two ways, which its possessive parts see to.
- A group with a star keeps a note for every round until it ends. That is little for the lines of a recipe,
  but not for a path of a million numbers, which are found one at a time.

A test reads every pattern of the package for the second rule; others give the readers long digits, spaces,
quotes and dots.
"""

from __future__ import annotations

import re

NUMBER = r"[-+]?+(?:\d++\.?+\d*+|\.\d++)(?:[eE][-+]?+\d++)?"
"""A number as SVG and CSS write it: ``1``, ``-.5``, ``1.``, ``3e-2``."""

_NUMBERS = re.compile(NUMBER)


def numbers_in(text: str) -> list[float] | None:
    """Return the numbers of a list in which spaces, commas or nothing stand between them (SVG 2, 9.3.9).

    None where anything else stands there: ``"1-2.5.5, 3"`` → 1, -2.5, 0.5, 3.
    """
    if _NUMBERS.sub("", text).replace(",", " ").strip():
        return None
    return list(map(float, _NUMBERS.findall(text)))
