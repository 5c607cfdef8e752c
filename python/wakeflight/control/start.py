# SPDX-License-Identifier: MIT OR Apache-2.0
"""What controllers ask of the trim a flight begins from."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np


class Start(Protocol):
    """A `wf.Trim`: its aircraft (travel of the sticks, data of its file), its attitude, its sticks."""

    @property
    def aircraft(self) -> Any:
        """The aircraft."""

    @property
    def model(self) -> Any:
        """What was compiled of it: the rigging."""

    @property
    def stick_si(self) -> np.ndarray:
        """Lateral, longitudinal, collective, pedal [m from the stop]."""

    @property
    def roll(self) -> float:
        """Bank, right side down positive [rad]."""

    @property
    def pitch(self) -> float:
        """Pitch attitude, nose up positive [rad]."""

    @property
    def yaw(self) -> float:
        """Heading against the track, nose right positive [rad]."""
