# SPDX-License-Identifier: MIT OR Apache-2.0
"""Primary servos: what carries the mixed commands of all sticks to the blades."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import InputError
from ..units import quantity

PITCH = ("theta_1c", "theta_1s", "theta_0", "theta_tr")
"""What the servos move, in the order of the rigging's rows."""


@dataclass(frozen=True)
class Servos:
    """Generic servos behind the mixing unit, all alike: a lag of first order with a limit on its rate, and stops.

    lag: time constant, `"0.03 s"` is usual for hydraulic servos; `"0 s"`: none. rate: largest rate of blade pitch, `"40 deg/s"`;
    None: no limit. limits: stops of blade pitch by name, `{"theta_0": ("9.9 deg", "25.9 deg")}`; names that are absent have none.
    Generic: no numbers of a particular aircraft.
    """

    lag: str = "0.03 s"
    rate: str | None = None
    limits: Mapping[str, tuple[str, str]] | None = None

    def __post_init__(self) -> None:
        """Check by reading."""
        if not 0.0 <= self.time_constant <= 10.0:
            raise InputError.of("actuators.lag", self.lag, "must lie between 0 and 10 s")
        if not self.fastest > 0.0:
            raise InputError.of("actuators.rate", self.rate, "must be above 0")
        low, high = self.stops
        if not (low < high).all():
            raise InputError.of("actuators.limits", self.limits, "the lower one must lie below the upper one")

    def __hash__(self) -> int:
        """By what it was made with."""
        return hash(repr(self))

    @property
    def time_constant(self) -> float:
        """Of the lag [s]."""
        return quantity(self.lag, "s", "actuators.lag")

    @property
    def fastest(self) -> float:
        """Largest rate [rad/s]."""
        return np.inf if self.rate is None else quantity(self.rate, "rad/s", "actuators.rate")

    @property
    def stops(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper stops (4,) [rad]."""
        low, high = np.full(4, -np.inf), np.full(4, np.inf)
        given = {} if self.limits is None else self.limits
        if not isinstance(given, Mapping):
            raise InputError.of("actuators.limits", given, f"must hold pairs of angles by name: {', '.join(PITCH)}")
        for name, pair in given.items():
            if name not in PITCH:
                raise InputError.of("actuators.limits", name, f"allowed: {', '.join(PITCH)}")
            if isinstance(pair, str) or len(pair) != 2:
                raise InputError.of(f"actuators.limits.{name}", pair, 'must be a pair of angles ("-8 deg", "8 deg")')
            k = PITCH.index(name)
            low[k], high[k] = (quantity(each, "rad", f"actuators.limits.{name}") for each in pair)
        return low, high

    def described(self) -> dict[str, Any]:
        """What it was made with."""
        limits = {name: list(pair) for name, pair in (self.limits or {}).items()}
        return {"lag": self.lag, "rate": self.rate, "limits": limits}


GENERIC = Servos()
"""What `actuators="generic"` means."""


def servos(given: Any) -> Servos | None:
    """Of what a user gives: None, `generic`, or Servos."""
    if given is None:
        return None
    if isinstance(given, str):
        if given != "generic":
            raise InputError.of("actuators", given, "allowed: generic, or wf.Servos(...)")
        return GENERIC
    try:
        given.described, given.time_constant  # noqa: B018
    except AttributeError as reason:
        raise InputError.of("actuators", given, "must be None, generic, or wf.Servos(...)") from reason
    found: Servos = given
    return found


Mounted = tuple[float, float, list[tuple[float, float]], np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""Servos of an aircraft as the core takes them."""


def mounted(servos: Servos, offset: np.ndarray, matrix: np.ndarray, stick: np.ndarray) -> Mounted:
    """Lag, rate, stops, rigging and its inverse, where they are: offset [rad], matrix [rad/m]; stick (4,) [m]: all at rest."""
    if abs(np.linalg.det(matrix / np.abs(matrix).max())) < 1e-9:
        raise InputError.of("actuators", "servos", "need a rigging whose matrix can be inverted")
    low, high = servos.stops
    stops = list(zip(low.tolist(), high.tolist(), strict=True))
    return servos.time_constant, servos.fastest, stops, offset, matrix, np.linalg.inv(matrix), offset + matrix @ stick
