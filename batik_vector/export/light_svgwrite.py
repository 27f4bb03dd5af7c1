"""svgwrite without what a file of ours has no use for.

With svgwrite come urllib.request, and with that ssl, http and email, for fonts fetched from the web; and it
compiles regular expressions of thousands of characters for its checks of attributes, which we switch off.
Together they take longer than drawing a design and writing it. Here both wait until they are called, which
for us is never; whoever uses svgwrite beside us finds it whole. Where other threads run, which might import
the same modules at that moment, svgwrite is imported as it is.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import Any

_importing = threading.Lock()
_LATER = ("urllib.request", "svgwrite.data.svgparser")
"""Modules from which svgwrite takes functions alone."""


def svgwrite() -> Any:
    """Return svgwrite, imported where it is not yet."""
    with _importing:
        alone = "svgwrite" not in sys.modules and threading.active_count() == 1
        later = _LATER if alone else ()
        waiting = {name: _stand_in(name) for name in later if name not in sys.modules}
        sys.modules.update(waiting)
        try:
            return import_module("svgwrite")
        finally:
            for name in waiting:
                del sys.modules[name]


def _stand_in(name: str) -> ModuleType:
    """Return a module whose functions import the module of that name when they are called."""
    module = ModuleType(name)

    def __getattr__(function: str) -> Callable[..., Any]:  # noqa: N807
        if function.startswith("__"):
            raise AttributeError(function)
        return lambda *args, **given: getattr(import_module(name), function)(*args, **given)

    vars(module)["__getattr__"] = __getattr__
    return module
