# SPDX-License-Identifier: MIT OR Apache-2.0
# mypy: disable-error-code="valid-type"
# annotations are made by calls (unit, range): types to pydantic, not to mypy
"""What the groups of aircraft and rotor files are made of: numbers of a dimension within a range, sources, conditions."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from ..text import name_of
from .number import Weight, scalar, vector

DEG = math.pi / 180.0

Length = scalar("m", above=0.0, high=100.0)
Offset = scalar("m", low=0.0, high=100.0)
Position = vector("m", 3, low=-100.0, high=100.0)
Station = scalar("m", low=-100.0, high=100.0)
Angle = scalar("rad", low=-math.pi, high=math.pi)
Rate = scalar("rad/s", above=0.0, high=10000.0)
Area = scalar("m2", above=0.0, high=1000.0)
Fraction = scalar("1", low=0.0, high=1.0)
Spring = scalar("N m/rad", low=0.0, high=1e9)

Name = Annotated[str, Field(min_length=1), AfterValidator(name_of)]
"""Name of an aircraft, a rotor, a section."""

Rotation = Literal["ccw", "cw"]
"""Way a rotor turns seen from above: counter-clockwise (the blade on the right advances) or clockwise."""


class Group(BaseModel):
    """A group of an aircraft file: immutable, no unknown keys."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, arbitrary_types_allowed=True)


class Source(Group):
    """A source: what it is and how it was read, and its keys in the bibliography."""

    text: Annotated[str, Field(min_length=1)]
    references: list[str] = []


class Condition(Group):
    """A flight condition; in a named one, what is not given is that of `[condition]`."""

    speed: scalar("m/s", low=0.0, high=260.0) | None = None
    flight_path: scalar("rad", low=-math.pi / 2, high=math.pi / 2) | None = None
    altitude: scalar("m", low=-500.0, high=11000.0) | None = None
    weight: Weight | None = None
    note: str = ""
