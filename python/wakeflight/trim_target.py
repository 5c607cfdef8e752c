# SPDX-License-Identifier: MIT OR Apache-2.0
"""What can be asked of a trim instead of a flight path: power or collective, with a part of the path left free for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .condition import SLOWEST_FREE, FlightCondition
from .errors import InputError
from .units import quantity, shown

FREE = ("flight_path", "speed")
"""What of the path can be left free, the first where nothing is said."""
UNITS = {"power": ("W", "hp"), "collective": ("rad", "deg")}
"""SI unit of what can be asked for, and the one it is shown in."""


@dataclass(frozen=True)
class Target:
    """A value that a trim meets with a part of its path left free, SI."""

    name: str
    value: float
    free: str

    def at(self, value: float) -> Target:
        """The same asked for another value."""
        return Target(self.name, value, self.free)

    def shown(self, value: float) -> str:
        """A value of what is asked for, with its unit."""
        return shown(value, UNITS[self.name][1])


def target(
    condition: FlightCondition, power: Any = None, collective: Any = None, free: str | None = None
) -> Target | None:
    """The target of a trim in a complete condition, from text with units or pint quantities; None where nothing is asked."""
    if free is not None and free not in FREE:
        raise InputError.of("free", free, f"allowed: {', '.join(FREE)}")
    given = {name: value for name, value in (("power", power), ("collective", collective)) if value is not None}
    if not given:
        if free is not None:
            raise InputError.of("free", free, "needs a power or a collective that it is left free for")
        return None
    if len(given) > 1:
        raise InputError.of("collective", collective, "give either power or collective")
    ((name, value),) = given.items()
    found = Target(name, quantity(value, UNITS[name][0], name), free or FREE[0])
    if condition.speed < SLOWEST_FREE:
        allowed = f"a speed of {shown(SLOWEST_FREE, 'm/s')} and more: at rest there is no path to leave free for {name}"
        raise InputError.of("speed", shown(condition.speed, "kt"), allowed)
    return found
