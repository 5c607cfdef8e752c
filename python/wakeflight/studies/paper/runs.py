# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flies the cases, as many at a time as there are cores, and keeps every run as NetCDF."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...errors import InputError, NumericalFailure
from ...progress import Progress, Silent
from ...results import load, save
from .cases import Case

if TYPE_CHECKING:
    import xarray as xr

# trims of this process by the model they were made with: flights of one trim share it
_TRIMS: dict[Any, Any] = {}


def fly_all(
    cases: Sequence[Case], folder: Path, workers: int | None = None, progress: Progress | Silent | None = None
) -> dict[str, xr.Dataset]:
    """Fly every case, save each as `folder`/NAME.nc, return the Datasets by name.

    Flights are single-threaded and spread over `workers` processes (the cores of the machine), the long ones first.
    A flight that fails leaves what it computed and ends the whole with `NumericalFailure` once the others are done.
    """
    failures = attempt(cases, folder, workers, progress)
    if failures:
        raise NumericalFailure("; ".join(f"{name}: {failure}" for name, failure in failures.items()))
    return load_all(cases, folder)


def attempt(
    cases: Sequence[Case], folder: Path, workers: int | None = None, progress: Progress | Silent | None = None
) -> dict[str, str]:
    """Fly every case and save each; what failed, by name."""
    progress = progress or Silent()
    workers = workers or max(1, len(os.sched_getaffinity(0)))
    failures = {}
    for case in cases:
        (folder / case.name).parent.mkdir(parents=True, exist_ok=True)
    # forked before anything has started a thread
    with ProcessPoolExecutor(workers, multiprocessing.get_context("fork"), initializer=_single_threaded) as pool:
        ordered = sorted(cases, key=lambda case: -case.cost)
        flights = {pool.submit(_fly, case, folder / f"{case.name}.nc"): case for case in ordered}
        progress.phase("flights", len(flights))
        for done in as_completed(flights):
            failure = done.result()
            if failure:
                failures[flights[done].name] = failure
            progress.advance(1, flights[done].name)
    return failures


def load_all(cases: Sequence[Case], folder: Path) -> dict[str, xr.Dataset]:
    """Datasets of finished flights from `folder`."""
    missing = [case.name for case in cases if not (folder / f"{case.name}.nc").is_file()]
    if missing:
        raise InputError.of("--redraw", str(folder), f"has no run {missing[0]}.nc; fly without --redraw first")
    return {case.name: load(folder / f"{case.name}.nc") for case in cases}


def _single_threaded() -> None:
    os.environ["WAKEFLIGHT_THREADS"] = "1"


class Log(Silent):
    """Keeps the phases a verb reports: name, steps and seconds since the log began."""

    def __init__(self) -> None:
        self.begun = time.perf_counter()
        self.phases: list[tuple[str, float | None, float]] = []

    def phase(self, name: str, total: float | None = None) -> None:
        """Keep the beginning of a phase."""
        self.phases.append((name, total, round(self.seconds(), 4)))

    def seconds(self) -> float:
        """Since the log began."""
        return time.perf_counter() - self.begun


def _fly(case: Case, path: Path) -> str:
    """Fly one case and save it; the failure as text, or nothing."""
    from ...flight import fly
    from ...maneuvers import load_maneuver

    clock, log = time.process_time(), Log()
    try:
        start = _trim(case, log)
    except NumericalFailure as reason:
        return str(reason)
    spent = time.process_time() - clock
    clock = time.process_time()
    failure = ""
    try:
        maneuver = load_maneuver(case.maneuver) if isinstance(case.maneuver, str) else case.maneuver
        flight = fly(start, maneuver, inflow=case.inflow, revolutions=case.revolutions, progress=log)
    except NumericalFailure as reason:
        if reason.partial is None:
            return str(reason)
        flight, failure = reason.partial, str(reason)
    data = flight.data.assign_attrs(
        case=case.name,
        seconds_processor=time.process_time() - clock,
        phases=log.phases,
        seconds_logged=log.seconds(),
    )
    if spent:
        data.attrs["seconds_processor_trim"] = spent
    save(data, path)
    return failure


def _trim(case: Case, log: Log) -> Any:
    from dataclasses import replace

    from ...aircraft import load_aircraft
    from ...condition import condition_for
    from ...inflow import RelaxationWake, trim_model
    from ...trim import trim

    model = trim_model(case.inflow)
    if isinstance(model, RelaxationWake):
        # the cap in flight is no part of a trim
        model = replace(model, max_loops_response=RelaxationWake().max_loops_response)
    key = (model, case.condition, case.given, case.modes)
    if key in _TRIMS:
        start, phases, seconds = _TRIMS[key]
        # the log of a flight begins with its trim, shared or not
        log.phases, log.begun = list(phases), log.begun - seconds
    else:
        aircraft = load_aircraft("uh60a")
        if case.modes is not None:
            aircraft = aircraft.discretised(n_modes=case.modes)
        condition = condition_for(aircraft, named=case.condition, **dict(case.given))
        start = trim(aircraft, condition, inflow=model, progress=log)
        _TRIMS[key] = start, list(log.phases), log.seconds()
    return start
