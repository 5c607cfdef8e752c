# SPDX-License-Identifier: MIT OR Apache-2.0
"""Section tables from an analytic polar, and tables continued to all angles of attack, in the form of those by Mach number."""

from __future__ import annotations

import math
from typing import Any

from .tables import HIGHEST_MACH

Grid = dict[str, list[Any]]
"""{x: alpha [rad], y: Mach, values}."""

LINEAR_LIMIT = math.radians(30.0)
"""Angle of attack [rad] up to which an analytic polar holds; beyond, a flat plate takes over within 10 deg."""


def to_pi(alpha: float) -> float:
    """180 degrees, rounded or not, is pi."""
    return math.copysign(math.pi, alpha) if abs(abs(alpha) - math.pi) < 1e-9 else alpha


def checked(name: str, grid: Grid) -> Grid:
    """`grid` if its axes ascend and cover +-180 deg and Mach numbers from 0 to 2; ValueError otherwise."""
    ascending(name, grid)
    if not covers(grid):
        told = f"cover {math.degrees(grid['x'][0]):g} to {math.degrees(grid['x'][-1]):g} deg"
        raise ValueError(f"{name}: angles {told}, must cover -180 to 180 deg; {NAMED_WAYS}")
    return grid


def ascending(name: str, grid: Grid) -> Grid:
    """`grid` if its axes ascend within a turn and Mach numbers from 0 to 2; ValueError otherwise."""
    for axis, nodes in (("angle of attack", grid["x"]), ("Mach", grid["y"])):
        if any(after <= before for before, after in zip(nodes, nodes[1:], strict=False)):
            raise ValueError(f"{name}: {axis} must ascend strictly")
    if grid["x"][0] < -math.pi - 1e-9 or grid["x"][-1] > math.pi + 1e-9:
        raise ValueError(f"{name}: angles must lie between -180 and 180 deg")
    if grid["y"][0] < 0.0 or grid["y"][-1] > HIGHEST_MACH:
        raise ValueError(f"{name}: Mach numbers must lie between 0 and {HIGHEST_MACH:g}")
    return grid


def covers(grid: Grid) -> bool:
    """Whether the angles of a table go all the way round."""
    return bool(grid["x"][0] <= -math.pi + 1e-9 and grid["x"][-1] >= math.pi - 1e-9)


def extended(grids: dict[str, Grid], way: str) -> tuple[dict[str, Grid], list[str]]:
    """Tables {cl, cd, cm} continued to +-180 deg in the `way` a file names, and what is to be told of it; ValueError: not so.

    `mirror`: angles from 0 on are those of a symmetric section, cl and cm odd, cd even. `flat-plate`: beyond the table's ends,
    after 10 deg of transition, cl = 2 sin cos, cd = 2 sin^2 + the table's least, cm = -sin/2 (the force at mid-chord).
    """
    found, notes = {}, []
    for name, grid in grids.items():
        ends = f"{math.degrees(grid['x'][0]):g} to {math.degrees(grid['x'][-1]):g} deg"
        if covers(grid):
            found[name] = grid
            continue
        found[name] = EXTENSIONS[way](name, grid)
        notes.append(f"{name} has angles from {ends}; continued to -180 and 180 deg by {way}, as the file says")
    return found, notes


def _mirrored(name: str, grid: Grid) -> Grid:
    """A table from zero on, of a symmetric section."""
    if abs(grid["x"][0]) > 1e-9:
        first = f"{math.degrees(grid['x'][0]):g} deg"
        raise ValueError(f"{name}: extend = mirror needs angles from 0 on; the first is {first}")
    if grid["x"][-1] < math.pi - 1e-9:
        last = f"{math.degrees(grid['x'][-1]):g} deg"
        raise ValueError(f"{name}: extend = mirror needs angles up to 180 deg; the last is {last}")
    sign = 1.0 if name == "cd" else -1.0
    if sign < 0.0 and any(grid["values"][0]):
        raise ValueError(f"{name}: extend = mirror needs a section without {name} at 0 deg: it is symmetric")
    alpha = [-each for each in grid["x"][:0:-1]]
    values = [[sign * each for each in row] for row in grid["values"][:0:-1]]
    return {**grid, "x": [*alpha, *grid["x"]], "values": [*values, *grid["values"]]}


