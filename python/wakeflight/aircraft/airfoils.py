# SPDX-License-Identifier: MIT OR Apache-2.0
"""Section tables from a C81 deck or from an analytic polar, in the form of the tables by Mach number."""

from __future__ import annotations

import math
from pathlib import Path

from ..text import read_text
from .tables import HIGHEST_MACH

Grid = dict[str, list]
"""{x: alpha [rad], y: Mach, values}."""

LINEAR_LIMIT = math.radians(30.0)
"""Angle of attack [rad] up to which an analytic polar holds; beyond, a flat plate takes over within 10 deg."""


def read_c81(path: Path) -> tuple[dict[str, Grid], list[str]]:
    """Lift, drag and moment tables of a C81 deck {cl, cd, cm}, and what is to be warned of.

    First line: name (30 columns), then numbers of Mach columns and angles of cl, cd, cm, two digits each. Fields of
    seven columns, nine values a line, angles in degrees. Lines before that one are passed over and told; a deck that counts
    no moments has none. ValueError says what cannot be read.
    """
    try:
        lines = read_text(path).splitlines()
    except ValueError as reason:
        raise ValueError(f"names the file {path}, which {reason}") from reason
    header, counts = _header(path, lines)
    notes = []
    if any(line.strip() for line in lines[:header]):
        notes.append(f"{path}: {header} lines stand before the C81 header in line {header + 1}; passed over")
    reader = _Fields(path, lines, header + 1)
    grids: dict[str, Grid] = {}
    for name, n_mach, n_alpha in zip(("cl", "cd", "cm"), counts[0::2], counts[1::2], strict=True):
        if (n_mach == 0) != (n_alpha == 0) or (n_mach == 0 and name != "cm"):
            where = f"the file {path}, line {header + 1}"
            raise ValueError(f"names {where}, which counts {n_mach} Mach numbers and {n_alpha} angles of {name}")
        if n_mach == 0:
            notes.append(f"{path}: the deck has no cm; taken as 0, sections carry no pitching moment")
            grids[name] = {**grids["cl"], "values": [[0.0] * len(row) for row in grids["cl"]["values"]]}
            continue
        mach = reader.row(n_mach, lead=False)
        rows = [reader.row(n_mach, lead=True) for _ in range(n_alpha)]
        grids[name] = {
            "x": [_to_pi(math.radians(row[0])) for row in rows],
            "y": mach,
            "values": [row[1:] for row in rows],
        }
    after = next((i for i in range(reader.at, len(lines)) if lines[i].strip()), None)
    if after is not None:
        notes.append(f"{path}: text after the tables, from line {after + 1} on; not used")
    return grids, notes


def _header(path: Path, lines: list[str]) -> tuple[int, list[int]]:
    """Index of the first line of a deck, and its six counts; ValueError where no line has them."""
    for at, line in enumerate(lines):
        fields = [line[30 + 2 * i : 32 + 2 * i] for i in range(6)]
        if all(field.strip().isdecimal() for field in fields):
            return at, [int(field) for field in fields]
    raise ValueError(f"names the file {path}, in which no line has six two-digit counts from column 31 on")


class _Fields:
    """Numbers of a deck, line by line in fields of seven columns."""

    def __init__(self, path: Path, lines: list[str], at: int) -> None:
        self.path, self.lines, self.at = path, lines, at

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
            needed = n + lead - len(values)
            if any(wanted[needed:]):
                counted = f"line {self.at + 1} holds more numbers than the {n} that the first line of the deck counts"
                raise ValueError(f"names the file {self.path}, whose {counted}")
            try:
                values += [float(field) for field in wanted[:needed]]
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
    """`grid` if its axes ascend and cover +-180 deg and Mach numbers from 0 to 2; ValueError otherwise."""
    for axis, nodes in (("angle of attack", grid["x"]), ("Mach", grid["y"])):
        if any(after <= before for before, after in zip(nodes, nodes[1:], strict=False)):
            raise ValueError(f"{name}: {axis} must ascend strictly")
    if grid["x"][0] > -math.pi + 1e-9 or grid["x"][-1] < math.pi - 1e-9:
        raise ValueError(f"{name}: angles must cover -180 to 180 deg")
    if grid["y"][0] < 0.0 or grid["y"][-1] > HIGHEST_MACH:
        raise ValueError(f"{name}: Mach numbers must lie between 0 and {HIGHEST_MACH:g}")
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
