from __future__ import annotations

import contextlib
import os
import signal
import zlib
from pathlib import Path

import pytest
from hypothesis import settings

KINDS = 8
"""Parameter sets up to which ``--few`` leaves a test alone: so many are kinds of things, more are samples."""

ALONE = "\npytestmark = pytest.mark.clients\n"
"""How a file says that all of it is for other programs."""

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


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--few",
        type=int,
        default=1,
        help="of a test that is tried on many samples, try every Nth: which ones, hangs on the test's name",
    )
    parser.addoption(
        "--part",
        type=int,
        default=1,
        help="run one test in N: which ones, hangs on their names",
    )


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out what is for other programs alone, where they are not asked for: it is slow to import."""
    if collection_path.parent.name != "clients" or "not clients" not in config.option.markexpr:
        return None
    alone = collection_path.suffix == ".py" and ALONE in collection_path.read_text(encoding="utf-8")
    return alone or None


# After what is chosen by marks.
@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    part: int = config.getoption("--part")
    _leave_out(config, items, {item for item in items if zlib.crc32(item.nodeid.encode()) % part})
    few: int = config.getoption("--few")
    of_test: dict[str, list[pytest.Item]] = {}
    for item in items:
        of_test.setdefault(item.nodeid.partition("[")[0], []).append(item)
    left_out = {
        item
        for name, each in of_test.items()
        if len(each) > KINDS and each[0].get_closest_marker("every") is None
        for number, item in enumerate(each)
        if (number + zlib.crc32(name.encode())) % few
    }
    _leave_out(config, items, left_out)


def _leave_out(config: pytest.Config, items: list[pytest.Item], left_out: set[pytest.Item]) -> None:
    config.hook.pytest_deselected(items=[item for item in items if item in left_out])
    items[:] = [item for item in items if item not in left_out]
