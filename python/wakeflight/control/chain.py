# SPDX-License-Identifier: MIT OR Apache-2.0
"""The chain from the stick to the blades in a flight: stick, parallel, series within its authority, mixing, servos.

Controllers look where a coupling step begins, or at their own times, where the solver stops. What they answer is held until they
look again, exactly; servos are advanced exactly under it, and reach the core as the straight line between where they are at the
two ends of a piece.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Sequence
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
        self.answer = [0.0] * 4

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
        self.scale = list(made.scale)
        self.travel = list(start.aircraft.stick_travel_in)
        own = [travel / scale for travel, scale in zip(self.travel, self.scale, strict=True)]
        self.limit = gains.authority("control.authority", made.authority, own).tolist()
        self.trim = start.stick_si
        self.trimmed = self.trim.tolist()
        rigging = start.model.data["rigging"]
        self.servos = None
        if made.actuators is not None:
            offset, matrix = np.asarray(rigging["offset"]), np.asarray(rigging["matrix"])
            self.servos = Moving(made.actuators, offset, matrix, self.trim)  # type: ignore[arg-type]
        self.series, self.parallel = [0.0] * 4, [0.0] * 4
        self.hands = self.pilot = self.reached = self.trim
        self.seconds = {"sas_saturated": [0.0] * 4}
        if self.servos is not None:
            self.seconds |= {"actuator_rate_limited": [0.0] * 4, "actuator_at_stop": [0.0] * 4}

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
            about_trim = zip(STICKS, hands.tolist(), self.trimmed, strict=True)
            stick, sensors = {name: (at - rest) / INCH for name, at, rest in about_trim}, sense()
            for member in due:
                member.ask(t0, sensors, stick)
        self._count("sas_saturated", self._sum(hands), t1 - t0)
        offset = np.array([INCH * (moved + added) for moved, added in zip(self.parallel, self.series, strict=True)])
        self.pilot, self.hands = self._moved(hands), sticks.at(t1)
        if self.servos is None:
            self.reached = self.hands + offset
            return Added(sticks, offset, {t0: hands + offset, t1: self.reached})
        before = self.reached
        self.reached, limited, stopped = self.servos.advance(hands + offset, self.hands + offset, t1 - t0)
        self._count("actuator_rate_limited", limited, t1 - t0)
        self._count("actuator_at_stop", stopped, t1 - t0)
        return Ramp(t0, t1, before, self.reached)

    def rest(self, sticks: StickPath, t: float) -> StickPath:
        """Sticks that reach the blades at `t`, where the flight ends."""
        self.pilot = self._moved(sticks.at(t))
        if self.servos is None:
            return Added(sticks, INCH * (np.array(self.parallel) + np.array(self.series)))
        return Ramp(t, t + 1.0, self.reached, self.reached)

    def _moved(self, hands: np.ndarray) -> np.ndarray:
        """Sticks (4,) [m] where the hands have them, as the parallel actuators move them."""
        moved: np.ndarray = hands + INCH * np.array(self.parallel) if any(self.parallel) else hands
        return moved

    def _count(self, name: str, held: Sequence[float], seconds: float) -> None:
        """Seconds more for those that a limit held."""
        if any(held):
            spent = self.seconds[name]
            self.seconds[name] = [before + seconds * each for before, each in zip(spent, held, strict=True)]

    def _sum(self, hands: np.ndarray) -> list[float]:
        """Inches of all in their order, kept in `parallel` and `series`; on which sticks a limit held them (4,)."""
        # plain numbers: arrays of four would take three times as long, at every step
        shared, own, parallel = [0.0] * 4, [0.0] * 4, [0.0] * 4
        held = [0.0] * 4
        for member in self.members:
            controller = member.controller
            series = own if controller.own_authority else shared
            total = parallel if controller.acts == "parallel" else series
            for k, inches_of in enumerate(member.answer):
                total[k] += inches_of
            for name in controller.saturated:
                held[STICKS.index(name)] = 1.0
        for k, (limit, scale) in enumerate(zip(self.limit, self.scale, strict=True)):
            within = min(limit, max(-limit, shared[k]))
            if within != shared[k]:
                held[k] = 1.0
            self.series[k] = scale * (within + own[k])
        # a parallel actuator takes the stick no further than its stops; where the hands have it already beyond, no further
        if any(parallel):
            for k, at in enumerate((hands / INCH).tolist()):
                if parallel[k] != 0.0:
                    low, high = min(at, 0.0), max(at, self.travel[k])
                    parallel[k] = min(high, max(low, at + self.scale[k] * parallel[k])) - at
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
        self.series, self.parallel, self.seconds = list(kept["series"]), list(kept["parallel"]), kept["seconds"]
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
