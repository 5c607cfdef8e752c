# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cases run by a Dask cluster: the engine beyond one machine, its client made by the user."""

from __future__ import annotations

import os
from collections.abc import Generator, Mapping
from typing import Any

from ..errors import InputError
from .outcome import Kept, Outcome, told
from .worker import ONE_THREAD, run_case


def on_cluster(tasks: Mapping[int, tuple[Any, Any, Any]], client: Any) -> Generator[tuple[int, Outcome], None, None]:
    """Outcomes of tasks by their places, in the order in which they are done."""
    from distributed import as_completed

    completed: Any = as_completed

    futures = {client.submit(_run, *task, pure=False): place for place, task in tasks.items()}
    try:
        for future in completed(list(futures)):
            reason = future.exception()
            place = futures.pop(future)
            yield place, future.result() if reason is None else Outcome(failure=told(reason), lasting=False)
            future.release()
    finally:
        # what has not been done is not done any more
        client.cancel(list(futures))


def check_client(client: Any) -> None:
    """Refuse what takes no tasks."""
    if not {"submit", "cancel", "scheduler_info"} <= set(dir(client)):
        raise InputError.of("client", type(client).__name__, "must be a dask.distributed.Client")


def _run(verb: Any, case: Mapping[str, Any], kept: Kept) -> Outcome:
    """One case in a worker of the cluster, with one thread of the physics core."""
    os.environ.update({"WAKEFLIGHT_THREADS": ONE_THREAD["WAKEFLIGHT_THREADS"]})
    return run_case(verb, case, kept)
