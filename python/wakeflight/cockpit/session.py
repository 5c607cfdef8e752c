# SPDX-License-Identifier: MIT OR Apache-2.0
"""What is flown in a cockpit: runs one after the other, each kept as any flight is, paced to the clock on the wall.

One thread flies and nothing else waits for pages: they leave the last place of the sticks and orders, and take the last picture.
A run ends when the pilot restarts, changes the inflow model, ends the session, reaches the ground that is drawn, or when the
numbers end it; with another inflow model the next run goes on from that moment.
"""

from __future__ import annotations

import contextlib
import json
import math
import queue
import re
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..aircraft import Aircraft
from ..condition import FlightCondition
from ..control import Augmentation
from ..errors import InputError, NumericalFailure, StorageFailure, WakeflightError
from ..flight_by_hand import FlyingByHand, by_hand
from ..flight_folder import RunFolder
from ..flight_input import Asked, FlightInput, Plan
from ..inflow import InflowModel, trim_model
from ..interruption import asked, deferred
from ..progress import Progress, Silent
from ..recorder import Recorder
from ..snapshot import Snapshot
from ..stepping import Instant
from ..transfer import carried
from ..trim import Trim
from .messages import Message
from .pace import Pace
from .picture import Painter, Shown

FRAMES = 40.0
"""Pictures a second of the wall clock."""
REMEMBERED = 1000
"""Exchanges whose times are told of."""
WAITING = 64
"""Orders that wait; more are not taken."""


@dataclass(frozen=True)
class Setup:
    """What is flown. models: inflow models that can be changed to in flight, by name; the first flies first.

    folder: where runs are kept, each in one of its own. height: of the start above the ground that is drawn [m]; the ground does
    not act on the flight, but ends it. control: between sticks and blades.
    """

    aircraft: Aircraft
    condition: FlightCondition
    models: Mapping[str, InflowModel]
    folder: Path
    control: Augmentation | None = None
    height: float = 150.0


