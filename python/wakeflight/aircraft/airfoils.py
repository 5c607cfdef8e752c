# SPDX-License-Identifier: MIT OR Apache-2.0
"""Section tables from a C81 deck or from an analytic polar, in the form of the tables by Mach number."""

from __future__ import annotations

import math
from pathlib import Path

Grid = dict[str, list]
"""{x: alpha [rad], y: Mach, values}."""

LINEAR_LIMIT = math.radians(30.0)
"""Angle of attack [rad] up to which an analytic polar holds; beyond, a flat plate takes over within 10 deg."""


def read_c81(path: Path) -> dict[str, Grid]:
    """Lift, drag and moment tables of a C81 deck: {cl, cd, cm}.

    First line: name (30 columns), then numbers of Mach columns and angles of cl, cd, cm, two digits each. Fields of
    seven columns, nine values a line, angles in degrees. ValueError says what cannot be read.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as reason:
        raise ValueError(f"names the file {path}, which cannot be read") from reason
    try:
        counts = [int(lines[0][30 + 2 * i : 32 + 2 * i]) for i in range(6)]
    except (ValueError, IndexError) as reason:
        raise ValueError(
            f"names the file {path}, whose first line has no six two-digit counts from column 31 on"
        ) from reason
    reader = _Fields(path, lines)
    grids = {}
    for name, n_mach, n_alpha in zip(("cl", "cd", "cm"), counts[0::2], counts[1::2], strict=True):
        mach = reader.row(n_mach, lead=False)
        rows = [reader.row(n_mach, lead=True) for _ in range(n_alpha)]
        grids[name] = {
            "x": [_to_pi(math.radians(row[0])) for row in rows],
            "y": mach,
            "values": [row[1:] for row in rows],
        }
    return grids


class _Fields:
    """Numbers of a deck, line by line in fields of seven columns."""

    def __init__(self, path: Path, lines: list[str]) -> None:
        self.path, self.lines, self.at = path, lines, 1

    def row(self, n: int, lead: bool) -> list[float]:
        """The next `n` numbers over as many lines as they need; `lead`: an angle stands before them."""
        values: list[float] = []
        first = True
        while len(values) < n + lead:
            if self.at >= len(self.lines):
                raise ValueError(f"names the file {self.path}, which ends before its tables do")
            line = self.lines[self.at].ljust(70)
            fields = [line[7 * i : 7 * i + 7].strip() for i in range(10)]
            wanted = fields if first and lead else fields[1:]
            try:
                values += [float(field) for field in wanted[: n + lead - len(values)]]
            except ValueError as reason:
                message = f"names the file {self.path}, whose line {self.at + 1} '{line.strip()[:40]}' is not numbers"
                raise ValueError(message) from reason
            first = False
            self.at += 1
        if not all(map(math.isfinite, values)):
            raise ValueError(f"names the file {self.path}, which holds a number that is not finite")
        return values


def _to_pi(alpha: float) -> float:
    """180 degrees, rounded or not, is pi."""
    return math.copysign(math.pi, alpha) if abs(abs(alpha) - math.pi) < 1e-9 else alpha


def checked(name: str, grid: Grid) -> Grid:
    """`grid` if its axes ascend and cover +-180 deg and Mach 0.3 or less to 0.9 or more; ValueError otherwise."""
    for axis, nodes in (("angle of attack", grid["x"]), ("Mach", grid["y"])):
        if any(after <= before for before, after in zip(nodes, nodes[1:], strict=False)):
            raise ValueError(f"{name}: {axis} must ascend strictly")
    if grid["x"][0] > -math.pi + 1e-9 or grid["x"][-1] < math.pi - 1e-9:
        raise ValueError(f"{name}: angles must cover -180 to 180 deg")
    if grid["y"][0] > 0.3 or grid["y"][-1] < 0.9 - 1e-12:
        raise ValueError(f"{name}: Mach numbers must begin at 0.3 or less and reach 0.9 or more")
    return grid


def analytic_polar(
    slope: float, zero_lift: float, drag: tuple[float, ...], moment: float, compressible: bool
) -> dict[str, Grid]:
    """cl = slope (alpha - zero_lift), cd = d0 + d1 alpha + d2 alpha^2, cm constant, as tables: {cl, cd, cm}.

    slope [1/rad]; angles [rad]; `compressible`: lift by 1/sqrt(1 - M^2) (Prandtl, Glauert), held beyond Mach 0.8.
    The polar holds to 30 deg either side; from 40 deg on it is a flat plate (cl = 2 sin cos, cd = 2 sin^2),
    blended between. In reverse flow it is the same polar with the edges changed about.
    """
    degrees = sorted({*(-180 + 2 * i for i in range(181)), *(x / 2 for x in range(-80, 81))})
    alpha = [_to_pi(math.radians(d)) for d in degrees]
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
