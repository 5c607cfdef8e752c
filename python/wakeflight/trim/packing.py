# SPDX-License-Identifier: MIT OR Apache-2.0
"""A trim by value, as numbers and blocks of the core: what a checkpoint of a flight holds of where it began."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _core
from ..aircraft import Aircraft
from ..condition import FlightCondition, Target
from ..inflow import InflowModel
from ..model import Model
from .results import Trim
from .wake import WakeInTrim

MAPS = ("x", "inflow_map", "circulation")


def packed(start: Trim) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Scalars (as JSON takes them) and parts of a trim; its aircraft and inflow model are told elsewhere."""
    arrays = {name: np.ascontiguousarray(vars(start)[name], "<f8") for name in MAPS}
    target = start.model.target
    scalars: dict[str, Any] = {
        "condition": start.condition.as_attributes(),
        "target": None if target is None else vars(target),
        "n_harmonics": start.model.n_harmonics,
        "shapes": {name: list(values.shape) for name, values in arrays.items()},
        "history": start.history,
        "notes": list(start.notes),
        "settled": start.settled,
        "seconds": start.seconds,
        "asked": None if start.asked is None else start.asked.as_attributes(),
        "control_tolerance": start.control_tolerance,
        "counters": None if start.wake is None else start.wake.counters,
    }
    parts = {name: values.tobytes() for name, values in arrays.items()}
    parts["problem"] = bytes(start.problem.to_bytes())
    if start.wake is not None:
        parts["wake"] = bytes(start.wake.core.to_bytes())
    return scalars, parts


def unpacked(aircraft: Aircraft, inflow: InflowModel, scalars: dict[str, Any], parts: dict[str, bytes]) -> Trim:
    """The trim again, of the same aircraft and inflow model."""
    target = None if scalars["target"] is None else Target(**scalars["target"])
    condition = FlightCondition().changed(**scalars["condition"])
    model = Model.build(aircraft, condition, inflow, target, scalars["n_harmonics"])
    arrays = {
        name: np.frombuffer(parts[name], "<f8").reshape(shape).copy() for name, shape in scalars["shapes"].items()
    }
    wake = None
    if "wake" in parts:
        core = _core.SteadyWake.from_bytes(parts["wake"])
        wake = WakeInTrim.unpacked(model, core, scalars["counters"])
    asked = scalars["asked"]
    return Trim(
        model=model,
        problem=_core.TrimProblem.from_bytes(parts["problem"]),
        wake=wake,
        history=scalars["history"],
        notes=tuple(scalars["notes"]),
        settled=scalars["settled"],
        seconds=scalars["seconds"],
        asked=None if asked is None else FlightCondition().changed(**asked),
        control_tolerance=scalars["control_tolerance"],
        **arrays,
    )
