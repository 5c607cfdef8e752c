# SPDX-License-Identifier: MIT OR Apache-2.0
"""The trim equations of a model: the problem the core solves, when its residuals count as met, the scales of its unknowns.

Unknowns x, in order: controls (lateral, longitudinal, collective, pedal [m]; on a stand theta_0, theta_1c, theta_1s [rad]); of an
aircraft roll, pitch, heading against the track [rad], and what of its path is left free; with dynamic inflow lambda_0, lambda_1s,
lambda_1c; tail-rotor inflow; mean, cosines and sines of every blade mode. The core's layout names them all.
"""

from __future__ import annotations

import numpy as np

from .. import _core
from ..model import CompiledRotor

INCH = 0.0254
TOLERANCES = {"m/s2": 1e-4, "rad/s2": 1e-4, "rad": 1e-6, "1": 1e-6}
"""Residual below which an equation is met, by its unit. In rad: lateral convention, pitch, equivalent angle of a blade harmonic;
in 1: loads as coefficients over the solidity, inflow rates over the rotor speed."""
SCALES = {"m": 0.1 * INCH, "rad": np.radians(1.0), "rad/s": np.radians(1.0), "m/s": 1.0, "1": 1e-3}
"""A small change of an unknown, by its unit: 0.1 in of stick, 1 deg, 1 deg/s, 1 m/s, 1e-3 of inflow."""


def trim_problem(
    model: CompiledRotor, inflow_map: np.ndarray | None, wash: np.ndarray | None = None
) -> _core.TrimProblem:
    """The equations of what is asked of the model, on a held inflow map (n_azimuths, n_stations) or with dynamic inflow.

    wash: air of the wake at the parts of the airframe (4, 3) [m/s], body axes, in place of washes on the mean inflow.
    """
    n_azimuths = model.steps_per_revolution if inflow_map is None else inflow_map.shape[0]
    # the inflow of thin sections is twice as wide, that of the stations first
    mean = 0.0 if inflow_map is None else model.disk_mean(inflow_map[:, : model.stations.size])
    # at least four azimuths per highest harmonic
    fine = n_azimuths * int(np.ceil(4 * max(model.n_harmonics, 1) / n_azimuths))
    if inflow_map is not None and fine > n_azimuths:
        inflow_map = resample(inflow_map, fine)
    asked = model.question
    given = (asked.path, asked.free, asked.equations, model.n_harmonics, fine, inflow_map, mean)
    problem = _core.TrimProblem(*given)
    return problem if wash is None else problem.washed(wash)


def resample(inflow_map: np.ndarray, n: int) -> np.ndarray:
    """Trigonometric interpolation of a periodic map (n_azimuths, ...) to `n` azimuths."""
    from scipy.signal import resample as fourier_resample

    return np.ascontiguousarray(fourier_resample(inflow_map, n, axis=0))


def tolerances(model: CompiledRotor, problem: _core.TrimProblem) -> np.ndarray:
    """Residual of every equation below which it is met (n,)."""
    return np.array([TOLERANCES[unit] for _, unit in model.core.trim_layout(problem).equations])


def scales(model: CompiledRotor, problem: _core.TrimProblem) -> np.ndarray:
    """A small change of every unknown (n,); of a blade harmonic 0.1 deg."""
    layout = model.core.trim_layout(problem)
    scale = np.array([SCALES.get(unit, 1.0) for _, unit in layout.unknowns])
    for i, angle in enumerate(model.rotor["angle_per_coordinate"]):
        scale[layout.modes[i] : layout.modes[i + 1]] = np.radians(0.1) / angle
    return scale


def residual_norms(model: CompiledRotor, problem: _core.TrimProblem, x: np.ndarray) -> dict[str, float]:
    """Largest residuals by kind."""
    f = np.abs(model.core.trim_residual(problem, x))
    modes = model.core.trim_layout(problem).modes
    return {
        "linear": float(f[:3].max()),
        "angular": float(f[3:6].max()),
        "other": float(f[6 : modes[0]].max()),
        "harmonics": float(f[modes[0] :].max()),
    }


def unmet(model: CompiledRotor, problem: _core.TrimProblem, x: np.ndarray) -> str:
    """The equation that is met worst, with its residual."""
    f = model.core.trim_residual(problem, x)
    worst = int(np.nanargmax(np.abs(f) / tolerances(model, problem)))
    name, unit = model.core.trim_layout(problem).equations[worst]
    return f"equation {name} is not met (residual {f[worst]:.3g} {'-' if unit == '1' else unit})"


def inflow_of_states(model: CompiledRotor, problem: _core.TrimProblem, x: np.ndarray, n_azimuths: int) -> np.ndarray:
    """Inflow map (n_azimuths, n_stations) of a trim with dynamic inflow."""
    i = model.core.trim_layout(problem).inflow
    mean, sine, cosine = x[i : i + 3]
    psi = 2 * np.pi * np.arange(n_azimuths) / n_azimuths
    r = model.stations / model.rotor["radius"]
    found: np.ndarray = mean + np.outer(cosine * np.cos(psi) + sine * np.sin(psi), r)
    return found


def without_inflow(model: CompiledRotor, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray:
    """The unknowns of the same trim on a held inflow map."""
    i = model.core.trim_layout(problem).inflow
    return np.delete(x, slice(i, i + 3))


def dynamic_map(
    model: CompiledRotor, problem: _core.TrimProblem, x: np.ndarray, n_azimuths: int | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Inflow and circulation maps (n_azimuths, n_stations) of a trim with dynamic inflow."""
    n = n_azimuths or model.steps_per_revolution
    inflow_map = inflow_of_states(model, problem, x, n)
    psi = 2 * np.pi * np.arange(n) / n
    if model.remembers:
        return inflow_map, model.core.passages(problem, x, psi, inflow_map)["circulation"]
    q, q_dot = model.core.trim_motion(problem, x, n)
    y, _ = model.core.trim_state(problem, x, 0.0)
    hub = model.core.hub(y)
    controls = x[: model.n_controls]
    circulation = np.array(
        [model.core.section_circulation(hub, controls, (psi[k], q[k], q_dot[k]), inflow_map[k]) for k in range(n)]
    )
    return inflow_map, circulation
