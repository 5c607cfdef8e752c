# SPDX-License-Identifier: MIT OR Apache-2.0
"""The compiled rotor on its stand, and the inflow models it can have."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from .. import _core
from ..aircraft import Rotor
from ..inflow import STAND_MODELS, AnnularInflow, InflowModel, inflow_model
from ..model import CompiledRotor, Question, resolution, setting, turning_core
from ..rotor_speed import Corners
from .condition import StandCondition

StandInflow = InflowModel | AnnularInflow
"""Inflow models of the stand."""


def stand_inflow(inflow: str | StandInflow) -> StandInflow:
    """Model from its name, or the configured model itself."""
    found: StandInflow = inflow_model(inflow, STAND_MODELS)
    return found


LIFT: dict[str, Any] = {
    "lifting-line": None,
    "second-order": "tables",
    "weissinger": {"tangency": {"prandtl_glauert": True}},
    "weissinger-incompressible": {"tangency": {"prandtl_glauert": False}},
}
"""What the lift of the sections comes from, by the model of the blade."""


@dataclass(frozen=True)
class StandModel(CompiledRotor):
    """Rotor, condition and inflow model compiled."""

    aircraft: Rotor
    condition: StandCondition
    inflow: StandInflow
    core: _core.System
    n_harmonics: int
    blade_model: str = "lifting-line"
    """As the core reads it: lifting-line, second-order, weissinger, weissinger-incompressible."""
    rotor_speed: Corners = ()
    """Time [s] and share of the nominal rotor speed; none at constant speed."""
    n_controls: ClassVar[int] = 3

    @classmethod
    def build(
        cls,
        rotor: Rotor,
        condition: StandCondition,
        inflow: StandInflow,
        n_harmonics: int,
        blade_model: str = "lifting-line",
    ) -> StandModel:
        """Compile; the tip loss of the file acts with dynamic inflow alone. Gravity acts down the shaft.

        Options of the wake that depend on the regime take the numbers of the condition's.
        """
        inflow = inflow.on_stand().resolved(condition.regime(rotor.omega * rotor.radius))
        inflow.step(rotor)
        air = (condition.density, condition.speed_of_sound)
        resolved = resolution(rotor.discretisation, inflow.n_stations)
        chosen = setting(air, not inflow.is_dynamic, resolved, lift=LIFT[blade_model], **inflow.sections)
        motion = (list(condition.velocity), list(condition.rates))
        core = _core.System.stand(json.dumps(rotor.data), chosen, motion, list(condition.higher))
        return cls(rotor, condition, inflow, core, n_harmonics, blade_model)

    def at_speed(self, corners: Corners) -> StandModel:
        """This model with a rotor speed in time."""
        return self if not corners else replace(self, core=turning_core(self, corners), rotor_speed=corners)

    @property
    def question(self) -> Question:
        """What the pitch controls are found from."""
        return Question(tuple((name, (value,)) for name, value in self.condition.controls))

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
        return float(self.condition.density * np.pi * self.rotor["radius"] ** 2 * self.tip_speed**2)
