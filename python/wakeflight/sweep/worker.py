# SPDX-License-Identifier: MIT OR Apache-2.0
"""A process that runs cases: started anew (spawned), with one thread, fed through a pipe; it ends when the pipe does."""

from __future__ import annotations

import pickle
import signal
from collections.abc import Mapping
from multiprocessing.connection import Connection
from typing import Any

from .find import verb_of
from .outcome import Kept, Outcome, attempted, told

ONE_THREAD = {
    "WAKEFLIGHT_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
}
"""Environment of a worker: as many processes as cores, and sums of linear algebra in one order."""


def serve(connection: Connection) -> None:
    """Answer (place, packed task) by (place, Outcome) until the pipe ends; an interrupt is its parent's to answer."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    connection.send(None)
    while True:
        try:
            place, task = connection.recv()
        except (EOFError, OSError):
            return
        try:
            verb, case, kept = pickle.loads(task)
            found = run_case(verb, case, kept)
        except Exception as reason:
            found = Outcome(failure=told(reason))
        try:
            connection.send((place, found))
        except (BrokenPipeError, ConnectionResetError):
            return


def run_case(verb: Any, case: Mapping[str, Any], kept: Kept) -> Outcome:
    """One case of a verb."""
    return attempted(verb_of(verb).run, case, kept)
