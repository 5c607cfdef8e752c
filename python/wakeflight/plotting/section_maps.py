# SPDX-License-Identifier: MIT OR Apache-2.0
"""Section loading over the disk in flight: circulation, lift coefficient, and the lift itself as c_l M²."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .disk import chosen_revolutions, revolution_map, rows_of_maps
from .style import styled

if TYPE_CHECKING:
    import xarray as xr

CAPTION = (
    "Bound circulation, section lift coefficient and $c_l M^2$ (proportional to lift per span) in the "
    "revolution that ends at the number given; the first is flown at trim."
)
ROWS = (
    ("circulation", "circulation", "Γ [m²/s]"),
    ("cl", "lift coefficient", "$c_l$ [–]"),
    ("cl_m2", "lift", "$c_l M^2$ [–]"),
)


@styled
def figure(run: xr.Dataset, revolutions: Sequence[float] | None = None) -> Figure:
    """Circulation, cl and cl M^2 in rows, revolutions in columns."""
    when = [1.0, *chosen_revolutions(run, revolutions)]
    rows = [[revolution_map(run, name, n) for n in when] for name, _, _ in ROWS]
    return rows_of_maps(
        rows,
        [title for _, title, _ in ROWS],
        ["revolution 1 (trim)", *(f"revolution {n:g}" for n in when[1:])],
        [label for _, _, label in ROWS],
        [False] * len(ROWS),
        "Section loading over the disk",
    )
