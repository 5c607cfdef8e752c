# SPDX-License-Identifier: MIT OR Apache-2.0
"""A pilot who follows a path: bank, load factor, speed and climb rate by time, flown by integrators on what is missing.

Flight tests give what an aircraft did, seldom what its sticks did. Each stick closes a rate loop with an integrator; what is
asked of the rates follows from the path by the kinematics of flight, n_z = V q/g + cos(theta) cos(phi) and
r = g sin(phi) cos(theta)/V.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ..arguments import checked
from ..errors import InputError
from ..sticks import STICKS
from ..units import STANDARD_GRAVITY, number, quantity
from .controller import Controller
from .sensors import Sensors
from .start import Start

ASKED = {"bank": "rad", "load_factor": "", "speed": "m/s", "climb_rate": "m/s"}
"""What a path may hold, and its SI unit."""

SLOWEST_TURN = 10.0
"""Airspeed [m/s] below which the rate of a coordinated turn, g tan(bank)/V, is taken as there: it grows without bound."""

History = Sequence[tuple[str, Any]]


@dataclass(frozen=True)
class Hands:
    """Gains of the pilot, generic: they suit helicopters of the UH-60A's and the BO 105's kind.

    roll, pitch, yaw [in per rad/s], heave [in per m/s]: stick for a rate that is missing; slow: share of it that grows with every
    second it is missing [1/s]. bank, attitude: rate asked for per angle that is missing [1/s]. accelerating: pitch per speed that
    is missing [rad per m/s]. loading: load factor more asked for per load factor that is missing, every second [1/s]. ball: pedal
    per lateral acceleration [in per m/s2].
    """

    roll: float = 3.0
    pitch: float = 8.0
    yaw: float = 4.0
    heave: float = 0.3
    slow: float = 1.5
    bank: float = 2.0
    attitude: float = 1.0
    accelerating: float = 0.03
    loading: float = 2.0
    ball: float = 0.1

    def __post_init__(self) -> None:
        """Check every gain."""
        for each in fields(self):
            number(f"hands.{each.name}", vars(self)[each.name], 0.0, 100.0)


class Follow(Controller):
    """Moves the sticks, as a pilot does, so that the aircraft follows histories of bank, load factor or speed, and climb rate."""

    acts = "parallel"

    def __init__(self, path: Mapping[str, tuple[np.ndarray, np.ndarray]], hands: Hands, rate: str | None):
        self.path, self.hands, self.rate = dict(path), hands, rate
        moved = {"lateral", "longitudinal", "pedal"} | ({"collective"} if "climb_rate" in path else set())
        self.outputs = tuple(name for name in STICKS if name in moved)
        self._forget()

    def _forget(self) -> None:
        self.t: float | None = None
        self.rest: dict[str, float] = {}
        self.sums = dict.fromkeys((*STICKS, "load_factor", "speed"), 0.0)

    def reset(self, start: Start) -> None:
        """At rest in the trim."""
        self._forget()

    def step(self, t: float, sensors: Sensors, stick: Mapping[str, float]) -> dict[str, float]:
        """Inches by stick."""
        s, hands = sensors, self.hands
        if self.t is None:
            self.t = t
            self.rest = {
                "roll": s.roll,
                "pitch": s.pitch,
                "airspeed": s.airspeed,
                "climb_rate": s.climb_rate,
                "ay": s.ay,
            }
        dt, self.t = t - self.t, t
        speed = max(s.airspeed, SLOWEST_TURN)
        bank, turning = self._asked("bank", t, self.rest["roll"])
        roll_rate = turning + hands.bank * math.remainder(bank - s.roll, 2.0 * math.pi)
        yaw_rate = STANDARD_GRAVITY * math.sin(s.roll) * math.cos(s.pitch) / speed
        moved = {
            "lateral": self._close("lateral", hands.roll, roll_rate - s.p, dt),
            "longitudinal": self._close("longitudinal", hands.pitch, self._pitch_rate(t, dt, s, speed) - s.q, dt),
            "pedal": self._close("pedal", hands.yaw, yaw_rate - s.r, dt) - hands.ball * (s.ay - self.rest["ay"]),
        }
        if "climb_rate" in self.path:
            climb, _ = self._asked("climb_rate", t, 0.0)
            moved["collective"] = self._close("collective", hands.heave, climb - s.climb_rate, dt)
        return moved

    def _pitch_rate(self, t: float, dt: float, s: Sensors, speed: float) -> float:
        """Pitch rate that is asked for [rad/s]."""
        hands = self.hands
        if "load_factor" in self.path:
            asked, _ = self._asked("load_factor", t, 1.0)
            self.sums["load_factor"] += dt * hands.loading * (asked - s.load_factor)
            pulled = asked + self.sums["load_factor"] - math.cos(s.pitch) * math.cos(s.roll)
            return STANDARD_GRAVITY / speed * pulled
        wanted, _ = self._asked("speed", t, self.rest["airspeed"])
        missing = wanted - s.airspeed
        self.sums["speed"] += dt * missing
        pitch = self.rest["pitch"] - hands.accelerating * (missing + 0.1 * hands.slow * self.sums["speed"])
        # in a turn the nose rises with r tan(phi)
        return float(hands.attitude * (pitch - s.pitch) + s.r * math.tan(max(-1.2, min(1.2, s.roll))))

    def _asked(self, name: str, t: float, rest: float) -> tuple[float, float]:
        """Value of the path and its slope at `t`; `rest` where it is not given."""
        if name not in self.path:
            return rest, 0.0
        times, values = self.path[name]
        piece = int(np.searchsorted(times, t, side="right")) - 1
        inside = 0 <= piece < len(times) - 1
        slope = (values[piece + 1] - values[piece]) / (times[piece + 1] - times[piece]) if inside else 0.0
        return float(np.interp(t, times, values)), float(slope)

    def _close(self, stick: str, gain: float, missing: float, dt: float) -> float:
        """Inches for a rate that is missing."""
        self.sums[stick] += dt * self.hands.slow * missing
        return gain * (missing + self.sums[stick])

    def state(self) -> dict[str, Any]:
        """Time of the last call, the beginning, the integrals."""
        return {"t": self.t, "rest": dict(self.rest), "sums": dict(self.sums)}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        self.t, self.rest, self.sums = state["t"], dict(state["rest"]), dict(state["sums"])

    def described(self) -> dict[str, Any]:
        """What it was made with."""
        path = {name: [times.tolist(), values.tolist()] for name, (times, values) in self.path.items()}
        return super().described() | {"path": path, "hands": vars(self.hands)}


@checked
def follow(
    bank: History | None = None,
    load_factor: History | None = None,
    speed: History | None = None,
    climb_rate: History | None = None,
    hands: Hands | None = None,
    rate: str | None = None,
) -> Follow:
    """A controller that flies a path given by what the aircraft does.

    bank: pairs such as `[("0 s", "0 deg"), ("2 s", "45 deg")]`, linear between them, steady after the last; load_factor: pairs of
    time and n_z, by the longitudinal stick; speed: pairs of time and airspeed, by the same stick, so one of the two; climb_rate:
    by the collective, which else stays. What is not given stays at trim: its bank, its speed; the ball in the middle.

    Gains are generic (`wf.Hands`): a bank that changes at 20 deg/s is followed 0.3 s late, a load factor about a second. How well
    is for the reader of the result to see: nothing is fitted, and a path that the aircraft cannot fly is not flown.
    """
    given = {"bank": bank, "load_factor": load_factor, "speed": speed, "climb_rate": climb_rate}
    path = {name: _history(name, pairs) for name, pairs in given.items() if pairs is not None}
    if not path:
        raise InputError.of("follow", "no history", f"needs at least one of {', '.join(ASKED)}")
    if load_factor is not None and speed is not None:
        raise InputError.of("follow", "load_factor and speed", "one of them: both are flown by the longitudinal stick")
    return Follow(path, Hands() if hands is None else hands, rate)


def _history(name: str, pairs: Any) -> tuple[np.ndarray, np.ndarray]:
    """Times [s] and values, SI, of a history."""
    unit = ASKED[name]
    example = '[("0 s", 1.0), ("1 s", 1.5)]' if not unit else '[("0 s", "..."), ("2 s", "...")] with units'
    if isinstance(pairs, str) or not isinstance(pairs, Sequence) or not pairs:
        raise InputError.of(name, pairs, f"must be pairs of time and value, {example}")
    times: list[float] = []
    values: list[float] = []
    for pair in pairs:
        if isinstance(pair, str) or not isinstance(pair, Sequence) or len(pair) != 2:
            raise InputError.of(name, pair, f"must be a pair of time and value, {example}")
        t = quantity(pair[0], "s", f"{name} time")
        if t < 0.0 or (times and not t > times[-1]):
            raise InputError.of(f"{name} time", pair[0], "must ascend strictly from 0 s")
        times.append(t)
        values.append(quantity(pair[1], unit, name) if unit else number(name, pair[1], -5.0, 10.0))
    return np.array(times), np.array(values)
