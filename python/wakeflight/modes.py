# SPDX-License-Identifier: MIT OR Apache-2.0
"""Natural modes of the rotating blade."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import _core
from .aircraft import Aircraft, Rotor, load_rotor
from .arguments import checked
from .errors import InputError
from .units import number, whole

MOST_MODES = 500
"""Most modes that can be asked for: five of each of a hundred finite elements."""
KINDS = ("flap", "lag", "torsion")
CLEAR = 0.7
"""Share of the kinetic energy from which a mode is called by one kind alone."""
LEAST = 0.3
"""Share with which a mode may still stand for a name."""
NEAR = 0.05
"""Relative difference of frequency below which a mode of another kind is worth naming beside the one of the same kind."""
NOISE = 0.02
"""Deflections below this share of the largest do not make a node."""


def nodes(shape: np.ndarray) -> int:
    """Changes of sign of a mode shape (n,) between root and tip."""
    felt = shape[np.abs(shape) > NOISE * np.abs(shape).max()]
    return int(np.count_nonzero(np.diff(np.sign(felt))))


@dataclass(frozen=True)
class BladeModes:
    """Modes of a blade, ascending in frequency; shapes normalised to a largest tip deflection of one (m/m or rad)."""

    natural_frequencies: np.ndarray  # (n_modes,) [rad/s]
    shares: np.ndarray  # (n_modes, 3), kinetic energy in flap, lag, torsion
    radius: np.ndarray  # (n,) [m]
    shapes: dict[str, np.ndarray]  # "flap", "lead" [m], "twist" [rad]: (n_modes, n)
    omega: float  # [rad/s]
    reference_pitch: float  # [rad]

    @property
    def frequencies(self) -> np.ndarray:
        """Frequencies (n_modes,) [1/rev]; refused for a rotor at rest, which has `natural_frequencies` only."""
        if self.omega == 0.0:
            raise InputError("rotor_speed = 0: no frequency per revolution; read natural_frequencies [rad/s]")
        return self.natural_frequencies / self.omega

    @property
    def components(self) -> list[dict[str, float]]:
        """What each mode is made of: share of its kinetic energy by kind and order, `flap 3`, the largest first.

        The order is that of the kind's own shape: one more than the nodes between root and tip of the deflection (flap, lag) or
        of the twist (torsion), in whatever order the frequencies come.
        """
        made = []
        for i, shares in enumerate(self.shares):
            orders = [1 + nodes(self.shapes[part][i]) for part in ("flap", "lead", "twist")]
            named = {f"{kind} {order}": float(s) for kind, order, s in zip(KINDS, orders, shares, strict=True)}
            made.append(dict(sorted(named.items(), key=lambda item: -item[1])))
        return made

    @property
    def labels(self) -> list[str]:
        """What each mode mostly is: `flap 2`; where modes veer and no kind has seven tenths, the two largest: `lag 2/flap 3`."""
        found = []
        for made in self.components:
            (first, share), (second, _) = list(made.items())[:2]
            found.append(first if share >= CLEAR else f"{first}/{second}")
        return found

    def matched(self, names: Sequence[str]) -> dict[str, int | None]:
        """Index of the mode that each of `names` (`lag 2`, `torsion 1` ...) is by content; None where no mode kept is.

        A mode stands for one name, the one of which it has most; with less than three tenths of it, for none.
        """
        made = self.components
        pairs = sorted(
            ((made[i][name], name, i) for name in names for i in range(len(made)) if made[i].get(name, 0.0) >= LEAST),
            reverse=True,
        )
        found: dict[str, int | None] = dict.fromkeys(names)
        taken: set[int] = set()
        for _, name, i in pairs:
            if found[name] is None and i not in taken:
                found[name] = i
                taken.add(i)
        return found

    @property
    def has_torsion(self) -> bool:
        """Whether a mode kept is mostly torsion."""
        return bool(np.any(self.shares[:, 2] > 0.5))

    def table(self) -> str:
        """Frequencies and content, one mode a line."""
        lines = ["mode  frequency [1/rev]   flap    lag  torsion  mostly"]
        for i, (f, s, label) in enumerate(zip(self.frequencies, self.shares, self.labels, strict=True), start=1):
            flap, lag, torsion = np.clip(s, 0.0, 1.0)
            lines.append(f"{i:4d}  {f:17.4f}  {flap:5.1%}  {lag:5.1%}  {torsion:7.1%}  {label}")
        if not self.has_torsion and np.any(self.shapes["twist"]):
            lines.append("warning: no mode kept is mostly torsion: keep more modes")
        return "\n".join(lines)


@checked
def blade_modes(
    aircraft: str | Path | Aircraft | Rotor,
    n_modes: int | None = None,
    n_elements: int | None = None,
    rotor_speed: float | None = None,
    reference_pitch: float | None = None,
) -> BladeModes:
    """Modes of the blade of an aircraft or of a rotor, hinged or clamped, at a rotor speed and root pitch.

    Those of a rigid blade are the turns about its hinges.

    rotor_speed [rad/s]: the nominal one by default, zero for a rotor at rest. reference_pitch [rad]: that of the aircraft's mid
    collective, or of the rotor file, by default. n_elements: the aircraft's, and enough for the modes asked.
    """
    rotor = load_rotor(aircraft)
    d = rotor.discretisation
    if d.n_modes == 0:
        raise InputError.of("blade", "rigid and clamped", "must bend or have hinges: it has no modes", file=rotor.path)
    n_modes = d.n_modes if n_modes is None else n_modes
    n_modes = whole("n_modes", n_modes, 1, MOST_MODES)
    n_elements = max(d.n_elements, -(-n_modes // 5)) if n_elements is None else n_elements
    n_elements = whole("n_elements", n_elements, 1, 100)
    omega = float(rotor.omega) if rotor_speed is None else number("rotor_speed", rotor_speed, 0.0, 1e4)
    pitch = d.reference_pitch
    if reference_pitch is not None:
        pitch = number("reference_pitch", reference_pitch, -math.pi, math.pi)
    blade = rotor.data["blade"]
    try:
        core = _core.BladeModes(json.dumps(blade), omega, pitch, n_elements, n_modes)
    except ValueError as reason:
        raise InputError(f"{rotor.path}: {reason}") from None
    radius = np.linspace(blade["root_station"], blade["radius"], 201)
    raw = {name: np.asarray(values).T for name, values in core.shapes(radius).items()}
    tip = np.maximum(np.abs(raw["v"][:, -1]), np.abs(raw["w"][:, -1]))
    scale = np.where(np.asarray(core.energy_shares)[:, 2] > 0.5, np.abs(raw["phi"][:, -1]), tip)
    shapes = {name: raw[key] / scale[:, None] for name, key in (("flap", "w"), ("lead", "v"), ("twist", "phi"))}
    return BladeModes(np.asarray(core.frequencies), np.asarray(core.energy_shares), radius, shapes, omega, pitch)


def reference_table(aircraft: Aircraft, modes: BladeModes) -> str | None:
    """Frequencies beside every column of the aircraft's `reference/blade_frequencies.csv`, None where it has none.

    A published mode is compared with ours of the same content. Where another of ours is nearer in frequency it is named too:
    curves that are labelled along a rotor speed keep their label through a veering, in which the modes change their content.
    """
    path = aircraft.path.parent / "reference" / "blade_frequencies.csv"
    if not path.is_file():
        return None
    with path.open() as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    lines = ["against published and computed frequencies of the same kind and order [1/rev]:"]
    labels, ours = modes.labels, modes.frequencies
    for column in (name for name in rows[0] if name not in ("mode", "note")):
        named = {row["mode"]: float(row[column]) for row in rows if row[column]}
        found = modes.matched([_kind_and_order(name) for name in named])
        lines.append(f"  {column}")
        for name, value in named.items():
            i = found[_kind_and_order(name)]
            nearest = int(np.argmin(np.abs(ours - value)))
            text = "none of ours" if i is None else _compared(ours[i], value, labels[i])
            if nearest != i and abs(ours[nearest] / value - 1) < NEAR:
                text += f"; nearest {_compared(ours[nearest], value, labels[nearest])}"
            lines.append(f"    {name:<20} {value:8.4f}  {text}")
    return "\n".join(lines)


def _kind_and_order(name: str) -> str:
    """`flap 2` of `flap 2 (1st elastic)`."""
    return " ".join(name.split()[:2])


def _compared(ours: float, value: float, label: str) -> str:
    return f"ours {ours:8.4f} {ours / value - 1:+7.2%} ({label})"


def mode_labels(rotor: Aircraft | Rotor) -> list[str]:
    """What the modes that a result's `modal` coordinates belong to mostly are, by `BladeModes.labels`."""
    loaded = load_rotor(rotor)
    return blade_modes(loaded).labels if loaded.discretisation.n_modes else []


