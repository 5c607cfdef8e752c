# SPDX-License-Identifier: MIT OR Apache-2.0
"""Physics of section tables: what no section of a blade can have is refused, what is doubtful is told."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ..errors import InputError

Grid = dict[str, list[Any]]
"""{x: alpha [rad], y: Mach, values}."""

LARGEST_COEFFICIENT = 4.0
"""Largest |cl|, |cd|, |cm|: a plate across the stream has cd of 2, a flapped section stalls before cl of 4."""

PLAUSIBLE_SLOPES = (3.0, 9.0)
"""Lift slope at low Mach number [1/rad]: thin sections have 2 pi; a low Reynolds number halves it, nothing adds half to it."""

LOW_MACH = 0.3
"""Mach number up to which sections are as in incompressible flow, slope within 5 %."""

SUBSONIC = 0.6
"""Mach number up to which the lift of every section of a blade grows with the angle of attack."""

LEAST_DRAG = 0.0025
"""Least cd about zero lift: a smooth plate, laminar on both sides, has 2.66 / sqrt(Re), 0.0027 at a million."""

PLATE_DRAG = 1.0
"""Drag coefficient across the stream that every section exceeds: a plate has 2, a short one between its ends 1.2."""

GAP = 0.01
"""Difference of a coefficient between -180 and 180 deg, the same attitude, beyond the rounding of a printed table."""

Refuse = Callable[[str, object, str], InputError]
"""Error about `cl`, `cd`, `cm` or `cd_increment` of the file at hand, from its name, value and what is allowed."""


def check_sections(grids: dict[str, Grid], cd_increment: float, refuse: Refuse, polar: bool = False) -> list[str]:
    """Warnings about section tables {cl, cd, cm} in SI; InputError where one is impossible.

    cd_increment: added to cd everywhere. polar: whether they were made from an analytic polar, whose lift grows straight up to
    30 deg by definition, so that its magnitude is no slip.
    """
    for name, grid in grids.items():
        if polar and name == "cl":
            continue
        at, value = _first(grid, lambda x: not abs(x) <= LARGEST_COEFFICIENT)
        if value is not None:
            allowed = f"must lie within +-{LARGEST_COEFFICIENT:g}: no section of a blade has more"
            raise refuse(name, f"{value:g} at {at}", allowed)
    at, value = _first(grids["cd"], lambda x: x + cd_increment < 0.0)
    if value is not None:
        given = f"{value:g} at {at}" + (f" with cd_increment {cd_increment:g}" if cd_increment else "")
        raise refuse("cd", given, "drag must not be negative: it would drive the blade")
    return [
        *_lift(grids["cl"], refuse),
        *_moment(grids["cm"], refuse),
        *_mach(grids, refuse),
        *_doubtful(grids, cd_increment),
    ]


def tip_mach_warnings(grids: dict[str, Grid], tip_mach: float, of_what: str) -> list[str]:
    """Where tables end below the Mach number that the tip reaches; they are held there."""
    last = min(grid["y"][-1] for grid in grids.values())
    if last >= tip_mach:
        return []
    return [f"section tables end at Mach {last:g} and are held there; {of_what} reaches Mach {tip_mach:.2f}"]


def zero_lift(grid: Grid, column: int) -> float | None:
    """Angle of attack [rad] nearest to zero at which cl of a Mach column changes sign, within 20 deg; None: nowhere."""
    alpha, lift = grid["x"], [row[column] for row in grid["values"]]
    roots = []
    for i in range(len(alpha) - 1):
        low, high = lift[i], lift[i + 1]
        if low == 0.0 or low * high < 0.0:
            roots.append(alpha[i] if low == 0.0 else alpha[i] - low * (alpha[i + 1] - alpha[i]) / (high - low))
    nearest = min(roots, key=abs, default=math.inf)
    return nearest if abs(nearest) <= math.radians(20.0) else None


def lift_slope(grid: Grid, column: int) -> float:
    """Mean lift slope [1/rad] over 4 deg either side of zero lift (of zero angle where lift is nowhere zero)."""
    centre, half = zero_lift(grid, column) or 0.0, math.radians(4.0)
    lift = [row[column] for row in grid["values"]]
    return (_at(grid["x"], lift, centre + half) - _at(grid["x"], lift, centre - half)) / (2.0 * half)


def _lift(grid: Grid, refuse: Refuse) -> list[str]:
    warnings = []
    for column, mach in enumerate(grid["y"]):
        slope = lift_slope(grid, column)
        if mach > SUBSONIC and column > 0:
            if slope <= 0.0:
                warnings.append(
                    f"cl falls with the angle of attack at zero lift and Mach {mach:g}: {slope:.3g} per rad"
                )
            continue
        # the flow turns against the lift: attached, lift grows with the angle of attack
        if not slope > 0.0:
            raise refuse("cl", f"{slope:.3g} per rad at zero lift and Mach {mach:g}", "lift slope must be positive")
        low, high = PLAUSIBLE_SLOPES
        if (mach <= LOW_MACH or column == 0) and not low <= slope <= high:
            warnings.append(
                f"cl: lift slope {slope:.3g} per rad at Mach {mach:g}; thin sections have 6.3, measured ones {low:g} to {high:g}"
            )
    if zero_lift(grid, 0) is None:
        warnings.append("cl is zero at no angle of attack within 20 deg of zero")
    return warnings


def _moment(grid: Grid, refuse: Refuse) -> list[str]:
    # across the stream the force acts near mid-chord, behind the quarter chord: nose down at 90 deg, nose up at -90 deg
    signs = [_at(grid["x"], [row[0] for row in grid["values"]], angle) for angle in (-0.5 * math.pi, 0.5 * math.pi)]
    if signs[0] < -0.1 and signs[1] > 0.1:
        given = f"{signs[0]:g} at -90 deg, {signs[1]:g} at 90 deg"
        raise refuse(
            "cm", given, "must be nose down across the stream at 90 deg, nose up at -90 deg (nose up positive)"
        )
    if signs[0] < -0.1 or signs[1] > 0.1:
        return [f"cm is {signs[0]:g} at -90 deg and {signs[1]:g} at 90 deg; a plate has about 0.5 and -0.5"]
    return []


def _mach(grids: dict[str, Grid], refuse: Refuse) -> list[str]:
    warnings = []
    for name, grid in grids.items():
        first = grid["y"][0]
        if first > SUBSONIC:
            raise refuse(name, f"Mach {first:g} on", f"must begin at Mach {LOW_MACH:g} or less: blades begin at rest")
        if first > LOW_MACH:
            warnings.append(f"{name} begins at Mach {first:g} and is held below")
    return warnings


def _doubtful(grids: dict[str, Grid], cd_increment: float) -> list[str]:
    warnings = []
    for name, grid in grids.items():
        gaps = [abs(a - b) for a, b in zip(grid["values"][0], grid["values"][-1], strict=True)]
        if max(gaps) > GAP:
            mach = grid["y"][gaps.index(max(gaps))]
            warnings.append(
                f"{name} differs by {max(gaps):.3g} between -180 and 180 deg, the same attitude, at Mach {mach:g}"
            )
    for first, second in (("cl", "cd"), ("cl", "cm"), ("cd", "cm")):
        if grids[first] == grids[second] and any(map(any, grids[first]["values"])):
            warnings.append(f"{first} and {second} are the same table")
    drag = grids["cd"]
    attached = [row for alpha, row in zip(drag["x"], drag["values"], strict=True) if abs(alpha) <= math.radians(10.0)]
    if cd_increment == 0.0 and attached and not any(map(any, attached)):
        warnings.append("cd is zero within 10 deg: the blades have no profile drag")
    elif attached and min(map(min, attached)) + cd_increment < LEAST_DRAG:
        least = min(map(min, attached)) + cd_increment
        warnings.append(f"cd down to {least:.3g} within 10 deg; a smooth plate has {LEAST_DRAG:g} or more")
    across = min(_at(drag["x"], [row[0] for row in drag["values"]], angle) for angle in (-0.5 * math.pi, 0.5 * math.pi))
    if across < PLATE_DRAG:
        warnings.append(f"cd is {across:.3g} across the stream; a plate has 1.2 to 2")
    return warnings


def _first(grid: Grid, wrong: Callable[[float], bool]) -> tuple[str, float | None]:
    """First cell of a table that is wrong, with where it is; None where none is."""
    for alpha, row in zip(grid["x"], grid["values"], strict=True):
        for mach, value in zip(grid["y"], row, strict=True):
            if wrong(value):
                return f"{math.degrees(alpha):g} deg, Mach {mach:g}", value
    return "", None


def _at(x: list[float], y: list[float], at: float) -> float:
    """Piecewise linear within the table."""
    for i in range(len(x) - 1):
        if x[i] <= at <= x[i + 1]:
            return y[i] + (at - x[i]) / (x[i + 1] - x[i]) * (y[i + 1] - y[i])
    return y[-1]
