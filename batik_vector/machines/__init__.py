"""Machines and workshops: what each can do, in profiles that are data."""

from __future__ import annotations

from batik_vector.machines.limits import Limits, Twice
from batik_vector.machines.profile import Machine, Motion, Tool
from batik_vector.machines.shipped import MACHINES, shipped_text

__all__ = ["MACHINES", "Limits", "Machine", "Motion", "Tool", "Twice", "shipped_text"]
