# SPDX-License-Identifier: MIT OR Apache-2.0
"""One set of monitors for trim, stand and flight: is a result inside what the models hold for, and inside what physics allows?

Pure functions of arrays. Every monitor gives variables of the Dataset, a line of the table, and at times a warning (beyond a
limit of aircraft or model) or a failure (beyond what physics allows: the number is no answer). See docs/numerics/monitors.md.
"""

from __future__ import annotations

from .bounds import Bounds, bounds
from .monitor import Monitor, Places, failures, lines, variables, warnings

__all__ = ["Bounds", "Monitor", "Places", "bounds", "failures", "lines", "variables", "warnings"]
