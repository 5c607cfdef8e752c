# SPDX-License-Identifier: MIT OR Apache-2.0
"""How far a rotor has turned in a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr


def revolutions(run: xr.Dataset) -> np.ndarray:
    """Rotor revolutions from the start to every recorded time (time,).

    A recorded speed is linear between two instants but for where its rate jumps: the trapezoids of it.
    """
    time = run.time.values
    if "rotor_speed" not in run:
        turned: np.ndarray = time * float(run.attrs["omega"]) / (2 * np.pi)
        return turned
    speed = run.rotor_speed.values
    turns = 0.5 * (speed[1:] + speed[:-1]) * np.diff(time) / (2 * np.pi)
    return np.concatenate([[0.0], np.cumsum(turns)])
