# SPDX-License-Identifier: MIT OR Apache-2.0
"""Results for other programs: ParaView, MATLAB, spreadsheets, older NetCDF readers, acoustics."""

from .formats import FORMATS, export
from .wopwop import export_wopwop

__all__ = ["FORMATS", "export", "export_wopwop"]
