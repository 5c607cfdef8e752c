# SPDX-License-Identifier: MIT OR Apache-2.0
"""The trim equations of a condition: the problem the core solves, when its residuals count as met, the scales of its unknowns.

Unknowns x, in order: lateral, longitudinal, collective, pedal [m]; roll, pitch, heading against the track [rad]; with dynamic
inflow lambda_0, lambda_1s, lambda_1c; tail-rotor inflow; mean, cosines and sines of every blade mode.
"""

from __future__ import annotations

import numpy as np

from . import _core
from .model import Model

INCH = 0.0254
LINEAR_TOLERANCE = 1e-4  # m/s2
ANGULAR_TOLERANCE = 1e-4  # rad/s2
HARMONIC_TOLERANCE = 1e-6  # rad, equivalent angle of a blade harmonic
OTHER_TOLERANCE = 1e-6  # rad of the lateral convention, inflow rates over the rotor speed
ROLL, PITCH, YAW = 4, 5, 6


def trim_problem(model: Model, inflow_map: np.ndarray | None, n_harmonics: int = 8) -> _core.TrimProblem:
    """The trim equations of the model's condition, on a held inflow map (n_azimuths, n_stations) or with dynamic inflow."""
    c = model.condition
    n_azimuths = model.steps_per_revolution if inflow_map is None else inflow_map.shape[0]
    mean = 0.0 if inflow_map is None else model.disk_mean(inflow_map)
    # at least four azimuths per highest harmonic
    fine = n_azimuths * int(np.ceil(4 * n_harmonics / n_azimuths))
    if inflow_map is not None and fine > n_azimuths:
        inflow_map = resample(inflow_map, fine)
    return _core.TrimProblem(
        c.speed,
        c.flight_path,
        c.turn_rate,
        c.bank or 0.0,
        c.sideslip or 0.0,
        c.bank_share,
        n_harmonics,
        fine,
        inflow_map,
        mean,
    )


def resample(inflow_map: np.ndarray, n: int) -> np.ndarray:
    """Trigonometric interpolation of a periodic map (n_azimuths, ...) to `n` azimuths."""
    from scipy.signal import resample as fourier_resample

    return np.ascontiguousarray(fourier_resample(inflow_map, n, axis=0))


def tolerances(model: Model, problem: _core.TrimProblem, n: int) -> np.ndarray:
    """Residual of every equation below which it is met (n,)."""
    modes, _, _ = model.core.trim_layout(problem)
    allowed = np.full(n, HARMONIC_TOLERANCE)
    allowed[:3], allowed[3:6], allowed[6 : modes[0]] = LINEAR_TOLERANCE, ANGULAR_TOLERANCE, OTHER_TOLERANCE
    return allowed


def scales(model: Model, problem: _core.TrimProblem, n: int) -> np.ndarray:
    """What counts as a small change of every unknown (n,): 0.1 in of stick, 1 deg, 1e-3 of inflow, 0.1 deg of a blade harmonic."""
    modes, inflow, _ = model.core.trim_layout(problem)
    scale = np.empty(n)
    scale[:4], scale[4:7], scale[inflow : modes[0]] = 0.1 * INCH, np.radians(1.0), 1e-3
    for i, angle in enumerate(model.rotor["angle_per_coordinate"]):
        scale[modes[i] : modes[i + 1]] = np.radians(0.1) / angle
    return scale


def residual_norms(model: Model, problem: _core.TrimProblem, x: np.ndarray) -> dict[str, float]:
    """Largest residuals by kind."""
    f = np.abs(model.core.trim_residual(problem, x))
    modes, _, _ = model.core.trim_layout(problem)
    return {
        "linear": float(f[:3].max()),
        "angular": float(f[3:6].max()),
        "other": float(f[6 : modes[0]].max()),
        "harmonics": float(f[modes[0] :].max()),
    }


def normalised(x: np.ndarray) -> np.ndarray:
    """`x` with roll and heading in (-pi, pi]."""
    x = x.copy()
    for i in (ROLL, YAW):
        # rounding at -pi does not turn a heading about
        turned = np.remainder(x[i] + np.pi - 1e-9, 2 * np.pi) - np.pi + 1e-9
        x[i] = min(turned, np.pi)
    return x


def unmet(model: Model, problem: _core.TrimProblem, x: np.ndarray) -> str:
    """The equation that is met worst, with its residual."""
    f = model.core.trim_residual(problem, x)
    modes, _, _ = model.core.trim_layout(problem)
    worst = int(np.nanargmax(np.abs(f) / tolerances(model, problem, f.size)))
    unit = "m/s2" if worst < 3 else "rad/s2" if worst < 6 else "rad" if worst == 6 or worst >= modes[0] else "-"
    return f"equation {model.core.trim_equations(problem)[worst]} is not met (residual {f[worst]:.3g} {unit})"


def dynamic_map(
    model: Model, problem: _core.TrimProblem, x: np.ndarray, n_azimuths: int | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Inflow and circulation maps (n_azimuths, n_stations) of a trim with dynamic inflow."""
    n = n_azimuths or model.steps_per_revolution
    _, i, _ = model.core.trim_layout(problem)
    mean, sine, cosine = x[i : i + 3]
    psi = 2 * np.pi * np.arange(n) / n
    r = model.stations / model.rotor["radius"]
    inflow_map = mean + np.outer(cosine * np.cos(psi) + sine * np.sin(psi), r)
    q, q_dot = model.core.trim_motion(problem, x, n)
    y, _ = model.core.trim_state(problem, x, 0.0)
    hub_velocity, hub_rates = model.core.hub(y)
    circulation = np.array(
        [
            model.core.section_circulation(hub_velocity, hub_rates, x[:4], psi[k], q[k], q_dot[k], inflow_map[k])[0]
            for k in range(n)
        ]
    )
    return inflow_map, circulation
