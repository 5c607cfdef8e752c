# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flights that begin beside their trim: some states moved by what is given, the others as trimmed.

Body velocities are in body axes and stay where an attitude is moved; the path turns with the aircraft then.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .attitude import euler_angles, quaternion_of
from .errors import InputError
from .units import number, quantity

Perturbation = tuple[tuple[str, float], ...]
"""States by name and what they are moved by, SI and radians."""

ANGLES = ("roll", "pitch", "yaw")
UNITS = {
    **dict.fromkeys("uvw", "m/s"),
    **dict.fromkeys("pqr", "rad/s"),
    **dict.fromkeys(ANGLES, "rad"),
    **dict.fromkeys(("north", "east", "down"), "m"),
    **dict.fromkeys(("rotor.main.inflow_0", "rotor.main.inflow_1c", "rotor.main.inflow_1s", "rotor.tail.inflow"), "1"),
}
"""States that can be moved, with their SI units; those of the inflow where it has states."""


def offsets_of(given: Any) -> Perturbation:
    """What a user gives as `perturb=`: `{"q": "2 deg/s", "pitch": "1 deg"}`, or a Perturbation."""
    if given is None:
        return ()
    if isinstance(given, Mapping):
        pairs = list(given.items())
    else:
        try:
            pairs = [(str(name), float(value)) for name, value in given]
            if all(name in UNITS and math.isfinite(value) for name, value in pairs):
                return tuple(pairs)
            raise ValueError
        except (TypeError, ValueError):
            raise InputError.of("perturb", given, 'must be values by name, {"q": "2 deg/s"}') from None
    found = []
    for name, value in pairs:
        if name not in UNITS:
            raise InputError.choice("perturb", name, UNITS)
        unit, field = UNITS[name], f"perturb.{name}"
        found.append((name, number(field, value) if unit == "1" else quantity(value, unit, field)))
        limit = math.pi if unit == "rad" else 1e4
        if abs(found[-1][1]) > limit:
            raise InputError.of(field, value, f"must be at most {limit:.4g} {unit} either way")
    return tuple(found)


def perturbed(y: np.ndarray, names: Sequence[tuple[str, str]], perturb: Perturbation) -> np.ndarray:
    """States `y` moved by `perturb`."""
    place = {name: k for k, (name, _) in enumerate(names)}
    moved_y, turned = np.array(y), np.zeros(3)
    for name, value in perturb:
        if name in ANGLES:
            turned[ANGLES.index(name)] += value
        elif name in place:
            moved_y[place[name]] += value
        else:
            raise InputError.of("perturb", name, "is no state of this flight: its inflow is held")
    if turned.any():
        first = place["quaternion_0"]
        quaternion = moved_y[first : first + 4]
        angles = np.concatenate(euler_angles(quaternion[None])) + turned
        if abs(angles[1]) >= math.pi / 2:
            raise InputError.of(
                "perturb.pitch", f"{math.degrees(angles[1]):.4g} deg", "must leave the nose within 90 deg of level"
            )
        moved_y[first : first + 4] = np.linalg.norm(quaternion) * quaternion_of(*angles)
    return moved_y