def _on_a_plate(name: str, grid: Grid) -> Grid:
    """A table whose ends pass into a flat plate."""
    first, last, least = grid["x"][0], grid["x"][-1], [min(column) for column in zip(*grid["values"], strict=True)]
    if not first <= 0.0 <= last:
        raise ValueError(f"{name}: extend = flat-plate needs a table about 0 deg")

    def plate(angle: float) -> list[float]:
        s, c = math.sin(angle), math.cos(angle)
        return {
            "cl": [2.0 * s * c] * len(least),
            "cd": [2.0 * s * s + each for each in least],
            "cm": [-0.5 * s] * len(least),
        }[name]

    steps = [to_pi(math.radians(degrees)) for degrees in range(-180, 181, 5)]
    below = [angle for angle in steps if angle <= first - TRANSITION]
    above = [angle for angle in steps if angle >= last + TRANSITION]
    # where less than the transition is left to half a turn, the plate is met there
    below, above = below or [-math.pi] * (first > -math.pi), above or [math.pi] * (last < math.pi)
    values = [*map(plate, below), *grid["values"], *map(plate, above)]
    return {**grid, "x": [*below, *grid["x"], *above], "values": values}


TRANSITION = math.radians(10.0)
"""Angle [rad] in which a table passes into a flat plate."""

EXTENSIONS = {"flat-plate": _on_a_plate, "mirror": _mirrored}
"""Ways to continue tables that do not go all the way round."""

NAMED_WAYS = 'extend = "flat-plate" or "mirror" in the section\'s group continues them'


def analytic_polar(
    slope: float, zero_lift: float, drag: tuple[float, ...], moment: float, compressible: bool
) -> dict[str, Grid]:
    """cl = slope (alpha - zero_lift), cd = d0 + d1 alpha + d2 alpha^2, cm constant, as tables: {cl, cd, cm}.

    slope [1/rad]; angles [rad]; `compressible`: lift by 1/sqrt(1 - M^2) (Prandtl, Glauert), held beyond Mach 0.8.
    The polar holds to 30 deg either side; from 40 deg on it is a flat plate (cl = 2 sin cos, cd = 2 sin^2),
    blended between. In reverse flow it is the same polar with the edges changed about.
    """
    degrees = sorted({*(-180 + 2 * i for i in range(181)), *(x / 2 for x in range(-80, 81))})
    alpha = [to_pi(math.radians(d)) for d in degrees]
    mach = [0.05 * i for i in range(21)] if compressible else [0.0, 1.0]

    def factor(m: float) -> float:
        return 1.0 / math.sqrt(1.0 - min(m, 0.8) ** 2) if compressible else 1.0

    def attached(a: float) -> tuple[float, float, float]:
        """Share of the polar, and its angle of attack, the reversed one beyond 90 deg."""
        reverse = abs(a) > 0.5 * math.pi
        angle = a - math.copysign(math.pi, a) if reverse else a
        share = min(max((LINEAR_LIMIT + math.radians(10.0) - abs(angle)) / math.radians(10.0), 0.0), 1.0)
        return share, angle, zero_lift if not reverse else -zero_lift

    def lift(a: float, m: float) -> float:
        share, angle, zero = attached(a)
        return share * slope * factor(m) * (angle - zero) + (1.0 - share) * 2.0 * math.sin(a) * math.cos(a)

    def drag_at(a: float) -> float:
        share, angle, _ = attached(a)
        polar = sum(d * angle**k for k, d in enumerate(drag))
        return share * polar + (1.0 - share) * 2.0 * math.sin(a) ** 2

    return {
        "cl": {"x": alpha, "y": mach, "values": [[lift(a, m) for m in mach] for a in alpha]},
        "cd": {"x": alpha, "y": mach, "values": [[drag_at(a)] * len(mach) for a in alpha]},
        "cm": {"x": alpha, "y": mach, "values": [[moment] * len(mach) for _ in alpha]},
    }
