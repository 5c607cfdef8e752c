# SPDX-License-Identifier: MIT OR Apache-2.0
"""What an accelerometer shows in a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arguments import checked
from ..errors import InputError
from ..units import STANDARD_GRAVITY

if TYPE_CHECKING:
    import xarray as xr


@checked
def load_factor(run: xr.Dataset) -> np.ndarray:
    """Load factor n_z = (g cos theta cos phi - (dw/dt + p v - q u))/g (time,) at the body origin, up positive.

    From the recorded motion, dw/dt by central differences: it shows vibration up to half the rate of the record. -force_z over
    the weight is not it: force_z has the weight and inertia of the blades in it, which is 7 % of a UH-60A.
    """
    if "time" not in run.dims or not {"u", "v", "w", "p", "q", "roll", "pitch"} <= set(run.data_vars):
        raise InputError.of("run", run.attrs.get("maneuver", "result"), "must be the Dataset of a flight")
    u, v, w, p, q = (run[name].values for name in ("u", "v", "w", "p", "q"))
    gravity = STANDARD_GRAVITY * np.cos(run["pitch"].values) * np.cos(run["roll"].values)
    slope = np.gradient(w, run["time"].values) if w.size > 1 else np.zeros(1)
    found: np.ndarray = (gravity - (slope + p * v - q * u)) / STANDARD_GRAVITY
    return found
