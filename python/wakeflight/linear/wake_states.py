# SPDX-License-Identifier: MIT OR Apache-2.0
"""A marched wake as part of a linear model: what it answers at once, and states for what it answers later.

lambda(psi, r, t) = D(psi, r) u + C(psi, r) x, x_dot = A x + B(psi) u: u are motion of the hub, blade pitch and what the blades
do by their modes; the maps are by azimuth. D holds every mode of every blade. What is answered later is so to motion that the
fixed frame sees as slow: multiblade coordinates, and the second harmonic that all blades make in turn, whose amplitude is twice
the mean of its product with their motion. A flight carries the inflow on over a step, so that what is felt at an azimuth is the
map there; where it holds it (`extrapolate=False`), that is the mean of the maps there and a step before, half a step late.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..errors import InputError, NumericalFailure
from ..trim import Trim
from .in_turn import alike, served
from .marched import Answer, Cause, Orbit, causes_of
from .multiblade import columns, transformation
from .names import MOTION, Places
from .realisation import FINE, Realisation, coefficients, filtered, realised
from .sweeps import Driven, at_once

COUNTS = (28, 40, 56)
"""Laguerre functions, of which the first number that is enough is taken; their pole is the rotor speed. At a time t they tell
motion up to the frequency pole sqrt(2 count/(pole t) - 1): a slow flight, whose wake answers late, needs more."""
ENOUGH = 0.03
"""What they leave of the answers they are fitted to, over those, with which more are not tried: from 0.016 on (80 kt) more
functions move responses by less than a per cent."""
FITTED = 0.05
"""The same beyond which the model is refused: with 0.15 (28 functions at 40 kt) blades and wake together are unstable in the
model and not in flight."""


@dataclass(frozen=True)
class WakeStates:
    """Felt inflow of all stations of all blades and its mean (lambdas), by states in multiblade coordinates and sticks, SI.

    at_once (n, lambdas, s), by_sticks and by_stick_rates (n, lambdas, 4); states of the wake: a (k, k), b (n, k, s), b_sticks
    (k, 4), c (n, lambdas, k).
    """

    at_once: np.ndarray
    by_sticks: np.ndarray
    by_stick_rates: np.ndarray
    a: np.ndarray
    b: np.ndarray
    b_sticks: np.ndarray
    c: np.ndarray
    hankel: np.ndarray
    """Hankel singular values over the largest."""
    hold: float
    """Time [s] by which the inflow that is felt is late: half a step where a flight holds it, else none."""
    said: Mapping[str, float]
    """What else is to be said of it, by attribute."""

    @property
    def order(self) -> int:
        """States of the wake."""
        return int(self.a.shape[0])

    @property
    def described(self) -> dict[str, float | int]:
        """What is to be said of it."""
        orders = {f"wake_order_{level:.0e}": int(np.sum(self.hankel > level)) for level in (1e-2, 1e-3, 1e-4)}
        return {
            "wake_order": self.order,
            **orders,
            **self.said,
            "wake_hold": self.hold,
        }


def states_of_wake(start: Trim, where: Places, tolerance: float) -> WakeStates:
    """The marched wake about the trim, realised to `tolerance`."""
    orbit = Orbit(start, where)
    if orbit.model.remembers:
        raise InputError.of("wake", "states", "needs sections without a memory of their own: unsteady = quasi-steady")
    slow, quick = causes_of(where, list(range(where.n_modes)))
    inflow, circulation = orbit.at_once(quick)
    once = quick, inflow
    pulsed, others = served(slow, where)
    found, misfit = _realised(orbit, pulsed, once, tolerance)
    if misfit > FITTED:
        raise NumericalFailure(
            f"linearize: wake = states: the functions that hold what the wake answers later miss {100 * misfit:.1f} % of it "
            f"(allowed {100 * FITTED:.0f} %), as at low speed: wake = identified or quasi-static do without them"
        )
    # what the others do is what those do that give the same circulation
    found = found.driven(np.hstack([np.eye(len(pulsed)), alike(orbit, pulsed, others, (quick, circulation))]))
    slow = [*pulsed, *others]
    # how far it was from repeating itself; what the answers differ from what was fitted to them, over them
    said = {"wake_orbit": orbit.distance, "wake_misfit": misfit}
    return coupled(orbit, (slow, found), once, said)


def _realised(
    orbit: Orbit, slow: list[Cause], known: tuple[list[Cause], np.ndarray], tolerance: float
) -> tuple[Realisation, float]:
    """The wake's answers to pulses less what is answered at once, as a system; what the fit leaves."""
    later = [_later(orbit, cause, answer, known) for cause, answer in zip(slow, orbit.all_later(slow), strict=True)]
    sizes = [cause.size for cause in slow]
    for count in COUNTS:
        c, misfit = _fitted(orbit, count, later, sizes)
        if misfit < ENOUGH:
            break
    n_width = known[1].shape[1]
    weights = np.resize(orbit.model.area_weights, n_width) / orbit.n
    outputs = np.sqrt(np.append(np.tile(weights, orbit.n), 1.0))
    inputs = np.array([cause.unit(orbit.model) for cause in slow])
    return realised(c, orbit.omega, tolerance, (outputs, inputs)), misfit


