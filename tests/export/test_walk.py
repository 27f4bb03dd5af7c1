from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import shapely

from batik_vector.artwork import Artwork, Cell, Ink, Layer
from batik_vector.errors import ExportError
from batik_vector.export import FORMATS, render
from batik_vector.export.walk import Outlines, RecordingSurface, walk

from .drawings import empty, geometries, line, sample


def recorded(artwork: Artwork) -> list[tuple[str, tuple[object, ...]]]:
    surface = RecordingSurface()
    walk(artwork, surface)
    return surface.calls


def outlines(artwork: Artwork, call: int) -> Outlines:
    found = recorded(artwork)[call][1][0]
    assert isinstance(found, Outlines)
    return found


def test_calls_come_in_painting_order_and_none_is_made_in_vain() -> None:
    names = [name for name, _ in recorded(sample())]
    assert names == ["begin", "ink", "areas", "ink", "lines", "ink", "areas", "lines", "end"]
    assert [args[1] for name, args in recorded(sample()) if name == "ink"] == [1, 2, 3]
    assert [name for name, _ in recorded(empty())] == ["begin", "end"]


def test_areas_are_handed_over_in_steps_without_repeated_points() -> None:
    artwork = sample()
    found = outlines(artwork, 2)
    rings = shapely.get_rings(artwork.layers[0].areas)
    assert found.marks.tolist() == [0, 2, 3]
    assert found.closed.all()
    for i, ring in enumerate(rings):
        points = found.points[found.rings[i] : found.rings[i + 1]]
        assert (points / 1000 == shapely.get_coordinates(ring)[:-1]).all()


def test_lines_say_which_are_closed() -> None:
    found = outlines(sample(), 4)
    assert found.closed.tolist() == [False, True, False]
    assert np.diff(found.rings).tolist() == [3, 3, 2]
    assert found.names == ("stem", "ring", "stem")


def test_there_and_back_is_open() -> None:
    layer = Layer(Ink("w", "#000000"), lines=geometries(line((0, 0), (1, 0), (0, 0))))
    assert not outlines(Artwork("", Cell(10, 10), (layer,)), 2).closed.any()


def test_repeating_closes_the_closed_only() -> None:
    points, rings = outlines(sample(), 4).repeating()
    assert np.diff(rings).tolist() == [3, 4, 2]
    assert (points[3] == points[6]).all()
    assert (points[0] == [1000, 1000]).all()
    assert (points[-1] == [9000, 5250]).all()


@pytest.mark.parametrize("format", sorted(FORMATS.keys() - {"gpl", "ase"}))
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf, 1e9, 1e300])
def test_no_format_writes_what_is_no_place(format: str, bad: float) -> None:
    artwork = sample()
    spoilt = geometries(line((0, 0), (1, 1)))
    spoilt = shapely.transform(spoilt, lambda c: np.where(c == 1, bad, c))
    layers = (
        *artwork.layers,
        replace(artwork.layers[1], ink=Ink("bad", "#000000"), lines=spoilt, line_names=("",)),
    )
    with pytest.raises(ExportError, match=r"not finite|outside the cell"):
        render(replace(artwork, layers=layers), format)
    with pytest.raises(ExportError, match=r"not finite|beyond"):
        render(replace(artwork, layers=layers), format, check=False)


def test_other_geometries_are_refused() -> None:
    points = np.array([shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(2, 2, 3, 3)])])
    for layer in (Layer(Ink("w", "#000000"), areas=points), Layer(Ink("w", "#000000"), lines=points)):
        with pytest.raises(ExportError, match='ink "w"'):
            recorded(Artwork("", Cell(10, 10), (layer,)))
