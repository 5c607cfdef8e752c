# SPDX-License-Identifier: MIT OR Apache-2.0
"""A linear model with the periodic system that it stands for."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .constant import Constant, averaged
from .modes import base_name
from .periodic import PeriodicSystem
from .response import time_response
from .statespace import LinearModel

METHODS = ("harmonic-decomposition", "averaging")


@dataclass(frozen=True, repr=False)
class Linearized(LinearModel):
    """Linear model of a trimmed helicopter: a constant one, by harmonic decomposition or averaging, and the periodic one."""

    periodic: PeriodicSystem = field(kw_only=True)
    """A, B, C, D by azimuth, in multiblade or individual coordinates."""
    harmonics: tuple[int, ...] = field(kw_only=True, default=())
    """Harmonics of the state that the constant model keeps."""
    rate: np.ndarray = field(kw_only=True)
    """How much more the motion is than the state per unit of input (s, m): rates of inputs are felt."""

    @classmethod
    def from_periodic(
        cls,
        constant: Constant,
        periodic: PeriodicSystem,
        harmonics: tuple[int, ...],
        input_si: tuple[float, ...],
        attributes: dict[str, Any],
    ) -> Linearized:
        """The constant model of a periodic system."""
        return cls(
            (constant.a, constant.b, constant.c, constant.d),
            constant.states,
            periodic.inputs,
            periodic.outputs,
            input_si,
            tuple(int(n) for n in constant.harmonic),
            periodic.omega,
            attributes=attributes,
            periodic=periodic,
            harmonics=harmonics,
            rate=constant.rate,
        )

    def averaged(self) -> LinearModel:
        """The mean of the periodic system over azimuth: small, and off by a tenth or two off-axis in forward flight."""
        mean = averaged(self.periodic)
        return LinearModel(
            (mean.a, mean.b, mean.c, mean.d),
            mean.states,
            self.inputs,
            self.outputs,
            self.input_si,
            omega=self.omega,
            attributes={**self.attributes, "method": "averaging"},
        )

    def derivatives_table(self) -> str:
        """Stability and control derivatives to print, the rates of the sticks not felt."""
        a, b, c, d = self.matrices
        plain = a, b - a @ self.rate, c, d - c @ self.rate
        return LinearModel(plain, self.states, self.inputs, self.outputs, self.input_si).derivatives_table()

    def floquet(self, steps: int = 90) -> np.ndarray:
        """Characteristic exponents of the periodic system (s,) [1/s]; multiples of the rotor speed by the averaged roots."""
        return self.periodic.exponents(np.linalg.eigvals(self.periodic.a.mean(axis=0)), steps)

    def _outputs(self, time: np.ndarray, u: np.ndarray) -> np.ndarray:
        """Outputs with their harmonics of the rotor's turning: the first blade is at azimuth 0 at time 0."""
        y, x = time_response(self.matrices, time, u)
        if not self.harmonics:
            return y
        x = x + u @ self.rate.T
        psi, order = self.omega * time, np.array(self.harmonic)
        swing = np.where(order >= 0, np.cos(np.outer(psi, order)), -np.sin(np.outer(psi, order)))
        place = {name: i for i, (name, _) in enumerate(self.periodic.states)}
        z = np.zeros((time.size, len(place)))
        for i, ((name, _), n) in enumerate(zip(self.states, self.harmonic, strict=True)):
            z[:, place[base_name(name, n)]] += x[:, i] * swing[:, i]
        c, d = self.periodic.outputs_at(psi)
        found: np.ndarray = np.einsum("tks,ts->tk", c, z) + np.einsum("tkm,tm->tk", d, u)
        return found
