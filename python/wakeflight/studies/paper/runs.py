# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flies the cases, as many at a time as there are cores, and keeps every run as NetCDF."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ...errors import InputError, NumericalFailure
from ...progress import Progress, Silent
from ...results import load, save
from ..case import Trims, run, several
from .cases import Planned

if TYPE_CHECKING:
    import xarray as xr

TRIMS = Trims()
"""Trims of this process: flights share them."""

_LOGGED: dict[int, tuple[list[tuple[str, float | None, float]], float]] = {}
"""What the trims of this process logged, phases and seconds."""


def fly_all(
    cases: Sequence[Planned], folder: Path, workers: int | None = None, progress: Progress | Silent | None = None
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
    cases: Sequence[Planned], folder: Path, workers: int | None = None, progress: Progress | Silent | None = None
) -> dict[str, str]:
    """Fly every case and save each; what failed, by name."""
    progress = progress or Silent()
    for case in cases:
        (folder / case.name).parent.mkdir(parents=True, exist_ok=True)
    progress.phase("flights", len(cases))
    # forked before anything has started a thread
    failures = several(
        _fly,
        [(case, folder / f"{case.name}.nc") for case in cases],
        workers,
        method="fork",
        each=lambda k, _: progress.advance(1, cases[k].name),
        cost=lambda planned: planned[0].cost,
    )
    return {case.name: failure for case, failure in zip(cases, failures, strict=True) if failure}


def load_all(cases: Sequence[Planned], folder: Path) -> dict[str, xr.Dataset]:
    """Datasets of finished flights from `folder`."""
    missing = [case.name for case in cases if not (folder / f"{case.name}.nc").is_file()]
    if missing:
        raise InputError.of("--redraw", str(folder), f"has no run {missing[0]}.nc; fly without --redraw first")
    return {case.name: load(folder / f"{case.name}.nc") for case in cases}


class Log(Silent):
    """Keeps the phases a verb reports: name, steps and seconds since the log began."""

    def __init__(self) -> None:
        self.begun = time.perf_counter()
        self.phases: list[tuple[str, float | None, float]] = []

    def phase(self, name: str, total: float | None = None) -> None:
        """Keep the beginning of a phase."""
        self.phases.append((name, total, round(self.seconds(), 4)))

    def go_on(self, phases: list[tuple[str, float | None, float]], seconds: float) -> None:
        """Begin with what a shared trim logged when it was made."""
        self.phases, self.begun = list(phases), self.begun - seconds

    def seconds(self) -> float:
        """Since the log began."""
        return time.perf_counter() - self.begun


def _fly(planned: tuple[Planned, Path]) -> str:
    """Fly one case and save it; the failure as text, or nothing."""
    wanted, path = planned
    case, log = wanted.case(), Log()
    start = TRIMS.start(case, log)
    # the log of a flight begins with its trim, shared or not
    if id(start) in _LOGGED:
        log.go_on(*_LOGGED[id(start)])
    elif not start.failure:
        _LOGGED[id(start)] = list(log.phases), log.seconds()
    done = run(case, log, TRIMS)
    if done.answer is None:
        return done.failure
    data = done.data.assign_attrs(
        case=wanted.name,
        seconds_processor=done.cpu_seconds,
        seconds_processor_trim=start.cpu_seconds,
        phases=log.phases,
        seconds_logged=log.seconds(),
    )
    save(data, path)
    return done.failure
