# SPDX-License-Identifier: MIT OR Apache-2.0
"""Inflow over the disk in flight: at chosen revolutions, and its change from trim."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .disk import chosen_revolutions, difference, revolution_map, rows_of_maps
from .style import styled

if TYPE_CHECKING:
    import xarray as xr

CAPTION = (
    "Induced inflow v_i/(ΩR), positive down through the disk, in the revolution that ends at the number "
    "given, and its change from the first revolution, which is flown at trim. Nose left, advancing side "
    "at the top."
)


@styled
def figure(run: xr.Dataset, revolutions: Sequence[float] | None = None) -> Figure:
    """Inflow maps (upper row) and their change from the first revolution (lower row)."""
    later = chosen_revolutions(run, revolutions)
    trim = revolution_map(run, "inflow", 1)
    maps = [revolution_map(run, "inflow", n) for n in later]
    rows = [[trim, *maps]]
    if maps:
        rows.append([difference(field, trim) for field in (trim, *maps)])
    return rows_of_maps(
        rows,
        ("inflow", "change from trim")[: len(rows)],
        ["revolution 1 (trim)", *(f"revolution {n:g}" for n in later)],
        ("λ [–]", "Δλ [–]")[: len(rows)],
        (False, True)[: len(rows)],
        "Induced inflow over the disk, positive down",
    )
