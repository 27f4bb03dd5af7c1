"""A plotter that takes HP-GL word by word, as its manual has it; it shares nothing with the writer."""

from __future__ import annotations

from dataclasses import dataclass, field

Place = tuple[int, int]


@dataclass
class Drawn:
    """What has come onto the paper."""

    strokes: list[tuple[int, list[Place]]] = field(default_factory=list)
    """The pen of each and the places that it draws through."""
    words: list[str] = field(default_factory=list)
    """Everything else that was said."""
    ups: int = 0
    """Moves with the pen up."""

    def of(self, pen: int) -> list[list[Place]]:
        return [places for each, places in self.strokes if each == pen]

    @property
    def pens(self) -> list[int]:
        """In the order in which they are taken."""
        return list(dict.fromkeys(pen for pen, _ in self.strokes))

    @property
    def bounds(self) -> tuple[int, int, int, int]:
        xs = [x for _, places in self.strokes for x, _ in places]
        ys = [y for _, places in self.strokes for _, y in places]
        return min(xs), min(ys), max(xs), max(ys)


class Plotter:
    def __init__(self) -> None:
        self.paper = Drawn()
        self.pen, self.down, self.at = 0, False, (0, 0)
        self._open = False

    def take(self, data: bytes) -> Drawn:
        text = data.decode("ascii")
        for word in text.split(";"):
            word = word.strip("\n")
            if not word:
                continue
            name, rest = word[:2], word[2:]
            if name in ("PU", "PD"):
                self._set(name == "PD")
                numbers = [int(number) for number in rest.split(",")] if rest else []
                for x, y in zip(numbers[::2], numbers[1::2], strict=True):
                    self._go((x, y))
            elif name == "PE":
                self._encoded(rest)
            elif name == "SP":
                self._set(False)
                self.pen = int(rest)
            else:
                self.paper.words.append(word)
        return self.paper

    def _set(self, down: bool) -> None:
        self._open &= down
        self.down = down

    def _go(self, place: Place) -> None:
        if self.down:
            assert self.pen, "draws without a pen"
            assert place != self.at, "a stroke of no length"
            if not self._open:
                self.paper.strokes.append((self.pen, [self.at]))
            self.paper.strokes[-1][1].append(place)
            self._open = True
        else:
            assert place != self.at or not self.paper.strokes, "a move of no length"
            self.paper.ups += 1
        self.at = place

    def _encoded(self, rest: str) -> None:
        assert rest[0] == "7"
        numbers, value, places = list[int](), 0, 0
        up = absolute = False
        for character in rest[1:]:
            if character in "<=":
                up, absolute = up or character == "<", absolute or character == "="
                continue
            code = ord(character) - 63
            assert 0 <= code < 64
            value += (code % 32) << places
            places += 5
            if code < 32:
                continue
            numbers.append(value // 2 * (-1 if value % 2 else 1))
            value = places = 0
            if len(numbers) == 2:
                x, y = numbers
                self._set(not up)
                self._go((x, y) if absolute else (self.at[0] + x, self.at[1] + y))
                numbers, up, absolute = [], False, False
        assert not numbers
        assert not places


def plotted(data: bytes) -> Drawn:
    return Plotter().take(data)
