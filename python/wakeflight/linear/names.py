# SPDX-License-Identifier: MIT OR Apache-2.0
"""States of a linear model by name: which entries of y they are, blade by blade or as multiblade coordinates of all blades."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..model import Model
from ..modes import mode_labels

MOTION = ("u", "v", "w", "p", "q", "r")
ATTITUDE = ("roll", "pitch")
BODY = (*MOTION, *ATTITUDE)
"""States of the body, first in every model: position and heading act on nothing and are left out."""
UNITS = dict(zip(BODY, ("m/s",) * 3 + ("rad/s",) * 3 + ("rad",) * 2, strict=True))
INFLOW = ("inflow_0", "inflow_1s", "inflow_1c")


@dataclass(frozen=True)
class Places:
    """Where the states are in y, and what they are called.

    The linear model's order: body, blade after blade (coordinates, then rates), what else the system has as states.
    """

    motion: np.ndarray
    """u, v, w, p, q, r (6,)."""
    attitude: np.ndarray
    """Quaternion (4,)."""
    modal: np.ndarray
    """Modal coordinates (n_blades, n_modes)."""
    modal_rate: np.ndarray
    rest: np.ndarray
    """Inflow of the rotors, and whatever else is a state."""
    rest_names: tuple[tuple[str, str], ...]
    labels: tuple[str, ...]
    """What each blade mode is, `flap_1`, no two alike."""
    angle: np.ndarray
    """Angle of every mode per coordinate (n_modes,): its states are angles [rad]."""

    @property
    def n_blades(self) -> int:
        """Blades."""
        return int(self.modal.shape[0])

    @property
    def n_modes(self) -> int:
        """Modes per blade."""
        return int(self.modal.shape[1])

    @cached_property
    def kept(self) -> np.ndarray:
        """Entries of y that are states of the linear model but for the attitude."""
        blades = np.concatenate([self.modal, self.modal_rate], axis=1).ravel()
        return np.concatenate([self.motion, blades, self.rest])

    @cached_property
    def blades(self) -> slice:
        """States of the blades in the linear model."""
        return slice(len(BODY), len(BODY) + 2 * self.modal.size)

    @cached_property
    def scale(self) -> np.ndarray:
        """What the kept entries of y are multiplied with: blades become angles."""
        blades = np.tile(self.angle, 2 * self.n_blades)
        return np.concatenate([np.ones(len(MOTION)), blades, np.ones(self.rest.size)])

    @cached_property
    def size(self) -> int:
        """States."""
        return len(ATTITUDE) + self.kept.size

    def named(self, columns: Sequence[str]) -> tuple[tuple[str, str], ...]:
        """Name and unit of every state, the blades' by the name of their column: a blade, or a multiblade coordinate."""
        blades = [
            (f"{label}_{column}{rate}", unit)
            for column in columns
            for rate, unit in (("", "rad"), ("_rate", "rad/s"))
            for label in self.labels
        ]
        return (*UNITS.items(), *blades, *self.rest_names)


def places(model: Model) -> Places:
    """Where the states of an aircraft are."""
    names = model.core.state_names()
    index = {name: i for i, (name, _) in enumerate(names)}
    layout = model.layout
    modal, modal_rate = (np.array([range(a, b) for a, b in layout[part]], int) for part in ("modal", "modal_rate"))
    taken = {*modal.ravel().tolist(), *modal_rate.ravel().tolist()}
    attitude = [index[f"quaternion_{i}"] for i in range(4)]
    left_out = {*(index[name] for name in (*MOTION, "north", "east", "down")), *attitude, *taken}
    rest = [i for i in range(len(names)) if i not in left_out]
    return Places(
        motion=np.array([index[name] for name in MOTION]),
        attitude=np.array(attitude),
        modal=modal,
        modal_rate=modal_rate,
        rest=np.array(rest, int),
        rest_names=tuple((_short(names[i][0]), names[i][1]) for i in rest),
        labels=_labels(model, modal.shape[1]),
        angle=np.asarray(model.rotor["angle_per_coordinate"])[: modal.shape[1]],
    )


def _short(name: str) -> str:
    """`inflow_0` of `rotor.main.inflow_0`, `tail_inflow` of `rotor.tail.inflow`."""
    parts = name.split(".")
    return parts[-1] if len(parts) < 3 or parts[1] == "main" else f"{parts[1]}_{parts[-1]}"


def _labels(model: Model, n_modes: int) -> tuple[str, ...]:
    """`flap_1` of `flap 1`, `lag_2-flap_3` of `lag 2/flap 3`; a label that comes again gets the number of its mode."""
    found: list[str] = []
    for i, label in enumerate(mode_labels(model.aircraft)[:n_modes], start=1):
        name = label.replace(" ", "_").replace("/", "-")
        found.append(name if name not in found else f"{name}_mode_{i}")
    return tuple(found)
