"""Calls of ``batik-vector check``, and the tiles that it is called on."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from click.testing import Result

from batik_vector.command.cli import cli
from tests.calling import runner

TILES = Path(__file__).parents[1] / "certificate" / "broken"
GOOD = (TILES / "good.svg").read_text("utf-8")


def call(*args: str | Path) -> Result:
    return runner().invoke(cli, ["check", *map(str, args)])


def checked(*args: str | Path, code: int = 0) -> dict[str, Any]:
    """Return the one report of a call for machines."""
    result = call(*args, "--json")
    assert result.exit_code == code, (result.stderr, result.exception)
    (facts,) = json.loads(result.stdout)["recipes"]
    assert isinstance(facts, dict)
    return facts
