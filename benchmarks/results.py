"""What was measured, and the figures that follow from it: medians, spreads, ratios, exponents.

A run is known by its contest, its entrant, and where a process times several parts of its work by the part:
``svg/vpype``, ``growth/1000000/tiling``. Run number i of every entrant of a contest was made in the same
round, so ratios are taken round by round, and the median is the ratios' own.
"""

from __future__ import annotations

import json
import math
import statistics
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

from benchmarks.timing import Sample


@dataclass(frozen=True)
class Spread:
    """A median, and between what the values lie."""

    median: float
    low: float
    high: float


def spread(values: Iterable[float]) -> Spread:
    """Return the spread of some values, of which there is one at least."""
    known = list(values)
    return Spread(statistics.median(known), min(known), max(known))


def exponent(sizes: Sequence[float], costs: Sequence[float]) -> float:
    """Return k where the costs grow as size^k: the slope of the least-squares line through their logarithms.

    Raises:
        ValueError: where there are fewer than two different sizes, or a cost is not positive.
    """
    if len(set(sizes)) < 2 or min(costs) <= 0:
        raise ValueError("an exponent needs two sizes and positive costs")
    x, y = [math.log(size) for size in sizes], [math.log(cost) for cost in costs]
    return statistics.linear_regression(x, y).slope


def over_log(sizes: Sequence[float], costs: Sequence[float]) -> list[float]:
    """Return costs over the logarithm of their size: what grows as n log n then grows as n."""
    return [cost / math.log(size) for size, cost in zip(sizes, costs, strict=True)]


@dataclass
class Results:
    """All runs, why some are missing, and plain facts read from files."""

    runs: dict[str, list[Sample]] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)
    facts: dict[str, Any] = field(default_factory=dict)

    def add(self, name: str, sample: Sample) -> None:
        """Enter a run."""
        self.runs.setdefault(name, []).append(sample)

    def values(self, name: str, what: str = "cpu") -> list[float]:
        """Return one figure of every run, in the order of the rounds; none where there are no runs."""
        return [getattr(sample, what) for sample in self.runs.get(name, [])]

    def of(self, name: str, what: str = "cpu") -> Spread | None:
        """Return the spread of a figure."""
        values = self.values(name, what)
        return spread(values) if values else None

    def ratio(self, peer: str, own: str, what: str = "cpu") -> Spread | None:
        """Return how many times as much a peer needs, round by round."""
        pairs = list(zip(self.values(peer, what), self.values(own, what), strict=False))
        if not pairs or min(mine for _, mine in pairs) <= 0:
            return None
        return spread(theirs / mine for theirs, mine in pairs)

    def medians(self, names: Iterable[str], what: str = "cpu") -> list[float] | None:
        """Return the medians of several runs, or None where one of them is missing."""
        spreads = [self.of(name, what) for name in names]
        return None if None in spreads else [each.median for each in spreads if each]

    def to_json(self) -> str:
        """Return everything as text."""
        runs = {name: [asdict(sample) for sample in samples] for name, samples in self.runs.items()}
        return json.dumps({"runs": runs, "missing": self.missing, "facts": self.facts}, indent=1)

    @classmethod
    def from_json(cls, text: str) -> Results:
        """Read what :meth:`to_json` wrote."""
        data = json.loads(text)
        runs = {name: [Sample(**sample) for sample in samples] for name, samples in data["runs"].items()}
        return cls(runs, data["missing"], data["facts"])
