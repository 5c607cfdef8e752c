# SPDX-License-Identifier: MIT OR Apache-2.0
"""A discrete gust, frozen in space."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from .. import _core
from ..arguments import with_checked_init
from ..errors import InputError
from ..units import quantity
from .kinds import STRONGEST, Told

SHAPES = ("1-cosine", "step")


@with_checked_init
@dataclass(frozen=True)
class Gust(Told):
    """A gust frozen in space (a steady wind beside it carries it) that begins `ahead` of the start of the flight, along `toward`.

    shape: `1-cosine`, amplitude (1 - cos(2 pi x/length))/2 over `length`, or `step`, risen so over half of `length`, then steady.
    amplitude: of the velocity of the air; direction: `up`, `down`, or where it blows to, clockwise from north. Text with units.
    """

    kind: ClassVar[str] = "gust"
    carried: ClassVar[bool] = True

    shape: str = "1-cosine"
    amplitude: str = "5 m/s"
    length: str = "50 m"
    ahead: str = "20 m"
    toward: str = "0 deg"
    direction: str = "up"

    def __post_init__(self) -> None:
        """Check."""
        if self.shape not in SHAPES:
            raise InputError.choice("gust shape", self.shape, SHAPES)
        if not quantity(self.length, "m", "gust length") > 0.0:
            raise InputError.of("gust length", self.length, "must be above 0")
        _ = self._place, self.velocity

    @cached_property
    def _place(self) -> tuple[np.ndarray, float, float]:
        """Direction along which it begins, where, and its length."""
        angle = quantity(self.toward, "rad", "gust toward")
        along = np.array([math.cos(angle), math.sin(angle), 0.0])
        return along, quantity(self.ahead, "m", "gust ahead"), quantity(self.length, "m", "gust length")

    @cached_property
    def velocity(self) -> np.ndarray:
        """Of its peak: north, east, down (3,) [m/s]."""
        size = quantity(self.amplitude, "m/s", "gust amplitude")
        if abs(size) > STRONGEST:
            raise InputError.of("gust amplitude", self.amplitude, f"must be at most {STRONGEST:g} m/s")
        vertical = {"up": -1.0, "down": 1.0}.get(self.direction)
        if vertical is not None:
            return np.array([0.0, 0.0, size * vertical])
        try:
            angle = quantity(self.direction, "rad", "gust direction")
        except InputError:
            raise InputError.of(
                "gust direction", self.direction, "must be up, down, or an angle such as '90 deg'"
            ) from None
        return size * np.array([math.cos(angle), math.sin(angle), 0.0])

    @cached_property
    def closed(self) -> _core.Wind:
        """The gust as the core evaluates it."""
        along, ahead, length = self._place
        return _core.Wind.gust(along, ahead, length, self.shape == "1-cosine", self.velocity)
