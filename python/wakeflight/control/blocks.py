# SPDX-License-Identifier: MIT OR Apache-2.0
"""Generic blocks of stability augmentation and autopilot, from textbooks: structures, no numbers of any aircraft."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from .._core import Feedback
from ..errors import InputError
from ..sticks import STICKS
from ..units import quantity
from . import gains
from .controller import Controller
from .sensors import Sensors
from .start import Start


@dataclass(frozen=True)
class Term:
    """One feedback: `argument` names its gain, which goes with `sign` times the `signal` of that name to `stick`.

    unit: of the gain, SI with the stick in metres. angle: the signal is an angle, and its deviation counted the short way round.
    """

    argument: str
    stick: str
    unit: str
    signal: str
    sign: float = -1.0
    angle: bool = False


class Block(Controller):
    """Feedback of signals, as they differ from where the flight began, within an authority.

    Signals are taken as straight between two calls, filters are advanced exactly for that, answers are held until the next call.
    The core does it: a block is its data.
    """

    terms: ClassVar[tuple[Term, ...]] = ()
    along_path: ClassVar[bool] = False
    """Whether altitude counts from the straight path of the beginning."""
    works: tuple[float, float] | None = None
    """Airspeeds [m/s] from which it works, and works fully; None: always."""
    rate: str | None
    _law: Feedback | None

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
        lags = gains.seconds(f"{self.name}.lag", lag), gains.seconds(f"{self.name}.washout", washout)
        fast, slow = self.constants = lags
        # a lag and a washout are the difference of two lags, which would be none
        if fast is not None and slow is not None and abs(slow - fast) < 1e-6 * slow:
            raise InputError.of("lag", f"{fast:g} s", "must differ from the washout")
        self._limit((10.0,) * 4)

    def _limit(self, travel: Sequence[float]) -> None:
        """At rest, its authority in inches of sticks with a `travel` (4,) [in]."""
        self.limits = gains.authority(f"{self.name}.authority", self.given["authority"], travel).tolist()
        self._law = None

    @property
    def law(self) -> Feedback:
        """Feedback of the core with its memory, made where it is first asked for."""
        if self._law is None:
            terms = [
                (STICKS.index(term.stick), term.sign * size, term.signal, term.angle)
                for term, size in ((self.terms[k], size) for k, size in self.sizes.items())
            ]
            self._law = Feedback(terms, self.constants, self.works, self.along_path, self.limits)
        return self._law

    def feedback(self) -> Feedback | None:
        """Its law; of a class with a `step` of its own that is asked."""
        return self.law if type(self).step is Block.step else None

    def reset(self, start: Start) -> None:
        """At rest; the authority in inches of this aircraft."""
        self._limit(start.aircraft.stick_travel_in)

    def step(self, t: float, sensors: Sensors, stick: Mapping[str, float]) -> dict[str, float]:
        """Inches by stick."""
        inches = self.law.step(t, sensors, sensors.ay if self.law.measures else 0.0)
        return {name: inches[STICKS.index(name)] for name in self.outputs}

    @property
    def saturated(self) -> tuple[str, ...]:
        """Sticks that the authority held back in the last call."""
        return tuple(name for name, held in zip(STICKS, self.law.held, strict=True) if held)

    def state(self) -> dict[str, Any]:
        """Time of the last call, signals of the beginning, filters."""
        return {"law": np.frombuffer(self.law.memory(), np.uint8)}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        self.law.recall(bytes(state["law"]))

    def __getstate__(self) -> dict[str, Any]:
        """What it was made with: a copy is at rest."""
        return vars(self) | {"_law": None}

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
        Term("roll", "lateral", "m s/rad", "p"),
        Term("pitch", "longitudinal", "m s/rad", "q"),
        Term("yaw", "pedal", "m s/rad", "r"),
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
        Term("roll", "lateral", "m/rad", "roll", angle=True),
        Term("roll_rate", "lateral", "m s/rad", "p"),
        Term("pitch", "longitudinal", "m/rad", "pitch"),
        Term("pitch_rate", "longitudinal", "m s/rad", "q"),
        Term("heading", "pedal", "m/rad", "yaw", angle=True),
        Term("yaw_rate", "pedal", "m s/rad", "r"),
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


class TurnCoordination(Block):
    """Pedals that keep the ball in the middle, above a speed: sideslip beta - lateral_acceleration a_y - yaw_rate (r - r_turn).

    sideslip: `"5 in/rad"`, nose into the wind; lateral_acceleration: `"0.1 in/(m/s2)"`; yaw_rate: `"2 in/(rad/s)"`, against that
    of a coordinated turn, g sin phi/V. above: airspeed from which it works, fully 10 kt faster, `"50 kt"` by default.
    authority, lag, washout, rate: as for `RateDamping`.
    """

    terms = (
        Term("sideslip", "pedal", "m/rad", "sideslip", sign=1.0, angle=True),
        Term("lateral_acceleration", "pedal", "s2", "ay"),
        Term("yaw_rate", "pedal", "m s/rad", "turning"),
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
        slowest = quantity(above, "m/s", f"{self.name}.above")
        self.works = slowest, slowest + quantity("10 kt", "m/s", "above")


class AltitudeHold(Block):
    """Collective that holds the path of the trim, h_0 + h_dot_0 t: -altitude (h - path) - climb_rate (h_dot - h_dot_0).

    altitude: `"0.05 in/ft"`, climb_rate: `"0.05 in/(ft/s)"`. authority, lag, rate: as for `RateDamping`. acts: `parallel` by
    default, it moves the stick itself.
    """

    along_path = True
    terms = (
        Term("altitude", "collective", "1", "altitude"),
        Term("climb_rate", "collective", "s", "climb_rate"),
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
        self._make({"altitude": altitude, "climb_rate": climb_rate}, authority, rate, acts, lag)
