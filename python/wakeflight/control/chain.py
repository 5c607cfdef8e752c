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

from ..errors import InputError, NumericalFailure, WakeflightError, one_line
from ..sticks import INCH, STICKS, Added, Ramp, StickPath
from . import gains
from .augmentation import Augmentation
from .controller import Controller, inches
from .sensors import Sensors
from .servos import PITCH, Moving
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
            raise InputError.of("control", controller.name, f"its reset raised {_said(reason)}") from reason
        self.called = self.controller.check()
        declared = self.controller.outputs
        self.outputs = (declared,) if isinstance(declared, str) else tuple(declared)
        self.count = 0
        self.answer = np.zeros(4)

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

    def ask(self, t: float, sensors: Sensors, stick: dict[str, float]) -> None:
        """Its answer at `t`; whatever is wrong with it ends the flight there."""
        if self.called is not None:
            self.count = math.floor((t + SAME) * self.called) + 1
        try:
            self.answer = inches(self.controller.step(t, sensors, stick), self.outputs)
        except Exception as reason:
            what = str(reason) if isinstance(reason, WakeflightError) else _said(reason)
            text = f"controller {self.controller.name} at t = {t:.4f} s: {one_line(what)}"
            raise NumericalFailure(text) from reason

    def memory(self) -> dict[str, Any]:
        """What it depends on."""
        return {"state": self.controller.state(), "count": self.count, "answer": self.answer}

    def recall(self, memory: dict[str, Any]) -> None:
        """Go on from what `memory` gave."""
        self.controller.restore(memory["state"])
        self.count, self.answer = memory["count"], memory["answer"]


class Chain:
    """Controllers and servos of a flight that begins from `start`; `sticks` of the pilot go in, those of the blades come out."""

    def __init__(self, made: Augmentation, start: Start):
        self.members = [Member(each, start) for each in made.controllers]
        self.scale = np.array(made.scale)
        self.travel = np.asarray(start.aircraft.stick_travel_in)
        self.limit = gains.authority("control.authority", made.authority, self.travel / self.scale)
        self.trim = start.stick_si
        rigging = start.model.data["rigging"]
        self.servos = None
        if made.actuators is not None:
            offset, matrix = np.asarray(rigging["offset"]), np.asarray(rigging["matrix"])
            self.servos = Moving(made.actuators, offset, matrix, self.trim)  # type: ignore[arg-type]
        self.series, self.parallel = np.zeros(4), np.zeros(4)
        self.hands = self.pilot = self.reached = self.trim
        self.seconds = {"sas_saturated": np.zeros(4)}
        if self.servos is not None:
            self.seconds |= {"actuator_rate_limited": np.zeros(4), "actuator_at_stop": np.zeros(4)}

    def pieces(self, sticks: StickPath, t0: float, t1: float) -> list[tuple[float, float]]:
        """The interval t0..t1 cut where a stick has a corner and where a controller is asked."""
        found: list[tuple[float, float]] = []
        for a, b in sticks.pieces(t0, t1):
            times = sorted({time for member in self.members for time in member.times(a, b)})
            inner = [time for k, time in enumerate(times) if k == 0 or time > times[k - 1] + SAME]
            ends = [a, *inner, b]
            found += zip(ends[:-1], ends[1:], strict=True)
        return found

    def path(self, sticks: StickPath, piece: tuple[float, float], begins: bool, sense: Sense) -> StickPath:
        """Sticks that reach the blades over `piece`; begins: a coupling step begins with it. sense: what controllers may know."""
        t0, t1 = piece
        due = [member for member in self.members if member.due(t0, begins)]
        hands = sticks.at(t0)
        if due:
            about_trim = ((hands - self.trim) / INCH).tolist()
            stick, sensors = dict(zip(STICKS, about_trim, strict=True)), sense()
            for member in due:
                member.ask(t0, sensors, stick)
        held = self._sum(hands)
        self.seconds["sas_saturated"] += (t1 - t0) * held
        offset = INCH * (self.parallel + self.series)
        self.pilot, self.hands = hands + INCH * self.parallel, sticks.at(t1)
        if self.servos is None:
            self.reached = self.hands + offset
            return Added(sticks, offset, {t0: hands + offset, t1: self.reached})
        before = self.reached
        self.reached, limited, stopped = self.servos.advance(hands + offset, self.hands + offset, t1 - t0)
        self.seconds["actuator_rate_limited"] += (t1 - t0) * limited
        self.seconds["actuator_at_stop"] += (t1 - t0) * stopped
        return Ramp(t0, t1, before, self.reached)

    def rest(self, sticks: StickPath, t: float) -> StickPath:
        """Sticks that reach the blades at `t`, where the flight ends."""
        self.pilot = sticks.at(t) + INCH * self.parallel
        if self.servos is None:
            return Added(sticks, INCH * (self.parallel + self.series))
        return Ramp(t, t + 1.0, self.reached, self.reached)

    def _sum(self, hands: np.ndarray) -> np.ndarray:
        """Inches of all in their order, kept in `parallel` and `series`; on which sticks a limit held them (4,)."""
        shared, own, parallel = np.zeros(4), np.zeros(4), np.zeros(4)
        held = np.zeros(4)
        for member in self.members:
            controller = member.controller
            if controller.acts == "parallel":
                parallel += member.answer
            elif controller.own_authority:
                own += member.answer
            else:
                shared += member.answer
            for name in controller.saturated:
                held[STICKS.index(name)] = 1.0
        within = np.minimum(np.maximum(shared, -self.limit), self.limit)
        held[within != shared] = 1.0
        self.series = self.scale * (within + own)
        # a parallel actuator takes the stick no further than its stops; where the hands have it already beyond, no further
        if parallel.any():
            at = hands / INCH
            moved = np.clip(at + self.scale * parallel, np.minimum(at, 0.0), np.maximum(at, self.travel))
            parallel = np.where(parallel == 0.0, 0.0, moved - at)
        self.parallel = parallel
        return held

    def memory(self) -> bytes:
        """Everything that what comes depends on; refuses a controller that holds what cannot be kept."""
        kept = {name: getattr(self, name) for name in ("series", "parallel", "hands", "pilot", "reached", "seconds")}
        kept["servos"] = None if self.servos is None else self.servos.at
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
        self.series, self.parallel, self.seconds = kept["series"], kept["parallel"], kept["seconds"]
        self.hands, self.pilot, self.reached = kept["hands"], kept["pilot"], kept["reached"]
        if self.servos is not None:
            self.servos.at = kept["servos"]
        for k, member in enumerate(self.members):
            member.recall(kept[f"member {k}"])

    def counted(self) -> dict[str, dict[str, float]]:
        """Seconds that limits held the chain, by stick or blade pitch."""
        names = {"sas_saturated": STICKS}
        return {
            name: {each: float(x) for each, x in zip(names.get(name, PITCH), values, strict=True)}
            for name, values in self.seconds.items()
        }


def _said(reason: Exception) -> str:
    """An error of a user's code in words."""
    return str(reason) if type(reason) is ValueError else f"{type(reason).__name__}: {reason}"
