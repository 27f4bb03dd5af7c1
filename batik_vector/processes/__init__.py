"""Processes: what machines need done to marks before they are written, as passes over outlines."""

from __future__ import annotations

from batik_vector.processes.order import contours, in_order, ordered, travel

__all__ = ["contours", "in_order", "ordered", "travel"]
