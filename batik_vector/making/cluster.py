"""Work on the machines of a Dask cluster, for those who outgrow one: the engine is an extra, and theirs.

Workers compile and send bytes back; this process alone writes. A worker that dies costs time only: its tasks
go to another one.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar

from batik_vector._version import __version__
from batik_vector.errors import ExportError, Fault, MissingLibraryError
from batik_vector.fields import installed
from batik_vector.making.pool import Failure, Outcome, tried

Task = TypeVar("Task")
Result = TypeVar("Result")

IN_FLIGHT = 3
"""Tasks on their way for each of the cluster's threads: none waits for work, and memory is bounded."""
ANSWER, PATIENCE = 5, 30
"""Seconds to wait for the scheduler, and for a first worker."""


def outcomes_on(
    scheduler: str, work: Callable[[Task], Result], tasks: Iterable[Task]
) -> Iterator[Outcome[Task, Result]]:
    """Yield what comes of tasks that the workers of a Dask scheduler do, as they are done.

    Args:
        scheduler: its address, such as ``tcp://10.0.0.5:8786``.
        work: done for each, where this version is installed.
        tasks: taken as workers get free.

    Raises:
        MissingLibraryError: where the extra is not installed.
        ExportError: where nobody answers, there is no worker, or a worker has another version.
    """
    try:
        distributed: Any = importlib.import_module("distributed")
    except ImportError as error:
        raise MissingLibraryError(
            "a cluster needs Dask, which is not installed: pip install 'batik-vector[cluster]'"
        ) from error
    try:
        client = distributed.Client(scheduler, timeout=ANSWER, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise ExportError(f"--scheduler {scheduler}: nobody answers there: {error}") from error
    try:
        yield from _outcomes(client, distributed.as_completed, scheduler, work, iter(tasks))
    finally:
        client.close()


def _outcomes(
    client: Any, as_completed: Any, scheduler: str, work: Callable[[Any], Any], tasks: Iterator[Any]
) -> Iterator[Outcome[Any, Any]]:
    most = IN_FLIGHT * _threads(client, scheduler)
    on_its_way: dict[Any, Any] = {}
    # Told its loop: without it that looks for a client of the whole process.
    running = as_completed(loop=client.loop, raise_errors=False)

    def send() -> None:
        for task in tasks:
            future = client.submit(tried, work, task, pure=False)
            on_its_way[future.key] = task
            running.add(future)
            if len(on_its_way) >= most:
                return

    send()
    for future in running:
        task = on_its_way.pop(future.key)
        error = future.exception()
        if error is not None:
            yield Outcome(task, None, Failure((Fault(f"the cluster gave it up: {error}"),)))
        else:
            yield Outcome(task, *future.result())
        send()


def _threads(client: Any, scheduler: str) -> int:
    """Return how many tasks the cluster works at, once all its workers are known to have this version."""
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except (OSError, TimeoutError) as error:
        raise ExportError(f"--scheduler {scheduler}: no worker has come within {PATIENCE} s") from error
    try:
        # A worker that dies this moment has no say.
        versions = client.run(version, on_error="return")
    except ImportError as error:
        raise ExportError(f"--scheduler {scheduler}: a worker has no batik-vector: {error}") from error
    for worker, found in sorted(versions.items()):
        if isinstance(found, OSError):
            continue
        if found != version():
            raise ExportError(f"--scheduler {scheduler}: {worker} has version {found}, expected {version()}")
    return max(1, sum(int(count) for count in client.nthreads().values()))


def version() -> str:
    """Return the version of this package and of its plug-ins, as a worker has them."""
    return " with ".join([__version__, *installed()])
