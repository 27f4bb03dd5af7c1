"""Files that one process holds alone, on every system."""

from __future__ import annotations

import os
import sys
from typing import Any

FAR = 1 << 40
"""The byte that is locked where locks are of bytes: behind all that is ever written."""


def held_alone(file: Any) -> bool:
    """Take hold of an open file, unless another process has; return whether it is held.

    The system lets go of it where this process ends, however it ends.
    """
    try:
        if sys.platform == "win32":
            import msvcrt

            os.lseek(file.fileno(), FAR, os.SEEK_SET)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def let_go(file: Any) -> None:
    """Let go of a file that is held."""
    if sys.platform == "win32":
        import msvcrt

        os.lseek(file.fileno(), FAR, os.SEEK_SET)
        msvcrt.locking(file.fileno(), msvcrt.LK_UNLCK, 1)
    else:
        import fcntl

        fcntl.flock(file.fileno(), fcntl.LOCK_UN)
