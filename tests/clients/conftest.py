from __future__ import annotations

import pytest

from batik_vector.artwork import Artwork
from tests.clients import drawings


@pytest.fixture(params=sorted(drawings.RECIPES))
def drawing(request: pytest.FixtureRequest) -> Artwork:
    """Every drawing in turn."""
    name: str = request.param
    return drawings.artwork(name)


@pytest.fixture(params=["line-art", "three-baths"])
def lopsided(request: pytest.FixtureRequest) -> Artwork:
    """Drawings without any symmetry."""
    name: str = request.param
    return drawings.artwork(name)
