"""The library: patterns kept with all their versions in one file, and found again.

It sees what ``batik_vector`` offers to everyone, and nothing else of it.
"""

from __future__ import annotations

from batik_vector.library.store import Library as Library

__all__ = ["Library"]
