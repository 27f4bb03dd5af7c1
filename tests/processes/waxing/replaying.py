"""A dyeing replayed: wax goes on and comes off as plates say, and what is bare takes the dye."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

import shapely

from batik_vector.artwork import Artwork

Cloth = Mapping[frozenset[str], shapely.Geometry]


def dyed(page: Artwork, work: Iterable[Mapping[str, str]]) -> Cloth:
    """Return what of a cloth has seen which baths when the work is done.

    Args:
        page: the plates as layers, in the order in which they are used.
        work: the steps, of which those that wax or scrape take one plate each.
    """
    plates = iter([shapely.union_all(layer.areas) for layer in page.layers])
    cloth: dict[frozenset[str], shapely.Geometry] = {
        frozenset(): shapely.box(0, 0, page.cell.width, page.cell.height)
    }
    wax: shapely.Geometry = shapely.Polygon()
    for step in work:
        if step["doing"] == "wax":
            wax = shapely.union(wax, next(plates))
        elif step["doing"] == "scrape":
            wax = areas(shapely.difference(wax, next(plates)))
        elif step["doing"] == "dye":
            after: dict[frozenset[str], list[shapely.Geometry]] = defaultdict(list)
            for seen, part in cloth.items():
                after[seen].append(areas(shapely.intersection(part, wax)))
                after[seen | {step["bath"]}].append(areas(shapely.difference(part, wax)))
            cloth = {seen: shapely.union_all(parts) for seen, parts in after.items()}
    assert next(plates, None) is None
    return cloth


def areas(found: shapely.Geometry) -> shapely.Geometry:
    """Return what of a geometry is area: where areas touch, GEOS adds lines and points."""
    parts = shapely.get_parts(shapely.get_parts(found))
    return shapely.union_all(parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON])


def painted(page: Artwork) -> Cloth:
    """Return what of a cloth is to see which baths, as its artwork shows: one ink painted over another."""
    assert page.dyeing
    box = shapely.box(0, 0, page.cell.width, page.cell.height)
    cloth: dict[frozenset[str], shapely.Geometry] = {page.dyeing.ground: box}
    for layer in page.layers:
        marks = shapely.union_all([*layer.areas, *_bodies(page, layer.ink.name)])
        over = areas(shapely.intersection(marks, box))
        cloth = {seen: areas(shapely.difference(part, over)) for seen, part in cloth.items()}
        seen = page.dyeing.inks[layer.ink.name]
        cloth[seen] = shapely.union(cloth.get(seen, shapely.Polygon()), over)
    return cloth


def _bodies(page: Artwork, ink: str) -> list[shapely.Geometry]:
    """Return the bodies of an ink's lines, with those of the repeats around."""
    (layer,) = [each for each in page.layers if each.ink.name == ink]
    (ax, ay), (bx, by) = page.cell.lattice
    lines = [
        shapely.affinity.translate(line, (i * ax + j * bx) / 1000, (i * ay + j * by) / 1000)
        for line in layer.lines
        for i in (-1, 0, 1)
        for j in (-2, -1, 0, 1, 2)
    ]
    return list(shapely.buffer(lines, layer.ink.width / 2, quad_segs=64))


def apart(one: Cloth, other: Cloth) -> float:
    """Return on how many mm² two cloths differ."""
    empty = shapely.Polygon()
    return sum(
        float(shapely.area(shapely.symmetric_difference(one.get(each, empty), other.get(each, empty))))
        for each in one.keys() | other.keys()
    )
