# SPDX-License-Identifier: MIT OR Apache-2.0
"""A flight by hand: stepped with whatever the sticks do, kept as a run like any other.

Its sticks are sampled where every coupling step begins. When it ends, the samples become the manoeuvre of its input, and the run
is the one that `fly` makes of that input, bit by bit. A stick takes effect one coupling step after it was sampled: where a step
ends, the rate that follows is part of what blades and wake give each other.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from .errors import NumericalFailure
from .flight import Flight, Flying
from .flight_folder import SAMPLES, Kept, RunFolder
from .flight_input import FlightInput
from .maneuvers import Maneuver
from .progress import Progress, Silent
from .recorder import Recorder
from .runlog import read
from .snapshot import Snapshot
from .stepping import Instant
from .stick_samples import DECIMALS, SampledSticks, sampled
from .trim import INCH, Trim

MOST_REVOLUTIONS = 9999
"""Revolutions of the longest flight by hand: what a manoeuvre may last."""


def by_hand(name: str, notes: str = "") -> Maneuver:
    """The manoeuvre of a flight that has not been flown yet."""
    return Maneuver(name, (), revolutions=MOST_REVOLUTIONS, notes=notes)


class FlyingByHand(Flying):
    """A flight by hand; `given` holds a manoeuvre of `by_hand`.

    `begin` opens it in the folder where it is kept, `step` flies one coupling step, `land` the last one, `keep` makes the run.
    The folder is closed by whoever opened it, when the run has been made.
    """

    folder: RunFolder
    at_start: Kept
    recorder: Recorder
    failure: str | None = None

    def __init__(self, start: Trim, given: FlightInput, progress: Progress | Silent):
        """Check what is flown, converge the wake."""
        super().__init__(start, given, progress)
        self.sim.converge(progress)
        self.trim_in = start.stick_si / INCH
        self.travel_in = np.asarray(start.aircraft.stick_travel_in, dtype=float)
        # at the two ends of the step that begins, and at the end of the next one
        self._samples = np.zeros((3, 4))

    def begin(self, folder: RunFolder, moment: Snapshot | None = None) -> None:
        """The flight begins, at its trim or at the `moment` of `transfer.carried` at which another one was left for it."""
        sim = self.sim
        if moment is not None:
            self.given = self.given.with_plan(begin=moment)
            sim.restore(moment)
            self._samples = np.tile(self._possible(sim.hands / INCH - self.trim_in), (3, 1))
        self.folder = folder
        note = folder.begin(self.given)
        if note:
            self.progress(f"note: {note}")
        self.at_start = Kept(sim.snapshot(), sim.phase, dict(sim.seconds))
        folder.keep_start(self.start, self.at_start)
        self._log = folder.samples()
        rows, wakes = folder.rows(sim, 0), folder.wakes(0)
        lattice = self.given.plan.lattice
        self.recorder = Recorder(sim, self.maneuver, self.n_steps, rows, wakes, lattice=lattice)
        for k in (0, 1):
            self._keep(k, self._samples[k])

    @property
    def inches(self) -> np.ndarray:
        """Sticks (4,) [in about trim] that were asked for last."""
        return np.array(self._samples[2])

    @property
    def now(self) -> np.ndarray:
        """Sticks (4,) [in about trim] where the coupling step begins that was flown last."""
        return np.array(self._samples[0])

    @property
    def exhausted(self) -> bool:
        """Whether no step more than the last one fits into a run."""
        return self.sim.steps >= self.n_steps - 2

    def _possible(self, inches: Sequence[float] | np.ndarray) -> np.ndarray:
        """Inches about trim between the stops, in whole units of what a sample keeps."""
        unit = 10.0**-DECIMALS
        low = np.ceil(-self.trim_in / unit) * unit
        high = np.floor((self.travel_in - self.trim_in) / unit) * unit
        held: np.ndarray = np.round(np.clip(inches, low, high), DECIMALS)
        # no zero below zero: it is another number in a file
        return held + 0.0

    def _keep(self, k: int, inches: np.ndarray) -> None:
        place = self._log.place()
        self._log.window["time"][place], self._log.window["inches"][place] = self.sim.clock.time(k), inches
        self._log.done(k)

    def _path(self) -> SampledSticks:
        clock, step = self.sim.clock, self.sim.steps
        times = (clock.time(step), clock.time(step + 1), clock.time(step + 2))
        return SampledSticks(self.trim_in, times, self._samples)

    def step(
        self, inches: Sequence[float] | np.ndarray, observer: Callable[[Instant, Recorder], None] | None = None
    ) -> None:
        """Fly one coupling step; sticks are at `inches` (4,) about trim when the next one ends, held between the stops.

        observer sees the instant at which the step begins, kept already. After a NumericalFailure `land` with its text.
        """
        sim = self.sim
        self._samples = np.stack([self._samples[1], self._samples[2], self._possible(inches)])
        self._keep(sim.steps + 2, self._samples[2])

        def seen(instant: Instant) -> None:
            self.recorder.record(instant)
            if observer is not None:
                observer(instant, self.recorder)

        try:
            sim.follow(self._path(), seen)
        except (ArithmeticError, np.linalg.LinAlgError) as reason:
            raise NumericalFailure(str(reason)) from reason
        self.folder.beat(sim)

    def land(self, failure: str | None = None) -> None:
        """No step follows: of a flight that did not fail, after a last one to where the sticks are."""
        if failure is None:
            try:
                self.step(self.inches)
                self.recorder.record(self.sim.last(self._rest()))
            except NumericalFailure as reason:
                failure = str(reason)
        if failure is not None:
            self.failure = f"flight of {self.maneuver.name} stopped at t = {self.sim.t:.4f} s: {failure}"
        self._log.flush()

    def keep(self) -> Flight:
        """The run of a flight that has landed, written to its folder."""
        log = read(self.folder.restart / SAMPLES)
        # of a flight that failed also the samples that the step which failed went by
        n = len(log.records) if self.failure is not None else self.sim.steps + 1
        times, inches = (np.array(log.records[name][:n]) for name in ("time", "inches"))
        name, notes = self.maneuver.name, self.maneuver.notes
        self.given = self.given.with_plan(maneuver=sampled(name, times, inches, notes))
        self.maneuver = self.recorder.maneuver = self.given.plan.maneuver
        flight = self.flight(self.recorder, self.failure)
        self.folder.change(self.given, self.start, self.at_start)
        self.folder.save(flight.data, ended=True)
        return flight

    def _rest(self) -> SampledSticks:
        """Sticks that stay where the last step took them."""
        clock, step = self.sim.clock, self.sim.steps
        times = (clock.time(step - 1), clock.time(step), clock.time(step + 1))
        return SampledSticks(self.trim_in, times, np.stack([self._samples[0], self._samples[1], self._samples[1]]))
