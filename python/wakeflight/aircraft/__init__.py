# SPDX-License-Identifier: MIT OR Apache-2.0
"""Aircraft as data: a TOML file with tables beside it, checked on loading."""

from .load import load_aircraft
from .model import Aircraft, Settings, SourceRow
from .rotor import Rotor, load_rotor
from .shipped import SHIPPED

__all__ = ["SHIPPED", "Aircraft", "Rotor", "Settings", "SourceRow", "load_aircraft", "load_rotor"]
