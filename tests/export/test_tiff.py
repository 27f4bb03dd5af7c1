from __future__ import annotations

import io
import shutil
import subprocess
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from PIL.TiffImagePlugin import TiffImageFile

from batik_vector.errors import MissingLibraryError
from batik_vector.export import TiffOptions, render, tiff, write_artwork
from batik_vector.export.provenance import read_provenance

from .drawings import NASTY, sample


def test_the_file_says_what_a_film_setter_asks(tmp_path: Path) -> None:
    path = write_artwork(sample(), tmp_path / "a.tiff", options=TiffOptions(dpi=333.3))
    with TiffImageFile(path) as image:
        tags = image.tag_v2
    # Group 4, one bit, white is 0, inches, first row at the top.
    assert [tags[each] for each in (258, 259, 262, 274, 277, 296)] == [(1,), 4, 0, 1, 1, 2]
    assert tags[285] == "wax, soga brown, Indigo/2"
    assert tags[269] == "Kawung"
    # A tile is filled: 525 pixels are 40 mm.
    exact = Fraction(525 * 254, 400)
    assert Fraction(tags[282].numerator, tags[282].denominator) == exact


def test_ink_is_black() -> None:
    read = np.asarray(Image.open(io.BytesIO(render(sample(), "tiff"))))
    assert read.shape == (300, 400)
    # The stem lies at the foot of the page: black there, and the corner white.
    assert not read[290, 20:380].any()
    assert read[0, 0]


def test_the_same_bytes_and_the_recipe_back(tmp_path: Path) -> None:
    from batik_vector.artwork import Provenance

    made = sample(provenance=Provenance(NASTY, 7, "0.1.0"), title="Blüte\nzwei")
    assert render(made, "tiff") == render(made, "tiff")
    path = write_artwork(made, tmp_path / "b.tiff")
    assert read_provenance(path) == made.provenance


def test_a_system_without_libtiff_says_what_would_do(monkeypatch: pytest.MonkeyPatch) -> None:
    from PIL import features

    monkeypatch.setattr(features, "check", lambda name: False)
    with pytest.raises(MissingLibraryError, match="pip install --upgrade pillow"):
        tiff.check_ready()


@pytest.mark.clients
@pytest.mark.skipif(shutil.which("tiffinfo") is None, reason="needs libtiff's tools")
def test_libtiffs_own_tools_read_it(tmp_path: Path) -> None:
    path = write_artwork(sample(), tmp_path / "a.tiff")
    told = subprocess.run(["tiffinfo", "-D", str(path)], capture_output=True, text=True, check=True)
    assert told.stderr == ""
    assert "Resolution: 254, 254 pixels/inch" in told.stdout
    assert "CCITT Group 4" in told.stdout
    copied = tmp_path / "plain.tiff"
    subprocess.run(["tiffcp", "-c", "none", str(path), str(copied)], check=True)
    assert np.array_equal(np.asarray(Image.open(copied)), np.asarray(Image.open(path)))
