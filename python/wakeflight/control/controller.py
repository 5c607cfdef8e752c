# SPDX-License-Identifier: MIT OR Apache-2.0
"""A controller: what a user writes to have a say between the stick and the blades."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from .._core import Feedback
from ..errors import InputError, shown
from ..sticks import STICKS
from ..units import quantity
from .sensors import Sensors
from .start import Start

ACTS = ("series", "parallel")


class Controller:
    """Looks at the flight and adds inches to the sticks; a user's own one overrides `step`, and `reset` if it has a memory.

        class Hold(wf.Controller):
            rate = "100 Hz"
            outputs = ("longitudinal",)

            def reset(self, start):
                self.reference, self.sum = start.pitch, 0.0

            def step(self, t, sensors, stick):
                error = self.reference - sensors.pitch
                self.sum += 0.01 * error
                return {"longitudinal": 5.0 * error + 2.0 * self.sum}

    rate: how often it is called, text such as `"100 Hz"`; None, the default: where every coupling step begins. What it answers is
    held until its next call. outputs: sticks it may move. acts: `series`, inches added behind the stick, within the authority;
    `parallel`, it moves the stick itself, within the stops. own_authority: a series actuator of its own, outside the authority
    that the others share.

    What a flight keeps of it between two calls are its attributes: numbers, text, arrays, lists, tuples, dicts of them. One that
    holds anything else says so itself (`state`, `restore`). A simulation flies a copy: the object given is never changed.
    """

    rate: str | None = None
    outputs: tuple[str, ...] = STICKS
    acts: str = "series"
    own_authority: bool = False

    def reset(self, start: Start) -> None:
        """A flight begins from `start`."""

    def step(self, t: float, sensors: Sensors, stick: Mapping[str, float]) -> Mapping[str, float]:
        """Inches to add, by stick; those that are absent: none.

        t: time [s]. sensors: see `wf.Sensors`. stick: where the pilot has the sticks, inches about trim; aft, right, up positive.
        """
        raise NotImplementedError

    @property
    def saturated(self) -> tuple[str, ...]:
        """Sticks on which its own limits held it in the last call."""
        return ()

    def state(self) -> dict[str, Any]:
        """What its answers to come depend on."""
        return dict(vars(self))

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        vars(self).clear()
        vars(self).update(state)

    def feedback(self) -> Feedback | None:
        """What it is to the core, which then answers in its place; None: `step` is asked."""
        return None

    def described(self) -> dict[str, Any]:
        """What it is, for results and snapshots: its class and what it was made with."""
        return {"controller": type(self).__qualname__, "rate": self.rate, "acts": self.acts}

    def members(self) -> tuple[Controller, ...]:
        """Itself, as a list of controllers is made of them."""
        return (self,)

    def whole(self) -> None:
        """Nothing: it is one of a list."""
        return

    @property
    def name(self) -> str:
        """What messages call it."""
        return type(self).__qualname__

    def check_on(self, aircraft: Any) -> None:
        """Refuse an aircraft that lacks what it needs."""

    def check(self) -> float | None:
        """Refuse declarations that cannot be; how often it is called [1/s], None for every coupling step."""
        if self.acts not in ACTS:
            raise InputError.of(f"{self.name}.acts", self.acts, f"allowed: {', '.join(ACTS)}")
        outputs = (self.outputs,) if isinstance(self.outputs, str) else tuple(self.outputs)
        for each in outputs:
            if each not in STICKS:
                raise InputError.of(f"{self.name}.outputs", each, f"allowed: {', '.join(STICKS)}")
        if self.rate is None:
            return None
        called = quantity(self.rate, "1/s", f"{self.name}.rate")
        if not 0.1 <= called <= 10000.0:
            raise InputError.of(f"{self.name}.rate", self.rate, "must lie between 0.1 and 10000 Hz")
        return called


def inches(answer: Any, outputs: tuple[str, ...]) -> list[float]:
    """What a controller answered (4,) [in]; ValueError says what is wrong with it."""
    if not isinstance(answer, Mapping):
        raise ValueError(f"step returned {type(answer).__name__}, must be a dict of inches by stick")
    found = [0.0] * 4
    for name, value in answer.items():
        if name not in outputs:
            raise ValueError(f"step moved '{name}', allowed are its outputs: {', '.join(outputs)}")
        if type(value) is not float and (isinstance(value, bool | str | bytes) or np.ndim(value) != 0):
            raise ValueError(f"step returned {name} = {shown(value)}, must be a number of inches")
        try:
            number = float(value)
        except (TypeError, ValueError, OverflowError):
            raise ValueError(f"step returned {name} = {shown(value)}, must be a number of inches") from None
        if not math.isfinite(number):
            raise ValueError(f"step returned {name} = {number}, must be finite inches")
        found[STICKS.index(name)] = number
    return found
