# SPDX-License-Identifier: MIT OR Apache-2.0
"""Controllers between the pilot's hands and the blades: generic blocks, servos, a user's own, in one fixed order."""

from __future__ import annotations

from .augmentation import Augmentation, augmentation
from .blocks import AltitudeHold, AttitudeHold, RateDamping, TurnCoordination
from .chain import Chain
from .controller import Controller
from .file import from_description, from_table, load_control
from .follow import Follow, Hands, follow
from .log import ControlLog
from .pitch_bias import PitchBiasActuator
from .sensors import Sensors
from .servos import Servos
from .systems import from_control

__all__ = [
    "AltitudeHold",
    "AttitudeHold",
    "Augmentation",
    "Chain",
    "ControlLog",
    "Controller",
    "Follow",
    "Hands",
    "PitchBiasActuator",
    "RateDamping",
    "Sensors",
    "Servos",
    "TurnCoordination",
    "augmentation",
    "follow",
    "from_control",
    "from_description",
    "from_table",
    "load_control",
]
