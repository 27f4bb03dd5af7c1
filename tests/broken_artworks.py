"""Artworks made by hand that break the normal form, each in one way, and what is said of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer

INK = Ink("wax", "#f4efe2")
SQUARE = shapely.box(1, 1, 4, 4)


def artwork(*areas: shapely.Geometry, lines: tuple[shapely.Geometry, ...] = (), ink: Ink = INK) -> Artwork:
    polygons = shapely.orient_polygons(np.array(areas, dtype=object)) if areas else np.empty(0, object)
    return Artwork("test", Cell(10_000, 10_000), (Layer(ink, polygons, np.array(lines, dtype=object)),))


def raw(area: shapely.Geometry) -> Artwork:
    return Artwork("test", Cell(10_000, 10_000), (Layer(INK, np.array([area], dtype=object)),))


BROKEN: list[tuple[Artwork, str]] = [
    (raw(shapely.box(1, 1, 11, 4)), "outside the cell"),
    (raw(shapely.box(-0.001, 1, 4, 4)), "outside the cell"),
    (raw(shapely.Polygon([(1, 1), (4, 4), (4, 1), (1, 4)])), "invalid"),
    (raw(shapely.box(1, 1, 4, 4, ccw=False)), "clockwise"),
    (raw(shapely.box(1.0005, 1, 4, 4)), "off the 1 µm grid"),
    (raw(shapely.Polygon([(1, 1), (np.inf, 1), (4, 4)])), "not finite"),
    (raw(shapely.Polygon([(1, 1), (2, 1), (3, 1)])), "invalid"),
    (raw(shapely.Polygon([(1, 1), (2, 2), (1, 1)])), "invalid"),
    (raw(shapely.Polygon()), "empty"),
    (artwork(lines=(shapely.Point(1, 1),)), "no polyline"),
    (artwork(lines=(shapely.LineString([(1, 1), (12, 2)]),)), "outside the cell"),
    (raw(shapely.Point(1, 1)), "no polygon"),
    (
        raw(shapely.Polygon([(1, 1), (4, 1), (4, 4)], [[(2, 1.5), (3, 1.5), (3, 2)]])),
        "hole runs anticlockwise",
    ),
    (artwork(SQUARE, shapely.box(3, 3, 5, 5)), "1 pairs of areas overlap"),
    (artwork(lines=(shapely.LineString([(1, 1), (1, 1), (2, 2)]),)), "length zero"),
    (
        artwork(lines=(shapely.LineString([(1, 1), (2, 2)]), shapely.LineString([(3, 3), (2, 2), (1, 1)]))),
        "drawn twice",
    ),
    (
        replace(artwork(SQUARE), layers=(replace(artwork(SQUARE).layers[0], area_names=("a", "b")),)),
        "names do not run",
    ),
    (replace(artwork(SQUARE), layers=artwork(SQUARE).layers * 2), 'two layers named "wax"'),
]
