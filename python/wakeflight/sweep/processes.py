# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cases run by spawned processes of this machine.

A process that dies (out of memory, a crash) takes its case with it: another one is started, the case is given once more, and
where that kills it too, the signal is its failure. Forked processes are never used: threads of the physics core do not
survive a fork.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
from collections import deque
from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from typing import Any

from ..errors import WakeflightError
from .outcome import Outcome
from .worker import ONE_THREAD, serve

ATTEMPTS = 2
"""How often a case may take its process with it."""


@dataclass
class _Worker:
    process: Any
    connection: Connection
    place: int | None = None
    ready: bool = False


def cores() -> int:
    """Cores that this process may use."""
    try:
        return max(1, len(os.sched_getaffinity(0)))
    except AttributeError:
        return os.cpu_count() or 1


def local(tasks: Mapping[int, tuple[Any, Any, Any]], workers: int) -> Generator[tuple[int, Outcome], None, None]:
    """Outcomes of tasks (verb, case, what is kept) by their places, in the order in which they are done."""
    if not tasks:
        return
    waiting, left = deque(tasks), len(tasks)
    attempts: dict[int, int] = {}
    pool: list[_Worker] = []
    served = False
    try:
        with _environment(ONE_THREAD):
            pool.extend(_started() for _ in range(min(workers, left)))
            while left:
                by_connection = {each.connection: each for each in pool}
                for connection in wait(list(by_connection)):
                    worker = by_connection[connection]  # type: ignore[index]
                    try:
                        answer = worker.connection.recv()
                    except (EOFError, OSError):
                        if not worker.ready and not served:
                            raise WakeflightError(_cannot_start(worker)) from None
                        pool.remove(worker)
                        said = _ended(worker)
                        place = worker.place
                        if place is not None:
                            attempts[place] = attempts.get(place, 0) + 1
                            if attempts[place] < ATTEMPTS:
                                waiting.appendleft(place)
                            else:
                                left -= 1
                                yield place, Outcome(failure=said, lasting=False)
                        if waiting:
                            pool.append(_started())
                        continue
                    worker.ready = served = True
                    worker.place = None
                    if waiting:
                        worker.place = waiting.popleft()
                        worker.connection.send((worker.place, pickle.dumps(tasks[worker.place])))
                    if answer is not None:
                        left -= 1
                        yield answer
    finally:
        for worker in pool:
            worker.connection.close()
            worker.process.terminate()
        for worker in pool:
            worker.process.join()


def _started() -> _Worker:
    """A new process."""
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=serve, args=(theirs,), daemon=True)
    process.start()
    theirs.close()
    return _Worker(process, ours)


def _ended(worker: _Worker) -> str:
    """How a process came to its end, in words."""
    worker.connection.close()
    worker.process.join()
    code = worker.process.exitcode
    how = f"signal {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"
    return f"its process was ended by {how}, {ATTEMPTS} times: out of memory, or a crash"


def _cannot_start(worker: _Worker) -> str:
    worker.process.join()
    guard = (
        'a script that sweeps keeps what it does below `if __name__ == "__main__":`, since every process reads it anew'
    )
    return f"no process could be started (exit code {worker.process.exitcode}): {guard}"


@contextmanager
def _environment(values: Mapping[str, str]) -> Iterator[None]:
    """Variables that processes begun within the block have."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def packable(tasks: Sequence[Any]) -> str:
    """Why tasks cannot be given to another process, empty if they can."""
    try:
        for each in tasks:
            pickle.dumps(each)
    except Exception as reason:  # objects refuse in many ways
        return f"{type(reason).__name__}: {reason}"
    return ""
