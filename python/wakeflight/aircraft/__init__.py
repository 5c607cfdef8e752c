# SPDX-License-Identifier: MIT OR Apache-2.0
"""Aircraft as data: a TOML file with tables beside it, checked on loading."""

from .load import SHIPPED, load_aircraft
from .model import Aircraft, Settings, SourceRow

__all__ = ["SHIPPED", "Aircraft", "Settings", "SourceRow", "load_aircraft"]