def fan(aircraft: Aircraft, n_modes: int = 7) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """For a fan plot: rotor speeds up to the nominal one (n,), frequencies (n, n_modes), both [rad/s], labels at the nominal one.

    A line is the mode of one place in ascending order: where two lines approach and part, the modes exchange what they are.
    """
    speeds = np.linspace(0.1, 1.0, 19) * float(aircraft.rotor.omega)
    found = [blade_modes(aircraft, n_modes, rotor_speed=w) for w in speeds]
    return speeds, np.array([each.natural_frequencies for each in found]), found[-1].labels


def fan_reference(aircraft: Aircraft) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Points of the aircraft's `reference/fanplot_*.csv` (rotor speed ratio and columns in Hz), all under one label [rad/s]."""
    points = {}
    for path in sorted((aircraft.path.parent / "reference").glob("fanplot_*.csv")):
        with path.open() as stream:
            rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        speed, frequency = [], []
        for row in rows:
            for name, value in row.items():
                if name.endswith("_Hz") and value:
                    speed.append(float(row["rpm_ratio"]) * float(aircraft.rotor.omega))
                    frequency.append(float(value) * 2 * np.pi)
        points[path.stem.removeprefix("fanplot_").replace("_", " ")] = (np.array(speed), np.array(frequency))
    return points
