"""A small interpreter of G-code, strict where real ones are: what a program makes a tool do."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

WORD = re.compile(r"([A-Z])([-+]?(?:\d+\.?\d*|\.\d+))")
COMMENT = re.compile(r"\([^()]*\)|;.*")


@dataclass
class Cut:
    """One move with the tool down: where it leads, and the centre about which, if it is an arc."""

    motion: int
    x: float
    y: float
    centre: tuple[float, float] | None
    feed: float


@dataclass
class Stroke:
    """What is drawn between two lifts."""

    start: tuple[float, float]
    tool: int
    cuts: list[Cut] = field(default_factory=list)

    @property
    def points(self) -> NDArray[np.float64]:
        """Where it begins, and where each of its moves leads, shape (n, 2)."""
        return np.array([self.start, *((cut.x, cut.y) for cut in self.cuts)])


@dataclass
class Program:
    """A program that has been run."""

    strokes: list[Stroke]
    words: list[list[tuple[str, str]]]
    """The words of each line that has any."""
    comments: list[str]
    ended: bool
    pauses: int

    def count(self, *words: str) -> int:
        """How often words stand in it."""
        return sum(letter + number in words for line in self.words for letter, number in line)


def read(data: bytes) -> Program:
    """Run a program in which a Z of zero or less, or M3 or M4 until M5, is down."""
    lines = data.decode("ascii").splitlines()
    assert data.endswith(b"\n")
    assert max(map(len, lines)) <= 80
    out = Program([], [], [], ended=False, pauses=0)
    machine = _Machine(out)
    percent = lines[0] == "%"
    for line in lines[1:] if percent else lines:
        assert not out.ended, "a line behind the end"
        if line == "%":
            assert percent
            out.ended = True
            continue
        out.comments += [each.strip("; ()") for each in COMMENT.findall(line)]
        bare = COMMENT.sub("", line)
        assert "(" not in bare
        assert ")" not in bare
        words = WORD.findall(bare.upper())
        assert WORD.sub("", bare).strip() == "", line
        if words:
            out.words.append(words)
            machine.line(words)
    return out


class _Machine:
    def __init__(self, out: Program) -> None:
        self.out = out
        self.modal: dict[str, float] = {}
        self.at: tuple[float, float] | None = None
        self.z = 1.0
        self.on = False
        self.tool = 1
        self.stroke: Stroke | None = None

    def line(self, words: list[tuple[str, str]]) -> None:
        values = {letter: float(number) for letter, number in words if letter not in "GM"}
        gs = [float(number) for letter, number in words if letter == "G"]
        ms = [float(number) for letter, number in words if letter == "M"]
        assert len(values) == sum(letter not in "GM" for letter, _ in words), "a letter twice"
        dwell = 4 in gs
        for g in gs:
            group = {0: "motion", 1: "motion", 2: "motion", 3: "motion"}.get(int(g), f"G{g:g}")
            self.modal[group] = g
        if "F" in values:
            self.modal["feed"] = values["F"]
        if "T" in values:
            self.tool = int(values["T"])
        if not dwell and values.keys() & {"X", "Y", "Z", "I", "J"}:
            self.move(values)
        for m in ms:
            self.miscellaneous(int(m))

    def miscellaneous(self, m: int) -> None:
        if m in (3, 4):
            self.on = True
        elif m == 5:
            self.on, self.stroke = False, None
        elif m == 0:
            assert self.stroke is None, "a pause with the tool down"
            self.out.pauses += 1
        elif m in (2, 30):
            assert self.stroke is None, "an end with the tool down"
            self.out.ended = True

    def move(self, values: dict[str, float]) -> None:
        motion = int(self.modal["motion"])
        assert self.modal.get("G21") == 21, "no unit"
        assert self.modal.get("G90") == 90
        if "Z" in values:
            assert not values.keys() & {"X", "Y"}
            assert motion == 0 or "feed" in self.modal
            self.z = values["Z"]
            if self.z > 0:
                self.stroke = None
            return
        before = self.at
        to = values["X"], values["Y"]
        self.at = to
        down = self.on or self.z <= 0
        if motion == 0:
            assert not down, "a rapid move with the tool down"
            return
        assert down
        assert before is not None
        assert "feed" in self.modal
        centre = None
        if motion in (2, 3):
            assert self.modal.get("G91.1") == 91.1
            centre = before[0] + values["I"], before[1] + values["J"]
            radii = [np.hypot(x - centre[0], y - centre[1]) for x, y in (before, to)]
            assert abs(radii[0] - radii[1]) < 0.002
        else:
            assert "I" not in values
            assert before != to, "a move without length"
        if self.stroke is None:
            self.stroke = Stroke(before, self.tool)
            self.out.strokes.append(self.stroke)
        self.stroke.cuts.append(Cut(motion, *to, centre, self.modal["feed"]))


def along(stroke: Stroke, sagitta: float = 0.0005) -> Iterator[NDArray[np.float64]]:
    """Yield the places of each move in turn, and of arcs between, so that chords are off by no more mm."""
    at = np.array(stroke.start)
    for cut in stroke.cuts:
        to = np.array([cut.x, cut.y])
        if cut.centre is None:
            yield np.stack([at, to])
        else:
            centre = np.array(cut.centre)
            first, last = (np.arctan2(*(each - centre)[::-1]) for each in (at, to))
            radius = np.hypot(*(at - centre))
            if cut.motion == 3 and last <= first:
                last += 2 * np.pi
            if cut.motion == 2 and last >= first:
                last -= 2 * np.pi
            # sagitta = r (1 - cos(step / 2))
            step = 2 * np.arccos(max(1 - sagitta / radius, 0.0))
            turn = np.linspace(first, last, 2 + int(abs(last - first) / step))
            yield centre + radius * np.c_[np.cos(turn), np.sin(turn)]
        at = to
