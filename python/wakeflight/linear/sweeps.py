# SPDX-License-Identifier: MIT OR Apache-2.0
"""A marched wake swept by all its causes together, and what is recorded of it.

Every cause follows a multisine of its own, a sum of lines from `LOWEST` to `HIGHEST` per revolution with phases by chance, about
the trim's own motion: hub, blade pitch and blades move independently, which in a flight they do not, and nothing drifts away. The
record repeats itself after its length, so that what filters make of the signals is known exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .marched import Cause, Orbit
from .multiblade import columns, transformation
from .realisation import laguerre
from .response import frequency_response

LOWEST, HIGHEST = 1.0 / 60.0, 1.0
"""Frequencies of the lines over the rotor speed."""
CORNER = 0.4
"""Frequency over the rotor speed beyond which lines are smaller, with its inverse."""


@dataclass(frozen=True)
class Signals:
    """Signals of mean square one that repeat themselves: complex amplitudes (lines, causes) at `w` (lines,) [rad/s]."""

    w: np.ndarray
    amplitudes: np.ndarray
    line: np.ndarray
    """Periods of each in the record (lines,)."""
    steps: int

    @classmethod
    def by_chance(cls, count: int, revolutions: int, n: int, omega: float, seed: int) -> Signals:
        """`count` signals over so many revolutions of `n` steps."""
        line = np.arange(round(LOWEST * revolutions), round(HIGHEST * revolutions) + 1)
        size = 1.0 / np.hypot(1.0, line / revolutions / CORNER)
        phase = np.random.default_rng(seed).uniform(0.0, 2 * np.pi, (line.size, count))
        size *= np.sqrt(2.0 / np.sum(size**2))
        return cls(omega * line / revolutions, size[:, None] * np.exp(1j * phase), line, n * revolutions)

    def at(self, steps: np.ndarray, gain: np.ndarray | None = None) -> np.ndarray:
        """Signals (steps, causes), or what `gain` (lines,) makes of them."""
        given = self.amplitudes if gain is None else gain[:, None] * self.amplitudes
        whole = np.zeros((self.steps // 2 + 1, given.shape[1]), complex)
        whole[self.line] = 0.5 * self.steps * given
        period: np.ndarray = np.fft.irfft(whole, self.steps, axis=0)
        return np.asarray(period[steps % self.steps])

    def rates(self, steps: np.ndarray) -> np.ndarray:
        """Their rates [1/s] (steps, causes)."""
        return self.at(steps, 1j * self.w)

    def filtered(self, steps: np.ndarray, pole: float, count: int) -> np.ndarray:
        """What `count` Laguerre functions make of them (steps, count, causes)."""
        gains = frequency_response(laguerre(pole, count), self.w)[:, :, 0]
        return np.stack([self.at(steps, gains[:, k]) for k in range(count)], axis=1)


@dataclass(frozen=True)
class Driven:
    """Motion about the trim's own at every step, SI."""

    hub: np.ndarray
    """(steps, 6) [m/s, rad/s]."""
    control: np.ndarray
    """Blade pitch (steps, 3) [rad]."""
    control_rate: np.ndarray
    angle: np.ndarray
    """Blades (steps, n_blades, n_modes) [rad]."""
    angle_rate: np.ndarray

    @classmethod
    def by(cls, orbit: Orbit, causes: list[Cause], steps: np.ndarray, values: np.ndarray, rates: np.ndarray) -> Driven:
        """By values and rates (steps, causes) of the causes at `steps` after the beginning."""
        n, modes = steps.size, orbit.where.n_modes
        hub, control, control_rate = np.zeros((n, 6)), np.zeros((n, 3)), np.zeros((n, 3))
        angle, angle_rate = np.zeros((n, orbit.n_blades, modes)), np.zeros((n, orbit.n_blades, modes))
        turn = np.arange(orbit.n)
        for i, cause in enumerate(causes):
            value, rate = values[:, i], rates[:, i]
            if cause.kind == "hub":
                hub[:, cause.index] += value
            elif cause.kind == "control":
                control[:, cause.index] += value
                control_rate[:, cause.index] += rate
            else:
                shape, slope = (
                    np.array(each)[steps % orbit.n]
                    for each in zip(*(orbit.shapes(cause, int(k)) for k in turn), strict=True)
                )
                angle[:, :, cause.index] += value[:, None] * shape
                angle_rate[:, :, cause.index] += rate[:, None] * shape + orbit.omega * value[:, None] * slope
        return cls(hub, control, control_rate, angle, angle_rate)

    def quick(self, orbit: Orbit, causes: list[Cause], steps: np.ndarray) -> np.ndarray:
        """The same as values (steps, causes) of causes that are answered at once."""
        psi = 2 * np.pi * steps / orbit.n
        one, two = (transformation(orbit.n_blades, psi, k) for k in (0, 1))
        z = np.linalg.solve(one, self.angle)
        z_rate = np.linalg.solve(one, self.angle_rate - orbit.omega * two @ z)
        odd = (steps % orbit.n) // orbit.passage % 2 == 1
        found = np.zeros((steps.size, len(causes)))
        for i, cause in enumerate(causes):
            if cause.kind == "hub":
                found[:, i] = self.hub[:, cause.index]
            elif cause.kind == "control":
                found[:, i] = (self.control_rate if cause.rate_alone else self.control)[:, cause.index]
            else:
                found[:, i] = (z_rate if cause.rate_alone else z)[:, cause.column, cause.index]
                if columns(orbit.n_blades)[cause.column] == "d":
                    # changes its sign with every passage, as its map does not
                    found[odd, i] *= -1.0
        return found


def at_once(orbit: Orbit, driven: Driven, once: tuple[list[Cause], np.ndarray], steps: np.ndarray) -> np.ndarray:
    """What is answered at once (steps, n_blades, n_width); `once`: causes, with their answers by azimuth."""
    quick = driven.quick(orbit, once[0], steps)
    return np.stack([once[1][orbit.rows(int(step))] @ each for step, each in zip(steps, quick, strict=True)])


def marched(orbit: Orbit, driven: Driven) -> tuple[np.ndarray, np.ndarray]:
    """Inflow (steps, n_blades, n_width) and its mean (steps,) of a copy of the wake from the step after its beginning on."""
    exchange, inflow, mean = orbit.exchange.copy(), [], []
    for i in range(driven.hub.shape[0]):
        rows = orbit.rows(i + 1)
        q, q_dot = (each[rows] for each in orbit.motion)
        y, stick, stick_rate = orbit.y.copy(), np.array(orbit.start.x[:4]), np.zeros(4)
        y[orbit.where.motion] += driven.hub[i]
        stick[:3] += orbit.controls @ driven.control[i]
        stick_rate[:3] += orbit.controls @ driven.control_rate[i]
        moved = (q + driven.angle[i] / orbit.where.angle, q_dot + driven.angle_rate[i] / orbit.where.angle)
        exchange.reach(orbit.begin + i + 1, y, stick, stick_rate, moved)
        inflow.append(np.array(exchange.inflow))
        mean.append(exchange.held(orbit.begin + i + 1)[1])
    return np.array(inflow), np.array(mean)
