# SPDX-License-Identifier: MIT OR Apache-2.0
"""Data of the three-dimensional view: wakes, blades, attitude and path of every snapshot, quantised and as text.

Lengths over R and hub axes (x aft, y right, z up), as in every figure. What a view needs of dynamic inflow, which has
no wake, is its inflow over the disk: mean and first harmonics.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping
from importlib import resources
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np

from ..results import frames
from ..results.disk import area_weights, element_widths

if TYPE_CHECKING:
    import xarray as xr

LABELS = {"dynamic": "dynamic inflow", "relaxation": "relaxation", "time-marching": "time marching"}
# largest number of an Int16; quantised lengths are exact to about a millimetre
FULL = 32767


NEEDED = ("azimuth", "flap", "lead", "inflow_mean")


def viewable(runs: Mapping[str, xr.Dataset]) -> bool:
    """Whether runs say enough to be looked at in three dimensions: how their blades stand, and common moments."""
    told = all("geometry" in run.attrs and all(name in run for name in NEEDED) for run in runs.values())
    return told and _moments(runs).size > 0


def rotor(run: xr.Dataset) -> dict[str, float]:
    """What the view draws of the rotor: shaft_tilt [rad], rotation, hinge_offset, root_cutout and chord over R."""
    shape, radius = frames.geometry(run), float(run.attrs["radius"])
    lengths = {name: shape[name] / radius for name in ("hinge_offset", "root_cutout", "chord")}
    return {"shaft_tilt": shape["shaft_tilt"][0], "rotation": shape["rotation"], **lengths}


def script() -> str:
    """The program of the view, to stand in the page."""
    return (resources.files(__package__) / "templates" / "viewer.js").read_text(encoding="utf-8")


def data(runs: Mapping[str, Mapping[str, xr.Dataset]], rotor: Mapping[str, float]) -> str:
    """JSON of every manoeuvre's models; `rotor`: see `rotor`, the sense of rotation may be left out."""
    maneuvers = {}
    for maneuver, models in runs.items():
        moments = _moments(models)
        wakes = [run for run in models.values() if "wake" in run]
        # without a wake a scale of nothing
        strength = np.concatenate([run["wake_circulation"].values.ravel() for run in wakes] or [np.zeros(1)])
        maneuvers[maneuver] = {
            "time": _floats(moments),
            "circulation": [float(strength.min()), float(strength.max())],
            "inflow": _inflow_range([run for run in models.values() if "wake" not in run]),
            "models": [_model(name, run, moments, float(np.abs(strength).max())) for name, run in models.items()],
        }
    first = next(iter(next(iter(runs.values())).values()))
    payload = {
        "radius": float(first.attrs["radius"]),
        "omega": float(first.attrs["omega"]),
        "rotor": dict(rotor),
        "colours": [matplotlib.colors.to_hex(c) for c in matplotlib.colormaps["plasma"](np.linspace(0.0, 0.92, 64))],
        "maneuvers": maneuvers,
    }
    # it stands in a page: no text in it ends its element
    return json.dumps(payload, allow_nan=False).replace("<", "\\u003c")


def _moments(models: Mapping[str, xr.Dataset]) -> np.ndarray:
    """Times [s] of the snapshots common to all models with a wake."""
    marks = [np.round(run["snapshot_revolution"].values, 6) for run in models.values() if "snapshot_revolution" in run]
    first = next(iter(models.values()))
    omega = float(first.attrs["omega"])
    if not marks:
        shortest = min(float(run["time"][-1]) for run in models.values())
        return np.arange(0.0, shortest + 1e-9, 0.5 * np.pi / omega)
    common = sorted(set(marks[0]).intersection(*marks[1:]))
    return np.asarray(common) * 2 * np.pi / omega


def _model(name: str, run: xr.Dataset, moments: np.ndarray, strongest: float) -> dict[str, Any]:
    """One model at the moments: state, blades, path, and its wake or its inflow over the disk."""
    rows = np.array([int(np.argmin(np.abs(run.time.values - t))) for t in moments])
    radius = float(run.attrs["radius"])
    path = np.stack([run[n].values for n in ("north", "east", "down")], axis=1) / radius
    model: dict[str, Any] = {
        "name": LABELS.get(name, name),
        "attitude": _floats(np.stack([run[n].values[rows] for n in ("roll", "pitch", "yaw")], axis=1)),
        "path": _floats(path[rows]),
        "blades": _floats(
            np.stack([run[n].values[rows] for n in ("azimuth", "flap", "lead")], axis=2)
        ),  # (moments, blade, 3)
        "inflowMean": _floats(run["inflow_mean"].values[rows]),
        "nBlades": int(run.sizes["blade"]),
    }
    if "wake" not in run:
        return {**model, "disk": _floats(disk_inflow(run, rows))}
    marks = run["snapshot_revolution"].values * 2 * np.pi / float(run.attrs["omega"])
    chosen = [int(np.argmin(np.abs(marks - t))) for t in moments]
    nodes = run["wake"].values[chosen] / radius
    reach = float(np.abs(nodes).max())
    return {
        **model,
        "nNodes": int(run.sizes["age"]),
        "turns": float(run["age"][-1]) / (2 * np.pi),
        "reach": reach,
        "strongest": strongest,
        "wake": _shorts(nodes / reach),
        "strength": _shorts(run["wake_circulation"].values[chosen] / strongest),
    }


def disk_inflow(run: xr.Dataset, rows: np.ndarray) -> np.ndarray:
    """Mean, cosine and sine of the inflow at some records (n, 3): least squares by area of λ0 + r (λ1c cos ψ + λ1s sin ψ)."""
    station = run["station"].values
    root = np.sqrt(area_weights(station, element_widths(station)))
    fits = []
    for k in rows:
        psi = run["azimuth"].values[k][:, None]
        columns = [np.ones((psi.size, station.size)), np.cos(psi) * station, np.sin(psi) * station]
        matrix = np.stack([(column * root).ravel() for column in columns], axis=1)
        fits.append(np.linalg.lstsq(matrix, (run["inflow"].values[k] * root).ravel(), rcond=None)[0])
    return np.array(fits)


def _inflow_range(runs: list[xr.Dataset]) -> list[float]:
    if not runs:
        return [0.0, 1.0]
    return [min(float(run["inflow"].min()) for run in runs), max(float(run["inflow"].max()) for run in runs)]


def _floats(values: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode("ascii")


def _shorts(shares: np.ndarray) -> str:
    """Numbers between -1 and 1 as 16-bit integers."""
    return base64.b64encode(np.rint(FULL * shares).astype("<i2").tobytes()).decode("ascii")
