# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a run says of itself: aircraft, condition, models and manoeuvre it was flown with, figures of trim and convergence."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from .control import Augmentation
from .maneuvers import Maneuver
from .model import Model
from .modes import mode_labels

if TYPE_CHECKING:
    from .flight_start import ConvergencePhase
    from .trim import Trim


def described(
    start: Trim,
    model: Model,
    maneuver: Maneuver,
    control: Augmentation,
    turning: str,
    wind: dict[str, Any] | None,
    revolutions: float,
) -> dict[str, Any]:
    """Attributes of a run from `start`; turning: the rotor's speed in words; wind: as described; revolutions: flown so far."""
    mean = start.mean_outputs()
    configuration = {
        "aircraft": start.aircraft.name,
        "loading": start.aircraft.loading_name or "",
        **({"varied": start.aircraft.changes} if start.aircraft.changes else {}),
        "condition": start.condition.as_attributes(),
        "inflow": {"model": model.inflow.name, **model.inflow.as_attributes()},
        "discretisation": start.aircraft.discretisation._asdict(),
        "trim_inflow": start.inflow.name,
        **({"rotor_speed": [list(corner) for corner in model.rotor_speed]} if model.rotor_speed else {}),
        **({} if control.nothing else {"control": control.described()}),
        **({"rotor_speed": turning} if model.has_free_speed else {}),
        **({"drive": json.loads(model.drive)} if model.drive else {}),
        **({} if wind is None else {"wind": wind}),
        "maneuver": {
            "name": maneuver.name,
            "adapted": list(maneuver.adapted),
            "controls": {stick: [list(corner) for corner in corners] for stick, corners in maneuver.corners_of},
        },
    }
    return {
        "aircraft": start.aircraft.name,
        "maneuver": maneuver.name,
        "maneuver_adapted": "; ".join(maneuver.adapted),
        "inflow_model": model.inflow.name,
        "radius": model.rotor["radius"],
        "omega": model.omega,
        "blade_modes": mode_labels(start.aircraft),
        "geometry": json.dumps(start.aircraft.geometry | _sections(model)),
        "configuration": configuration,
        "condition": start.condition.as_attributes(),
        "ct": mean["ct"],
        "ct_sigma": mean["ct"] / start.aircraft.solidity,
        "mu": mean["mu"],
        "power": mean["power"],
        "revolutions": revolutions,
    }


def _sections(model: Model) -> dict[str, Any]:
    """What forces are made from by their coefficients: chord, width and lifting width of the blade elements [m], the air."""
    rotor = model.rotor
    widths = np.array(rotor["widths"], dtype=float)
    # a free wake has its own loss at the tip; with dynamic inflow nothing lifts beyond the factor
    factor = float(model.aircraft.rotor.tip_loss_factor) if model.inflow.is_dynamic else 1.0
    inner = model.stations - 0.5 * widths
    lifting = np.clip(factor * rotor["radius"] - inner, 0.0, widths)
    return {
        "chords": [float(each) for each in rotor["chords"]],
        "widths": widths.tolist(),
        "lifting": lifting.tolist(),
        "density": float(model.density),
        "speed_of_sound": float(model.speed_of_sound),
    }


def convergence_attributes(phase: ConvergencePhase) -> dict[str, Any]:
    """Figures of the convergence phase: change per revolution, drift of the lift."""
    if not phase.change:
        return {}
    return {
        "convergence_change": [round(c, 12) for c in phase.change],
        "segment_evaluations_convergence": phase.segment_evaluations,
        "convergence_lift_drift": phase.circulation_lift[-1] / phase.circulation_lift[0] - 1.0,
    }
