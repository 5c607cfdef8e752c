# SPDX-License-Identifier: MIT OR Apache-2.0
"""Everything between the stick and the blades as one object: controllers, their common authority, servos."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from ..errors import InputError
from . import gains
from .controller import Controller
from .servos import Servos, servos


@dataclass(frozen=True)
class Augmentation:
    """Controllers in a list, what they may add together, and servos; None of it: the stick goes straight to the mixing unit.

    authority: most inches on each stick that the controllers in series add together, `"1 in"` or `"10 %"` of its travel; those
    with an authority of their own (`PitchBiasActuator`) are not counted. actuators: `generic` or `wf.Servos`. scale: inches of an
    aircraft over those the numbers were written for, by stick.
    """

    controllers: tuple[Controller, ...] = ()
    authority: str | None = None
    actuators: Servos | str | None = None
    scale: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)

    def __post_init__(self) -> None:
        """Check every member."""
        object.__setattr__(self, "controllers", _members(self.controllers))
        object.__setattr__(self, "actuators", servos(self.actuators))
        gains.authority("control.authority", self.authority, (10.0,) * 4)
        for each in self.controllers:
            each.check()

    @property
    def nothing(self) -> bool:
        """Whether the stick is left as it is."""
        return not self.controllers and self.actuators is None

    def check_on(self, aircraft: Any) -> None:
        """Refuse an aircraft that lacks what a member needs."""
        for each in self.controllers:
            each.check_on(aircraft)

    def described(self) -> dict[str, Any]:
        """What it is, for results and snapshots."""
        found: dict[str, Any] = {"controllers": [each.described() for each in self.controllers]}
        if self.authority is not None:
            found["authority"] = self.authority
        if self.scale != (1.0,) * 4:
            found["scale"] = list(self.scale)
        if self.actuators is not None:
            found["actuators"] = self.actuators.described()  # type: ignore[union-attr]
        return found

    def scaled(self, share: Sequence[float]) -> Augmentation:
        """For an aircraft whose sticks travel `share` (4,) times those the numbers were written for."""
        lateral, longitudinal, collective, pedal = (old * new for old, new in zip(self.scale, share, strict=True))
        return replace(self, scale=(lateral, longitudinal, collective, pedal))

    def with_actuators(self, given: Any) -> Augmentation:
        """With these servos, where any are given."""
        return self if given is None else replace(self, actuators=given)

    def members(self) -> tuple[Controller, ...]:
        """Refuses to be one of a list: it has an authority and servos of its own."""
        raise InputError.of("control", "an Augmentation in a list", "give it alone")

    def whole(self) -> Augmentation:
        """Itself."""
        return self


ALLOWED = "must be None, a wf.Controller, a list of them, or a wf.Augmentation"


def augmentation(control: Any, actuators: Any = None) -> Augmentation:
    """Of what a user gives as `control=` and `actuators=`."""
    if control is None:
        found = Augmentation()
    elif isinstance(control, list | tuple):
        found = Augmentation(tuple(control))
    else:
        try:
            whole = control.whole()
        except (AttributeError, TypeError) as reason:
            raise InputError.of("control", control, ALLOWED) from reason
        found = Augmentation((control,)) if whole is None else whole
    return found.with_actuators(actuators)


def _members(given: Any) -> tuple[Controller, ...]:
    """Controllers of a list."""
    if not isinstance(given, list | tuple):
        raise InputError.of("control", given, ALLOWED)
    found: list[Controller] = []
    for each in given:
        try:
            found += each.members()
        except AttributeError as reason:
            allowed = "must be made of the class wf.Controller, an object and not the class itself"
            raise InputError.of("control", type(each).__qualname__, allowed) from reason
        except TypeError as reason:
            raise InputError.of("control", each, "must be an object, not the class itself") from reason
    return tuple(found)
