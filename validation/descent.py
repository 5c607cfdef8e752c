"""Vertical descent of a rotor at constant thrust, and the induced velocity that blade-element theory infers from it."""

from dataclasses import dataclass

import numpy as np

import wakeflight as wf

THRUST = 0.004
"""Thrust coefficient of the test."""


@dataclass(frozen=True)
class Descent:
    """Rotor at a rate of descent over v_h: what the wake gives and what a blade-element reading of it infers."""

    rate: float
    collective: float  # deg
    cq: float
    ratio: float  # inferred v_i / v_h
    scatter: float  # of the ratio, from the thrust of single revolutions


def inferred_inflow(rotor, rate, inflow="time-marching"):
    """The rotor at C_T = 0.004, descending at `rate` times v_h.

    C_T = sigma a / 2 [theta/3 - lambda/2] (uniform inflow through the disk, untwisted blade) gives lambda, and
    v_i = lambda omega R + V_d.
    """
    loaded = wf.load_rotor(rotor)
    v_h = np.sqrt(THRUST / 2)  # over the tip speed
    tip_speed = loaded.omega * loaded.radius
    stand = wf.tunnel(rotor, inflow=inflow, ct=THRUST, climb=f"{-rate * v_h * tip_speed} m/s")
    # aerodynamic blade from the root on: integrals of r^2 and r over the blade instead of 1/3 and 1/2
    cut = loaded.data["blade"]["root_cutout"] / loaded.radius
    squares, radii = (1 - cut**3) / 3, (1 - cut**2) / 2
    slope, solidity = 5.90, loaded.solidity

    def ratio(ct):
        through = (stand.theta_0 * squares - 2 * ct / (slope * solidity)) / radii
        return (through + rate * v_h) / v_h

    spread = float(stand.data.ct_std) if "ct_std" in stand.data else 0.0
    scatter = abs(ratio(stand.ct + spread) - ratio(stand.ct))
    return Descent(rate, float(np.degrees(stand.theta_0)), stand.cq, ratio(stand.ct), scatter)
