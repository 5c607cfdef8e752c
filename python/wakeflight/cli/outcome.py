# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a command leaves: files written also where a verb fails, and what is said about them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError, NumericalFailure

if TYPE_CHECKING:
    from ..progress import Progress
    from .groups import Drawing
    from .request import Request


def folder_made(folder: Path) -> Path:
    """The folder for results, made when there is something to write."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as reason:
        raise InputError.of("--out", str(folder), f"cannot be made: {reason.strerror}") from reason
    return folder


def keeping(verb: Callable[..., Any], save: Callable[[Any], Any]) -> Callable[..., Any]:
    """`verb`, with what it had computed saved where it ends in a numerical failure."""

    def kept(*arguments: Any, **named: Any) -> Any:
        try:
            return verb(*arguments, **named)
        except NumericalFailure as failure:
            if failure.partial is not None:
                save(failure.partial)
            raise

    return kept


def fly_once(
    request: Request,
    revolutions: float | None,
    integrator: str,
    out: Path,
    progress: Progress,
    rotor_speed: str = "constant",
) -> Any:
    """Trim and fly one request, save whatever was computed, raise where the flight did not finish."""
    from ..flight import fly as solve
    from ..inflow import trim_model
    from ..trim import trim as trim_solve

    start = trim_solve(request.aircraft, request.condition, inflow=trim_model(request.inflow), progress=progress)
    flight = keeping(solve, lambda partial: save_flight(partial, out, progress, request.drawing))(
        start,
        request.maneuver,
        inflow=request.inflow,
        revolutions=revolutions,
        integrator=integrator,
        progress=progress,
        control=request.control,
        rotor_speed=rotor_speed,
    )
    save_flight(flight, out, progress, request.drawing)
    if not flight.finished:
        raise NumericalFailure(flight.failure or "the flight did not finish", partial=flight)
    progress(_pace(flight.data))
    return flight


def save_flight(flight: Any, out: Path, progress: Progress, drawing: Drawing) -> None:
    """Write run.nc, then figures and report: the numbers are safe before anything is drawn."""
    folder = folder_made(out)
    flight.save(folder / "run.nc")
    if not drawing.figures:
        progress(f"wrote {folder / 'run.nc'}")
        return
    from .. import report as reports

    reports.write(flight.data, folder, progress=progress, figure_format=drawing.figure_format)
    progress(f"wrote {folder / 'run.nc'}, figures and {folder / 'report.html'}")


def save_trim(start: Any, out: Path) -> None:
    """Write trim.nc."""
    from ..results import save

    print(f"wrote {save(start.to_dataset(), folder_made(out) / 'trim.nc')}")


def _pace(data: Any) -> str:
    """Time flown against the time it took, in words."""
    wake, dynamics = (float(data.attrs[f"seconds_{part}"]) for part in ("wake", "dynamics"))
    flown, taken = float(data.time[-1]), wake + dynamics
    return (
        f"flew {flown:.2f} s in {taken:.3g} s, {flown / taken:.3g} times as fast as time: wake {wake:.3g} s, flight dynamics "
        f"{dynamics:.3g} s by {data.attrs['integration_method']}, {data.attrs['blades']} blades"
    )
