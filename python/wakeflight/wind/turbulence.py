# SPDX-License-Identifier: MIT OR Apache-2.0
"""Isotropic turbulence, frozen, in three dimensions: random Fourier modes with the spectra of Dryden and von Karman.

u(x) = sum over modes of a_m [e1 cos(k_m.x + f1) + e2 cos(k_m.x + f2)], e1 and e2 across k_m: no divergence anywhere
[kraichnan1970]. Bands of equal ratio in |k| hold what the energy spectrum E(k) has in them; in each three wave vectors stand at
right angles to one another, so that every band, and the whole, is isotropic in each single realisation. It depends on place and
seed alone: nothing has to be kept, and rotor, fuselage and tail feel one air.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np

from .. import _core
from ..arguments import with_checked_init
from ..errors import InputError
from ..units import quantity
from .kinds import STRONGEST, Told

LONGEST = 0.003
"""Least |k| L that is resolved."""
SHORTEST = 1.0
"""Shortest wave [m]: a rotor blade's chord and less is left to the sections."""
FINE = 64
"""Points of each band in which its energy is summed."""
VON_KARMAN = 1.339
"""Ratio of the length in the spectrum of von Karman to its scale [hoblit1988]."""


@dataclass(frozen=True)
class Turbulence(Told):
    """Turbulence of one intensity in all directions, carried by a steady wind beside it.

    intensity: standard deviation of each component; scale: integral length along the flow. Text with units. seed: a whole number;
    the same one gives the same air. bands: of wave numbers, six modes each.
    """

    carried: ClassVar[bool] = True

    intensity: str
    scale: str
    seed: int = 0
    bands: int = 40

    def __post_init__(self) -> None:
        """Check."""
        sigma = quantity(self.intensity, "m/s", "turbulence intensity")
        length = quantity(self.scale, "m", "turbulence scale")
        if not 0.0 <= sigma <= STRONGEST / 5.0:
            raise InputError.of(
                "turbulence intensity", self.intensity, f"must be between 0 and {STRONGEST / 5.0:g} m/s"
            )
        if not 1.0 <= length <= 10_000.0:
            raise InputError.of("turbulence scale", self.scale, "must be between 1 and 10000 m")
        if not 0 <= self.seed < 2**63:
            raise InputError.of("turbulence seed", self.seed, "must be a whole number from 0 on")
        if not 4 <= self.bands <= 400:
            raise InputError.of("turbulence bands", self.bands, "must be between 4 and 400")

    def energy(self, k: np.ndarray) -> np.ndarray:
        """E(k) [m3/s2] at wave numbers `k` [1/m]; its integral is three halves of the variance of a component."""
        raise NotImplementedError

    @property
    def sigma(self) -> float:
        """Standard deviation of a component [m/s]."""
        return quantity(self.intensity, "m/s", "turbulence intensity")

    @property
    def length(self) -> float:
        """Scale [m]."""
        return quantity(self.scale, "m", "turbulence scale")

    @cached_property
    def modes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Wave vectors (modes, 3) [1/m], amplitudes (modes, 3) [m/s] and phases (modes,) [rad]."""
        chance = np.random.Generator(np.random.Philox(self.seed))
        least, most = LONGEST / self.length, 2.0 * math.pi / SHORTEST
        edges = np.geomspace(least, most, self.bands + 1)
        waves, sizes, phases = [], [], []
        for low, high in zip(edges[:-1], edges[1:], strict=True):
            fine = np.geomspace(low, high, FINE + 1)
            content = self.energy(fine)
            share = np.diff(fine) * 0.5 * (content[1:] + content[:-1])
            # a wave number of the band by its energy
            level = np.concatenate([[0.0], np.cumsum(share)])
            k = float(np.interp(chance.uniform(0.0, level[-1]), level, fine))
            axes, upper = np.linalg.qr(chance.normal(size=(3, 3)))
            axes = axes * np.sign(np.diag(upper))
            # each wave vector gives its two directions across it; three of them give all three twice
            size = math.sqrt(2.0 / 3.0 * level[-1])
            for i in range(3):
                for across in (axes[:, (i + 1) % 3], axes[:, (i + 2) % 3]):
                    waves.append(k * axes[:, i])
                    sizes.append(size * across)
                    phases.append(chance.uniform(0.0, 2.0 * math.pi))
        return np.array(waves), np.array(sizes), np.array(phases)

    @cached_property
    def closed(self) -> _core.Wind:
        """The turbulence as the core evaluates it."""
        return _core.Wind.waves(*self.modes)


@with_checked_init
@dataclass(frozen=True)
class Dryden(Turbulence):
    """Turbulence with Dryden's spectrum, E = sigma^2 (8 L/pi) (k L)^4/(1 + (k L)^2)^3: rational, and poor in small eddies."""

    kind: ClassVar[str] = "dryden"

    def energy(self, k: np.ndarray) -> np.ndarray:
        """Dryden's."""
        kl = (k * self.length) ** 2
        return self.sigma**2 * 8.0 * self.length / math.pi * kl**2 / (1.0 + kl) ** 3


@with_checked_init
@dataclass(frozen=True)
class VonKarman(Turbulence):
    """Turbulence with von Karman's spectrum, E = sigma^2 (55 L/9 pi) (a k L)^4/(1 + (a k L)^2)^(17/6), a = 1.339.

    -5/3 in small eddies.
    """

    kind: ClassVar[str] = "von-karman"

    def energy(self, k: np.ndarray) -> np.ndarray:
        """Von Karman's."""
        kl = (VON_KARMAN * k * self.length) ** 2
        return self.sigma**2 * 55.0 * self.length / (9.0 * math.pi) * kl**2 / (1.0 + kl) ** (17.0 / 6.0)
