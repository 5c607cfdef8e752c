# SPDX-License-Identifier: MIT OR Apache-2.0
"""Generic blocks of stability augmentation and autopilot, from textbooks: structures, no numbers of any aircraft."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from ..errors import InputError
from ..sticks import STICKS
from ..units import STANDARD_GRAVITY, quantity
from . import gains
from .controller import Controller
from .filters import Smoothed
from .sensors import Sensors
from .start import Start


@dataclass(frozen=True)
class Term:
    """One feedback: `argument` names its gain, which goes with `sign` times the signal to `stick`.

    unit: of the gain, SI with the stick in metres. angle: the signal is an angle, and its deviation counted the short way round.
    """

    argument: str
    stick: str
    unit: str
    signal: Callable[[Sensors], float]
    sign: float = -1.0
    angle: bool = False


class Block(Controller):
    """Feedback of signals, as they differ from where the flight began, within an authority.

    Signals are taken as straight between two calls, filters are advanced exactly for that, answers are held until the next call.
    """

    terms: ClassVar[tuple[Term, ...]] = ()
    rate: str | None

    def _make(
        self,
        given: Mapping[str, str | None],
        authority: str | None,
        rate: str | None,
        acts: str,
        lag: str | None = None,
        washout: str | None = None,
    ) -> None:
        """Read and check what a block was made with."""
        self.given = {**given, "authority": authority, "lag": lag, "washout": washout}
        self.rate, self.acts = rate, acts
        sizes = [gains.gain(f"{self.name}.{t.argument}", given[t.argument], t.unit) for t in self.terms]
        self.sizes = {k: size for k, size in enumerate(sizes) if size != 0.0}
        if not self.sizes:
            names = ", ".join(term.argument for term in self.terms)
            raise InputError.of(self.name, "no gain", f"needs at least one of {names}")
        self.outputs = tuple(name for name in STICKS if any(self.terms[k].stick == name for k in self.sizes))
        self.constants = (
            gains.seconds(f"{self.name}.lag", lag),
            gains.seconds(f"{self.name}.washout", washout),
        )
        self._limit((10.0,) * 4)
        self._forget()

    def _limit(self, travel: Sequence[float]) -> None:
        """The authority in inches of sticks with a `travel` (4,) [in]."""
        limits = gains.authority(f"{self.name}.authority", self.given["authority"], travel).tolist()
        self.limits = dict(zip(STICKS, limits, strict=True))

    def _forget(self) -> None:
        self.t: float | None = None
        self.reference: list[float] = []
        self.begun = 0.0
        self.filters = [Smoothed(*self.constants) for _ in self.sizes]
        self.held: tuple[str, ...] = ()
        terms = [(self.terms[k], size) for k, size in self.sizes.items()]
        self.fed = [
            (term.stick, term.sign * size, term.angle, smooth)
            for (term, size), smooth in zip(terms, self.filters, strict=True)
        ]

    def reset(self, start: Start) -> None:
        """At rest; the authority in inches of this aircraft."""
        self._limit(start.aircraft.stick_travel_in)
        self._forget()

    def step(self, t: float, sensors: Sensors, stick: Mapping[str, float]) -> dict[str, float]:
        """Inches by stick."""
        terms = self.terms
        signals = [terms[k].signal(sensors) for k in self.sizes]
        if self.t is None:
            self.t = self.begun = t
            self.reference = signals
        dt, self.t = t - self.t, t
        moved = dict.fromkeys(self.outputs, 0.0)
        share = self.share(sensors)
        changes = [signal - rest for signal, rest in zip(signals, self.reference, strict=True)]
        for (name, size, angle, smooth), change in zip(self.fed, self.counted(changes), strict=True):
            if angle:
                change = math.remainder(change, 2.0 * math.pi)
            moved[name] += size * share * smooth.advance(change, dt)
        return self.within(moved)

    def share(self, sensors: Sensors) -> float:
        """Share of all gains that counts at this moment."""
        return 1.0

    def counted(self, changes: list[float]) -> list[float]:
        """What counts of the changes of the signals since the beginning."""
        return changes

    def within(self, moved: dict[str, float]) -> dict[str, float]:
        """Within the authority; keeps which sticks were held back."""
        limits = self.limits
        self.held = tuple([name for name, inches in moved.items() if abs(inches) > limits[name]])
        return {name: min(limits[name], max(-limits[name], inches)) for name, inches in moved.items()}

    @property
    def saturated(self) -> tuple[str, ...]:
        """Sticks that the authority held back in the last call."""
        return self.held

    def state(self) -> dict[str, Any]:
        """Time of the last call, signals of the beginning, filters."""
        memory = [smooth.memory for smooth in self.filters]
        return {"t": self.t, "begun": self.begun, "reference": self.reference, "filters": memory, "held": self.held}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        self.t, self.begun, self.reference, self.held = (state[name] for name in ("t", "begun", "reference", "held"))
        for smooth, memory in zip(self.filters, state["filters"], strict=True):
            smooth.memory = memory

    def described(self) -> dict[str, Any]:
        """What it was made with."""
        return super().described() | {name: text for name, text in self.given.items() if text is not None}

    def __repr__(self) -> str:
        """As it was made."""
        given = ", ".join(f"{name}={text!r}" for name, text in self.given.items() if text is not None)
        return f"{self.name}({given})"

    def __eq__(self, other: object) -> bool:
        """By what it was made with."""
        return repr(self) == repr(other)

    def __hash__(self) -> int:
        """By what it was made with."""
        return hash(repr(self))


class RateDamping(Block):
    """Body rates against the sticks: lateral -roll p, longitudinal -pitch q, pedal -yaw r; a positive gain damps.

    roll, pitch, yaw: gains, `"0.10 in/(deg/s)"`. authority: most inches on each stick, `"1 in"` or `"10 %"` of its travel. lag:
    of the gyros, washout: time constant beyond which a steady rate no longer counts. rate: of a digital one, `"50 Hz"`. Rates are
    counted from those of the trim: in a steady turn it rests.
    """

    terms = (
        Term("roll", "lateral", "m s/rad", lambda s: s.p),
        Term("pitch", "longitudinal", "m s/rad", lambda s: s.q),
        Term("yaw", "pedal", "m s/rad", lambda s: s.r),
    )

    def __init__(
        self,
        roll: str | None = None,
        pitch: str | None = None,
        yaw: str | None = None,
        authority: str | None = None,
        lag: str | None = None,
        washout: str | None = None,
        rate: str | None = None,
        acts: str = "series",
    ):
        self._make({"roll": roll, "pitch": pitch, "yaw": yaw}, authority, rate, acts, lag, washout)


class AttitudeHold(Block):
    """Attitude, and rates, held at those of the trim: longitudinal -pitch (theta - theta_trim) - pitch_rate q, and so on.

    roll, pitch, heading: gains, `"5 in/rad"`; roll_rate, pitch_rate, yaw_rate: `"3 in/(rad/s)"`; pitch goes to the longitudinal
    stick, roll to the lateral, heading to the pedals. authority, lag, rate: as for `RateDamping`, of their sum.
    """

    terms = (
        Term("roll", "lateral", "m/rad", lambda s: s.roll, angle=True),
        Term("roll_rate", "lateral", "m s/rad", lambda s: s.p),
        Term("pitch", "longitudinal", "m/rad", lambda s: s.pitch),
        Term("pitch_rate", "longitudinal", "m s/rad", lambda s: s.q),
        Term("heading", "pedal", "m/rad", lambda s: s.yaw, angle=True),
        Term("yaw_rate", "pedal", "m s/rad", lambda s: s.r),
    )

    def __init__(
        self,
        roll: str | None = None,
        pitch: str | None = None,
        heading: str | None = None,
        roll_rate: str | None = None,
        pitch_rate: str | None = None,
        yaw_rate: str | None = None,
        authority: str | None = None,
        lag: str | None = None,
        rate: str | None = None,
        acts: str = "series",
    ):
        given = {"roll": roll, "pitch": pitch, "heading": heading}
        given |= {"roll_rate": roll_rate, "pitch_rate": pitch_rate, "yaw_rate": yaw_rate}
        self._make(given, authority, rate, acts, lag)


SLOWEST_TURN = 10.0
"""Airspeed [m/s] below which the rate of a coordinated turn, g tan(bank)/V, is taken as there: it grows without bound."""


def turning(s: Sensors) -> float:
    """Yaw rate beyond that of a coordinated turn at this bank, r - g sin(roll) cos(pitch)/V [rad/s]."""
    coordinated = STANDARD_GRAVITY * math.sin(s.roll) * math.cos(s.pitch) / max(s.airspeed, SLOWEST_TURN)
    return float(s.r - coordinated)


class TurnCoordination(Block):
    """Pedals that keep the ball in the middle, above a speed: sideslip beta - lateral_acceleration a_y - yaw_rate (r - r_turn).

    sideslip: `"5 in/rad"`, nose into the wind; lateral_acceleration: `"0.1 in/(m/s2)"`; yaw_rate: `"2 in/(rad/s)"`, against that
    of a coordinated turn, g sin phi/V. above: airspeed from which it works, fully 10 kt faster, `"50 kt"` by default.
    authority, lag, washout, rate: as for `RateDamping`.
    """

    terms = (
        Term("sideslip", "pedal", "m/rad", lambda s: s.sideslip, sign=1.0, angle=True),
        Term("lateral_acceleration", "pedal", "s2", lambda s: s.ay),
        Term("yaw_rate", "pedal", "m s/rad", turning),
    )

    def __init__(
        self,
        sideslip: str | None = None,
        lateral_acceleration: str | None = None,
        yaw_rate: str | None = None,
        above: str = "50 kt",
        authority: str | None = None,
        lag: str | None = None,
        washout: str | None = None,
        rate: str | None = None,
        acts: str = "series",
    ):
        given = {"sideslip": sideslip, "lateral_acceleration": lateral_acceleration, "yaw_rate": yaw_rate}
        self._make(given, authority, rate, acts, lag, washout)
        self.given["above"] = above
        self.above = quantity(above, "m/s", f"{self.name}.above")
        self.full = self.above + quantity("10 kt", "m/s", "above")

    def share(self, sensors: Sensors) -> float:
        """From none at the speed to all 10 kt beyond it."""
        return min(1.0, max(0.0, (sensors.airspeed - self.above) / (self.full - self.above)))


class AltitudeHold(Block):
    """Collective that holds the path of the trim, h_0 + h_dot_0 t: -altitude (h - path) - climb_rate (h_dot - h_dot_0).

    altitude: `"0.05 in/ft"`, climb_rate: `"0.05 in/(ft/s)"`. authority, lag, rate: as for `RateDamping`. acts: `parallel` by
    default, it moves the stick itself.
    """

    terms = (
        Term("altitude", "collective", "1", lambda s: s.altitude),
        Term("climb_rate", "collective", "s", lambda s: s.climb_rate),
    )

    def __init__(
        self,
        altitude: str | None = None,
        climb_rate: str | None = None,
        authority: str | None = None,
        lag: str | None = None,
        rate: str | None = None,
        acts: str = "parallel",
    ):
        self.climb = 0.0
        self._make({"altitude": altitude, "climb_rate": climb_rate}, authority, rate, acts, lag)

    def step(self, t: float, sensors: Sensors, stick: Mapping[str, float]) -> dict[str, float]:
        """Inches by stick."""
        if self.t is None:
            self.climb = sensors.climb_rate
        self.ahead = self.climb * (t - (t if self.t is None else self.begun))
        return super().step(t, sensors, stick)

    def counted(self, changes: list[float]) -> list[float]:
        """The altitude against the path."""
        first, *others = changes
        return [first - self.ahead if 0 in self.sizes else first, *others]

    def state(self) -> dict[str, Any]:
        """With the climb rate of the path."""
        return super().state() | {"climb": self.climb}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        super().restore(state)
        self.climb = state["climb"]
