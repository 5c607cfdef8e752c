# SPDX-License-Identifier: MIT OR Apache-2.0
"""Constants of a three-state inflow identified from a free wake: gains, apparent masses, wake distortion [pitt1981].

M lambda'/omega + L^-1 (lambda - K (p, q)/omega) = C, lambda = lambda_0 + (lambda_1s sin psi + lambda_1c cos psi) r/R and
C = (C_T, C_roll, C_pitch) of the air loads. Blade pitch acts through C alone: L(i w) = lambda_theta C_theta^-1, three by three.
Rates of the hub move the wake besides: K = (lambda_rate - L C_rate) omega, what they do at loads that stay. L and K are those of
w = 0, M is the slope of L(i w)^-1 by i w/omega over the lowest frequencies.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..arguments import checked
from ..errors import InputError
from ..trim import Trim
from .marched import Cause, Orbit, causes_of
from .names import places
from .quasi_static import CONTROLS

if TYPE_CHECKING:
    import xarray as xr

INFLOW = ("lambda_0", "lambda_1s", "lambda_1c")
LOADS = ("thrust", "roll", "pitch")
RATES = ("p", "q")
BAND = np.linspace(0.01, 0.15, 8)
"""Frequencies over the rotor speed from which apparent masses are taken."""


@checked
def inflow_constants(start: Trim) -> xr.Dataset:
    """Three-state inflow constants of the wake that would be marched from a trim on a free wake, about its periodic orbit.

    `L` (inflow, load), `M` (load, inflow) with time by azimuth, `K` (inflow, rate): inflow over the tip speed by p/omega and
    q/omega at held loads; `K_p` of lambda_1s by p and `K_q` of lambda_1c by q, positive where the inflow grows on the side that
    goes down; `lag` [s], L M over the rotor speed, `tau_0` of the mean and `tau_1` of the tilts from its diagonal; `misfit`: what
    the constants leave of the answers to each cause at each of the frequencies; attribute `stable`: whether three states with
    these constants are, which is not so where a tilt of the inflow overshoots. Loads: thrust over rho A (omega R)^2, moments over
    that and R, roll of more lift on the right (azimuth 90 deg), pitch of more lift aft. Of a clockwise rotor all is that of its
    mirror image.
    """
    try:
        dynamic = start.inflow.is_dynamic
    except AttributeError:
        raise InputError.of("start", type(start).__name__, "must be what wf.trim returned") from None
    if dynamic:
        raise InputError.of(
            "start", start.inflow.name, "must be a trim on a free wake: dynamic inflow has constants already"
        )
    orbit = Orbit(start, places(start.model))
    slow, _ = causes_of(orbit.where, [])
    causes = {cause.name: cause for cause in slow}
    w = np.concatenate([[0.0], BAND])
    answers = [_answers(orbit, causes[name], w) for name in (*CONTROLS, *RATES)]
    inflow, loads = (np.stack(each, axis=-1) for each in zip(*answers, strict=True))
    return constants((inflow, loads), w, orbit.omega)


def constants(answers: tuple[np.ndarray, np.ndarray], w: np.ndarray, omega: float) -> xr.Dataset:
    """L, M, K and the rest from inflow and loads (n, 3, 5) by three controls and two rates [s] at frequencies `w` over the rotor
    speed, zero first."""
    import xarray as xr

    inflow, loads = answers
    gain = inflow[:, :, :3] @ np.linalg.inv(loads[:, :, :3])
    k = omega * (inflow[:, :, 3:] - gain @ loads[:, :, 3:])
    static = gain[0].real
    inverse = np.linalg.inv(gain)
    mass = np.einsum("n,nij->ij", w, inverse.imag) / np.sum(w**2)
    distortion = k[0].real
    model = np.linalg.inv(np.linalg.inv(static) + 1j * w[:, None, None] * mass)
    # K acts within the lag: lambda = (1 + i w L M)^-1 (L C + K rate)
    said = model @ loads
    said[:, :, 3:] += model @ np.linalg.inv(static) @ (distortion / omega)
    misfit = np.linalg.norm(said - inflow, axis=1) / np.linalg.norm(inflow, axis=1)
    lag = static @ mass / omega
    found = xr.Dataset(
        {
            "L": (("inflow", "load"), static, {"units": "1"}),
            "M": (("load", "inflow"), mass, {"units": "1", "long_name": "apparent mass, time by azimuth"}),
            "lag": (("inflow", "inflow_"), lag, {"units": "s", "long_name": "L M/omega"}),
            "K": (
                ("inflow", "rate"),
                distortion,
                {"units": "1", "long_name": "wake distortion by rate over rotor speed"},
            ),
            "K_p": ((), distortion[1, 0], {"units": "1"}),
            "K_q": ((), distortion[2, 1], {"units": "1"}),
            "tau_0": ((), lag[0, 0], {"units": "s"}),
            "tau_1": ((), 0.5 * (lag[1, 1] + lag[2, 2]), {"units": "s"}),
            "misfit": (("frequency", "cause"), misfit, {"units": "1"}),
        },
        attrs={"stable": int(np.linalg.eigvals(lag).real.min() > 0.0), "omega": omega},
        coords={
            "frequency": ("frequency", omega * w, {"units": "rad/s"}),
            "inflow": list(INFLOW),
            "inflow_": list(INFLOW),
            "load": list(LOADS),
            "rate": list(RATES),
            "cause": [*CONTROLS, *RATES],
        },
    )
    return found


def _answers(orbit: Orbit, cause: Cause, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Inflow (n, 3) and loads (n, 3) at frequencies `w` over the rotor speed, by a cause."""
    answer, model = orbit.later(cause), orbit.model
    steps = np.arange(answer.mean.size)
    psi = 2 * np.pi * (steps[:, None] / orbit.n + np.arange(orbit.n_blades) / orbit.n_blades)
    station, radius = np.asarray(model.stations), float(model.rotor["radius"])
    x, areas = station / radius, model.area_weights
    (aft, right, _), _ = model.core.hub(orbit.y)
    tangential = orbit.omega * station + (right * np.cos(psi) - aft * np.sin(psi))[:, :, None]
    # lift of an element, over rho A (omega R)^2
    lift = (
        answer.circulation * tangential * np.asarray(model.rotor["widths"]) / (np.pi * radius**2 * model.tip_speed**2)
    )
    inflow = answer.inflow[:, :, : station.size]
    shapes = np.ones_like(psi), np.sin(psi), np.cos(psi)
    moment = areas @ x**2
    found = [np.mean((inflow @ areas) * shapes[0], axis=1)]
    found += [2.0 * np.mean((inflow @ (areas * x)) * shape, axis=1) / moment for shape in shapes[1:]]
    loads = [np.sum(lift @ (x if i else np.ones_like(x)) * shape, axis=1) for i, shape in enumerate(shapes)]
    turn = np.exp(-2j * np.pi / orbit.n * w[:, None] * steps)
    pulse = turn @ orbit.pulse(steps)[0]
    said = [turn @ np.stack(each, axis=1) / pulse[:, None] for each in (found, loads)]
    return said[0], said[1]
