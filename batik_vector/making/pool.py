"""Work on several cores: tasks go out one at a time, outcomes come back as they are done.

Each worker is a process of its own with a pipe to this one. One that dies costs the task it was at, which is
told as its failure, and another takes its place; where this process dies, however, the workers find their
pipes closed and end too. concurrent.futures gives up all tasks when one worker dies, and leaves workers
behind that wait for a parent killed by force.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from multiprocessing.connection import Connection, wait
from typing import Any, Generic, TypeVar

from batik_vector.errors import BatikError, Fault, RecipeError
from batik_vector.values import frozen

Task = TypeVar("Task")
Result = TypeVar("Result")


@frozen
class Failure:
    """Why a task came to nothing: the faults to tell, and what the command ends with."""

    faults: tuple[Fault, ...]
    exit_code: int = 2

    @property
    def words(self) -> str:
        """All faults, a line each."""
        return "\n".join(map(str, self.faults))


@frozen
class Outcome(Generic[Task, Result]):
    """A task that is done, and what came of it: a result or a failure."""

    task: Task
    result: Result | None
    failure: Failure | None = None

    def check(self, source: str = "") -> None:
        """Raise what a failure tells.

        Args:
            source: what the task was made of, where a fault does not say.

        Raises:
            BatikError: with the exit code of the error that it was.
        """
        if self.failure is not None:
            faults = self.failure.faults
            error = RecipeError([each if each.source else replace(each, source=source) for each in faults])
            error.exit_code = self.failure.exit_code
            raise error


def outcomes(
    work: Callable[[Task], Result], tasks: Iterable[Task], workers: int = 1
) -> Iterator[Outcome[Task, Result]]:
    """Yield what comes of tasks as they are done: with one worker in their order, here; else as they come.

    Args:
        work: done for each; for several workers a function at the top of a module, or an object that holds
            nothing but plain values.
        tasks: taken as workers get free, so that they may be many.
        workers: processes.
    """
    if workers <= 1:
        yield from (Outcome(task, *tried(work, task)) for task in tasks)
        return
    pool = _Pool(work, workers)
    try:
        yield from pool.outcomes(iter(tasks))
    finally:
        pool.end()


def tried(work: Callable[[Task], Result], task: Task) -> tuple[Result | None, Failure | None]:
    """Return what comes of a task: a result, or why there is none. Defects of this program are raised."""
    try:
        return work(task), None
    except RecipeError as error:
        return None, Failure(error.faults, error.exit_code)
    except BatikError as error:
        return None, Failure((Fault(str(error)),), error.exit_code)
    except MemoryError:
        return None, Failure((Fault("this needs more memory than there is"),))


class _Pool:
    def __init__(self, work: Callable[[Any], Any], workers: int) -> None:
        # A fork would take along locks that other threads hold.
        self._context = multiprocessing.get_context("spawn")
        self._work, self._most = work, workers
        self._busy: dict[Connection, tuple[Any, Any]] = {}
        self._free: list[tuple[Any, Connection]] = []

    def outcomes(self, tasks: Iterator[Any]) -> Iterator[Outcome[Any, Any]]:
        done = object()
        task = next(tasks, done)
        while task is not done or self._busy:
            while task is not done and len(self._busy) < self._most:
                self._give(task)
                task = next(tasks, done)
            for pipe in wait(list(self._busy)):
                assert isinstance(pipe, Connection)
                yield self._taken(pipe)

    def _give(self, task: Any) -> None:
        process, pipe = self._free.pop() if self._free else self._started()
        self._busy[pipe] = task, process
        with contextlib.suppress(BrokenPipeError):
            pipe.send(task)

    def _started(self) -> tuple[Any, Connection]:
        mine, theirs = self._context.Pipe()
        with deaf():
            process = self._context.Process(target=_serve, args=(theirs, self._work), daemon=True)
            process.start()
        theirs.close()
        return process, mine

    def _taken(self, pipe: Connection) -> Outcome[Any, Any]:
        task, process = self._busy.pop(pipe)
        try:
            result, failure, defect = pipe.recv()
        except (EOFError, ConnectionResetError):
            process.join()
            return Outcome(task, None, Failure((Fault(_death(process.exitcode)),)))
        self._free.append((process, pipe))
        if defect:
            raise RuntimeError(f"a worker failed by a defect of this program:\n{defect}")
        return Outcome(task, result, failure)

    def end(self) -> None:
        """End all workers, at once."""
        for process, pipe in [*self._free, *((process, pipe) for pipe, (_, process) in self._busy.items())]:
            process.terminate()
            pipe.close()


@contextlib.contextmanager
def deaf() -> Iterator[None]:
    """Let what is started inside not hear Ctrl-C, which goes to all processes of a terminal."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _death(code: int | None) -> str:
    if code is not None and code < 0:
        with contextlib.suppress(ValueError):
            name = signal.Signals(-code).name
            return f"the process that made it was ended by {name}, perhaps for want of memory"
    return f"the process that made it ended with {code}"


def _serve(pipe: Connection, work: Callable[[Any], Any]) -> None:
    """Be a worker: do what comes until the pipe is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    with contextlib.suppress(EOFError, BrokenPipeError, ConnectionResetError):
        while True:
            task = pipe.recv()
            try:
                told = (*tried(work, task), "")
            except Exception:
                import traceback

                told = (None, None, traceback.format_exc())
            pipe.send(told)
