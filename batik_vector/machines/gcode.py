"""The words of a machine's G-code: how it lowers and lifts its tool, changes it, begins and ends.

Words are texts with names in braces, for which the machine's numbers stand in the file: ``G1 Z{depth}
F{plunge_feed}``. There is a fixed set of names and nothing else in braces: no format specifications, no
attributes, no code.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Mapping
from typing import Annotated, TypeAlias

from batik_vector.errors import GeometryError, unknown_name
from batik_vector.fields import Between, Length, Says, Text, check
from batik_vector.values import frozen

NUMBERS = (
    "feed",
    "travel_feed",
    "plunge_feed",
    "safe_height",
    "depth",
    "s_down",
    "s_up",
    "dwell_down",
    "dwell_up",
    "temperature",
)
"""Names of numbers that a machine has."""
OF_THE_TOOL = ("tool", "ink", "width")
"""Names that mean something where a tool is in hand: its number from 1, its ink, the breadth of its line in
mm. ``{ink}`` is letters, digits, blanks, ``-``, ``_`` and ``.`` alone, whatever the ink is called."""
MILLISECONDS = "_ms"
"""``{dwell_down_ms}`` is the same dwell in whole milliseconds, as Marlin and its kin take it."""
NAMES = (*NUMBERS, *(name + MILLISECONDS for name in NUMBERS if name.startswith("dwell")), *OF_THE_TOOL)

LONGEST = 40
"""Characters of a name: a line of grbl's has room for 80 with all that stands around it."""
_BRACES = re.compile(r"\{([^{}]*)\}")
_COMMENT = re.compile(r"\([^()]*\)|;.*")
_WORD = re.compile(r"([A-Z])\s*([-+]?(?:\d+\.?\d*|\.\d+))?")
_NOT_PLAIN = re.compile(r"[^A-Za-z0-9 ._-]+")


class Stop(enum.StrEnum):
    """What ends the program: interpreters call a file that ends without one cut off."""

    M2 = "M2"
    """Program end."""
    M30 = "M30"
    """Program end, and back to its start."""
    PERCENT = "%"
    """A percent sign on the first line and on the last."""


class Comment(enum.StrEnum):
    """How comments are written."""

    SEMICOLON = ";"
    """From a semicolon to the end of the line."""
    PARENTHESES = "()"
    """Between parentheses, with none inside: interpreters refuse nested ones."""
    NONE = "none"
    """Not at all: for controllers that know none. Such a file carries no recipe."""


def parse_words(text: str) -> str:
    """Return words of G-code, line by line, blanks at the ends of lines and empty lines left out.

    Raises:
        ValueError: with what was expected.
    """
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    for line in lines:
        if not (line.isascii() and line.isprintable()):
            raise ValueError("expected printable ASCII")
        for name in _BRACES.findall(line):
            if name not in NAMES:
                raise ValueError(unknown_name(name, NAMES))
        rest = _BRACES.sub("0", line)
        if "{" in rest or "}" in rest:
            raise ValueError("expected braces in pairs, such as {feed}")
        if re.search("[()]", _COMMENT.sub("", rest)):
            raise ValueError("expected parentheses in pairs, none inside others: interpreters refuse them")
    _refuse_words(codes("\n".join(lines)))
    return "\n".join(lines)


def codes(text: str) -> list[str]:
    """Return the words of a text that are neither names in braces nor comments: G1, M3, S, Z."""
    bare = _COMMENT.sub("", _BRACES.sub("", text)).upper()
    return [letter + (f"{float(number):g}" if number else "") for letter, number in _WORD.findall(bare)]


def _refuse_words(found: list[str]) -> None:
    """Raise where words would change what the rest of the file says."""
    if "G20" in found:
        raise ValueError("expected no G20: coordinates are in millimetres")
    if "G91" in found and "G90" not in found[found.index("G91") :]:
        raise ValueError("expected G90 after G91: coordinates are absolute")
    ending = next((word for word in found if word in ("M2", "M30")), None)
    if ending:
        raise ValueError(f'expected no {ending}: what ends the program is said by stop = "{ending}"')


Words: TypeAlias = Annotated[str, Text(parse_words, "words of G-code, such as G1 Z{depth} F{plunge_feed}")]
Feed: TypeAlias = Annotated[float, Between(1, 100_000)]


