# SPDX-License-Identifier: MIT OR Apache-2.0
"""What `wf.tunnel` returns: the solved rotor, what is said of it, its Dataset and table, and what may follow."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..arguments import checked
from ..monitors import Monitor, failures, lines, warnings
from ..results import save
from ..rotor_speed import CONSTANT, RotorSpeed
from .dataset import attributes, dataset
from .monitors import monitors
from .solved import Solved
from .table import table

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from ..progress import Progress, Silent


class Tunnel(Solved):
    """A solved rotor on a stand: `.ct`, `.cq`, `.data` and the rest, SI and radians.

    Means over the revolution; with a marching wake over the last `.averaged` revolutions, with their scatter.
    """

    def __repr__(self) -> str:
        """Rotor and coefficients."""
        return f"Tunnel({self.model.aircraft.name!r}, ct={self.ct:.6f}, cq={self.cq:.7f})"

    @property
    def notes(self) -> list[str]:
        """What must be said about this solution: what does not rest, and every warning."""
        return [*self.solution.notes, *self.warnings]

    @property
    def assumed(self) -> tuple[str, ...]:
        """What was taken for granted because nothing in the request fixes it, in words."""
        return self.model.condition.assumed

    @cached_property
    def monitors(self) -> tuple[Monitor, ...]:
        """What is watched of this stand, each with its values and what it says."""
        return monitors(self)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful in the rotor's data, and what lies beyond a limit of the model."""
        return (*self.model.aircraft.warnings, *warnings(self.monitors))

    @property
    def failures(self) -> tuple[str, ...]:
        """What lies beyond physics: a stand that has any is raised in a `NumericalFailure`, not returned."""
        return failures(self.monitors)

    @checked
    def transient(
        self,
        collective: Sequence[Any],
        duration: Any,
        progress: Progress | Silent | None = None,
        rotor_speed: RotorSpeed = CONSTANT,
    ) -> xr.Dataset:
        """Move the collective in time from here on and follow rotor and wake: a Dataset over time.

        collective: pairs (time, collective at the root), text with units, linear between them and held after the last, from
        the stand's own collective of its last revolution at 0 s: a ramp of 200 deg/s is `[("0.035 s", "12 deg")]` from 5 deg.
        duration: text. rotor_speed: `constant`, or pairs (time as text, share of the nominal speed), with inflow dynamic; ct and
        cq are counted at the nominal speed.

        Every azimuth step the blades move by their own equations under the inflow held (Radau IIA), then circulation, wake
        and inflow are exchanged as in flight, or the states of dynamic inflow carried on by the loads of the instant; cyclic
        and wind stay. The stand itself is not changed. Needs inflow time-marching or dynamic.

        Raises `InputError`, or `NumericalFailure` with what was computed in `.partial`.
        """
        from .transient import transient

        return transient(self, self.attributes(), collective, duration, progress, rotor_speed)

    @cached_property
    def data(self) -> xr.Dataset:
        """Everything as an xarray Dataset, SI and radians, every variable with its unit and meaning."""
        return dataset(self, self.monitors, self.attributes())

    def save(self, path: str | Path) -> Path:
        """Write `.data` as NetCDF."""
        return save(self.data, path)

    def attributes(self) -> dict[str, Any]:
        """Attributes of the Dataset: rotor, condition, inflow, and what was counted."""
        said = {
            "assumed": "; ".join(self.assumed),
            "notes": "; ".join(self.notes),
            "warnings": "\n".join(self.warnings),
            "failure": "; ".join(self.failures),
        }
        return attributes(self, said)

    def table(self) -> str:
        """The result as a table to print."""
        said = [("note", note) for note in self.solution.notes] + [("warning", text) for text in self.warnings]
        return table(self, self.assumed, [*lines(self.monitors), *said])
