# SPDX-License-Identifier: MIT OR Apache-2.0
"""What turns a rotor whose speed is a state: governed engines, a torque that stays, or engines of the user's own.

Azimuth and speed of the rotor are then in the state y; blades, tail rotor and accessories load it, an overrunning clutch lets
it turn faster than the engines drive it. See `crates/wakeflight/src/rotor/drive.rs` for the equations.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .errors import InputError, NumericalFailure, WakeflightError, one_line, said
from .rotor_speed import CONSTANT, OVER_GROUND, Corners, RotorSpeed, as_text, history
from .units import number, quantity


class Engine:
    """Engines coupled to the rotor: subclass it, and define `torque`.

    Called once for every coupling step, in order; the torque is held over it. What later torques depend on must come out of
    `memory` and go back by `recall`: a flight that is kept and continued does both.
    """

    governed = False
    """Whether the governor of the aircraft's file turns the rotor; `torque` is then not asked."""
    name = "engine"

    def begin(self, torque: float, rotor_speed: float) -> None:
        """A flight begins in balance: torque of the trim at the rotor's speed [N m], and that speed [rad/s]."""

    def torque(self, t: float, dt: float, rotor_speed: float, collective: float) -> float:
        """Torque at the speed of the rotor [N m] over the coupling step that begins at `t` [s] and lasts `dt` [s].

        rotor_speed: there [rad/s]; collective: stick [m from the stop]. Below zero the clutch lets go.
        """
        raise NotImplementedError(f"{type(self).__name__} must define torque(t, dt, rotor_speed, collective)")

    def fuel(self, t: float) -> float:
        """Share of the fuel that reaches governed engines over the coupling step that begins at `t` [s]."""
        return 1.0

    def memory(self) -> dict[str, Any]:
        """What the torques to come depend on besides what they are asked with: numbers, text, lists of them."""
        return {}

    def recall(self, memory: Mapping[str, Any]) -> None:
        """Go on from `memory`."""

    def given(self, t: float, dt: float, rotor_speed: float, collective: float) -> tuple[float, float]:
        """Torque [N m] and share of the fuel over a coupling step, checked."""
        if self.governed:
            return 0.0, self.fuel(t)
        try:
            torque = self.torque(t, dt, rotor_speed, collective)
        except WakeflightError:
            raise
        except Exception as reason:
            what = one_line(said(reason))
            raise NumericalFailure(f"torque of {type(self).__name__} at t = {t:.4f} s: {what}") from reason
        try:
            found = float(torque)
        except (TypeError, ValueError):
            found = math.nan
        if not math.isfinite(found):
            raise NumericalFailure(
                f"torque of {type(self).__name__} at t = {t:.4f} s is {torque!r}: must be finite, N m"
            )
        return found, 1.0

    def described(self) -> dict[str, Any]:
        """For the file of a run: the name it is made by again, and what it was made with."""
        return {"engine": self.name}

    def __str__(self) -> str:
        """For the configuration of a run."""
        return type(self).__name__


def _time(failure: Any) -> float:
    """When engines fail [s]: text with a unit; never where it is None."""
    if failure is None:
        return math.inf
    found = quantity(failure, "s", "failure")
    if found < 0.0:
        raise InputError.of("failure", failure, "must not be negative")
    return found


def _failing(failure: float) -> dict[str, str | None]:
    """When engines fail, as they are made with it."""
    return {"failure": None if math.isinf(failure) else f"{failure!r} s"}


class GovernedEngine(Engine):
    """Engines that a governor holds at the nominal speed, by the numbers of the aircraft's file [hilbert1984].

    failure: text, from the coupling step on in which no fuel reaches the engines but for the share `remaining` (0.5: one of two).
    Their power then goes with their lag.
    """

    governed = True
    name = "governed"

    def __init__(self, failure: str | None = None, remaining: float = 0.0):
        self.failure = _time(failure)
        self.remaining = number("remaining", remaining, 0.0, 1.0)

    def described(self) -> dict[str, Any]:
        """With its failure and what remains."""
        return {"engine": self.name, **_failing(self.failure), "remaining": self.remaining}

    def __str__(self) -> str:
        """With its failure."""
        return f"governed, failure {self.failure} s, remaining {self.remaining}"

    def fuel(self, t: float) -> float:
        """All of it, or what remains."""
        return self.remaining if t >= self.failure - 1e-9 else 1.0


class FreeEngine(Engine):
    """The torque of the trim, whatever the rotor does; none from the first coupling step at `failure` (text) or later."""

    name = "free"

    def __init__(self, failure: str | None = None):
        self.failure = _time(failure)
        self.trimmed = 0.0

    def described(self) -> dict[str, Any]:
        """With its failure."""
        return {"engine": self.name, **_failing(self.failure)}

    def __str__(self) -> str:
        """With its failure."""
        return f"free, failure {self.failure} s"

    def begin(self, torque: float, rotor_speed: float) -> None:
        """Keep the torque."""
        self.trimmed = torque

    def torque(self, t: float, dt: float, rotor_speed: float, collective: float) -> float:
        """That of the trim, or none."""
        return 0.0 if t >= self.failure - 1e-9 else self.trimmed


ENGINES = {"governed": GovernedEngine, "free": FreeEngine}
"""Engines by the names that `rotor_speed` takes."""

NAMES = (CONSTANT, OVER_GROUND, *ENGINES)
"""All names that it takes."""


@dataclass(frozen=True)
class Turning:
    """How a rotor turns in a flight: at a speed given by corners (none: constant), by an engine, or constant over the ground."""

    corners: Corners = ()
    engine: Engine | None = None
    over_ground: bool = False

    @property
    def name(self) -> str:
        """In words, for what belongs to a flight."""
        return str(self.engine or self.corners or (OVER_GROUND if self.over_ground else CONSTANT))


def turning(rotor_speed: RotorSpeed | Engine) -> Turning:
    """What `rotor_speed` says: a name, pairs (time, share of the nominal speed), or an engine."""
    match rotor_speed:
        case Engine():
            return Turning(engine=rotor_speed)
        case str() if rotor_speed in ENGINES:
            return Turning(engine=ENGINES[rotor_speed]())
        case str() if rotor_speed == OVER_GROUND:
            return Turning(over_ground=True)
        case str() if rotor_speed != CONSTANT:
            allowed = f"allowed: {', '.join(NAMES)}, pairs (time, share of the nominal speed), an Engine"
            raise InputError.of("rotor_speed", rotor_speed, allowed)
    return Turning(history(rotor_speed))


def planned(rotor_speed: Any) -> Any:
    """A rotor speed as the plan of a flight holds it: names and engines as they are, pairs with their times as text."""
    match rotor_speed:
        case Engine():
            return rotor_speed
    return as_text(rotor_speed)


def told(rotor_speed: Any) -> Any:
    """The same for a file: an engine by its name and what it was made with."""
    match rotor_speed:
        case Engine():
            return rotor_speed.described()
    return rotor_speed


def engine_of(described: Mapping[str, Any]) -> Engine:
    """The engine that `Engine.described` told of; one of a user's own is in no file."""
    given = dict(described)
    name = given.pop("engine")
    if name not in ENGINES:
        raise InputError.of("rotor_speed", name, f"an engine of your own is in no file; allowed: {', '.join(ENGINES)}")
    found: Engine = ENGINES[name](**given)
    return found
