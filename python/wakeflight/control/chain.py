# SPDX-License-Identifier: MIT OR Apache-2.0
"""The chain from the stick to the blades in a flight: stick, parallel, series within its authority, mixing, servos.

Controllers look where a coupling step begins, or at their own times, where the solver stops. What they answer is held until they
look again, exactly; servos are advanced exactly under it, and reach the core as the straight line between where they are at the
two ends of a piece.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .._core import ControlChain
from ..errors import InputError, NumericalFailure, WakeflightError, one_line, said
from ..sticks import INCH, STICKS, Added, Ramp, StickPath
from . import gains
from .augmentation import Augmentation
from .controller import Controller, inches
from .sensors import Sensors
from .servos import PITCH, mounted
from .start import Start
from .state import packed, unpacked

SAME = 1e-9
"""Times [s] nearer than this are one."""

Sense = Callable[[], Sensors]


class Member:
    """A controller in a flight: the copy that is flown, its times, its answer."""

    def __init__(self, controller: Controller, start: Start):
        try:
            self.controller = copy.deepcopy(controller)
            self.controller.reset(start)
        except WakeflightError:
            raise
        except Exception as reason:
            raise InputError.of("control", controller.name, f"its reset raised {said(reason)}") from reason
        self.called = self.controller.check()
        declared = self.controller.outputs
        self.outputs = (declared,) if isinstance(declared, str) else tuple(declared)
        self.feedback = self.controller.feedback()
        self.count = 0

    def due(self, t: float, begins: bool) -> bool:
        """Whether it is asked at `t`; begins: a coupling step begins there."""
        return begins if self.called is None else self.count / self.called <= t + SAME

    def times(self, t0: float, t1: float) -> list[float]:
        """When it is asked within t0..t1, the ends left out."""
        if self.called is None:
            return []
        first = math.floor((t0 + SAME) * self.called) + 1
        last = math.ceil((t1 - SAME) * self.called)
        return [k / self.called for k in range(first, last)]

    def asked(self, t: float) -> None:
        """It is asked at `t`."""
        if self.called is not None:
            self.count = math.floor((t + SAME) * self.called) + 1

    def answer(self, t: float, sensors: Sensors, stick: dict[str, float]) -> tuple[list[float], list[bool]]:
        """Inches (4,) at `t`, and on which sticks limits of its own held it; whatever is wrong with it ends the flight there."""
        try:
            found = inches(self.controller.step(t, sensors, stick), self.outputs)
            saturated = self.controller.saturated
        except Exception as reason:
            what = str(reason) if isinstance(reason, WakeflightError) else said(reason)
            raise self.failure(t, one_line(what)) from reason
        return found, [name in saturated for name in STICKS]

    def failure(self, t: float, what: str) -> NumericalFailure:
        """What is wrong with it."""
        return NumericalFailure(f"controller {self.controller.name} at t = {t:.4f} s: {what}")

    @property
    def acts(self) -> str:
        """How the core counts it."""
        if self.controller.acts == "parallel":
            return "parallel"
        return "own" if self.controller.own_authority else "series"

    def memory(self) -> dict[str, Any]:
        """What it depends on."""
        return {"state": self.controller.state(), "count": self.count}

    def recall(self, memory: dict[str, Any]) -> None:
        """Go on from what `memory` gave."""
        self.controller.restore(memory["state"])
        self.count = memory["count"]


class Chain:
    """Controllers and servos of a flight that begins from `start`; `sticks` of the pilot go in, those of the blades come out."""

    def __init__(self, made: Augmentation, start: Start):
        self.members = [Member(each, start) for each in made.controllers]
        self._rated = [member for member in self.members if member.called is not None]
        self._measured = any(member.feedback.measures for member in self.members if member.feedback is not None)
        travel = list(start.aircraft.stick_travel_in)
        own = [full / scale for full, scale in zip(travel, made.scale, strict=True)]
        limit = gains.authority("control.authority", made.authority, own)
        self.trim = start.stick_si
        self.trimmed = self.trim.tolist()
        servos = None
        if made.actuators is not None:
            rigging = start.model.data["rigging"]
            offset, matrix = np.asarray(rigging["offset"]), np.asarray(rigging["matrix"])
            servos = mounted(made.actuators, offset, matrix, self.trim)  # type: ignore[arg-type]
        self.has_servos = servos is not None
        members = [(member.feedback, member.acts) for member in self.members]
        self.core = ControlChain(members, (limit, made.scale, travel), servos, self.trim)
        self.hands = self.pilot = self.trim

    def pieces(self, sticks: StickPath, t0: float, t1: float) -> list[tuple[float, float]]:
        """The interval t0..t1 cut where a stick has a corner and where a controller is asked."""
        whole = sticks.pieces(t0, t1)
        if not self._rated:
            return whole
        found: list[tuple[float, float]] = []
        for a, b in whole:
            times = sorted({time for member in self._rated for time in member.times(a, b)})
            inner = [time for k, time in enumerate(times) if k == 0 or time > times[k - 1] + SAME]
            ends = [a, *inner, b]
            found += zip(ends[:-1], ends[1:], strict=True)
        return found

    def path(self, sticks: StickPath, piece: tuple[float, float], begins: bool, sense: Sense) -> StickPath:
        """Sticks that reach the blades over `piece`; begins: a coupling step begins with it. sense: what controllers may know."""
        t0, t1 = piece
        hands, self.hands = sticks.at(t0), sticks.at(t1)
        due = [k for k, member in enumerate(self.members) if member.due(t0, begins)]
        if due:
            self._ask(t0, due, hands, sense())
        self.pilot, before, after = self.core.advance(hands, self.hands, t1 - t0)
        if self.has_servos:
            return Ramp(t0, t1, before, after)
        return Added(sticks, self.core.offset, {t0: before, t1: after})

    def _ask(self, t: float, due: list[int], hands: np.ndarray, sensors: Sensors) -> None:
        """All that are due at `t`: blocks in the core, the others one by one."""
        stick: dict[str, float] = {}
        for k in due:
            member = self.members[k]
            member.asked(t)
            if member.feedback is None:
                if not stick:
                    about_trim = zip(STICKS, hands.tolist(), self.trimmed, strict=True)
                    stick = {name: (at - rest) / INCH for name, at, rest in about_trim}
                self.core.answered(k, *member.answer(t, sensors, stick))
        failed = self.core.ask(t, due, sensors, sensors.ay if self._measured else 0.0)
        if failed is not None:
            raise self.members[failed].failure(t, "its answer is not finite")

    def rest(self, sticks: StickPath, t: float) -> StickPath:
        """Sticks that reach the blades at `t`, where the flight ends."""
        self.pilot = sticks.at(t) + INCH * self.core.parallel
        if not self.has_servos:
            return Added(sticks, self.core.offset)
        return Ramp(t, t + 1.0, self.reached, self.reached)

    @property
    def series(self) -> np.ndarray:
        """Inches added in series (4,)."""
        return self.core.series

    @property
    def reached(self) -> np.ndarray:
        """Sticks that stand for where the blades have been put (4,) [m]."""
        return self.core.reached

    def memory(self) -> bytes:
        """Everything that what comes depends on; refuses a controller that holds what cannot be kept."""
        kept: dict[str, Any] = {"hands": self.hands, "pilot": self.pilot}
        kept["chain"] = np.frombuffer(self.core.memory(), np.uint8)
        for k, member in enumerate(self.members):
            kept[f"member {k}"] = member.memory()
        try:
            return packed(kept)
        except ValueError as reason:
            names = ", ".join(member.controller.name for member in self.members)
            text = f"cannot be kept: {reason}; or give the controller state() and restore(state)"
            raise InputError.of("snapshot of control", names, text) from reason

    def recall(self, block: bytes) -> None:
        """Go on from what `memory` gave."""
        kept = unpacked(block)
        self.hands, self.pilot = kept["hands"], kept["pilot"]
        self.core.recall(bytes(kept["chain"]))
        for k, member in enumerate(self.members):
            member.recall(kept[f"member {k}"])

    def counted(self) -> dict[str, dict[str, float]]:
        """Seconds that limits held the chain, by stick or blade pitch."""
        names = {"sas_saturated": STICKS, "actuator_rate_limited": PITCH, "actuator_at_stop": PITCH}
        told = zip(names.items(), self.core.seconds, strict=True)
        found = {name: dict(zip(each, seconds, strict=True)) for (name, each), seconds in told}
        return found if self.has_servos else {"sas_saturated": found["sas_saturated"]}
