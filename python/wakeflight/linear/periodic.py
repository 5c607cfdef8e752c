# SPDX-License-Identifier: MIT OR Apache-2.0
"""Linear systems that are periodic in azimuth: z_dot = A(psi) z + B(psi) u + B_rate(psi) u_dot, y = C(psi) z + D(psi) u.

Between the azimuths at which they are known they are trigonometric: exact for a system without harmonics above half their number.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

GAUSS = 0.5 - np.sqrt(3.0) / 6.0, 0.5 + np.sqrt(3.0) / 6.0
"""Places of two-point Gauss quadrature in a step."""

Named = tuple[tuple[str, str], ...]
"""Name and unit of every state, input or output."""


@dataclass(frozen=True)
class PeriodicSystem:
    """A periodic linear system at equally spaced azimuths of a whole revolution.

    psi (n,) [rad]; omega [rad/s]; a (n, s, s), b and b_rate (n, s, m), c (n, k, s), d (n, k, m).
    passages: equal parts of a revolution after which the system is itself again but for `renumbering`, a matrix (s, s). slow: how
    many of the states, the last ones, are those of a wake, which knows no harmonics of them.
    """

    psi: np.ndarray
    omega: float
    a: np.ndarray
    b: np.ndarray
    b_rate: np.ndarray
    c: np.ndarray
    d: np.ndarray
    states: Named
    inputs: Named
    outputs: Named
    passages: int
    renumbering: np.ndarray
    slow: int = 0

    @property
    def period(self) -> float:
        """Time of a revolution [s]."""
        return 2 * np.pi / self.omega

    @cached_property
    def _a_harmonics(self) -> np.ndarray:
        return np.fft.rfft(self.a, axis=0)

    def a_at(self, psi: np.ndarray) -> np.ndarray:
        """A (len(psi), s, s) at any azimuths, trigonometric between those known."""
        return trigonometric(self._a_harmonics, self.psi.size, psi)

    def outputs_at(self, psi: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """C and D (len(psi), ...) at any azimuths."""
        c, d = (trigonometric(np.fft.rfft(each, axis=0), self.psi.size, psi) for each in (self.c, self.d))
        return c, d

    def coarser(self, n: int) -> PeriodicSystem:
        """The same at `n` of its azimuths: with the harmonics that they can tell, and without the others."""
        if n == self.psi.size:
            return self

        def told(values: np.ndarray) -> np.ndarray:
            spectrum = np.fft.rfft(values, axis=0)[: n // 2 + 1] * (n / self.psi.size)
            if n % 2 == 0:
                # of the last one they see the cosine alone
                spectrum[-1] = spectrum[-1].real * 2.0
            return np.fft.irfft(spectrum, n, axis=0)

        a, b, b_rate, c, d = (told(each) for each in (self.a, self.b, self.b_rate, self.c, self.d))
        return replace(self, psi=2 * np.pi * np.arange(n) / n, a=a, b=b, b_rate=b_rate, c=c, d=d)

    def transition(self, steps: int = 90) -> np.ndarray:
        """State after one passage by the state before (s, s): fourth-order Magnus steps, `steps` in a passage."""
        from scipy.linalg import expm

        h = 2 * np.pi / self.passages / steps
        places = h * (np.arange(steps)[:, None] + np.array(GAUSS))
        a1, a2 = np.moveaxis(self.a_at(places.ravel()).reshape(steps, 2, *self.a.shape[1:]), 1, 0)
        dt = h / self.omega
        exponent = 0.5 * dt * (a1 + a2) - np.sqrt(3.0) / 12.0 * dt * dt * (a1 @ a2 - a2 @ a1)
        whole = np.eye(self.a.shape[1])
        for step in expm(exponent):
            whole = step @ whole
        return whole

    def exponents(self, near: np.ndarray, steps: int = 90) -> np.ndarray:
        """Characteristic exponents (s,) [1/s], largest real part first [johnson1980].

        Multiples of i passages omega are unknown of each, halves of them too with the renumbering of the blades: taken are those
        that come nearest to `near`, roots of the averaged system, one to each.
        """
        from scipy.optimize import linear_sum_assignment

        passage = self.renumbering @ self.transition(steps)
        found = np.log(np.linalg.eigvals(passage).astype(complex)) * self.passages / self.period
        unit = self.passages * self.omega * (1.0 if np.allclose(self.renumbering, np.eye(len(passage))) else 0.5)
        off = near[None, :].imag - found[:, None].imag
        turns = np.round(off / unit)
        distance = np.abs(found[:, None] + 1j * unit * turns - near[None, :])
        rows, columns = linear_sum_assignment(distance)
        unwrapped = found[rows] + 1j * unit * turns[rows, columns]
        result: np.ndarray = unwrapped[np.lexsort((unwrapped.imag, -unwrapped.real))]
        return result

    def to_dataset(self) -> xr.Dataset:
        """A, B, B_rate, C, D by azimuth with names and units."""
        import xarray as xr

        names = {
            kind: [name for name, _ in named]
            for kind, named in (("state", self.states), ("input", self.inputs), ("output", self.outputs))
        }
        found = xr.Dataset(
            {
                "A": (("azimuth", "state", "state_"), self.a),
                "B": (("azimuth", "state", "input"), self.b),
                "B_rate": (("azimuth", "state", "input"), self.b_rate),
                "C": (("azimuth", "output", "state"), self.c),
                "D": (("azimuth", "output", "input"), self.d),
            },
            coords={
                "azimuth": ("azimuth", self.psi, {"units": "rad", "long_name": "azimuth of the first blade"}),
                "state": names["state"],
                "state_": names["state"],
                "input": names["input"],
                "output": names["output"],
                "state_units": ("state", [unit for _, unit in self.states]),
                "input_units": ("input", [unit for _, unit in self.inputs]),
                "output_units": ("output", [unit for _, unit in self.outputs]),
            },
            attrs={"omega": self.omega, "time_unit": "s"},
        )
        return found


def trigonometric(harmonics: np.ndarray, n: int, psi: np.ndarray) -> np.ndarray:
    """Values (len(psi), ...) of a real periodic function whose `n` equally spaced values have these harmonics (n//2 + 1, ...)."""
    k = np.arange(harmonics.shape[0])
    weight = np.where((k == 0) | (2 * k == n), 1.0, 2.0) / n
    phases = np.exp(1j * np.outer(psi, k)) * weight
    return np.tensordot(phases.real, harmonics.real, 1) - np.tensordot(phases.imag, harmonics.imag, 1)


def complex_harmonics(values: np.ndarray, most: int) -> np.ndarray:
    """Complex coefficients of harmonics -most..most (2 most + 1, ...) of a real periodic function, (n, ...) values of it."""
    n = values.shape[0]
    one_sided = np.fft.rfft(values, axis=0) / n
    order = np.arange(-most, most + 1)
    inside = 2 * np.abs(order) < n
    picked = one_sided[np.where(inside, np.abs(order), 0)]
    conjugated = np.where((order < 0).reshape(-1, *(1,) * (values.ndim - 1)), picked.conj(), picked)
    found: np.ndarray = conjugated * inside.reshape(-1, *(1,) * (values.ndim - 1))
    return found
