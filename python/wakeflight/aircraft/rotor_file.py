# SPDX-License-Identifier: MIT OR Apache-2.0
# mypy: disable-error-code="valid-type"
# annotations are made by calls (unit, range): types to pydantic, not to mypy
"""What a rotor file may hold: the rotor part of the aircraft format, alone, for a rotor on a stand.

Keys are those of `[rotor]` in an aircraft file. A rigid blade (`flexible = false`) needs no structure: hinged, it needs
its mass about the hinge; clamped, nothing. Numbers may be written as in an aircraft file, or short: text with a unit,
a bare number where there is none; tables as CSV files, or as `{ columns = { ... } }` in the file itself.
"""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import Field, model_validator

from .blade_file import BladeGroup
from .fields import Angle, Condition, Group, Length, Name, Position, Rate, Rotation, Source
from .number import Noted, scalar
from .schema import LagDamper
from .span import Section, along_span

UNSTATED = Source(text="Not stated in the rotor file", references=[])
"""Source of numbers written short."""


class RotorGroup(Group):
    """The rotor; hub place, shaft tilt and swashplate phase are not used on a stand."""

    name: str = "main"
    n_blades: scalar("1", low=1, high=8, whole=True)
    radius: Length
    omega: Rate
    rotation: Rotation = "ccw"
    blade: BladeGroup
    airfoil: along_span(Section)
    tip_loss_factor: scalar("1", low=0.8, high=1.0) | None = None
    lag_damper: LagDamper | None = None
    hub: Position | None = None
    shaft_tilt_forward: Angle | None = None
    shaft_tilt_lateral: Angle | None = None
    swashplate_phase: Angle | None = None


class RotorDiscretisation(Group):
    """How finely to compute."""

    n_modes: Annotated[int, Field(ge=1, le=12)] = 5
    n_elements: Annotated[int, Field(ge=1, le=100)] = 4
    n_gauss: Annotated[int, Field(ge=2, le=20)] = 8
    azimuth_step: str | None = None
    reference_pitch: str | None = None


class RotorFile(Group):
    """A whole rotor file."""

    name: Name
    notes: str = ""
    sources: dict[str, Source] = Field(default_factory=dict)
    rotor: RotorGroup
    condition: Condition | None = None
    discretisation: RotorDiscretisation = RotorDiscretisation()
    comparison: dict[str, Noted] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _ascending(self) -> RotorFile:
        blade, radius = self.rotor.blade, self.rotor.radius
        if not (blade.root_station <= blade.root_cutout < radius):
            raise ValueError("rotor.blade: root_station <= root_cutout < radius is needed")
        return self


WORDS = {"root", "name", "kind", "rotation", "model"}
"""Keys whose text is text, not a number with a unit."""


def written_out(entry: Any, key: str = "") -> Any:
    """Numbers written short (`"1.143 m"`, `0.97`) and tables without source as tables with value, unit, source, confidence."""
    if isinstance(entry, dict):
        if "value" in entry or "table" in entry or "columns" in entry:
            return {"source": "unstated", "confidence": "C", **entry}
        return {name: written_out(value, name) for name, value in entry.items()}
    if isinstance(entry, bool) or key in WORDS:
        return entry
    if isinstance(entry, int | float):
        return {"value": entry, "source": "unstated", "confidence": "C"}
    if isinstance(entry, str):
        number, _, unit = entry.strip().partition(" ")
        try:
            return {"value": float(number), "unit": unit.strip() or "1", "source": "unstated", "confidence": "C"}
        except ValueError:
            return entry
    if isinstance(entry, list) and any(isinstance(each, dict) for each in entry):
        return [written_out(each, key) for each in entry]
    if isinstance(entry, list):
        return {"value": entry, "source": "unstated", "confidence": "C"}
    return entry
