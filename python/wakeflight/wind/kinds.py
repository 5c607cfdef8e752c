# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a wind is, a steady one, several at once, and a function of a user's own."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from .. import _core
from ..arguments import with_checked_init
from ..errors import InputError, NumericalFailure, WakeflightError, one_line, said
from ..units import quantity

STRONGEST = 100.0
"""Most that the velocity of the air may be [m/s]."""


class Wind:
    """A wind: subclass it and define `__call__`, or give a function of points and time wherever a wind is asked for."""

    kind: ClassVar[str] = "own"
    """Name in files."""
    carried: ClassVar[bool] = False
    """Whether a steady wind beside it carries it along."""

    @property
    def uniform(self) -> bool:
        """Whether it is the same at all points."""
        return False

    @property
    def constant(self) -> np.ndarray | None:
        """Its velocity (3,) [m/s] where it is the same at all points and at all times; None where it is not."""
        return None

    @property
    def closed(self) -> _core.Wind | None:
        """The wind as the core evaluates it; None where it does not know its form, and asks by points."""
        return None

    def __call__(self, points: np.ndarray, t: float) -> np.ndarray:
        """Velocity of the air (n, 3) [m/s] at `points` (n, 3) [m] and time `t` [s], north, east, down."""
        raise NotImplementedError(f"{type(self).__name__} must define __call__(points, t)")

    def __getstate__(self) -> dict[str, Any]:
        """All but what the core makes of it, which is made anew."""
        return {name: value for name, value in vars(self).items() if name != "closed"}

    def drift(self) -> np.ndarray:
        """Velocity (3,) [m/s] at which it carries what is carried."""
        return np.zeros(3)

    def described(self) -> dict[str, Any]:
        """For the file of a run: the kind, and what it was made with."""
        return {"kind": self.kind, "name": type(self).__name__}


class Told(Wind):
    """A wind in closed form, whose fields are all that it was made with."""

    @property
    def closed(self) -> _core.Wind:
        """The wind as the core evaluates it."""
        raise NotImplementedError

    def __call__(self, points: np.ndarray, t: float) -> np.ndarray:
        """At points (n, 3)."""
        return self.closed.at(np.asarray(points, dtype=float), t)

    def described(self) -> dict[str, Any]:
        """Kind and fields."""
        given = {each.name: getattr(self, each.name) for each in fields(self)}  # type: ignore[arg-type]
        return {"kind": self.kind, **given}


@with_checked_init
@dataclass(frozen=True)
class SteadyWind(Told):
    """A wind that is the same everywhere and always.

    speed, from_: text with units, where it blows from, clockwise from north; up: its vertical part, positive up.
    """

    kind: ClassVar[str] = "steady"

    speed: str
    from_: str = "0 deg"
    up: str = "0 m/s"

    def __post_init__(self) -> None:
        """Check."""
        _ = self.velocity

    @cached_property
    def velocity(self) -> np.ndarray:
        """North, east, down (3,) [m/s]."""
        speed, angle = quantity(self.speed, "m/s", "wind speed"), quantity(self.from_, "rad", "wind from_")
        found = np.array([-speed * math.cos(angle), -speed * math.sin(angle), -quantity(self.up, "m/s", "wind up")])
        if speed < 0.0 or np.linalg.norm(found) > STRONGEST:
            raise InputError.of("wind speed", self.speed, f"must be between 0 and {STRONGEST:g} m/s")
        return found

    @property
    def uniform(self) -> bool:
        """It is."""
        return True

    @property
    def constant(self) -> np.ndarray:
        """It is."""
        return self.velocity

    def drift(self) -> np.ndarray:
        """It carries what is carried."""
        return self.velocity

    @cached_property
    def closed(self) -> _core.Wind:
        """The same at every point."""
        return _core.Wind.steady(self.velocity)


class OwnWind(Wind):
    """A function of a user's own."""

    def __init__(self, function: Callable[[np.ndarray, float], Any]):
        self.function = function

    def __call__(self, points: np.ndarray, t: float) -> np.ndarray:
        """What the function says; whatever is wrong with it ends the flight there."""
        try:
            found = np.asarray(self.function(points, t), dtype=float)
        except WakeflightError:
            raise
        except Exception as reason:
            what = f"wind {self.described()['name']} at t = {t:.4f} s: {said(reason)}"
            raise NumericalFailure(one_line(what)) from reason
        if found.shape != points.shape:
            allowed = f"must be {points.shape}, as the points"
            raise InputError.of("wind", f"an answer of the shape {found.shape}", allowed)
        return found

    def described(self) -> dict[str, Any]:
        """By the name of the function."""
        try:
            name = str(self.function.__qualname__)
        except AttributeError:
            name = type(self.function).__name__
        return {"kind": self.kind, "name": name}


class Winds(Wind):
    """Several at once: their sum; steady winds carry along what is carried, such as turbulence."""

    kind: ClassVar[str] = "sum"

    def __init__(self, *parts: Wind):
        self.parts = parts
        self._drift = np.sum([part.drift() for part in parts], axis=0)

    @property
    def uniform(self) -> bool:
        """Whether all are."""
        return all(part.uniform for part in self.parts)

    @property
    def constant(self) -> np.ndarray | None:
        """The sum where all are."""
        return self._drift if all(part.constant is not None for part in self.parts) else None

    @cached_property
    def closed(self) -> _core.Wind | None:
        """The sum where all parts are in closed form."""
        parts = [part.closed for part in self.parts]
        known = [part for part in parts if part is not None]
        return _core.Wind.sum(known) if len(known) == len(parts) else None

    def drift(self) -> np.ndarray:
        """That of its parts."""
        drift: np.ndarray = self._drift
        return drift

    def __call__(self, points: np.ndarray, t: float) -> np.ndarray:
        """The sum."""
        if self.closed is not None:
            return self.closed.at(np.asarray(points, dtype=float), t)
        moved, whole = points - self._drift * t, np.zeros(np.shape(points))
        for part in self.parts:
            whole += part(moved if part.carried else points, t)
        return whole

    def described(self) -> dict[str, Any]:
        """Part by part."""
        return {"kind": self.kind, "parts": [part.described() for part in self.parts]}
