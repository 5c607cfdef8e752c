# SPDX-License-Identifier: MIT OR Apache-2.0
"""The periodic linear system of a trim, from the derivatives along its revolution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..trim import Trim
from .instants import Instants, along, units_of
from .multiblade import columns, renumbered, rotation, to_multiblade
from .names import Places, places
from .outputs import outputs
from .periodic import PeriodicSystem

BLADES = ("multiblade", "individual")


@dataclass(frozen=True)
class Raw:
    """Blade by blade, over a whole revolution, SI: by states, inputs, rates of inputs, held inflow."""

    where: Places
    psi: np.ndarray
    a: np.ndarray
    b: np.ndarray
    b_rate: np.ndarray
    held: np.ndarray


def derivatives(start: Trim, inputs: tuple[str, ...], n: int) -> Raw:
    """Derivatives at `n` azimuths, computed for one passage of the blades and renumbered for the others."""
    where = places(start.model)
    if n < 8 or n % where.n_blades:
        raise InputError.of(
            "azimuths", n, f"must be a multiple of the number of blades, {where.n_blades}, and at least 8"
        )
    first: Instants = along(start, where, inputs, n)
    orders = [renumbered(where, part) for part in range(where.n_blades)]
    stations = (first.held.shape[2] - 1) // where.n_blades if first.held.shape[2] else 0
    held = []
    for part, order in enumerate(orders):
        mean = where.n_blades * stations
        blades = np.roll(np.arange(mean).reshape(where.n_blades, stations), -part, axis=0).ravel()
        held.append(first.held[:, order][:, :, [*blades, mean] if stations else []])
    return Raw(
        where,
        2 * np.pi * np.arange(n) / n,
        np.concatenate([first.a[:, order][:, :, order] for order in orders]),
        np.concatenate([first.b[:, order] for order in orders]),
        np.concatenate([first.b_rate[:, order] for order in orders]),
        np.concatenate(held),
    )


def periodic(
    start: Trim, raw: Raw, inputs: tuple[str, ...], blades: str, left_out: tuple[str, ...] = ()
) -> PeriodicSystem:
    """The periodic system in multiblade or individual coordinates, without states that are held."""
    where, omega = raw.where, start.model.omega
    multi = blades == "multiblade"
    names = columns(where.n_blades)
    a, b, b_rate = raw.a, raw.b, raw.b_rate
    if multi:
        left = rotation(where, raw.psi, omega)[2]
        (a, b), b_rate = to_multiblade(where, raw.psi, omega, a, b), left @ b_rate
    states = where.named(names if multi else [f"blade_{i + 1}" for i in range(where.n_blades)])
    given = units_of(inputs)
    si = np.array([each for _, _, each in given])
    b, b_rate = b * si, b_rate * si
    c, d, named = outputs(start.model, where, states, start.state(0.0), a, b)
    again = renumbered(where, 1)
    swap = np.eye(where.size)[again].T if not multi else np.diag(_signs(where, names))
    kept = np.array([i for i, (name, _) in enumerate(states) if name not in left_out])
    shown = np.array([i for i, (name, _) in enumerate(named) if name not in left_out])
    return PeriodicSystem(
        raw.psi,
        omega,
        a[:, kept][:, :, kept],
        b[:, kept],
        b_rate[:, kept],
        c[:, shown][:, :, kept],
        d[:, shown],
        tuple(states[i] for i in kept),
        tuple((name, unit) for name, unit, _ in given),
        tuple(named[i] for i in shown),
        where.n_blades,
        swap[np.ix_(kept, kept)],
    )


def _signs(where: Places, names: tuple[str, ...]) -> np.ndarray:
    """-1 of the differential coordinate, which changes sign when the next blade comes by."""
    sign = np.ones(where.size)
    blades = np.ones((where.n_blades, 2 * where.n_modes))
    if names[-1] == "d":
        blades[-1] = -1.0
    sign[where.blades] = blades.ravel()
    return sign
