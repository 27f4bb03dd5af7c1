"""Nets: what many areas that meet cover together, found at the edges that meet others and nowhere else."""

from __future__ import annotations

from batik_vector.geometry.nets.net import Net, united

__all__ = ["Net", "united"]
