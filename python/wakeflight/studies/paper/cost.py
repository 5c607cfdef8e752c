# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the models cost: processor time and counted work by phase, and the relaxation wake under its caps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .cases import CAPS, MANEUVERS, MODELS, UNTIL_CONVERGED, cap_name

if TYPE_CHECKING:
    import xarray as xr

    Runs = Mapping[str, xr.Dataset]


@dataclass(frozen=True)
class Work:
    """Segment evaluations of one flight by phase."""

    trim: float
    convergence: float
    flight: float


def work(run: xr.Dataset) -> Work:
    """Counted evaluations of the segment law; the counter of a relaxation wake goes on from its trim."""
    total = float(run.attrs.get("segment_evaluations", 0))
    trim = float(run.attrs.get("segment_evaluations_trim", 0))
    convergence = float(run.attrs.get("segment_evaluations_convergence", 0))
    relaxed = run.attrs["inflow_model"] == "relaxation"
    return Work(trim, convergence, total - (trim if relaxed else convergence))


def processor(run: xr.Dataset) -> float:
    """Processor seconds of convergence phase and flight; the trim, which both wakes share, left out."""
    return float(run.attrs["seconds_processor"])


def per_sweep(run: xr.Dataset) -> float:
    """Segment evaluations of one sweep of relaxation, inflow at the blades included, from the trim."""
    return work(run).trim / float(run.attrs["relaxation_iterations_trim"])


def per_revolution(run: xr.Dataset) -> float:
    """Segment evaluations of one revolution of time marching, inflow at the blades included, from the convergence phase."""
    return work(run).convergence / float(run.attrs["configuration.inflow.convergence_revolutions"])


HEAD = (
    "flight",
    "trim [s]",
    "convergence [s]",
    "wake [s]",
    "dynamics [s]",
    "processor [s]",
    "residuals [10³]",
    "Jacobians",
    "segments trim [10⁶]",
    "segments convergence [10⁶]",
    "segments flight [10⁶]",
)


def table(runs: Runs) -> list[list[str]]:
    """Wall clock and counted work by phase, a row per flight of the figures."""
    rows = []
    for maneuver in MANEUVERS:
        for model in MODELS:
            run = runs[f"{maneuver}/{model}"]
            counted, attrs = work(run), run.attrs
            rows.append(
                [
                    f"{maneuver.replace('-', ' ')}, {model}",
                    *(f"{float(attrs[f'seconds_{p}']):.2f}" for p in ("trim", "convergence", "wake", "dynamics")),
                    f"{processor(run):.2f}",
                    f"{float(attrs['residual_evaluations']) / 1e3:.1f}",
                    f"{int(attrs['jacobians'])}",
                    *(f"{n / 1e6:.0f}" if n else "–" for n in (counted.trim, counted.convergence, counted.flight)),
                ]
            )
    return rows


CAP_HEAD = (
    "flight",
    "cap",
    "revolutions",
    "not converged",
    "sweeps per revolution",
    "segments in flight [10⁶]",
    "over time marching",
    "processor [s]",
    "over time marching",
)


def cap_table(runs: Runs) -> list[list[str]]:
    """Relaxation under its caps: revolutions that did not converge, work and time against time marching."""
    rows = []
    for maneuver in MANEUVERS:
        marched = runs[f"{maneuver}/time-marching"]
        for cap in (*CAPS, UNTIL_CONVERGED):
            run = runs[cap_name(maneuver, cap)]
            updates = int(run.attrs["relaxation_updates"])
            rows.append(
                [
                    maneuver.replace("-", " "),
                    "until converged" if cap == UNTIL_CONVERGED else str(cap),
                    str(updates),
                    str(int(run.attrs["unconverged_revolutions"])),
                    f"{float(run.attrs['relaxation_iterations']) / updates:.1f}",
                    f"{work(run).flight / 1e6:.0f}",
                    f"{work_ratio(run, marched):.2f}",
                    f"{processor(run):.2f}",
                    f"{processor(run) / processor(marched):.2f}",
                ]
            )
    return rows


def work_ratio(run: xr.Dataset, marched: xr.Dataset) -> float:
    """Segment evaluations of a relaxation flight over those of the time-marching one, both without their starts."""
    return work(run).flight / work(marched).flight
