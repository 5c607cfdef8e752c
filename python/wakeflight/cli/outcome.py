# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a command leaves: files written also where a verb fails, and what is said about them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError, Interrupted, NumericalFailure, WakeflightError, known, one_line

if TYPE_CHECKING:
    from ..flight_folder import RunFolder
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
    every: float | None = None,
    rotor_speed: str = "constant",
    wind: Any = None,
) -> Any:
    """Trim and fly one request in the folder `out`, draw whatever was flown, raise where the flight did not finish.

    every: seconds of wall clock between checkpoints.
    """
    from ..control import augmentation
    from ..flight import Flying
    from ..flight_folder import RunFolder
    from ..flight_input import Asked, FlightInput, Plan
    from ..inflow import trim_model

    asked = Asked(request.condition, trim_model(request.inflow))
    maneuver = known(request.maneuver)
    control = augmentation(maneuver.control if request.control is None else request.control)
    plan = Plan(
        replace(maneuver, control=None),
        request.inflow,
        revolutions,
        integrator,
        rotor_speed=rotor_speed,
        control=control,
        wind=wind,
        perturb=request.perturb,
    )
    given = FlightInput.of(request.aircraft, asked, plan)
    with RunFolder(out, every) as folder:
        note = folder.begin(given)
        if note:
            progress(f"note: {note}")

        def flown() -> Any:
            try:
                start = asked.trim(request.aircraft, progress)
                folder.keep_trim(start)
                flying = Flying(start, given, progress)
            except (InputError, NumericalFailure):
                folder.abandon()
                raise
            return flying.go(folder)

        return shown(flown, folder, progress, request.drawing)


def shown(flown: Callable[[], Any], folder: RunFolder, progress: Progress, drawing: Drawing) -> Any:
    """Fly in a folder, and draw what was flown, also where the flight came to a failure."""
    try:
        flight = flown()
    except NumericalFailure as failure:
        if failure.partial is not None:
            draw(failure.partial.data, known(folder.saved), progress, drawing)
        raise
    except Interrupted as signal:
        kept = "what was found is kept" if folder.saved is None else f"kept in {folder.saved}, incomplete"
        said = f"{signal}: {kept}; `wakeflight resume {folder.folder}` goes on"
        raise Interrupted(said, signal.exit_code - 128, signal.partial) from signal
    if folder.had_ended and (folder.folder / "report.html").is_file():
        return flight
    draw(flight.data, known(folder.saved), progress, drawing)
    progress(_pace(flight.data))
    return flight


def draw(data: Any, path: Path, progress: Progress, drawing: Drawing) -> None:
    """Figures and report beside the run.nc that was written: the numbers are safe before anything is drawn."""
    if path.name != "run.nc":
        progress(f"wrote {path}; run.nc there is that of a flight that came to its end")
        return
    if not drawing.figures:
        progress(f"wrote {path}")
        return
    try:
        from .. import report as reports

        form, units = drawing.figure_format, drawing.units
        reports.write(data, path.parent, progress=progress, figure_format=form, units=units)
    except WakeflightError:
        raise
    except Exception as reason:  # whatever a machine has against figures: the run stays
        progress(f"wrote {path}; warning: no figures, {type(reason).__name__}: {one_line(str(reason))}")
        return
    progress(f"wrote {path}, figures and {path.parent / 'report.html'}")


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
