# SPDX-License-Identifier: MIT OR Apache-2.0
"""The periodic linear system of a trim, from the derivatives along its revolution."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..errors import InputError
from ..trim import Trim
from .instants import STICKS, Instants, along, units_of
from .multiblade import columns, renumbered, rotation, to_multiblade
from .names import Places, places
from .outputs import outputs
from .periodic import PeriodicSystem
from .quasi_static import WakeGains, by_states
from .wake_states import WakeStates

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


def derivatives(start: Trim, inputs: tuple[str, ...], n: int, over_ground: bool = False) -> Raw:
    """Derivatives at `n` azimuths, computed for one passage of the blades and renumbered for the others."""
    where = places(start.model)
    if n < 8 or n % where.n_blades:
        raise InputError.of(
            "azimuths", n, f"must be a multiple of the number of blades, {where.n_blades}, and at least 8"
        )
    first: Instants = along(start, where, inputs, n, over_ground)
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


def without_rates(raw: Raw) -> Raw:
    """The same with the rates of the inputs not felt."""
    return replace(raw, b_rate=np.zeros_like(raw.b_rate))


def between(values: np.ndarray, n: int) -> np.ndarray:
    """A periodic quantity (m, ...) at `n` azimuths, a multiple of m: linear between, as inflow is in flight."""
    parts = n // values.shape[0]
    shares = (np.arange(parts) / parts).reshape(1, parts, *[1] * (values.ndim - 1))
    fine = values[:, None] + shares * (np.roll(values, -1, axis=0) - values)[:, None]
    return np.asarray(fine.reshape(n, *values.shape[1:]))


def with_wake(start: Trim, raw: Raw, gains: WakeGains, inputs: tuple[str, ...]) -> Raw:
    """The same with inflow that follows states and sticks at once."""
    where = raw.where
    n = raw.psi.size
    states, sticks = (between(each, n) for each in by_states(start, where, gains, columns(where.n_blades)))
    # states of the gains are multiblade coordinates of the blades
    a = raw.a + raw.held @ (states @ rotation(where, raw.psi, start.model.omega)[2])
    b = raw.b.copy()
    for i, name in enumerate(inputs):
        if name in STICKS:
            b[:, :, i] += np.einsum("tsl,tl->ts", raw.held, sticks[:, :, STICKS.index(name)])
    return replace(raw, a=a, b=b)


def with_states(start: Trim, raw: Raw, wake: WakeStates, inputs: tuple[str, ...], rates: bool) -> Raw:
    """The same with what a marched wake answers at once; `rates`: of the sticks too."""
    where = raw.where
    at_once, by_sticks, by_rates = (
        between(each, raw.psi.size) for each in (wake.at_once, wake.by_sticks, wake.by_stick_rates)
    )
    a = raw.a + raw.held @ (at_once @ rotation(where, raw.psi, start.model.omega)[2])
    b, b_rate = raw.b.copy(), raw.b_rate.copy()
    for i, name in enumerate(inputs):
        if name in STICKS:
            stick = STICKS.index(name)
            b[:, :, i] += np.einsum("tsl,tl->ts", raw.held, by_sticks[:, :, stick])
            if rates:
                b_rate[:, :, i] += np.einsum("tsl,tl->ts", raw.held, by_rates[:, :, stick])
    return replace(raw, a=a, b=b, b_rate=b_rate)


def periodic(
    start: Trim,
    raw: Raw,
    inputs: tuple[str, ...],
    blades: str,
    left_out: tuple[str, ...] = (),
    wake: WakeStates | None = None,
) -> PeriodicSystem:
    """The periodic system in multiblade or individual coordinates, without states that are held, with those of a wake."""
    where, omega = raw.where, start.model.omega
    multi = blades == "multiblade"
    names = columns(where.n_blades)
    a, b, b_rate, held = raw.a, raw.b, raw.b_rate, raw.held
    left = rotation(where, raw.psi, omega)[2]
    if multi:
        (a, b), b_rate, held = to_multiblade(where, raw.psi, omega, a, b), left @ b_rate, left @ held
    states = where.named(names if multi else [f"blade_{i + 1}" for i in range(where.n_blades)])
    again = renumbered(where, 1)
    swap = np.eye(where.size)[again].T if not multi else np.diag(_signs(where, names))
    slow = 0
    if wake is not None:
        slow = wake.order
        b_wake, c_wake = between(wake.b, raw.psi.size), between(wake.c, raw.psi.size)
        driven = b_wake if multi else b_wake @ left
        own = np.zeros((slow, len(inputs)))
        for i, name in enumerate(inputs):
            if name in STICKS:
                own[:, i] = wake.b_sticks[:, STICKS.index(name)]
        a = _beside(a, held @ c_wake, driven, wake.a)
        b, b_rate = _below(b, own), _below(b_rate, np.zeros_like(own))
        states = (*states, *((f"wake_{i + 1}", "1") for i in range(slow)))
        swap = np.block([[swap, np.zeros((where.size, slow))], [np.zeros((slow, where.size)), np.eye(slow)]])
    given = units_of(inputs)
    si = np.array([each for _, _, each in given])
    b, b_rate = b * si, b_rate * si
    c, d, named = outputs(start.model, where, states, start.state(0.0), a, b)
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
        slow,
    )


def _beside(a: np.ndarray, felt: np.ndarray, driven: np.ndarray, own: np.ndarray) -> np.ndarray:
    """A (n, s + k, s + k) with the states of a wake behind the others."""
    n, s, k = a.shape[0], a.shape[1], own.shape[0]
    whole = np.zeros((n, s + k, s + k))
    whole[:, :s, :s], whole[:, :s, s:], whole[:, s:, :s], whole[:, s:, s:] = a, felt, driven, own
    return whole


def _below(b: np.ndarray, own: np.ndarray) -> np.ndarray:
    """B (n, s + k, m) with that of a wake (k, m) below."""
    return np.concatenate([b, np.broadcast_to(own, (b.shape[0], *own.shape))], axis=1)


def _signs(where: Places, names: tuple[str, ...]) -> np.ndarray:
    """-1 of the differential coordinate, which changes sign when the next blade comes by."""
    sign = np.ones(where.size)
    blades = np.ones((where.n_blades, 2 * where.n_modes))
    if names[-1] == "d":
        blades[-1] = -1.0
    sign[where.blades] = blades.ravel()
    return sign
