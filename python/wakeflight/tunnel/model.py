# SPDX-License-Identifier: MIT OR Apache-2.0
"""The compiled rotor on its stand, and the inflow model it is given by default for a kind of condition."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from .. import _core
from ..aircraft import Rotor
from ..errors import InputError
from ..inflow import MODELS, AnnularInflow, DynamicInflow, InflowModel, TimeMarchingWake, inflow_model
from ..model import CompiledRotor
from ..trim import resample
from ..units import STANDARD_GRAVITY
from .condition import StandCondition

REGIME_OPTIONS: dict[str, dict[str, Any]] = {
    "forward": {},
    "hover": {"turns": 5, "far_wake_turns": 2, "relaxation": 0.3, "sheet_factor": 1.4},
    "descent": {"turns": 8, "far_wake_turns": 0, "relaxation": 0.3, "sheet_factor": 1.0},
}
"""Wake options that differ from the model's defaults by kind of condition, where the model is given by its name.

Hover (and climb): five free turns and two repeated ones, since the wake stays below the disk; axial descent: eight
free turns, none repeated, since the old end lies about the rotor. The same for every rotor.
"""

REVOLUTIONS = {"forward": (12, 4), "hover": (24, 12), "descent": (40, 20)}
"""Revolutions marched and, of them, the last ones averaged. Axial wakes do not become periodic: they need more."""


StandInflow = InflowModel | AnnularInflow
"""Inflow models of the stand."""


def stand_inflow(inflow: str | StandInflow, regime: str) -> StandInflow:
    """Model from its name with the options of the regime, or the configured model as it is."""
    if inflow == AnnularInflow.name or isinstance(inflow, AnnularInflow):
        return inflow if isinstance(inflow, AnnularInflow) else AnnularInflow()
    if isinstance(inflow, str) and inflow not in MODELS:
        allowed = ", ".join([*MODELS, AnnularInflow.name])
        raise InputError.of("inflow", inflow, f"allowed: {allowed}, or a configured model")
    model = inflow_model(inflow)
    if model is inflow or isinstance(model, DynamicInflow):
        return model
    known = {name: value for name, value in REGIME_OPTIONS[regime].items() if hasattr(model, name)}
    return replace(model, **known)


@dataclass(frozen=True)
class StandModel(CompiledRotor):
    """Rotor, condition and inflow model compiled."""

    aircraft: Rotor
    condition: StandCondition
    inflow: StandInflow
    core: _core.Stand
    n_harmonics: int
    blade_model: str = "lifting-line"
    """As the core reads it: lifting-line, second-order, weissinger, weissinger-incompressible."""
    windmill: bool = False
    """Whether dynamic inflow takes the windmill brake state in descent: a result does, the start of a wake does not, since it
    must exist at any collective."""
    n_controls: ClassVar[int] = 3

    @classmethod
    def build(
        cls,
        rotor: Rotor,
        condition: StandCondition,
        inflow: StandInflow,
        n_harmonics: int,
        blade_model: str = "lifting-line",
        windmill: bool = False,
    ) -> StandModel:
        """Compile; the tip loss of the file acts with dynamic inflow alone. Gravity acts down the shaft."""
        d = rotor.discretisation
        inflow.step(rotor)
        core = _core.Stand(
            json.dumps(rotor.data),
            condition.density,
            condition.speed_of_sound,
            STANDARD_GRAVITY,
            not isinstance(inflow, DynamicInflow),
            d.n_elements,
            d.n_modes,
            d.n_gauss,
            inflow.n_stations,
            d.reference_pitch,
            list(condition.higher),
            blade_model,
            windmill,
        )
        return cls(rotor, condition, inflow, core, n_harmonics, blade_model, windmill)

    def problem(self, inflow_map: np.ndarray | None) -> _core.StandProblem:
        """The equations on a held inflow map (n_azimuths, n_stations), or with dynamic inflow."""
        n = self.steps_per_revolution if inflow_map is None else inflow_map.shape[0]
        # at least four azimuths per highest harmonic
        fine = n * int(np.ceil(4 * max(self.n_harmonics, 1) / n))
        if inflow_map is not None and fine > n:
            inflow_map = resample(inflow_map, fine)
        c = self.condition
        higher, controls = list(c.higher), list(c.controls)
        return _core.StandProblem(c.velocity, c.rates, controls, higher, self.n_harmonics, fine, inflow_map)

    @property
    def rotor_tables(self) -> dict[str, Any]:
        """Blade and airfoil as the core was given them."""
        return self.aircraft.data

    @property
    def speed_of_sound(self) -> float:
        """Speed of sound [m/s]."""
        return self.condition.speed_of_sound

    @property
    def has_thin_sections(self) -> bool:
        """Whether the blades lift as thin sections without stall instead of by their tables."""
        return self.blade_model.startswith("weissinger")

    @property
    def dynamic_pressure_area(self) -> float:
        """rho pi R^2 (Omega R)^2 [N]: a force over it is its coefficient."""
        return self.condition.density * np.pi * self.rotor["radius"] ** 2 * self.tip_speed**2

    @property
    def is_dynamic(self) -> bool:
        """Whether the inflow has states of its own: no map of it is held."""
        return isinstance(self.inflow, DynamicInflow)

    @property
    def is_annular(self) -> bool:
        """Whether every ring of the disk has its own momentum."""
        return isinstance(self.inflow, AnnularInflow)

    @property
    def is_marching(self) -> bool:
        """Whether the wake marches in time."""
        return isinstance(self.inflow, TimeMarchingWake)
