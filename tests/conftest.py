from __future__ import annotations

import os
import signal

from hypothesis import settings

# How long one example takes says more of the machine than of the code.
settings.register_profile("here", deadline=None)
# What a change is judged by must not depend on luck.
settings.register_profile("ci", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "here")

# Where the tests run in the background, Ctrl-C is ignored, and what they start would take that over.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
