# SPDX-License-Identifier: MIT OR Apache-2.0
"""Motion that all blades make in turn, harmonic by harmonic of their azimuth, as a wake remembers it.

Circulation that is the same whenever a blade comes by a place trails the same vortices there, however fast each blade goes
through it: harmonics of the blades beyond the second move the mean and the tilt of the inflow too. A wake knows the blades by
their circulation. One mode, torsion where there is one, is given to it in all harmonics; what another does in turn is taken for
the motion of that mode which gives the circulation nearest to its own, over all azimuths and stations. Flapping moves the blade
tips, where the vortices begin, and what the second flap mode does along the span no other mode does: each is given itself up to
the harmonic near which it moves most.
"""

from __future__ import annotations

import numpy as np

from .marched import HARMONICS, Cause, Orbit
from .names import Places
from .sweeps import Driven, at_once

GIVEN = (2, 3)
"""Harmonics up to which the first flap modes are given themselves."""


def carriers(where: Places) -> tuple[int, list[int]]:
    """The modes that are given to the wake in turn: the one that stands for others, and the first flap modes."""

    def named(kind: str) -> list[int]:
        return [i for i, label in enumerate(where.labels) if label.startswith(kind)]

    flaps = named("flap")[: len(GIVEN)]
    return next(iter([*named("torsion"), *flaps]), 0), flaps


def served(causes: list[Cause], where: Places) -> tuple[list[Cause], list[Cause]]:
    """Causes that are given to the wake, and those for which others stand."""
    carrier, flaps = carriers(where)
    up_to = dict(zip(flaps, GIVEN, strict=False))

    def given(cause: Cause) -> bool:
        if cause.kind != "harmonic" or cause.index == carrier:
            return True
        return HARMONICS[cause.column][1] <= up_to.get(cause.index, 0)

    return [each for each in causes if given(each)], [each for each in causes if not given(each)]


def alike(orbit: Orbit, pulsed: list[Cause], others: list[Cause], once: tuple[list[Cause], np.ndarray]) -> np.ndarray:
    """How much (pulsed, others) of the causes given to the wake stands for each of the others.

    once: causes that are answered at once, and the bound circulation that they answer by azimuth.
    """
    found = np.zeros((len(pulsed), len(others)))
    if not others:
        return found
    carrier, _ = carriers(orbit.where)
    standing = [i for i, cause in enumerate(pulsed) if cause.of_blades and cause.index == carrier]
    weights = np.sqrt(orbit.model.area_weights)
    basis, wanted = (
        np.stack([(_circulation(orbit, cause, once) * weights).ravel() for cause in causes], axis=1)
        for causes in ([pulsed[i] for i in standing], others)
    )
    found[standing] = np.linalg.lstsq(basis, wanted, rcond=None)[0]
    return found


def _circulation(orbit: Orbit, cause: Cause, once: tuple[list[Cause], np.ndarray]) -> np.ndarray:
    """Circulation at once (n, n_stations) of a blade that goes round with the cause held at one."""
    turn, one = np.arange(orbit.n), np.ones((orbit.n, 1))
    found: np.ndarray = at_once(orbit, Driven.by(orbit, [cause], turn, one, 0.0 * one), once, turn)[:, 0]
    return found
