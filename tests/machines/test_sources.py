"""Profiles that come along say of every number where it is from, or that it is believed."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import fields
from typing import Any

import pytest

from batik_vector.machines import MACHINES, Machine, shipped_text


def _numbers(table: dict[str, Any], before: str = "") -> Iterator[str]:
    for key, value in table.items():
        if isinstance(value, dict):
            yield from _numbers(value, f"{before}{key}.")
        elif isinstance(value, str):
            # A length, such as "0.4 mm".
            if value[:1].isdigit():
                yield before + key
        elif not isinstance(value, bool) or key == "encoded":
            yield before + key


@pytest.mark.parametrize("name", MACHINES)
def test_every_number_has_its_source(name: str) -> None:
    profile = tomllib.loads(shipped_text(name))
    sources = profile.pop("sources", {})
    found = set(_numbers({key: value for key, value in profile.items() if key not in ("says", "base")}))
    assert {key for key in found if key not in sources and key.split(".")[0] not in sources} == set()
    assert {key.split(".")[0] for key in sources} <= {each.name for each in fields(Machine)}
