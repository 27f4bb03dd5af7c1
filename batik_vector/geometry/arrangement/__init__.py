"""Arrangements: the faces into which layers of polygons divide a rectangle, and what covers each."""

from __future__ import annotations

from batik_vector.geometry.arrangement.faces import Arrangement, arranged

__all__ = ["Arrangement", "arranged"]
