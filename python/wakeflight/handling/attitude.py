# SPDX-License-Identifier: MIT OR Apache-2.0
"""Bandwidth and phase delay of an attitude that answers a stick [ads33e2000, 3.3.2.1].

w_180: phase -180 deg. Phase bandwidth: phase -135 deg. Gain bandwidth: 6 dB above the gain at w_180. Bandwidth: the smaller of
both for a rate response. Phase delay: -(phase(2 w_180) + pi)/(2 w_180), and by the slope of a line through the phase from w_180
to 2 w_180, of which it is half.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .measured import Measured

LOWEST, HIGHEST = 0.3, 80.0
"""Frequencies between which crossings are looked for [rad/s]."""
REFERENCE = 2.0
"""Frequency [rad/s] at which the phase of an attitude is known to lie between +90 and -270 deg."""
MARGIN_DB = 6.0
NAMES = ("bandwidth", "bandwidth_phase", "bandwidth_gain", "w_180", "phase_delay", "phase_delay_fit")

Response = Callable[[np.ndarray], np.ndarray]
"""Complex response at frequencies [rad/s]."""


def attitude_metrics(response: Response) -> Measured:
    """Bandwidths, w_180 [rad/s] and phase delays [s] of attitude by stick."""
    from scipy.optimize import brentq

    found = Measured()
    w = np.geomspace(LOWEST, 2.2 * HIGHEST, 1200)
    phase = _phase(response(w), w)

    def at(frequency: float, known: float) -> float:
        """Phase near a known one."""
        value = float(np.angle(response(np.array([frequency])))[0])
        return value + 2 * np.pi * round((known - value) / (2 * np.pi))

    def crossing(level: float, i: int) -> float:
        """Frequency at which the phase crosses `level` between the points i and i + 1."""
        return float(brentq(lambda x: at(x, phase[i]) - level, w[i], w[i + 1], xtol=1e-11))

    below = np.flatnonzero((phase[:-1] > -np.pi) & (phase[1:] <= -np.pi) & (w[1:] <= HIGHEST))
    if not below.size:
        found.none(f"the phase does not reach -180 deg between {LOWEST:g} and {HIGHEST:g} rad/s", *NAMES)
        return found
    first = int(below[0])
    w_180 = crossing(-np.pi, first)
    found.found("w_180", w_180)
    end = int(np.searchsorted(w, w_180))
    falls = np.flatnonzero((phase[: end - 1] > -0.75 * np.pi) & (phase[1:end] <= -0.75 * np.pi))
    if falls.size:
        found.found("bandwidth_phase", crossing(-0.75 * np.pi, int(falls[-1])))
    else:
        where = f"between {LOWEST:g} rad/s and {w_180:.3g} rad/s, where it is -180 deg"
        found.none(f"the phase does not fall through -135 deg {where}", "bandwidth_phase")
    level = np.log(np.abs(response(np.array([w_180])))[0]) + MARGIN_DB / 20.0 * np.log(10.0)
    gain = np.log(np.abs(response(w[:end]))) - level
    above = np.flatnonzero((gain[:-1] > 0.0) & (gain[1:] <= 0.0))
    if above.size:
        i = int(above[-1])
        root = brentq(lambda x: np.log(np.abs(response(np.array([x])))[0]) - level, w[i], w[i + 1], xtol=1e-11)
        found.found("bandwidth_gain", root)
    else:
        found.none(f"the gain is nowhere 6 dB above that at {w_180:.3g} rad/s", "bandwidth_gain")
    _bandwidth(found)
    j = int(np.argmin(np.abs(w - 2 * w_180)))
    found.found("phase_delay", -(at(2 * w_180, phase[j]) + np.pi) / (2 * w_180))
    fine = np.linspace(w_180, 2 * w_180, 100)
    found.found("phase_delay_fit", -0.5 * np.polyfit(fine, np.interp(fine, w, phase), 1)[0])
    return found


def _bandwidth(found: Measured) -> None:
    """The smaller of the two; none where one of them does not exist."""
    missing = [name for name in ("bandwidth_phase", "bandwidth_gain") if name in found.reasons]
    if missing:
        found.none(found.reasons[missing[0]], "bandwidth")
        return
    found.found("bandwidth", min(found.values["bandwidth_phase"], found.values["bandwidth_gain"]))


def _phase(values: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Phase without jumps, between -270 and 90 deg at the frequency of reference."""
    phase = np.unwrap(np.angle(values))
    here = float(np.interp(REFERENCE, w, phase))
    found: np.ndarray = phase - 2 * np.pi * np.round((here + 0.5 * np.pi) / (2 * np.pi))
    return found
