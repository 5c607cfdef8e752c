# SPDX-License-Identifier: MIT OR Apache-2.0
"""Beyond the paper: studies it left open or that test its conclusions, each with its flights, figure and finding."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from . import coupling, holding, loading, off_axis, sensitivity, strength
from .finding import Finding

if TYPE_CHECKING:
    import xarray as xr

    from ..cases import Planned

STUDIES = {
    study.__name__.rsplit(".", 1)[1]: study for study in (holding, coupling, off_axis, loading, strength, sensitivity)
}
"""Studies by name, in the order of the report."""

__all__ = ["STUDIES", "Finding", "cases", "findings"]


def cases() -> list[Planned]:
    """Flights of every study."""
    return [case for study in STUDIES.values() for case in study.cases()]


def findings(runs: Mapping[str, xr.Dataset], failures: Mapping[str, str]) -> tuple[list[Finding], list[str]]:
    """Findings of the studies whose flights all finished, and a line for every other."""
    found, missed = [], []
    for name, study in STUDIES.items():
        failed = [case.name for case in study.cases() if case.name not in runs]
        if failed:
            missed.append(f"{name}: {failed[0]} did not finish: {failures.get(failed[0], 'not flown')}")
        else:
            found.append(study.finding(runs))
    return found, missed
