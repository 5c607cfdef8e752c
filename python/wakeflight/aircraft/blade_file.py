# SPDX-License-Identifier: MIT OR Apache-2.0
# mypy: disable-error-code="valid-type"
# annotations are made by calls (unit, range): types to pydantic, not to mypy
"""What a file may hold of a blade: how it is held, its geometry, and its mass and stiffness as far as it moves by them."""

from __future__ import annotations

from typing import Literal

from pydantic import model_validator

from .fields import DEG, Angle, Fraction, Group, Length, Offset, Spring
from .number import scalar
from .tables import Table

OF_ELASTIC = ("structure", "control_stiffness", "km1_over_ktheta", "ka_over_ktheta", "structural_damping_ratio")
"""Keys that a blade needs to bend and twist."""

ABOUT_HINGE = ("blade_mass", "first_moment", "flap_inertia")
"""Keys that are all there is of the mass of a slender rigid blade: its moments about the hinge."""


class HingeStops(Group):
    """Stops of a hinge: angles from which a blade lies on a stiff spring that pushes it back, one of them at least.

    flap: up positive, from the preconed span, `low` is the droop stop; lag: forward positive, `low` the stop aft.
    """

    low: Angle | None = None
    high: Angle | None = None
    stiffness: scalar("N m/rad", above=0.0, high=1e9)

    @model_validator(mode="after")
    def _apart(self) -> HingeStops:
        if self.low is None and self.high is None:
            raise ValueError("needs low, high, or both")
        if self.low is not None and self.high is not None and not self.low < self.high:
            raise ValueError("has low not below high")
        return self

    @property
    def data(self) -> dict[str, float | None]:
        """As the core reads it."""
        low, high = (None if each is None else float(each) for each in (self.low, self.high))
        return {"low": low, "high": high, "stiffness": float(self.stiffness)}


class BladeGroup(Group):
    """Blade: `hinged` in flap and lag at `root_station`, `flapping` there (lag held), or `clamped` there.

    A rigid one (`flexible = false`) has its mass by `structure`, by the three moments about its hinge, or uniform: `mass` per
    length, or `flap_inertia` alone. It needs none of the elastic numbers.
    """

    root: Literal["hinged", "flapping", "clamped"]
    root_station: Offset
    root_cutout: Length
    geometry: Table
    flexible: bool = True
    structure: Table | None = None
    mass: scalar("kg/m", above=0.0, high=1000.0) | None = None
    blade_mass: scalar("kg", above=0.0, high=1e5) | None = None
    first_moment: scalar("kg m", above=0.0, high=1e6) | None = None
    flap_inertia: scalar("kg m2", above=0.0, high=1e6) | None = None
    flap_spring: Spring | None = None
    lag_spring: Spring | None = None
    flap_stops: HingeStops | None = None
    lag_stops: HingeStops | None = None
    straight_tip: bool = False
    pitch_axis_chord_fraction: Fraction | None = None
    control_stiffness: scalar("N m/rad", above=0.0, high=1e9) | None = None
    km1_over_ktheta: Fraction | None = None
    ka_over_ktheta: scalar("1", low=0.0, high=10.0) | None = None
    structural_damping_ratio: scalar("1", low=0.0, high=0.5) | None = None
    delta3: scalar("rad", low=-80 * DEG, high=80 * DEG) | None = None
    precone: scalar("rad", low=-20 * DEG, high=20 * DEG) | None = None

    def given(self, keys: tuple[str, ...]) -> list[str]:
        """Those of `keys` that the file has."""
        return [key for key, value in self if key in keys and value is not None]

    @model_validator(mode="after")
    def _complete(self) -> BladeGroup:
        needed = (*OF_ELASTIC, "pitch_axis_chord_fraction") if self.flexible else ()
        missing = [key for key in needed if not self.given((key,))]
        if missing:
            raise ValueError(f"{missing[0]} is missing; a rigid blade does without")
        moments = self.given(("blade_mass", "first_moment"))
        if moments and len(self.given(ABOUT_HINGE)) < len(ABOUT_HINGE):
            raise ValueError(
                f"has {' and '.join(moments)}; the mass about the hinge is {', '.join(ABOUT_HINGE)} together"
            )
        kinds = [*self.given(("structure", "mass")), *self.given(("flap_inertia",))]
        if len(kinds) > 1:
            raise ValueError(f"has {' and '.join(kinds)}; one of them gives the mass")
        if not kinds and self.root != "clamped":
            raise ValueError("needs structure, mass or flap_inertia: a blade with hinges moves")
        return self

    @model_validator(mode="after")
    def _springs_at_hinges(self) -> BladeGroup:
        for key in self.given(("flap_spring", "flap_stops")):
            if self.root == "clamped":
                raise ValueError(f"has {key}, but root = clamped has no flap hinge")
        for key in self.given(("lag_spring", "lag_stops")):
            if self.root != "hinged":
                raise ValueError(f"has {key}, but root = {self.root} has no lag hinge")
        return self
