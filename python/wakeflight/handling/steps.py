# SPDX-License-Identifier: MIT OR Apache-2.0
"""What is read from answers to steps: control power, coupling between axes, heave and yaw after collective [ads33e2000, 3.3.9,
3.3.10]."""

from __future__ import annotations

import numpy as np

from ..linear import LinearModel
from ..linear.response import time_response
from .measured import Measured

STEP_SECONDS, HEAVE_SECONDS = 4.0, 5.0
LEAST_FIT, MOST_FIT = 0.97, 1.03
SLOWEST = 50.0
"""Longest time constant of heave that is told from none [s]."""


def stepped(model: LinearModel, stick: str, seconds: float, n: int = 1001) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Answers to an inch of stick from the first instant on: the mean of the rotor's turning, without its harmonics."""
    t = np.linspace(0.0, seconds, n)
    u = np.zeros((n, len(model.inputs)))
    u[:, model.places("input", stick)] = 1.0
    y, _ = time_response(model.matrices, t, u)
    return t, {name: y[:, i] for i, (name, _) in enumerate(model.outputs)}


def control_power(model: LinearModel, stick: str, rate: str, attitude: str) -> Measured:
    """Per inch of stick: largest rate within four seconds [rad/s], change of attitude after one second [rad]."""
    found = Measured()
    t, y = stepped(model, stick, STEP_SECONDS)
    found.found("peak_rate", y[rate][np.argmax(np.abs(y[rate]))])
    found.found("attitude_1s", np.interp(1.0, t, y[attitude]))
    return found


def coupling(model: LinearModel, stick: str, on_axis: str, off_axis: str) -> float:
    """Largest change of the other attitude within four seconds over the change of the attitude asked for at four seconds."""
    _, y = stepped(model, stick, STEP_SECONDS)
    return float(y[off_axis][np.argmax(np.abs(y[off_axis]))] / y[on_axis][-1])


def heave(model: LinearModel) -> Measured:
    """Fit of the rate of climb after a collective step by K e^(-tau s)/(T s + 1) over five seconds; yaw beside it.

    heave_gain K [m/s per inch], heave_time T [s], heave_delay tau [s], heave_fit: sum of squares of the fit about its mean over
    that of the answer. yaw_collective_1, yaw_collective_3: yaw rate at its first peak before three seconds (at one second where
    it has none), and its change from there to three seconds, over the rate of climb at three seconds [rad/m].
    """
    from scipy.optimize import least_squares

    found = Measured()
    t, y = stepped(model, "collective", HEAVE_SECONDS)
    climb = y["climb_rate"] - y["climb_rate"][0]

    def fit(x: np.ndarray) -> np.ndarray:
        gain, constant, delay = x
        late = np.maximum(t - delay, 0.0)
        found: np.ndarray = gain * (1.0 - np.exp(-late / constant))
        return found

    scale = max(float(np.abs(climb).max()), 1e-12)
    best = least_squares(
        lambda x: (fit(x) - climb) / scale,
        (climb[-1], 1.0, 0.05),
        bounds=([-np.inf, 1e-3, 0.0], [np.inf, SLOWEST, 1.0]),
        x_scale=(scale, 1.0, 0.1),
    )
    gain, constant, delay = best.x
    fitted, mean = fit(best.x), climb.mean()
    share = float(np.sum((fitted - mean) ** 2) / np.sum((climb - mean) ** 2))
    found.found("heave_fit", share)
    names = ("heave_gain", "heave_time", "heave_delay")
    if constant > 0.99 * SLOWEST:
        found.none(f"the rate of climb does not settle: the time constant exceeds {SLOWEST:g} s", *names)
    elif not LEAST_FIT <= share <= MOST_FIT:
        found.none(
            f"the rate of climb is no first-order answer: fit {share:.3f}, allowed {LEAST_FIT} to {MOST_FIT}", *names
        )
    else:
        for name, value in zip(names, (gain, constant, delay), strict=True):
            found.found(name, value)
    _yaw(found, t, y, climb)
    return found


def _yaw(found: Measured, t: np.ndarray, y: dict[str, np.ndarray], climb: np.ndarray) -> None:
    """Yaw after collective."""
    third = float(np.interp(3.0, t, climb))
    names = ("yaw_collective_1", "yaw_collective_3")
    if abs(third) < 1e-9:
        found.none("no rate of climb after three seconds", *names)
        return
    r, early = y["r"], t < 3.0
    size = np.abs(r[early])
    peaks = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:]))
    first = float(r[peaks[0] + 1]) if peaks.size else float(np.interp(1.0, t, r))
    change = float(np.interp(3.0, t, r)) - first
    found.found(names[0], first / third)
    found.found(names[1], (change if first > 0 else -change) / third)
