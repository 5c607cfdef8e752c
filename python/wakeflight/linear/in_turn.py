# SPDX-License-Identifier: MIT OR Apache-2.0
"""Motion that all blades make in turn, harmonic by harmonic of their azimuth, as a wake remembers it.

Circulation that is the same whenever a blade comes by a place is a steady vortex system there, however fast each blade goes through
it: harmonics of the blades beyond the second move the mean and the tilt of the inflow too. A wake knows the blades by their
circulation. One mode, torsion where there is one, is given to it in all harmonics; what another does beyond the first is taken for
the motion of that mode which gives the circulation nearest to its own, over all azimuths and stations.
"""

from __future__ import annotations

import numpy as np

from .marched import HARMONICS, Cause, Orbit
from .names import Places
from .sweeps import Driven, at_once

GIVEN = 2
"""Harmonic up to which the first flap mode is given itself: it moves the blade tips, where the vortices begin."""


def carriers(where: Places) -> tuple[int, int]:
    """The modes that are given to the wake in turn: the one that stands for others, and the first flap mode."""
    first = {kind: next((i for i, label in enumerate(where.labels) if label.startswith(kind)), None) for kind in KINDS}
    flap = first["flap"] or 0
    torsion = first["torsion"]
    return (flap if torsion is None else torsion), flap


KINDS = ("torsion", "flap")


def served(causes: list[Cause], where: Places) -> tuple[list[Cause], list[Cause]]:
    """Causes that are given to the wake, and those for which others stand."""
    carrier, flap = carriers(where)

    def given(cause: Cause) -> bool:
        if cause.kind != "harmonic" or cause.index == carrier:
            return True
        return cause.index == flap and HARMONICS[cause.column][1] <= GIVEN

    return [each for each in causes if given(each)], [each for each in causes if not given(each)]


def alike(
    orbit: Orbit, pulsed: list[Cause], others: list[Cause], once: tuple[list[Cause], np.ndarray]
) -> np.ndarray:
    """How much (pulsed, others) of the causes given to the wake stands for each of the others.

    once: causes that are answered at once, and the bound circulation that they answer by azimuth.
    """
    carrier, _ = carriers(orbit.where)
    standing = [i for i, cause in enumerate(pulsed) if cause.of_blades and cause.index == carrier]
    weights = np.sqrt(orbit.model.area_weights)
    basis, wanted = (
        np.stack([(_circulation(orbit, cause, once) * weights).ravel() for cause in causes], axis=1)
        for causes in ([pulsed[i] for i in standing], others)
    )
    found = np.zeros((len(pulsed), len(others)))
    found[standing] = np.linalg.lstsq(basis, wanted, rcond=None)[0]
    return found


def _circulation(orbit: Orbit, cause: Cause, once: tuple[list[Cause], np.ndarray]) -> np.ndarray:
    """Circulation at once (n, n_stations) of a blade that goes round with the cause held at one."""
    turn, one = np.arange(orbit.n), np.ones((orbit.n, 1))
    found: np.ndarray = at_once(orbit, Driven.by(orbit, [cause], turn, one, 0.0 * one), once, turn)[:, 0]
    return found
