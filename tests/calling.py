"""The command as click's own runner calls it."""

from __future__ import annotations

import inspect
import os
from typing import Any

from click.testing import CliRunner


def runner() -> CliRunner:
    """Return a runner that keeps stdout and stderr apart: click before 8.2 mixes them unless it is told.

    The library that a call names is its own: the variable that hands it on is put back behind the call.
    """
    told = "mix_stderr" in inspect.signature(CliRunner).parameters
    apart: dict[str, Any] = {"mix_stderr": False} if told else {}
    return CliRunner(env={"BATIK_LIBRARY": os.environ.get("BATIK_LIBRARY")}, **apart)
