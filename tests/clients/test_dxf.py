"""DXF in LibreCAD, printed and compared with the artwork's own outlines; and in ezdxf's auditor."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from ezdxf.filemanagement import readfile

from batik_vector.artwork import Artwork, Geometries
from batik_vector.export import DxfOptions, DxfVersion, render
from tests.clients import programs
from tests.clients.drawings import outlines, per_mm, shared_out
from tests.clients.pictures import load, reference, stray

FEW = 1e-3
"""Share of line pixels that may stray: LibreCAD prints in steps of 1/1200 inch."""


def written(artwork: Artwork, folder: Path, version: DxfVersion) -> Path:
    path = folder / "drawing.dxf"
    path.write_bytes(render(artwork, "dxf", DxfOptions(version=version), check=False))
    return path


@pytest.mark.clients
@pytest.mark.parametrize(("drawing", "version"), shared_out(DxfVersion), indirect=["drawing"])
def test_librecad_draws_the_outlines_in_place_and_true_size(
    drawing: Artwork, tmp_path: Path, version: DxfVersion
) -> None:
    printed = programs.librecad(written(drawing, tmp_path, version))
    left, low, right, high = programs.page_mm(printed)
    # LibreCAD rounds its page down to whole points.
    assert (right - left, high - low) == pytest.approx((drawing.cell.width, drawing.cell.height), abs=0.36)
    scale = per_mm(drawing)
    known = reference(outlines(drawing, 1 / scale), scale)
    # That moves what is drawn by up to 0.36 mm, which is more than a pixel of small drawings.
    assert stray(load(programs.poppler(printed, scale)), known, math.ceil(0.36 * scale)) < FEW


@pytest.mark.clients
def test_a_mirrored_file_is_told(lopsided: Artwork, tmp_path: Path) -> None:
    width = lopsided.cell.width

    def mirrored(marks: Geometries) -> Geometries:
        return np.asarray(shapely.transform(marks, lambda xy: [width, 0] + xy * [-1, 1]), object)

    layers = tuple(
        replace(layer, areas=mirrored(layer.areas), lines=mirrored(layer.lines)) for layer in lopsided.layers
    )
    printed = programs.librecad(written(replace(lopsided, layers=layers), tmp_path, DxfVersion.R2000))
    scale = per_mm(lopsided)
    known = reference(outlines(lopsided, 1 / scale), scale)
    assert stray(load(programs.poppler(printed, scale)), known, math.ceil(0.36 * scale)) > 0.1


@pytest.mark.clients
@pytest.mark.parametrize(("drawing", "version"), shared_out(list(DxfVersion)[::-1]), indirect=["drawing"])
def test_ezdxf_finds_nothing_to_mend(drawing: Artwork, tmp_path: Path, version: DxfVersion) -> None:
    audit = readfile(written(drawing, tmp_path, version)).audit()
    assert not audit.errors
    assert not audit.fixes