def _later(
    orbit: Orbit, cause: Cause, answer: Answer, known: tuple[list[Cause], np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """What a pulse of the cause is answered later: inflow (steps, n_blades, n_width) by rows instead of blades, and mean."""
    inflow, every = answer.inflow, np.arange(answer.mean.size)
    value, rate = orbit.pulse(every)
    inflow -= at_once(orbit, Driven.by(orbit, [cause], every, value[:, None], rate[:, None]), known, every)
    inflow[1:] = (1.0 - orbit.late) * inflow[1:] + orbit.late * inflow[:-1]
    return np.stack([np.roll(each, k // orbit.passage, axis=0) for k, each in enumerate(inflow)]), answer.mean


def _fitted(
    orbit: Orbit, count: int, later: list[tuple[np.ndarray, np.ndarray]], sizes: list[float]
) -> tuple[np.ndarray, float]:
    """Coefficients c (count, lambdas, causes) of so many functions, and what they leave of the answers, over those."""
    steps, n_width = later[0][1].size, later[0][0].shape[2]
    whole_pulse = orbit.pulse(np.arange((steps - 1) * FINE + 1) / FINE)[0]
    functions = filtered(orbit.omega, count, 2 * np.pi / orbit.omega / orbit.n, whole_pulse)
    c = np.zeros((count, orbit.n * n_width + 1, len(later)))
    left, whole = 0.0, 0.0
    for i, ((inflow, mean), size) in enumerate(zip(later, sizes, strict=True)):
        for phase in range(orbit.passage):
            by_row, of_phase = inflow[phase :: orbit.passage], functions[phase :: orbit.passage]
            fitted = coefficients(of_phase, by_row)
            left += np.sum((by_row - np.tensordot(of_phase, fitted, 1)) ** 2) * size**2
            whole += np.sum(by_row**2) * size**2
            for blade in range(orbit.n_blades):
                k = phase + blade * orbit.passage
                c[:, k * n_width : (k + 1) * n_width, i] = fitted[:, blade]
        c[:, -1, i] = coefficients(functions, mean)
    return c, float(np.sqrt(left / whole))


def _turned(orbit: Orbit, cause: Cause, k: int) -> float:
    """Sign of a coordinate that changes it with every passage."""
    differential = cause.of_blades and columns(orbit.n_blades)[cause.column] == "d"
    return -1.0 if differential and (k % orbit.n) // orbit.passage % 2 else 1.0


def coupled(
    orbit: Orbit,
    later: tuple[list[Cause], Realisation],
    once: tuple[list[Cause], np.ndarray],
    said: Mapping[str, float],
) -> WakeStates:
    """By states and sticks of the linear model, blade after blade as the inflow is felt."""
    slow, found = later
    where = orbit.where
    quick, maps = once
    n, n_width = orbit.n, maps.shape[1]
    names = [name for name, _ in where.named(columns(where.n_blades))]
    lag = orbit.late * (2 * np.pi / orbit.omega / n)
    matrix = np.asarray(orbit.start.model.data["rigging"]["matrix"])[:3]

    def felt(values: np.ndarray, k: int) -> np.ndarray:
        """A map (n, n_width, ...) as all blades meet it at azimuth k of the first."""
        return np.asarray(values[orbit.rows(k)].reshape(orbit.n_blades * values.shape[1], *values.shape[2:]))

    lambdas = where.n_blades * n_width + 1
    at_once = np.zeros((n, lambdas, where.size))
    controls, rates = np.zeros((n, lambdas, 3)), np.zeros((n, lambdas, 3))
    for i, cause in enumerate(quick):
        for k in range(n):
            here, before = (_turned(orbit, cause, j) * felt(maps[:, :, i], j) for j in (k, k - 1))
            mean = (1.0 - orbit.late) * here + orbit.late * before
            late = -lag * before
            if cause.kind == "control":
                (rates if cause.rate_alone else controls)[k, :-1, cause.index] += mean
                if not cause.rate_alone:
                    rates[k, :-1, cause.index] += late
            elif cause.kind == "hub":
                at_once[k, :-1, MOTION.index(cause.name)] += mean
            else:
                at_once[k, :-1, names.index(cause.name)] += mean
                if not cause.rate_alone:
                    at_once[k, :-1, names.index(f"{cause.name}_rate")] += late
    b, b_controls = np.zeros((n, found.order, where.size)), np.zeros((found.order, 3))
    for i, cause in enumerate(slow):
        by = found.matrices[1][:, i]
        if cause.kind == "control":
            b_controls[:, cause.index] = by
        elif cause.kind == "harmonic":
            # its amplitude is what the blades' motion has of it, twice the mean over them
            places = [names.index(f"{where.labels[cause.index]}_{each}") for each in columns(where.n_blades)]
            one = transformation(where.n_blades, 2 * np.pi * np.arange(n) / n)
            share = np.array([orbit.shapes(cause, k)[0] @ one[k] for k in range(n)]) * 2.0 / where.n_blades
            b[:, :, places] += by[:, None] * share[:, None, :]
        else:
            b[:, :, names.index(cause.name)] += by
    c = found.matrices[2]
    c_maps = c[:-1].reshape(n, n_width, found.order)
    return WakeStates(
        at_once,
        controls @ matrix,
        rates @ matrix,
        found.matrices[0],
        b,
        b_controls @ matrix,
        np.stack([np.vstack([felt(c_maps, k), c[-1:]]) for k in range(n)]),
        found.hankel,
        lag,
        said,
    )
