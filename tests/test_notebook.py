"""What a notebook is told where it lacks what sliders need."""

from __future__ import annotations

import sys

import pytest

from batik_vector.errors import MissingLibraryError
from batik_vector.notebook import interact


def test_without_ipywidgets_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    with pytest.raises(MissingLibraryError, match=r"pip install 'batik-vector\[notebook\]'"):
        interact("library:sample/kawung")