class Session:
    """A cockpit's flying: `run` flies until the session is ended, other threads `say` and look at `shown`."""

    def __init__(
        self,
        setup: Setup,
        progress: Progress | Silent,
        publish: Callable[[Shown], None] = lambda _: None,
        pace: Pace | None = None,
    ):
        """publish: told of every new picture, in the thread that flies; it must not wait."""
        self.setup, self.progress, self.publish = setup, progress, publish
        self.shown: Shown | None = None
        self.runs: list[Path] = []
        """Folders of the runs that have been written."""
        self.sticks: tuple[float, ...] | None = None
        """Where the pilot's hands are, shares of travel; None: at trim."""
        self._orders: queue.Queue[Message] = queue.Queue(WAITING)
        self._told = threading.Event()
        self._pace = pace or Pace()
        self._trims: dict[str, Trim] = {}
        self._next: tuple[str, Future[FlyingByHand]] | None = None
        # trims and wakes for what may be flown next, and runs that have ended: one after the other
        self._ahead, self._keeper = ThreadPoolExecutor(1), ThreadPoolExecutor(1)
        self._kept: list[Future[None]] = []
        self._spent: deque[float] = deque(maxlen=REMEMBERED)
        self._count, self._version, self._due = 0, 0, 0.0
        self._paused, self._single, self._ended, self._show = True, 0, False, False
        self._note = ""
        self._name = next(iter(setup.models))
        self._flying: FlyingByHand | None = None

    # --- what other threads may call ----------------------------------------------------------------------------

    @property
    def models(self) -> tuple[str, ...]:
        """Names of the inflow models that can be changed to."""
        return tuple(self.setup.models)

    def say(self, message: Message) -> bool:
        """Where the sticks are, or an order; False where too many orders wait."""
        if message.sticks is not None:
            # what was meant for the run before is not for this one
            if message.run == self._count:
                self.sticks = message.sticks
            return True
        try:
            self._orders.put_nowait(message)
        except queue.Full:
            return False
        self._told.set()
        return True

    def prepare(self) -> None:
        """Find the trim; InputError and NumericalFailure as of `trim`."""
        self._standby(self._name)

    # --- the thread that flies ------------------------------------------------------------------------------------

    def run(self) -> None:
        """Fly until the session is ended, by the pilot or a signal; every run is kept."""
        try:
            with deferred():
                self._begin(self._ready(self._name), "space or the button begins")
                while not self._ended and asked() is None:
                    self._obey()
                    if self._flying is not None and (self._single or not self._paused):
                        self._advance(self._flying)
                    else:
                        self._told.wait(0.1)
                        self._told.clear()
                        self._pace.begin(0.0 if self._flying is None else self._flying.sim.t)
        finally:
            self._finish()
            self._tell("the session has ended; its runs are being written")
            self._ahead.shutdown(cancel_futures=True)
            self._keeper.shutdown()
        for each in self._kept:
            each.result()

    def _obey(self) -> None:
        """Do what was asked for."""
        with contextlib.suppress(queue.Empty):
            while True:
                message = self._orders.get_nowait()
                match message.do:
                    case "pause":
                        self._paused, self._single = True, 0
                        self._tell("paused")
                    case "fly":
                        self._paused = False
                        self._tell("")
                    case "step":
                        self._paused, self._single = True, self._single + 1
                    case "restart":
                        self._finish()
                        self.sticks, self._single, self._next = None, 0, None
                        self._begin(self._ready(self._name), "from the trim again")
                    case "end":
                        self._ended = True
                if message.inflow is not None and message.inflow != self._name:
                    self._ask_for(message.inflow)

    def _ask_for(self, name: str) -> None:
        """Prepare another inflow model beside the flight; the change comes at a whole revolution."""
        if self._next is None:
            self._next = name, self._ahead.submit(self._ready, name)
            self._tell(f"preparing {name}")

    def _standby(self, name: str) -> Trim:
        """The trim for an inflow model, found once."""
        if name not in self._trims:
            asked = Asked(self.setup.condition, trim_model(self.setup.models[name]))
            self._trims[name] = asked.trim(self.setup.aircraft, self.progress)
        return self._trims[name]

    def _ready(self, name: str) -> FlyingByHand:
        """A flight with an inflow model, its wake converged, that has not begun."""
        start = self._standby(name)
        plan = Plan(
            by_hand("cockpit", "flown by hand"),
            self.setup.models[name],
            integrator="fixed",
            control=self.setup.control,
            lattice=False,
        )
        given = FlightInput.of(self.setup.aircraft, Asked.of(start), plan)
        return FlyingByHand(start, given, Silent())

    def _begin(self, flying: FlyingByHand, note: str, moment: Snapshot | None = None) -> None:
        """A run begins in a folder of its own."""
        name = flying.sim.model.inflow.name
        folder = RunFolder(_numbered(self.setup.folder, name))
        flying.begin(folder, moment)
        self._count += 1
        self._flying, self._name = flying, name
        self._painter = Painter(flying, self._count, self.setup.height)
        self._opening = self._painter.opening()
        self._spent.clear()
        self._pace.begin(0.0)
        self._show = True
        self._note = note
        self._advance(flying)

    def _inches(self, flying: FlyingByHand) -> np.ndarray:
        """Where the sticks get to by the end of the next step [in about trim]: no faster than the aircraft's may move."""
        before = flying.inches
        if self.sticks is None:
            wanted = np.zeros(4) if flying.given.plan.begin is None else before
        else:
            wanted = np.array(self.sticks) * flying.travel_in - flying.trim_in
        limits = flying.start.aircraft.stick_rate_limit_in or flying.travel_in
        reach = np.asarray(limits) * flying.sim.delta_t * (1.0 - 1e-3)
        moved: np.ndarray = before + np.clip(wanted - before, -reach, reach)
        return moved

    def _advance(self, flying: FlyingByHand) -> None:
        """One exchange, its picture where one is due, and the wait until the next."""
        self._single = max(0, self._single - 1)
        clock = time.perf_counter()
        try:
            flying.step(self._inches(flying), self._seen)
        except NumericalFailure as reason:
            self._finish(str(reason))
            self._tell(f"the flight could not go on: {reason}")
            return
        self._spent.append(time.perf_counter() - clock)
        height = self.setup.height - float(flying.sim.y[12])
        if flying.exhausted or height <= 0.0:
            self._finish()
            self._tell(
                "on the ground: restart to fly again" if height <= 0.0 else "the run has its greatest length: restart"
            )
        elif self._next is not None and self._next[1].done():
            self._change(flying)
        elif not self._paused:
            self._pace.wait(flying.sim.t)

    def _change(self, flying: FlyingByHand) -> None:
        """Go on with the inflow model that was asked for, where a revolution ends."""
        assert self._next is not None, "a change has been asked for"
        if (flying.sim.steps + 1) % flying.sim.model.steps_per_revolution:
            self._pace.wait(flying.sim.t)
            return
        (name, prepared), self._next = self._next, None
        try:
            other = prepared.result()
        except WakeflightError as reason:
            self._tell(f"{name}: {reason}")
            return
        # hands stay where they are
        if self.sticks is None:
            self.sticks = tuple(((flying.trim_in + flying.inches) / flying.travel_in).tolist())
        fit = np.mean(self._painter.fits, axis=0)
        self._finish()
        if flying.failure is None:
            self._begin(other, f"{name} from here on", carried(flying.sim, other.sim, fit))
            self.progress(f"{name} goes on where {flying.folder.folder.name} ends")

    def _finish(self, failure: str | None = None) -> None:
        """The run ends here; it is written beside what comes."""
        flying, self._flying = self._flying, None
        if flying is None:
            return
        try:
            flying.land(failure)
        except StorageFailure as reason:
            # rows that reached the log are kept: the folder can be gone on with
            self.progress(f"warning: {reason}")
            return

        def kept() -> None:
            with flying.folder:
                flying.keep()
            assert flying.folder.saved is not None, "a run that has been kept"
            self.runs.append(flying.folder.saved)
            self.progress(f"wrote {flying.folder.saved}")

        self._kept.append(self._keeper.submit(kept))

    # --- what is shown ----------------------------------------------------------------------------------------------

    def _seen(self, instant: Instant, recorder: Recorder) -> None:
        """An exchange begins: a picture where one is due."""
        self._painter.see(instant, recorder)
        now = time.perf_counter()
        if not (self._show or self._paused or now >= self._due):
            return
        self._due = max(self._due + 1.0 / FRAMES, now - 1.0 / FRAMES)
        self._show = False
        pace = self._pace.factor
        frame = self._painter.frame(instant, recorder, pace, np.array(self._spent))
        self._publish(frame)

    def _tell(self, note: str) -> None:
        """Something is to be said."""
        self._note = note
        if self.shown is not None:
            self._publish(self.shown.frame)

    def _publish(self, frame: bytes) -> None:
        self._version += 1
        self.shown = Shown(self._count, self._opening, self._version, self._status(), frame)
        self.publish(self.shown)

    def _status(self) -> str:
        """What has changed since the run began: JSON."""
        flying = self._flying
        told = {
            "state": "ended" if flying is None else "paused" if self._paused else "flying",
            "note": self._note,
            "inflow": self._name,
            "models": list(self.models),
            "preparing": None if self._next is None else self._next[0],
            "folder": "" if flying is None else str(flying.folder.folder),
            "kept": [str(each.parent.name) for each in self.runs],
        }
        return json.dumps({"status": told}, allow_nan=False)


def _numbered(folder: Path, name: str) -> Path:
    """The next folder for a run: 01-dynamic, 02-time-marching ..."""
    taken = [int(found[1]) for each in folder.glob("*") if (found := re.match(r"(\d+)-", each.name))]
    return folder / f"{max(taken, default=0) + 1:02d}-{name}"


def height_of(value: float) -> float:
    """A height above the drawn ground [m] that can be flown at."""
    if not (math.isfinite(value) and 1.0 <= value <= 20000.0):
        raise InputError.of("ground", f"{value:g} m", "must lie between 1 and 20000 m below the start")
    return value
