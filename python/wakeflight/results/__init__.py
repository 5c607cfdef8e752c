# SPDX-License-Identifier: MIT OR Apache-2.0
"""Results: one schema of variables, datasets assembled and checked by it, averages over the disk, NetCDF files."""

from __future__ import annotations

from .attributes import flat_attributes
from .dataset import assemble, assemble_loop, assemble_transient, assemble_trim, assemble_tunnel
from .derived import drawn, forget_drawn
from .errors import ResultsError
from .files import by_name, finished, load, save

__all__ = [
    "ResultsError",
    "assemble",
    "assemble_loop",
    "assemble_transient",
    "assemble_trim",
    "assemble_tunnel",
    "by_name",
    "drawn",
    "finished",
    "flat_attributes",
    "forget_drawn",
    "load",
    "save",
]
