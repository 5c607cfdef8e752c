# SPDX-License-Identifier: MIT OR Apache-2.0
"""Arrays and attributes of a trimmed flight, by the names of the schema."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..modes import mode_labels
from ..monitors import Monitor, variables
from ..results import assemble_trim
from .solved import Solved

if TYPE_CHECKING:
    import xarray as xr

FIELDS = ("cl", "cl_m2", "alpha", "mach")


def dataset(start: Solved, monitors: tuple[Monitor, ...], said: dict[str, str]) -> xr.Dataset:
    """The trim by the schema of results; `said`: warnings and failure."""
    model, mean, n = start.model, start.mean_outputs(), start.inflow_map.shape[0]
    residual = model.core.trim_residual(start.problem, start.x)
    y = start.state()
    modes = model.core.trim_layout(start.problem).modes
    scale = np.asarray(model.rotor["angle_per_coordinate"])
    controls = start.pitch_controls
    averaged = ("ct", "mu", "power", "power_main", "power_tail", "beta_0", "beta_1c", "beta_1s", "inflow_mean")
    arrays = {
        **start.stick,
        "pitch": start.pitch,
        "roll": start.roll,
        "bank": start.roll,
        "theta_0": controls["theta_0"],
        "theta_1c": controls["theta_1c"],
        "theta_1s": controls["theta_1s"],
        "theta_tail": controls["theta_tr"],
        **{name: mean[name] for name in averaged},
        "ct_sigma": mean["ct"] / start.aircraft.solidity,
        "azimuth": 2 * np.pi * np.arange(n) / n,
        "station": model.stations / model.rotor["radius"],
        "inflow": model.at_stations(start.inflow_map),
        "circulation": start.circulation,
        "modal": model.core.trim_motion(start.problem, start.x, n)[0] * scale,
        "modal_harmonics": np.array([start.x[a:b] * s for a, b, s in zip(modes[:-1], modes[1:], scale, strict=True)]),
        "residual_linear": residual[:3],
        "residual_angular": residual[3:6],
        "residual_blade": float(np.abs(residual[modes[0] :]).max()),
        "stabilator": start.stabilator_incidence,
        "velocity_b": y[:3],
        "rates_b": y[3:6],
        **start.maps(*FIELDS),
        **variables(monitors),
    }
    if start.problem.wash is not None:
        arrays["wash"] = start.problem.wash
    if start.history:
        arrays["residual_inflow"] = start.history[-1]["inflow_change"]
    return assemble_trim({name: np.asarray(value) for name, value in arrays.items()}, attributes(start) | said)


def attributes(start: Solved) -> dict[str, Any]:
    """Attributes of the Dataset: aircraft, condition, inflow, what was counted."""
    condition = start.condition.as_attributes()
    return {
        "aircraft": start.aircraft.name,
        "inflow_model": start.inflow.name,
        "radius": start.model.rotor["radius"],
        "omega": start.model.omega,
        "blade_modes": mode_labels(start.aircraft),
        "yaw": start.yaw,
        "rate_of_descent": start.rate_of_descent,
        "load_factor": start.load_factor,
        "configuration": {
            "aircraft": start.aircraft.name,
            "condition": condition,
            "inflow": {"model": start.inflow.name, **start.inflow.as_attributes()},
            "discretisation": start.aircraft.discretisation._asdict(),
            **({"varied": start.aircraft.changes} if start.aircraft.changes else {}),
        },
        "condition": condition,
        "seconds_trim": start.seconds,
        **start.counters,
    }
