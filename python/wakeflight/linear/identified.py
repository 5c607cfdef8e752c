# SPDX-License-Identifier: MIT OR Apache-2.0
"""A marched wake as part of a linear model, identified from sweeps: where it repeats itself and where it does not, as in hover.

The wake of a flight is marched at the trim's own motion, and then with its causes swept together. What is answered at once is
had as for `states`, from differences over one step. What is left is fitted by Laguerre functions of the causes, azimuth by
azimuth and station by station, beside a level, which is the wake's mean; a ridge, taken by cross validation [golub1979], shuns
what the record does not say. Then it is realised. The last part of the record is not used in the fit: what is said of the model
is how it predicts that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import InputError, NumericalFailure
from ..trim import Trim
from .coherent import following, given
from .marched import Cause, Orbit, causes_of
from .names import Places
from .realisation import realised
from .sweeps import Driven, Signals, at_once, marched
from .wake_states import WakeStates, coupled

BEFORE = 25
"""Revolutions marched at most before the sweep."""
UNHEARD, RECORD, HELD_BACK = 8, 180, 0.25
"""Revolutions of the sweep that are not used, since the wake has not forgotten what was before it; those that are; the part of
them by which the model is judged."""
SHARE = 5.0
"""Root mean square of every cause over the change that `states` gives."""
SEED = 1
"""Of the phases of the sweep."""
COUNT, POLE = 8, 0.6
"""Laguerre functions, and their pole over the rotor speed."""
RIDGES = 10.0 ** np.arange(-3.0, 0.6, 0.25)
"""Parts of the largest singular value, of which cross validation takes one."""
COHERENT = 0.8
"""Least coherence of the mean, the cosine and the sine of the inflow that is taken for a model."""


def identified_wake(start: Trim, where: Places, tolerance: float) -> WakeStates:
    """The wake about the mean of what is flown, realised to `tolerance`; refused where it does not predict what was held back."""
    orbit = Orbit(start, where, BEFORE)
    if orbit.model.remembers:
        raise InputError.of(
            "wake", "identified", "needs sections without a memory of their own: unsteady = quasi-steady"
        )
    causes, quick = causes_of(where, list(range(where.n_modes)))
    once = quick, orbit.at_once(quick)[0]
    chosen = [causes[i] for i in given(causes, where)]
    shapes = following(start, orbit, causes, once)
    signals = Signals.by_chance(len(chosen), RECORD, orbit.n, orbit.omega, SEED)
    steps = np.arange(1, UNHEARD * orbit.n + signals.steps + 1)
    sizes = SHARE * np.array([cause.size for cause in chosen])
    values, rates = ((each * sizes) @ shapes.T for each in (signals.at(steps), signals.rates(steps)))
    driven = Driven.by(orbit, causes, steps, values, rates)
    fit = Fit(orbit, steps, signals.filtered(steps, POLE * orbit.omega, COUNT), *_later(orbit, driven, once, steps))
    c, said = fit.solved()
    if not said["wake_coherence"] >= COHERENT:
        raise NumericalFailure(
            f"linearize: wake = identified: what is identified is no model of this wake: it foretells the sweep that was held "
            f"back with a coherence of {said['wake_coherence']:.2f} (at least {COHERENT}) and leaves "
            f"{said['wake_residual']:.0%} of it"
        )
    weights = np.resize(orbit.model.area_weights, once[1].shape[1]) / orbit.n
    outputs = np.sqrt(np.append(np.tile(weights, orbit.n), 1.0))
    units = np.array([cause.unit(orbit.model) for cause in chosen])
    found = realised(c / sizes, POLE * orbit.omega, tolerance, (outputs, units))
    return coupled(orbit, (chosen, found), once, {"wake_orbit": orbit.distance, **said})


def _later(
    orbit: Orbit, driven: Driven, once: tuple[list[Cause], np.ndarray], steps: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Inflow (steps, n_blades, n_width), by the azimuth at which a blade is, less what is answered at once; and its mean."""
    inflow, mean = marched(orbit, driven)
    inflow -= at_once(orbit, driven, once, steps)
    inflow[1:] = (1.0 - orbit.late) * inflow[1:] + orbit.late * inflow[:-1]
    for i, step in enumerate(steps):
        inflow[i] = np.roll(inflow[i], step // orbit.passage, axis=0)
    return inflow, mean


@dataclass(frozen=True)
class Fit:
    """Inflow by Laguerre functions (steps, count, causes) of the causes."""

    orbit: Orbit
    steps: np.ndarray
    functions: np.ndarray
    inflow: np.ndarray
    mean: np.ndarray

    def solved(self) -> tuple[np.ndarray, dict[str, float]]:
        """c (count, outputs, causes) and how it predicts what was held back."""
        count, n_causes = self.functions.shape[1:]
        orbit, n_width = self.orbit, self.inflow.shape[2]
        c = np.zeros((count, orbit.n * n_width + 1, n_causes))
        heard = np.flatnonzero(self.steps > UNHEARD * orbit.n)
        begin = heard[0] + round((1.0 - HELD_BACK) * heard.size)
        fitted, judged = heard[heard < begin], heard[heard >= begin]
        seen, said = [], []
        left, whole = 0.0, 0.0
        for phase in range(orbit.passage):
            at, then = (each[self.steps[each] % orbit.passage == phase] for each in (fitted, judged))
            found, level = regression(self.functions[at], self.inflow[at])
            for blade in range(orbit.n_blades):
                k = phase + blade * orbit.passage
                c[:, k * n_width : (k + 1) * n_width, :] = found[:, :, blade].transpose(0, 2, 1)
            measured = self.inflow[then] - level
            predicted = np.einsum("tkc,kcbw->tbw", self.functions[then], found)
            weights = np.resize(orbit.model.area_weights, n_width)
            left += float(np.sum((measured - predicted) ** 2 @ weights))
            whole += float(np.sum(measured**2 @ weights))
            seen.append(self._harmonics(measured, phase))
            said.append(self._harmonics(predicted, phase))
        c[:, -1] = regression(self.functions[fitted], self.mean[fitted, None])[0][:, :, 0]
        real, told = np.concatenate(seen), np.concatenate(said)
        coherence = np.sum(real * told, axis=0) ** 2 / np.sum(real**2, axis=0) / np.sum(told**2, axis=0)
        residual = np.sqrt(np.sum((real - told) ** 2, axis=0) / np.sum(real**2, axis=0))
        names = ("0", "1c", "1s")
        return c, {
            "wake_coherence": float(coherence.min()),
            "wake_residual": float(residual.max()),
            **{f"wake_coherence_{name}": float(each) for name, each in zip(names, coherence, strict=True)},
            **{f"wake_residual_{name}": float(each) for name, each in zip(names, residual, strict=True)},
            "wake_residual_stations": float(np.sqrt(left / whole)),
        }

    def _harmonics(self, inflow: np.ndarray, phase: int) -> np.ndarray:
        """Mean, cosine and sine over the disk (samples, 3) of the inflow (samples, n_blades, n_width) at a phase of passage."""
        model = self.orbit.model
        psi = 2 * np.pi * (phase / self.orbit.n + np.arange(self.orbit.n_blades) / self.orbit.n_blades)
        areas = model.area_weights
        x = np.asarray(model.stations) / float(model.rotor["radius"])
        inflow = inflow[:, :, : areas.size]
        first = 2.0 * (inflow @ (areas * x)) / (areas @ x**2)
        return np.stack(
            [
                np.mean(inflow @ areas, axis=1),
                np.mean(first * np.cos(psi), axis=1),
                np.mean(first * np.sin(psi), axis=1),
            ],
            axis=1,
        )


def regression(functions: np.ndarray, answers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """c (count, causes, ...) with answers (samples, ...) = level + c functions (samples, count, causes), and the level.

    Small singular values count less, by the ridge that cross validation prefers: each sample foretold by the others.
    """
    given = functions.reshape(functions.shape[0], -1)
    wanted = answers.reshape(answers.shape[0], -1)
    middle, level = given.mean(axis=0), wanted.mean(axis=0)
    left, size, right = np.linalg.svd(given - middle, full_matrices=False)
    parts = left.T @ (wanted - level)
    beyond = np.sum((wanted - level) ** 2) - np.sum(parts**2)
    shares = [size**2 / (size**2 + (ridge * size[0]) ** 2) for ridge in RIDGES]
    errors = [
        (beyond + np.sum(((1.0 - share)[:, None] * parts) ** 2)) / (wanted.shape[0] - 1.0 - share.sum()) ** 2
        for share in shares
    ]
    share = shares[int(np.argmin(errors))]
    c = (right.T * (share / size)) @ parts
    return (
        c.reshape(*functions.shape[1:], *answers.shape[1:]),
        (level - middle @ c).reshape(answers.shape[1:]),
    )
