from __future__ import annotations

import contextlib
import os
import signal

from hypothesis import settings

# How long one example takes says more of the machine than of the code.
settings.register_profile("here", deadline=None)
# What a change is judged by must not depend on luck.
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "here")

# Random examples take constants out of whatever code of ours is imported by then: another order of the tests,
# or a new line anywhere, would draw others.
with contextlib.suppress(ImportError, AttributeError):
    from hypothesis.internal.conjecture import providers

    none_of_ours = providers._local_constants
    providers._get_local_constants = lambda: none_of_ours

# Where the tests run in the background, Ctrl-C is ignored, and what they start would take that over.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
