# SPDX-License-Identifier: MIT OR Apache-2.0
"""The pitch-bias actuator of an aircraft's file: an actuator in series with the longitudinal stick, apart from the SAS."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .._core import limited_lag
from ..errors import InputError
from .controller import Controller
from .sensors import Sensors
from .start import Start


class PitchBiasActuator(Controller):
    """Pitch-bias actuator with the numbers of the aircraft's file.

    Asked for, as a share of the longitudinal travel, aft positive: bias + attitude_gain theta + rate_gain q + airspeed_gain
    (V - airspeed_from), each signal within its range, the sum within the authority, behind a lag of limited rate. A trim has
    the actuator in its stick: what moves in flight is its change from where the trim has it.
    """

    outputs = ("longitudinal",)
    own_authority = True

    def __init__(self, rate: str | None = None):
        self.rate = rate
        self.travel = 0.0
        self.law: dict[str, Any] = {}
        self.t: float | None = None
        self.asked = self.at = self.rest = 0.0
        self.limited = False

    def reset(self, start: Start) -> None:
        """Settled at the first call."""
        self.check_on(start.aircraft)
        law = start.aircraft.pitch_bias_actuator
        self.law, self.travel, self.t, self.limited = dict(law), start.aircraft.stick_travel_in[1], None, False

    def check_on(self, aircraft: Any) -> None:
        """Refuse an aircraft whose file has none."""
        if aircraft.pitch_bias_actuator is None:
            raise InputError.of(self.name, aircraft.name, "its file has no [rigging.pitch_bias_actuator]")

    def command(self, sensors: Sensors) -> float:
        """Share of the longitudinal travel asked for."""
        law = self.law
        theta = min(law["attitude_limit"], max(-law["attitude_limit"], sensors.pitch))
        q = min(law["rate_limit"], max(-law["rate_limit"], sensors.q))
        faster = min(law["airspeed_range"], max(0.0, sensors.airspeed - law["airspeed_from"]))
        asked = law["bias"] + law["attitude_gain"] * theta + law["rate_gain"] * q + law["airspeed_gain"] * faster
        return float(min(law["authority"], max(-law["authority"], asked)))

    def step(self, t: float, sensors: Sensors, stick: Mapping[str, float]) -> dict[str, float]:
        """Inches on the longitudinal stick."""
        asked = self.command(sensors)
        if self.t is None:
            self.t, self.asked, self.at, self.rest = t, asked, asked, asked
        dt, self.t = t - self.t, t
        self.at, self.limited = limited_lag(self.at, self.asked, asked, dt, self.law["lag"], self.law["actuator_rate"])
        self.asked = asked
        return {"longitudinal": (self.at - self.rest) * self.travel}

    @property
    def saturated(self) -> tuple[str, ...]:
        """Whether its authority or its rate held it back in the last call."""
        return self.outputs if self.limited or abs(self.asked) >= self.law.get("authority", 1.0) else ()

    def __repr__(self) -> str:
        """As it was made."""
        return f"{self.name}()" if self.rate is None else f"{self.name}(rate={self.rate!r})"

    def __eq__(self, other: object) -> bool:
        """By what it was made with."""
        return repr(self) == repr(other)

    def __hash__(self) -> int:
        """By what it was made with."""
        return hash(repr(self))
