# SPDX-License-Identifier: MIT OR Apache-2.0
"""Linear models of a rotor that is constant in speed over the ground: its azimuth and speed are eliminated, exactly.

With k the rate about the shaft by the rates of the body, in the sense of the rotor, the speed about the airframe is less by
k . d_omega, for good: d_Omega = -k . d_omega. The azimuth is off by the integral of that. A trim that is turned by d_psi is a
trim: what a state has at the azimuth of its blades is taken off, d* y = d_y - y' d_psi, and with M y'' Omega + K y' + F_psi = 0
along the trim

    M (d* y)_dot + K d* y + (F_Omega + M y') d_Omega + F_Omega_dot d_Omega_dot = 0,

in which the azimuth does not occur.
"""

from __future__ import annotations

import numpy as np

from ..errors import InputError
from ..rotor_speed import CONSTANT, OVER_GROUND

SPEEDS = (CONSTANT, OVER_GROUND)
"""What the rotor of a linear model may be constant in speed relative to."""


def check_speed(rotor_speed: str, wake: str | None) -> None:
    """Refuse a speed that no linear model has, and a wake whose answers to it are not known."""
    if rotor_speed not in SPEEDS:
        raise InputError.choice("rotor_speed", rotor_speed, SPEEDS)
    if rotor_speed == OVER_GROUND and wake not in ("dynamic", "frozen"):
        why = "no other knows what the wake does as the speed changes"
        raise InputError.of("wake", wake, f"allowed with rotor_speed={OVER_GROUND!r}: dynamic, frozen; {why}")


def without_turn(
    stiffness: np.ndarray, mass: np.ndarray, y_dot: np.ndarray, turn: tuple[int, int], rates: np.ndarray, omega: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """K and M without azimuth and speed, and the places of the states that are left, for F with both as states.

    y_dot: rates of the trim [1/s]; turn: places of azimuth and speed; rates: those of p, q, r; omega: speed of the trim [rad/s].
    """
    azimuth, speed = turn
    along = y_dot / omega
    along[[azimuth, speed]] = 0.0
    # the row of the speed: Omega_dot + k . omega_dot = 0
    by_rates = mass[speed, rates]
    stiffness[:, rates] -= np.outer(stiffness[:, speed] + mass @ along, by_rates)
    mass[:, rates] -= np.outer(mass[:, speed], by_rates)
    left = np.setdiff1d(np.arange(len(mass)), turn)
    return stiffness[np.ix_(left, left)], mass[np.ix_(left, left)], left
