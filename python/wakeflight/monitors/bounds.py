# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the motion of a rotor can give at most: induced velocity and section Mach number. Derived in docs/numerics/monitors.md.

Ratios of velocity are over the tip speed Omega R, lengths over R. A number beyond these bounds is no answer of any rotor.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

VORTEX_RING = 2.0
"""Largest induced velocity of a rotor in any axial flow, over that of hover at the same thrust [leishman2006]."""
THINNEST_CORE = 0.05
"""Core radius of a tip vortex over the chord below which none is taken, whatever the options of the wake say."""
UNCERTAIN_ANGLE = 0.1
"""Angle [rad] that flapping, elastic twist and the zero-lift angle may add to the pitch of a section."""
AZIMUTHS = 12
"""Azimuths at which a section's pitch and speed are looked at."""
ACROSS = 0.45
"""Velocity across the disk over the in-plane speed that a blade tip may have: inflow of 0.3 and flapping of 0.15."""
SLANTED = math.hypot(1.0, ACROSS)


@dataclass(frozen=True)
class Bounds:
    """Bounds of one rotor in one air; `ring`, `vortex` and `section` are the three causes of induced velocity.

    station, chord, twist (n_stations,): r/R, c/R, built-in twist [rad]; lift_max: largest |cl| of the section tables;
    core: least core radius over R that blades see of a vortex.
    """

    n_blades: int
    omega: float
    radius: float
    speed_of_sound: float
    station: np.ndarray
    chord: np.ndarray
    twist: np.ndarray
    lift_max: float
    core: float

    def ring(self, mu: Any) -> Any:
        """Momentum: induced velocity of hover of the ring whose sections all have their largest lift.

        lambda^2 = N_b (c/R) cl_max (r^2 + mu^2/2)/(8 pi r): lift of the ring's blade elements, mean over azimuth, against
        4 pi rho v^2 r dr. mu: advance ratio, a number or (n_times,).
        """
        lift = self.chord * (self.station**2 + 0.5 * np.square(_column(mu))) / self.station
        return np.sqrt(self.n_blades * self.lift_max * lift / (8.0 * np.pi)).max(axis=-1)

    def vortex(self, mu: Any) -> Any:
        """A tip vortex of the largest circulation, U c cl_max/2, at its core radius: Gamma/(2 sqrt(2) pi r_c) [vatistas1991]."""
        circulation = 0.5 * self.lift_max * (self.chord * (self.station + _column(mu))).max(axis=-1)
        return circulation / (2.0 * np.sqrt(2.0) * np.pi * self.core)

    def section(self, velocity: Any, theta: Any) -> Any:
        """The section's own near wake, which acts until the section no longer lifts: velocity across its zero-lift line.

        |U_T| sin|theta| + |mu_z|, the largest of all azimuths and stations, U_T = r - mu_x sin psi + mu_y cos psi; the sine is
        taken as the angle, at most 1.
        """
        psi = 2 * np.pi * np.arange(AZIMUTHS)[:, None] / AZIMUTHS
        (x, y, z), (mean, cosine, sine) = (np.moveaxis(np.asarray(each), -1, 0) for each in (velocity, theta))
        x, y, mean, cosine, sine = (np.asarray(each)[..., None, None] for each in (x, y, mean, cosine, sine))
        along = np.abs(self.station - x * np.sin(psi) + y * np.cos(psi))
        angle = np.abs(mean + self.twist + cosine * np.cos(psi) + sine * np.sin(psi)) + UNCERTAIN_ANGLE
        return (along * np.minimum(angle, 1.0)).max(axis=(-2, -1)) + np.abs(z)

    def inflow(self, velocity: Any, theta: Any) -> tuple[Any, Any]:
        """Induced velocity up to which one cause is enough, and beyond which all together are not: to warn of, to fail at.

        velocity (..., 3): of the hub through the air over the tip speed, hub axes (x aft, y right, z up); theta (..., 3): pitch
        at the root theta_0, theta_1c, theta_1s [rad].
        """
        mu = np.hypot(np.asarray(velocity)[..., 0], np.asarray(velocity)[..., 1])
        ring, vortex, section = VORTEX_RING * self.ring(mu), self.vortex(mu), self.section(velocity, theta)
        return np.maximum(np.maximum(ring, vortex), section), np.maximum(ring + vortex, section)

    @cached_property
    def least_inflow(self) -> float:
        """Induced velocity that is within the bound in any motion."""
        return float(VORTEX_RING * self.ring(0.0) + self.vortex(0.0))

    def least_mach(self, speed: float, rate: float) -> float:
        """Mach number that is within the bound at any pitch."""
        return SLANTED * ((self.omega + rate) * self.radius + speed) / self.speed_of_sound

    def mach(self, speed: Any, rate: Any = 0.0, section: Any = 0.0) -> Any:
        """Section Mach number: blade tip against a wind of `speed` [m/s], the hub turning at `rate` [rad/s], and across.

        Across the disk the tip has `ACROSS` of that speed, or what brings its section to zero lift, where that is more.
        """
        along = (self.omega + rate) * self.radius + speed
        across = np.maximum(ACROSS * along, section * self.omega * self.radius)
        return np.sqrt(along**2 + across**2) / self.speed_of_sound


def bounds(
    rotor: Mapping[str, Any],
    tables: Mapping[str, Any],
    speed_of_sound: float,
    wake: Any,
    thin_sections: bool = False,
) -> Bounds:
    """Bounds of a compiled rotor.

    rotor: its constants as the core gives them; tables: `blade` and `airfoil` as the core was given them; wake: a free wake's
    options, for the cores of its vortices; thin_sections: lift of thin sections (Weissinger) instead of that of the tables.
    """
    radius = rotor["radius"]
    station, chord = (np.asarray(rotor[name]) / radius for name in ("stations", "chords"))
    twist = np.interp(rotor["stations"], tables["blade"]["twist"]["x"], tables["blade"]["twist"]["y"])
    # a filament that stretches thins its core, down to the floor of the stations
    inboard = LEAST_TRAILER_CORE if wake.trailer_core is None else wake.trailer_core
    released = min(inboard, wake.core_radius) if wake.is_full_span else wake.core_radius
    named = 0.0 if wake.core_stretching else released
    core = max(named, max(wake.station_core_floor, THINNEST_CORE) * float(chord.min()))
    # thin sections lift by 2 pi sin(alpha) and have no stall
    lift_max = (
        2.0 * np.pi if thin_sections else max(largest(table["cl"]["values"]) for table in tables["airfoil"]["tables"])
    )
    return Bounds(rotor["n_blades"], rotor["omega"], radius, speed_of_sound, station, chord, twist, lift_max, core)


LEAST_TRAILER_CORE = 0.02
"""What the core gives to trailers inboard of the tip at least, over R, where `trailer_core` is left open."""


def largest(table: Sequence[Sequence[float]]) -> float:
    """Largest magnitude in a table."""
    return float(np.abs(np.asarray(table)).max())


def _column(value: Any) -> np.ndarray:
    """A number as it is, a history (n_times,) as a column against the stations."""
    return np.asarray(value)[..., None]
