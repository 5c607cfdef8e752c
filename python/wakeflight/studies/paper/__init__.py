# SPDX-License-Identifier: MIT OR Apache-2.0
"""The paper [ribera2004] from one command: its runs, its figures, its statements judged, and one page with all of it."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ...progress import Progress

__all__ = ["reproduce"]


def reproduce(
    out_dir: str | Path,
    redraw: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
    with_studies: bool = False,
) -> Path:
    """Fly everything the report needs, or take the flights a former call left in `out_dir`, and write the report.

    with_studies: also what goes beyond the paper, many more flights. Returns the path of report.html; flights are kept in
    `out_dir`/flights, wakes for ParaView in `out_dir`/paraview.
    """
    from ...aircraft import load_aircraft
    from . import studies
    from .cases import base_cases, question_cases, reading_cases
    from .page import write
    from .runs import attempt, fly_all, load_all

    out_dir = Path(out_dir)
    cases = [*base_cases(), *question_cases(), *reading_cases()]
    folder = out_dir / "flights"
    runs = load_all(cases, folder) if redraw else fly_all(cases, folder, workers, progress)
    found: list[Any] = []
    missed: list[Any] = []
    if with_studies:
        more = studies.cases()
        failures = {} if redraw else attempt(more, folder, workers, progress)
        flown = [case for case in more if case.name not in failures and (folder / f"{case.name}.nc").is_file()]
        found, missed = studies.findings({**runs, **load_all(flown, folder)}, failures)
    aircraft = load_aircraft("uh60a")
    radius = float(aircraft.rotor.radius)
    rotor = {
        "shaft_tilt": float(aircraft.rotor.shaft_tilt_forward),
        "hinge_offset": float(aircraft.rotor.blade.root_station) / radius,
        "root_cutout": float(aircraft.rotor.blade.root_cutout) / radius,
        "chord": float(aircraft.chord) / radius,
    }
    return write(runs, out_dir, rotor, found, missed)
