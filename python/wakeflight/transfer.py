# SPDX-License-Identifier: MIT OR Apache-2.0
"""A flight that goes on with another inflow model: the moment of one simulation as a moment of another.

Airframe, blades and sticks go over as they are. A wake is that of the other's trim, carried over a few revolutions by the motion
of the hub as it is now; the states of dynamic inflow are the mean and the first harmonics of what the wake gave.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import InputError
from .exchange import Exchange
from .snapshot import Snapshot
from .trim import INCH

if TYPE_CHECKING:
    from .simulation import Simulation

CARRIED_TURNS = 4
"""Revolutions over which a wake is carried by the motion that it finds: as many as it has turns."""


def harmonics(sim: Simulation, azimuth: np.ndarray, inflow: np.ndarray) -> np.ndarray:
    """Mean, sine and cosine of the inflow (n_blades, n_stations) of a moment (3,): least squares by area.

    azimuth (n_blades,) [rad]: of the blades as recorded, their lag left out: a few hundredths of the harmonics.

    What is fitted is lambda_0 + r/R (lambda_1s sin psi + lambda_1c cos psi), the distribution of dynamic inflow.
    """
    model = sim.model
    psi = np.asarray(azimuth)[:, None]
    station = np.asarray(model.stations)[None, :] / model.rotor["radius"]
    columns = (np.ones((psi.size, station.size)), np.sin(psi) * station, np.cos(psi) * station)
    root = np.sqrt(model.area_weights)[None, :]
    matrix = np.stack([(column * root).ravel() for column in columns], axis=1)
    found: np.ndarray = np.linalg.lstsq(matrix, (inflow * root).ravel(), rcond=None)[0]
    return found


def carried(sim: Simulation, other: Simulation, inflow_states: np.ndarray) -> Snapshot:
    """The present moment of `sim` as the first moment of `other`, which rests at its start; neither is changed.

    The moment must be at a whole revolution: there the blades stand as where a flight begins. inflow_states (3,): mean, sine and
    cosine of the inflow now, for a model in which they are states.
    """
    if sim.steps % sim.model.steps_per_revolution:
        raise InputError.of("step", sim.steps, "must end a revolution for a flight to go on with another inflow model")
    before, after = sim.model.layout, other.model.layout
    if (before["modal"], before["modal_rate"]) != (after["modal"], after["modal_rate"]):
        raise InputError.of("inflow", other.model.inflow.name, "must be of an aircraft with the same blades")
    y, now = other.y, sim.y
    shared = after["inflow"][0]
    y[:shared] = now[:shared]
    if other.model.inflow.is_dynamic:
        y[slice(*after["inflow"])] = inflow_states
    y[slice(*after["tail_inflow"])] = now[slice(*before["tail_inflow"])]
    kept = sim.snapshot()
    hands = INCH * (other.start.stick_si / INCH + (sim.hands / INCH - other.start.stick_si / INCH))
    scalars: dict[str, Any] = {
        "step": 0,
        "stick": hands.tolist(),
        "stabilator": kept.scalars["stabilator"],
        **other.clock.memory(),
    }
    parts = {
        "y": np.asarray(y, "<f8").tobytes(),
        "integrator": other.solver.memory(),
        "exchange": bytes(_moved(other, y, hands).core.to_bytes()),
        **({"control": kept.parts["control"]} if "control" in kept.parts else {}),
    }
    return Snapshot(dict(other.configuration), scalars, parts)


def _moved(other: Simulation, y: np.ndarray, hands: np.ndarray) -> Exchange:
    """A copy of the exchange at the start of `other`; a marching wake, carried by the hub's motion in `y`."""
    exchange, model, start = other.exchange.copy(), other.model, other.start
    if not model.inflow.is_marching:
        return exchange
    n = model.steps_per_revolution
    q, q_dot = model.core.trim_motion(start.problem, start.x, n)
    first = exchange.step_index
    for step in range(first + 1, first + 1 + CARRIED_TURNS * n):
        rows = exchange.rows(step)
        exchange.reach(step, y, hands, np.zeros(4), (q[rows], q_dot[rows]))
    exchange.core.restart()
    return exchange
