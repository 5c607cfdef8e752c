# SPDX-License-Identifier: MIT OR Apache-2.0
"""A case, everything a run depends on, and the one way to run it: what it gave, what it took, what stopped it."""

from __future__ import annotations

import multiprocessing
import os
import time
import traceback
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from ..errors import NumericalFailure, WakeflightError
from ..flight import fly
from ..inflow import trim_model
from ..integrators import RTOL
from ..progress import Progress, Silent
from ..trim import trim
from ..trim.wake import CONTROL_TOLERANCE
from ..tunnel import tunnel

if TYPE_CHECKING:
    import xarray as xr

    from ..aircraft import Aircraft, Rotor
    from ..condition import CompleteCondition
    from ..inflow import InflowModel
    from ..maneuvers import Maneuver
    from ..tunnel.model import StandInflow


@dataclass(frozen=True)
class Case:
    """One run: a rotor on a stand where `stand` is given, a flight where a manoeuvre is, else a trim.

    trim_inflow: model of the trim of a flight, where it is not the one that goes with `inflow`. stand: arguments of `wf.tunnel`.
    revolutions, integrator, rtol: of the flight.
    """

    aircraft: Aircraft | Rotor
    inflow: InflowModel | StandInflow
    condition: CompleteCondition | None = None
    maneuver: Maneuver | None = None
    stand: Mapping[str, Any] | None = None
    trim_inflow: InflowModel | None = None
    revolutions: float | None = None
    integrator: str = "ida"
    rtol: float = RTOL
    n_harmonics: int = 8
    control_tolerance: float = CONTROL_TOLERANCE

    @property
    def helicopter(self) -> Aircraft:
        """The aircraft of a trim or a flight."""
        return cast("Aircraft", self.aircraft)

    @property
    def flown_inflow(self) -> InflowModel:
        """The inflow model of a trim or a flight."""
        return cast("InflowModel", self.inflow)


@dataclass(frozen=True)
class Done:
    """A run that has ended: `answer` is a Trim, a Flight or a Tunnel, as far as it came, None where there is nothing.

    seconds, cpu_seconds: wall clock, and time of the processor over all threads. failure: why it stopped, empty if it did not;
    foreseen: whether it was one of numerics, which says where and why. start: the trim a flight began with, its cost apart.
    """

    answer: Any
    seconds: float = 0.0
    cpu_seconds: float = 0.0
    failure: str = ""
    foreseen: bool = True
    start: Done | None = field(default=None, repr=False)

    @property
    def data(self) -> xr.Dataset:
        """Dataset of a flight or a stand."""
        found: xr.Dataset = self.answer.data
        return found


def attempt(action: Callable[[], Any], keep: type[Exception] = NumericalFailure) -> Done:
    """Do something, clocked; an error of the kind `keep` becomes the failure, with what had been computed, others are raised."""
    wall, cpu = time.perf_counter(), time.process_time()
    answer, failure, foreseen = None, "", True
    try:
        answer = action()
    except NumericalFailure as reason:
        answer, failure = reason.partial, str(reason)
    except keep as reason:
        failure, foreseen = told(reason), False
    return Done(answer, time.perf_counter() - wall, time.process_time() - cpu, failure, foreseen)


def told(reason: Exception) -> str:
    """An error in words; of one that is not the program's own also where it came from."""
    if isinstance(reason, WakeflightError):
        return str(reason)
    last = traceback.extract_tb(reason.__traceback__)[-1]
    return f"{type(reason).__name__}: {reason} ({Path(last.filename).name}, line {last.lineno})"


class Trims:
    """Trims of this process, remembered: runs that differ in what a trim does not depend on share it."""

    def __init__(self) -> None:
        """None yet."""
        self._known: list[tuple[tuple[Any, ...], Done]] = []

    def start(self, case: Case, progress: Progress | Silent, keep: type[Exception] = NumericalFailure) -> Done:
        """Trim of a case, and what it cost when it was made; one that failed is not remembered."""
        flown = case.flown_inflow
        inflow = case.trim_inflow or (trim_model(flown) if case.maneuver is not None else flown)
        key = (case.aircraft, case.condition, inflow, case.n_harmonics, case.control_tolerance)
        for known, done in self._known:
            if known == key:
                return done
        done = attempt(
            lambda: trim(
                case.helicopter,
                case.condition,
                inflow=inflow,
                progress=progress,
                n_harmonics=case.n_harmonics,
                control_tolerance=case.control_tolerance,
            ),
            keep,
        )
        if not done.failure:
            self._known.append((key, done))
        return done


def run(
    case: Case,
    progress: Progress | Silent | None = None,
    trims: Trims | None = None,
    keep: type[Exception] = NumericalFailure,
) -> Done:
    """Run a case. A failure of the kind `keep` is part of what is returned; a flight whose trim failed has no answer."""
    progress, trims = progress or Silent(), trims or Trims()
    if case.stand is not None:
        stand = {"n_harmonics": case.n_harmonics, **case.stand}
        return attempt(lambda: tunnel(case.aircraft, inflow=case.inflow, progress=progress, **stand), keep)
    start = trims.start(case, progress, keep)
    maneuver = case.maneuver
    if maneuver is None:
        return start
    if start.failure:
        return Done(None, 0.0, 0.0, start.failure, start.foreseen, start)
    flown = attempt(
        lambda: fly(
            start.answer,
            maneuver,
            inflow=case.flown_inflow,
            revolutions=case.revolutions,
            integrator=case.integrator,
            progress=progress,
            rtol=case.rtol,
        ),
        keep,
    )
    return Done(flown.answer, flown.seconds, flown.cpu_seconds, flown.failure, flown.foreseen, start)


def several(
    function: Callable[[Any], Any],
    given: Sequence[Any],
    workers: int | None = None,
    method: str = "spawn",
    each: Callable[[int, Any], None] | None = None,
    cost: Callable[[Any], float] | None = None,
) -> list[Any]:
    """`function` of every entry, in order, in single-threaded processes, as many as there are cores.

    method: `spawn`, or `fork`, which starts faster and needs a process that has started no thread. each: told the place and the
    answer of an entry when it is done. cost: the dearest are begun first.
    """
    workers = workers or max(1, len(os.sched_getaffinity(0)))
    order: Iterable[int] = range(len(given))
    if cost is not None:
        order = sorted(order, key=lambda k: -cost(given[k]))
    answers: list[Any] = [None] * len(given)
    with ProcessPoolExecutor(workers, multiprocessing.get_context(method), initializer=_single_threaded) as pool:
        places = {pool.submit(function, given[k]): k for k in order}
        for done in as_completed(places):
            k = places[done]
            answers[k] = done.result()
            if each is not None:
                each(k, answers[k])
    return answers


def _single_threaded() -> None:
    os.environ["WAKEFLIGHT_THREADS"] = "1"
