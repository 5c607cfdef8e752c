# SPDX-License-Identifier: MIT OR Apache-2.0
"""Mass of the blades, and inertia of the airframe without them."""

from __future__ import annotations

from collections.abc import Sequence


def blade_mass(structure: dict[str, list[float]]) -> float:
    """Mass of one blade [kg]: integral of the piecewise constant mass per length."""
    return sum(
        m * (r_out - r_in)
        for m, r_in, r_out in zip(structure["mass"], structure["r_in"], structure["r_out"], strict=True)
    )


def airframe_inertia(
    gross: Sequence[float], gross_mass: float, blades_mass: float, hub: Sequence[float]
) -> list[float]:
    """Ixx, Iyy, Izz, Ixz [kg m2] of the airframe about its own centre of gravity, from the gross ones.

    The blades are taken out as a point mass at the hub. gross: about the gross centre of gravity; hub: its
    position from there [m], body axes. Ixz is the product of inertia, positive as the integral of x z dm.
    """
    airframe_mass = gross_mass - blades_mass
    centre = [-blades_mass / airframe_mass * each for each in hub]
    without = list(gross)
    for mass, (x, y, z) in ((blades_mass, hub), (airframe_mass, centre)):
        steiner = (y * y + z * z, x * x + z * z, x * x + y * y, x * z)
        without = [have - mass * each for have, each in zip(without, steiner, strict=True)]
    return without
