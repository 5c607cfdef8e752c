# SPDX-License-Identifier: MIT OR Apache-2.0
"""Causes that a sweep gives to a wake, with what the blades do of themselves at each.

Hub, blade pitch, and coning and tilt of the disk are given. All other modes of the blades, and what all blades do in turn, follow
at once: they stand where the linear model whose wake only answers at once has its equilibrium. So the wake sees motion like that
of a flight, from a third of the causes.
"""

from __future__ import annotations

import numpy as np

from ..trim import INCH, Trim
from .build import derivatives, periodic, with_states
from .constant import decomposed, default_harmonics
from .instants import STICKS
from .marched import HARMONICS, Cause, Orbit
from .modes import base_name
from .multiblade import columns, transformation
from .names import MOTION, Places
from .realisation import Realisation
from .wake_states import coupled

AZIMUTHS = 72
"""Azimuths over which amplitudes are taken."""


def given(causes: list[Cause], where: Places) -> list[int]:
    """Which of the causes are given: those of the hub and the controls, and the first flap mode held still in the fixed frame."""
    first = next(label for label in where.labels if label.startswith("flap"))
    return [
        i
        for i, cause in enumerate(causes)
        if not cause.of_blades or (cause.kind == "blade" and where.labels[cause.index] == first)
    ]


def following(start: Trim, orbit: Orbit, causes: list[Cause], once: tuple[list[Cause], np.ndarray]) -> np.ndarray:
    """Values (causes, given) of all causes by each that is given; `once`: causes answered at once, with their answers."""
    where, names = orbit.where, columns(orbit.n_blades)
    nothing = Realisation.none(len(causes), orbit.n * once[1].shape[1] + 1)
    at_once = coupled(orbit, (causes, nothing), once, {})
    raw = with_states(start, derivatives(start, STICKS, orbit.n), at_once, STICKS, True)
    system = periodic(start, raw, STICKS, "multiblade")
    found = decomposed(system, default_harmonics(where.n_blades))
    states = [name for name, _ in found.states]
    place = {name: i for i, name in enumerate(states)}
    chosen = [causes[i] for i in given(causes, where)]
    held = [place[cause.name] for cause in chosen if cause.of_blades]
    still = [place[f"{cause.name}_rate"] for cause in chosen if cause.of_blades]
    body = [i for i, name in enumerate(states) if not _of_blades(base_name(name, int(found.harmonic[i])), where)]
    fast = np.setdiff1d(np.arange(len(states)), [*held, *still, *body])
    inverse = np.linalg.inv(found.a[np.ix_(fast, fast)])
    # B without the rates of the sticks, per radian of blade pitch
    by_sticks = (found.b - found.a @ found.rate)[:, :3] / INCH @ orbit.controls
    result = np.zeros((len(causes), len(chosen)))
    for k, cause in enumerate(chosen):
        if cause.kind == "hub":
            acting = found.a[fast, place[MOTION[cause.index]]]
        elif cause.kind == "control":
            acting = by_sticks[fast, cause.index]
        else:
            acting = found.a[fast, place[cause.name]]
        x = np.zeros(len(states))
        x[fast] = -inverse @ acting
        if cause.of_blades:
            x[place[cause.name]] = 1.0
        result[:, k] = _amplitudes(x, states, found.harmonic, where, causes, names)
        if not cause.of_blades:
            result[causes.index(cause), k] = 1.0
    return result


def _of_blades(name: str, where: Places) -> bool:
    return any(name.startswith(f"{label}_") for label in where.labels)


def _amplitudes(
    x: np.ndarray, states: list[str], harmonic: np.ndarray, where: Places, causes: list[Cause], names: tuple[str, ...]
) -> np.ndarray:
    """Amplitudes (causes,) of the blades' motion in states x of the mean and its harmonics."""
    psi = 2 * np.pi * np.arange(AZIMUTHS) / AZIMUTHS
    one = transformation(where.n_blades, psi)
    z = np.zeros((where.n_modes, AZIMUTHS, len(names)))
    for value, state, order in zip(x, states, harmonic, strict=True):
        name = base_name(state, int(order))
        for m, label in enumerate(where.labels):
            for c, column in enumerate(names):
                if name == f"{label}_{column}":
                    z[m, :, c] += value * (np.cos(order * psi) if order >= 0 else np.sin(-order * psi))
    blades = np.einsum("tbc,mtc->mtb", one, z)
    at = psi[:, None] + 2 * np.pi * np.arange(where.n_blades) / where.n_blades
    found = np.zeros(len(causes))
    for i, cause in enumerate(causes):
        if cause.kind == "blade":
            found[i] = z[cause.index, :, cause.column].mean()
        elif cause.kind == "harmonic":
            _, order, phase = HARMONICS[cause.column]
            found[i] = 2.0 * np.mean(blades[cause.index] * np.cos(order * at + phase))
    return found
