# SPDX-License-Identifier: MIT OR Apache-2.0
"""What `wf.trim` returns: the trimmed flight, what is said of it, its Dataset and table."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..monitors import Monitor, failures, lines, warnings
from ..views import html_table
from .dataset import dataset
from .monitors import monitors
from .solved import Solved
from .table import KNOT, table

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True, repr=False)
class Trim(Solved):
    """A trimmed flight; angles in rad, SI, sticks in inches from the stop."""

    def __repr__(self) -> str:
        """One line."""
        c = self.condition
        own = f"{self.aircraft.name}, {c.speed / KNOT:.1f} kt, flight path {np.degrees(c.flight_path):.2f} deg"
        return f"<Trim: {own}, {self.inflow.name}>"

    def _repr_html_(self) -> str:
        """A small table."""
        deg = np.degrees
        rows = [
            ("aircraft", self.aircraft.name),
            ("speed, flight path", f"{self.speed / KNOT:.1f} kt, {deg(self.flight_path):.2f} deg"),
            ("inflow", self.inflow.name),
            ("sticks", ", ".join(f"{name} {value:.2f}" for name, value in self.stick.items()) + " in"),
            ("roll, pitch", f"{deg(self.roll):.2f}, {deg(self.pitch):.2f} deg"),
            *((name, f"{deg(value):.2f} deg") for name, value in self.pitch_controls.items()),
            *(("warning", text) for text in self.warnings),
        ]
        return html_table("Trim", rows)

    @cached_property
    def monitors(self) -> tuple[Monitor, ...]:
        """What is watched of this trim, each with its values and what it says."""
        return monitors(self)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful in the aircraft's data, and what lies beyond a limit of aircraft or model."""
        return (*self.aircraft.warnings, *self.notes, *warnings(self.monitors))

    @property
    def failures(self) -> tuple[str, ...]:
        """What lies beyond physics: a trim that has any is raised in a `NumericalFailure`, not returned."""
        return failures(self.monitors)

    def to_dataset(self) -> xr.Dataset:
        """The trim as an xarray Dataset."""
        return dataset(self, self.monitors, {"warnings": "\n".join(self.warnings), "failure": "; ".join(self.failures)})

    def table(self) -> str:
        """The trim as a table to print."""
        return table(self, [*lines(self.monitors), *(("warning", text) for text in self.warnings)])