@frozen(kw_only=True)
class Gcode:
    """How a machine is spoken to in G-code. As it stands: a pen on a Z axis that touches at zero.

    Every file begins with G21 (millimetres), G90 (absolute), G17 and ``start``; then the tool is lifted.
    """

    start: Annotated[Words, Says("words at the beginning, behind G21 G90 G17")] = ""
    end: Annotated[Words, Says("words at the end, when the tool is up")] = ""
    stop: Annotated[Stop, Says("what ends the program: M2, M30, or % on the first and the last line")] = (
        Stop.M2
    )
    tool_down: Annotated[Words, Says("words that lower the tool, or switch the beam on")] = (
        "G1 Z{depth} F{plunge_feed}"
    )
    tool_up: Annotated[Words, Says("words that lift the tool, or switch the beam off")] = "G0 Z{safe_height}"
    tool_change: Annotated[Words, Says("words between one ink and the next; M0 pauses")] = "M0"
    first_tool: Annotated[bool, Says("whether they stand before the first ink as well")] = False
    rapid: Annotated[Words, Says("the word that begins each move with the tool up")] = "G0"
    comment: Annotated[Comment, Says("how comments are written: ;, (), or none")] = Comment.SEMICOLON
    arcs: Annotated[bool, Says("whether the machine takes arcs (G2 and G3)")] = True
    feed: Annotated[Feed | None, Says("mm/min with the tool down; its motion's if unset")] = None
    travel_feed: Annotated[Feed | None, Says("mm/min with the tool up, for those whose rapid says it")] = None
    plunge_feed: Annotated[Feed, Says("mm/min at which a Z axis lowers the tool")] = 300.0
    safe_height: Annotated[Annotated[Length, Between(-1000, 1000)], Says("Z with the tool up")] = 5.0
    depth: Annotated[Annotated[Length, Between(-1000, 1000)], Says("Z with the tool down")] = 0.0
    s_down: Annotated[
        Annotated[float, Between(0, 100_000)] | None, Says("S with the tool down: servo position or power")
    ] = None
    s_up: Annotated[
        Annotated[float, Between(0, 100_000)] | None, Says("S with the tool up: servo position or power")
    ] = None
    dwell_down: Annotated[float, Between(0, 600), Says("s to wait when the tool has been lowered")] = 0.0
    dwell_up: Annotated[float, Between(0, 600), Says("s to wait when the tool has been lifted")] = 0.0
    temperature: Annotated[
        Annotated[float, Between(0, 400)] | None, Says("°C of the wax, for words that set a heater")
    ] = None

    def __post_init__(self) -> None:
        check(self)
        for field in ("start", "end", "tool_down", "tool_up", "tool_change", "rapid"):
            self._check_words(field)
        moves = {"X", "Y"} & {word[0] for word in codes(self.tool_down)}
        if moves:
            raise self._fault("tool_down", f"expected no {min(moves)}: the tool goes straight down")
        if len(self.rapid.splitlines()) != 1:
            raise self._fault("rapid", "expected words on one line, such as G0")
        if _COMMENT.search(self.rapid):
            raise self._fault("rapid", "expected no comment: the rest of the move stands behind it")
        lifts = "{safe_height}" in self.tool_up and "{depth}" in self.tool_down
        if lifts and self.safe_height <= self.depth:
            raise GeometryError(
                f"safe_height = {self.safe_height:g}, expected more than the depth of {self.depth:g} mm"
            )

    def _check_words(self, field: str) -> None:
        """Raise where words use a number that is not set, or a tool's where there is none."""
        for name in _BRACES.findall(getattr(self, field)):
            if name in OF_THE_TOOL and field in ("start", "end", "rapid"):
                raise self._fault(field, f"expected no {{{name}}}: no tool is in hand there")
            # Without a feed of its own it goes by the machine's motion.
            if name != "feed" and getattr(self, name.removesuffix(MILLISECONDS), "") is None:
                name = name.removesuffix(MILLISECONDS)
                raise self._fault(field, f"expected a value for {name}: set {name} as well")

    def _fault(self, field: str, expected: str) -> GeometryError:
        shown = getattr(self, field).replace("\n", "\\n")
        return GeometryError(f'{field} = "{shown}", {expected}')

    def filled(self, words: str, more: Mapping[str, float | str]) -> str:
        """Return words with numbers and names in place of what stands in braces.

        Args:
            words: of this machine.
            more: what the machine itself does not know: ``feed``, ``tool``, ``ink``, ``width``.
        """

        def value(match: re.Match[str]) -> str:
            name = match[1]
            if name.endswith(MILLISECONDS):
                return str(round(getattr(self, name.removesuffix(MILLISECONDS)) * 1000))
            found = more[name] if name in more else getattr(self, name)
            return plain(found) if isinstance(found, str) else number(found)

        return _BRACES.sub(value, words)


def plain(text: str) -> str:
    """Return a text without anything that means something in G-code."""
    from unicodedata import normalize

    bare = normalize("NFKD", text).encode("ascii", "ignore").decode("ascii")
    return " ".join(_NOT_PLAIN.sub(" ", bare).split())[:LONGEST].rstrip() or "unnamed"


def number(value: float) -> str:
    """Return a number as interpreters read it: no exponent, no more than four decimals."""
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
