# SPDX-License-Identifier: MIT OR Apache-2.0
"""Speed of the main rotor in time, and the clock that equal steps of its azimuth make.

A coupling step is a step of azimuth: at a speed that changes its duration does. Whatever is counted without dimension (inflow,
thrust coefficient, blade modes) is counted at the nominal speed, that of the trim.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeVar

import numpy as np

from .errors import InputError
from .units import number, quantity

CONSTANT = "constant"
"""Name of the speed that stays, relative to the airframe."""

OVER_GROUND = "constant-over-ground"
"""Name of the speed that stays in inertial space, whatever the airframe does about the shaft."""

SHARES = (0.5, 1.25)
"""Least and most of the nominal speed that a history may ask for."""

ROUNDING = 1e-9
"""Times [s] nearer than this are one."""

Corners = tuple[tuple[float, float], ...]
"""Time [s] and share of the nominal speed; none at constant speed."""

RotorSpeed = str | Sequence[tuple[Any, float]]
"""`constant`, `constant-over-ground`, or pairs of time, text with a unit, and share of the nominal speed."""

Time = TypeVar("Time", float, np.ndarray)


def history(given: Any) -> Corners:
    """Corners of a rotor speed: `constant`, or pairs (time as text with a unit, share of the nominal speed).

    Linear between the pairs, nominal before the first, which is 1, and steady after the last.
    """
    if isinstance(given, str) and given == CONSTANT:
        return ()
    form = 'must be constant or pairs (time, share of the nominal speed) such as [("0.5 s", 1.0), ("1.5 s", 0.95)]'
    if isinstance(given, str) or not isinstance(given, Sequence) or len(given) < 2:
        raise InputError.of("rotor_speed", given, form)
    corners: list[tuple[float, float]] = []
    for pair in given:
        if isinstance(pair, str) or not isinstance(pair, Sequence) or len(pair) != 2:
            raise InputError.of("rotor_speed", pair, form)
        t, share = quantity(pair[0], "s", "rotor_speed time"), number("rotor_speed", pair[1], *SHARES)
        if not 0.0 <= t < math.inf or (corners and not t > corners[-1][0] + ROUNDING):
            raise InputError.of("rotor_speed time", pair[0], "must ascend strictly from 0 s")
        corners.append((t, share))
    if corners[0][1] != 1.0:
        raise InputError.of("rotor_speed", corners[0][1], "must begin at 1: the trim is at the nominal speed")
    return tuple(corners)


def as_text(given: Any) -> Any:
    """A rotor speed as it may be written down: a name as it is, pairs with their times as text."""
    return given if isinstance(given, str) else tuple((f"{t!r} s", share) for t, share in history(given))


def unflown(corners: Corners, end: float) -> list[str]:
    """Warning about corners of a history after the end of the flight at `end` [s]."""
    last = max((t for t, _ in corners), default=0.0)
    if last <= end * (1.0 + 1e-9):
        return []
    return [f"rotor_speed: the flight ends at {end:.6g} s; corners up to {last:.6g} s are not flown"]


class Turning(Protocol):
    """What a clock asks of a compiled rotor."""

    def turned(self, t: float) -> float:
        """Angle [rad] by which the first blade has turned at `t` [s]."""

    def time(self, psi: float) -> float:
        """Time [s] at which it has turned by `psi` [rad]."""


class Clock(Protocol):
    """When the steps of a flight are."""

    def time(self, step: Time) -> Time:
        """Time [s] after `step` steps, whole or not."""

    def duration(self, step: int) -> float:
        """Length [s] of the step that begins after `step` steps."""

    def steps(self, step: int, seconds: float) -> float:
        """How many steps `seconds` [s] are from `step` on."""

    def cut(self, pieces: list[tuple[float, float]]) -> list[tuple[float, float]]:
        """Intervals of time cut where the rate of the speed jumps."""

    def own(self) -> Clock:
        """The clock of one flight: where it keeps something, a new one."""

    def reach(self, step: int, t: float, turn: tuple[float, float, float]) -> None:
        """A flight has reached `step` at `t` [s]; turn: azimuth [rad], speed [rad/s], its rate, of a free speed."""

    def memory(self) -> dict[str, Any]:
        """What it keeps."""

    def recall(self, memory: Mapping[str, Any]) -> None:
        """Go on from what it kept."""


class _Stateless:
    """A clock that keeps nothing: its times follow from the steps."""

    def own(self) -> Any:
        """Itself."""
        return self

    def reach(self, step: int, t: float, turn: tuple[float, float, float]) -> None:
        """Nothing to keep."""

    def memory(self) -> dict[str, Any]:
        """Nothing."""
        return {}

    def recall(self, memory: Mapping[str, Any]) -> None:
        """Nothing."""


@dataclass(frozen=True)
class SteadyClock(_Stateless):
    """Of a constant speed: times are steps times the length of one, never a sum."""

    delta_t: float

    def time(self, step: Time) -> Time:
        """Time [s] after `step` steps."""
        return step * self.delta_t

    def duration(self, step: int) -> float:
        """Length [s] of a step."""
        return self.delta_t

    def steps(self, step: int, seconds: float) -> float:
        """How many steps `seconds` [s] are."""
        return seconds / self.delta_t

    def cut(self, pieces: list[tuple[float, float]]) -> list[tuple[float, float]]:
        """The intervals as they are."""
        return pieces


class HistoryClock(_Stateless):
    """Of a speed that changes: the times at which `core` has turned by whole steps of `delta_psi` [rad]."""

    def __init__(self, core: Turning, delta_psi: float, corners: Corners):
        self.core, self.delta_psi = core, delta_psi
        self.corners = [t for t, _ in corners]

    def time(self, step: Time) -> Time:
        """Time [s] after `step` steps."""
        found: Any = np.array([self.core.time(psi) for psi in np.ravel(step) * self.delta_psi])
        told: Any = found if np.ndim(step) else float(found[0])
        return told  # type: ignore[no-any-return]  # a number or an array, as `step` is

    def duration(self, step: int) -> float:
        """Length [s] of the step that begins after `step` steps."""
        return self.time(step + 1) - self.time(step)

    def steps(self, step: int, seconds: float) -> float:
        """How many steps `seconds` [s] are from `step` on."""
        return self.core.turned(self.time(step) + seconds) / self.delta_psi - step

    def cut(self, pieces: list[tuple[float, float]]) -> list[tuple[float, float]]:
        """Intervals of time cut where the rate of the speed jumps."""
        found: list[tuple[float, float]] = []
        for t0, t1 in pieces:
            first = bisect_right(self.corners, t0 + ROUNDING)
            ends = [t0, *self.corners[first : bisect_left(self.corners, t1 - ROUNDING)], t1]
            found += zip(ends[:-1], ends[1:], strict=True)
        return found


class FreeClock:
    """Of a speed that is a state: a step lasts until the rotor, at the rate of its speed where the step begins, has turned by it.

    What that misses of a whole step, of third order in its length, the next one makes good: it is never a sum of errors.
    """

    def __init__(self, omega: float, delta_psi: float):
        self.delta_psi = delta_psi
        self._omega = omega
        self._step, self._t = 0, 0.0
        self._turn = (0.0, omega, 0.0)
        self._last = delta_psi / omega
        self._length: float | None = None

    def own(self) -> FreeClock:
        """A new one, at the start."""
        return FreeClock(self._omega, self.delta_psi)

    def reach(self, step: int, t: float, turn: tuple[float, float, float]) -> None:
        """Begin the step after `step` at `t`."""
        self._last, self._step, self._t, self._turn = t - self._t, step, t, turn
        self._length = None

    def _ahead(self) -> float:
        """Length of the step that begins [s], found once."""
        if self._length is not None:
            return self._length
        azimuth, omega, rate = self._turn
        left = (self._step + 1) * self.delta_psi - azimuth
        # the root that does not cancel
        squared = omega * omega + 2.0 * rate * left
        if not (omega > 0.0 and squared > 0.0 and left > 0.0):
            raise ArithmeticError(f"the rotor stops at t = {self._t:.4f} s: {omega:.4g} rad/s, {rate:.4g} rad/s2")
        self._length = length = 2.0 * left / (omega + math.sqrt(squared))
        return length

    def time(self, step: Time) -> Time:
        """Time [s] after `step` steps: exact for the present one and the next, beyond them at the present speed."""
        ahead = step - self._step
        match ahead:
            case int() if ahead in (0, 1):
                now: Any = self._t + self._ahead() if ahead else self._t
                return now  # type: ignore[no-any-return]  # a number, as `step` is
        return self._t + ahead * (self.delta_psi / self._turn[1])

    def duration(self, step: int) -> float:
        """Length [s] of the step that begins after `step` steps: of the present one or of the last."""
        return self._last if step < self._step else self._ahead()

    def steps(self, step: int, seconds: float) -> float:
        """How many steps `seconds` [s] are at the present speed."""
        return seconds * self._turn[1] / self.delta_psi

    def cut(self, pieces: list[tuple[float, float]]) -> list[tuple[float, float]]:
        """The intervals as they are."""
        return pieces

    def memory(self) -> dict[str, Any]:
        """Time, turn, length of the last step."""
        return {"time": self._t, "turn": list(self._turn), "last_step": self._last}

    def recall(self, memory: Mapping[str, Any]) -> None:
        """Go on from there."""
        azimuth, omega, rate = memory["turn"]
        self._step, self._t, self._last = memory["step"], memory["time"], memory["last_step"]
        self._turn = (azimuth, omega, rate)
        self._length = None


def clock_of(core: Turning, omega: float, steps_per_revolution: int, corners: Corners) -> Clock:
    """Clock of a rotor with the nominal speed `omega` [rad/s]."""
    if not corners:
        return SteadyClock(2 * np.pi / omega / steps_per_revolution)
    return HistoryClock(core, 2 * np.pi / steps_per_revolution, corners)


def shares(corners: Corners, t: np.ndarray) -> np.ndarray:
    """Share of the nominal speed at times `t` [s]."""
    if not corners:
        return np.ones(np.shape(t))
    times, values = np.array(corners).T
    found: np.ndarray = np.interp(t, times, values)
    return found
