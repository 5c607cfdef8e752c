# SPDX-License-Identifier: MIT OR Apache-2.0
# mypy: disable-error-code="valid-type"
# annotations are made by calls (unit, range): types to pydantic, not to mypy
"""What a rotor file may hold: the rotor part of the aircraft format, alone, for a rotor on a stand.

Keys are those of `[rotor]` in an aircraft file. A rigid blade (`flexible = false`) needs no structure: hinged, it needs
its mass or its flap inertia; clamped, nothing. Numbers may be written as in an aircraft file, or short: text with a unit,
a bare number where there is none; tables as CSV files, or as `{ columns = { ... } }` in the file itself.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, ValidationInfo, model_validator

from ..text import file_beside
from .airfoils import Grid, analytic_polar, checked, read_c81
from .number import Noted, Provenance, provenance_of, scalar, vector
from .schema import (
    _DEG,
    Angle,
    Condition,
    Fraction,
    Group,
    LagDamper,
    Length,
    Offset,
    Position,
    Rate,
    Rotation,
    Source,
    one_section,
)
from .tables import Table

UNSTATED = Source(text="Not stated in the rotor file", references=[])
"""Source of numbers written short."""


class Deck(Group):
    """A C81 deck that was read."""

    path: Path
    grids: dict[str, Grid]
    provenance: Provenance
    notes: tuple[str, ...] = ()


def _deck(entry: Any, info: ValidationInfo) -> Deck:
    allowed = "a table { table, source, confidence } naming a C81 file beside this one"
    provenance = provenance_of(entry, info, {"table", "source", "confidence", "note"}, allowed)
    name = entry.get("table")
    if not isinstance(name, str) or not name:
        raise ValueError(f"must be {allowed}")
    path = file_beside(Path((info.context or {}).get("directory", Path())), name)
    grids, notes = read_c81(path)
    for key, grid in grids.items():
        checked(key, grid)
    return Deck(path=path, grids=grids, provenance=provenance, notes=tuple(notes))


class Polar(Group):
    """Analytic polar: cl = slope (alpha - zero_lift), cd = d0 + d1 alpha + d2 alpha^2 (alpha in rad)."""

    lift_curve_slope: scalar("1/rad", above=0.0, high=10.0)
    cd: vector("1", 3, low=-10.0, high=10.0)
    zero_lift: Angle | None = None
    cm: scalar("1", low=-1.0, high=1.0) | None = None
    prandtl_glauert: bool = False


class RotorAirfoil(Group):
    """Section tables along the whole span: `cl`, `cd`, `cm` by Mach number, a `c81` deck, or an analytic `polar`."""

    name: str
    cl: Table | None = None
    cd: Table | None = None
    cm: Table | None = None
    c81: Annotated[Deck, BeforeValidator(_deck)] | None = None
    polar: Polar | None = None
    cd_increment: scalar("1", low=-0.1, high=0.1) | None = None

    @model_validator(mode="after")
    def _one_kind(self) -> RotorAirfoil:
        tables = self.cl is not None or self.cd is not None or self.cm is not None
        if tables + (self.c81 is not None) + (self.polar is not None) != 1:
            raise ValueError("needs one of: the tables cl and cd (and cm), a c81 deck, a polar")
        if tables and (self.cl is None or self.cd is None):
            raise ValueError("needs both tables, cl and cd")
        return self

    def grids(self) -> dict[str, Grid]:
        """Tables {cl, cd, cm} in SI."""
        from .tables import by_mach

        if self.c81 is not None:
            return self.c81.grids
        if self.polar is not None:
            p = self.polar
            zero_lift, moment = float(p.zero_lift or 0.0), float(p.cm or 0.0)
            return analytic_polar(float(p.lift_curve_slope), zero_lift, tuple(p.cd), moment, p.prandtl_glauert)
        grids = {"cl": by_mach(self.cl), "cd": by_mach(self.cd)}
        if self.cm is not None:
            grids["cm"] = by_mach(self.cm)
        else:
            grids["cm"] = {**grids["cl"], "values": [[0.0] * len(row) for row in grids["cl"]["values"]]}
        return grids


class RotorBlade(Group):
    """Blade: `hinged` in flap and lag at `root_station`, `flapping` there (lag clamped), or `clamped` there."""

    root: Literal["hinged", "flapping", "clamped"]
    root_station: Offset
    root_cutout: Length
    geometry: Table
    flexible: bool = True
    structure: Table | None = None
    mass: scalar("kg/m", above=0.0, high=1000.0) | None = None
    flap_inertia: scalar("kg m2", above=0.0, high=1e6) | None = None
    straight_tip: bool = False
    pitch_axis_chord_fraction: Fraction | None = None
    control_stiffness: scalar("N m/rad", above=0.0, high=1e9) | None = None
    km1_over_ktheta: Fraction | None = None
    ka_over_ktheta: scalar("1", low=0.0, high=10.0) | None = None
    structural_damping_ratio: scalar("1", low=0.0, high=0.5) | None = None
    delta3: scalar("rad", low=-80 * _DEG, high=80 * _DEG) | None = None
    precone: scalar("rad", low=-20 * _DEG, high=20 * _DEG) | None = None

    @model_validator(mode="after")
    def _complete(self) -> RotorBlade:
        if self.flexible:
            for key in (
                "structure",
                "control_stiffness",
                "km1_over_ktheta",
                "ka_over_ktheta",
                "structural_damping_ratio",
                "pitch_axis_chord_fraction",
            ):
                if getattr(self, key) is None:
                    raise ValueError(f"{key} is missing; a blade with flexible = false does without")
        given = [key for key in ("structure", "mass", "flap_inertia") if getattr(self, key) is not None]
        if len(given) > 1:
            raise ValueError(f"has {' and '.join(given)}; one of them gives the mass")
        if not given and self.root != "clamped":
            raise ValueError("needs structure, mass or flap_inertia: a blade with hinges moves")
        return self


class RotorGroup(Group):
    """The rotor; hub place, shaft tilt and swashplate phase are not used on a stand."""

    n_blades: scalar("1", low=1, high=8, whole=True)
    radius: Length
    omega: Rate
    rotation: Rotation = "ccw"
    blade: RotorBlade
    airfoil: Annotated[RotorAirfoil, BeforeValidator(one_section)]
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

    format: Literal[1]
    name: Annotated[str, Field(min_length=1)]
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


WORDS = {"root", "name", "kind", "rotation"}
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
    if isinstance(entry, list) and not any(isinstance(each, dict) for each in entry):
        return {"value": entry, "source": "unstated", "confidence": "C"}
    return entry
