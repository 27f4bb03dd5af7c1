"""What is told of a drawing: its features, in the words of Tian et al. 2019, Tables 1 and 2."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from typing import Any

from batik_vector.analysis.dimension import BoxDimension
from batik_vector.analysis.petal_shape import PetalShape
from batik_vector.values import frozen

COLUMNS = ("elements", "relation", "symmetry", "layers", "petal", "petals", "pistils")
"""The features in the order of Table 2."""

NONE, MULTI = "none", "multi"
MANY_ELEMENTS, MANY_LAYERS, MANY_PETALS, MANY_PISTILS = 4, 3, 10, 3
"""From how many on they are "multi", and petals "10 or more"."""


@frozen
class Symmetry:
    """A flower's rosette group: its ``name``, its ``order``, and its ``kind`` in words.

    ``axis`` (degrees) is the direction of a mirror, None where there is none. ``deviation`` (mm) is the most
    by which an image of the outline misses it.
    """

    name: str
    order: int
    kind: str
    axis: float | None
    deviation: float

    @property
    def word(self) -> str:
        """Table 1's word: 1/8 for a flower that an eighth of a turn keeps."""
        if self.name == "O(2)":
            return "rotation"
        return f"1/{self.order}" if self.order > 1 else NONE


@frozen
class Layer:
    """A layer of petals: their number, their shapes, how far from the centre they reach, in mm."""

    petals: int
    shapes: tuple[str, ...]
    outer: float


@frozen(kw_only=True)
class Features:
    """The features of a flower, or of a drawing that holds none.

    ``elements`` is the number of types among what is repeated; a single heart in the middle is none of them.
    ``relation`` says how like elements lie to one another. ``layers`` go from the outermost inwards,
    ``pistils`` are the numbers of them that petals have, in the layers that have any. The flower stands about
    ``centre`` (mm, y up) and reaches ``reach`` mm; ``flowers`` counts those that are like it, itself too.
    """

    elements: int
    relation: str
    symmetry: Symmetry
    layers: tuple[Layer, ...] = ()
    pistils: tuple[float, ...] = ()
    flowers: int = 0
    centre: tuple[float, float] | None = None
    reach: float | None = None

    @property
    def row(self) -> dict[str, str]:
        """The features in Table 2's words, by the names of ``COLUMNS``."""
        shapes = [shape for shape in PetalShape if any(shape in layer.shapes for layer in self.layers)]
        words = (
            _up_to(self.elements, MANY_ELEMENTS),
            self.relation,
            self.symmetry.word,
            _layers(len(self.layers)),
            " and ".join(shapes) or NONE,
            _several(
                [_petals(layer.petals) for layer in sorted(self.layers, key=lambda layer: layer.petals)]
            ),
            _several([word for count in sorted(self.pistils) for word in _pistils(count)]),
        )
        return dict(zip(COLUMNS, words, strict=True))

    def __str__(self) -> str:
        return ", ".join(self.row.values())

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as plain values."""
        return {
            "row": self.row,
            "elements": self.elements,
            "relation": self.relation,
            "symmetry": {
                "group": self.symmetry.name,
                "order": self.symmetry.order,
                "kind": self.symmetry.kind,
                "axis_degrees": self.symmetry.axis,
                "deviation_mm": round(self.symmetry.deviation, 6),
            },
            "layers": [
                {"petals": each.petals, "shapes": list(each.shapes), "outer_mm": round(each.outer, 3)}
                for each in self.layers
            ],
            "pistils_per_petal": [round(count, 6) for count in self.pistils],
            "flowers": self.flowers,
            "centre_mm": None if self.centre is None else [round(value, 3) for value in self.centre],
            "reach_mm": None if self.reach is None else round(self.reach, 3),
        }


@frozen(kw_only=True)
class Analysis(Features):
    """What was measured of a drawing, from geometry alone: the features of its largest flower, and figures.

    ``judged`` is False where the drawing holds no flower; ``reason`` then says why, with what was found.
    ``marks`` and ``kinds`` count what is drawn on the page and how many shapes there are. ``others`` are
    flowers of other kinds beside the largest.

    ``coverage`` is the share of the page under ink, ``coverages`` that of each ink. ``line_widths`` are the
    least and the greatest, in mm, None without lines. ``dimension`` is the box dimension of all outlines and
    lines.
    """

    title: str
    judged: bool
    reason: str
    marks: int
    kinds: int
    others: tuple[Features, ...] = ()
    coverage: float = 0.0
    coverages: Mapping[str, float] = field(default_factory=dict)
    line_widths: tuple[float, float] | None = None
    nodes: int = 0
    dimension: BoxDimension | None = None
    notes: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """Return all of it as plain values."""
        fit = self.dimension
        return {
            "title": self.title,
            "judged": self.judged,
            "reason": self.reason,
            "marks": self.marks,
            "kinds": self.kinds,
            **Features.as_dict(self),
            "others": [each.as_dict() for each in self.others],
            "covers": round(self.coverage, 6),
            "inks": {name: round(share, 6) for name, share in self.coverages.items()},
            "line_widths_mm": None
            if self.line_widths is None
            else [round(each, 4) for each in self.line_widths],
            "nodes": self.nodes,
            "box_dimension": None
            if fit is None
            else {
                "dimension": round(fit.dimension, 4),
                "from_mm": round(fit.smallest, 4),
                "to_mm": round(fit.largest, 4),
                "residual": round(fit.residual, 4),
                "sizes": fit.sizes,
            },
            "notes": list(self.notes),
        }


def _up_to(count: int, many: int) -> str:
    return MULTI if count >= many else str(count) if count else NONE


def _layers(count: int) -> str:
    return MULTI if count >= MANY_LAYERS else (NONE, "single", "double")[count]


def _petals(count: int) -> str:
    return "10 or more" if count >= MANY_PETALS else str(count)


def _pistils(count: float) -> list[str]:
    """Return a number of pistils in words: between two whole numbers, both."""
    least = int(count + 1e-9)
    if abs(count - least) <= 1e-9 or least >= MANY_PISTILS:
        return [_up_to(least, MANY_PISTILS)]
    return [_up_to(least, MANY_PISTILS), _up_to(least + 1, MANY_PISTILS)]


def _several(words: Sequence[str]) -> str:
    return " and ".join(dict.fromkeys(words)) or NONE
