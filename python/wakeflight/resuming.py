# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flights that were cut: gone on with to the same bits, given another stick, turned into a result, watched, flown again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .arguments import checked
from .control import Augmentation, augmentation
from .errors import InputError, NumericalFailure
from .flight import Flight, Flying
from .flight_folder import INCOMPLETE, RUN, Kept, RunFolder
from .flight_input import FlightInput
from .maneuvers import Maneuver
from .progress import Progress, Reported, Silent, heard, reporting
from .recorder import Recorder
from .results import load
from .runlog import LoggedRows, LoggedWakes
from .trim import Trim
from .units import quantity

if TYPE_CHECKING:
    import xarray as xr


@reporting
@checked
def resume(
    path: str | Path,
    until: Any = None,
    progress: Reported = None,
    out: str | Path | None = None,
    control: Any = None,
) -> Flight:
    """Go on with the flight in the folder `path` that was cut, to the bits of the uncut one.

    until: end of the flight (`"3 s"` from its start) in place of the one it was to have; a flight that has come to its end is
    flown again from its start to the new one, its trim and converged wake being kept. What is damaged is not used, and said: an
    older checkpoint is, or the flight begins again. out: where the result goes, by default the folder itself. control:
    controllers that were a user's own, given once more: of them only what they were made with is kept.
    """
    elsewhere = out is not None and Path(out).resolve() != Path(path).resolve()
    with opened(path, read_only=elsewhere) as folder:
        return resumed(folder, until, heard(progress), None, out, _given(control))


@reporting
@checked
def branch(
    path: str | Path,
    maneuver: Maneuver,
    until: Any = None,
    progress: Reported = None,
    out: str | Path | None = None,
    control: Any = None,
) -> Flight:
    """Fly the sticks of another manoeuvre from the start of the flight in the folder `path`: same past, another stick.

    Trim and converged wake are those that are kept; rows are the same, bit by bit, as long as both histories of the sticks are.
    The folder stays as it is, also where its flight goes on. out: another folder to keep this one in, by default none.
    """
    with opened(path, read_only=True) as folder:
        return resumed(folder, until, heard(progress), maneuver, out, _given(control))


def _given(control: Any) -> Augmentation | None:
    return None if control is None else augmentation(control)


def resumed(
    folder: RunFolder,
    until: Any,
    progress: Progress | Silent,
    maneuver: Maneuver | None = None,
    out: str | Path | None = None,
    control: Augmentation | None = None,
) -> Flight:
    """What `resume` does in a folder that is open; `branch` with another manoeuvre."""
    elsewhere = maneuver is not None or (out is not None and Path(out).resolve() != folder.folder.resolve())
    given = folder.input(control) if elsewhere else folder.reopen(control)
    found = _Found.of(folder, given, progress)
    before = Flying(found.start, given, Silent())
    asked = given
    if maneuver is not None or until is not None:
        changed: dict[str, Any] = (
            {} if maneuver is None else {"revolutions": None, "maneuver": replace(maneuver, control=None)}
        )
        if until is not None:
            steps = max(1, round(before.sim.clock.steps(0, quantity(until, "s", "until"))))
            changed["revolutions"] = steps / before.sim.model.steps_per_revolution
        asked = given.with_plan(**changed)
    elif not elsewhere and (data := folder.result()) is not None:
        folder.saved, folder.had_ended = folder.folder / RUN, True
        progress("the flight has come to its end: nothing is flown")
        return Flight(found.start, before.maneuver, data)
    flying = Flying(found.start, asked, progress)
    if elsewhere:
        return _elsewhere(found, flying, asked, progress, out)
    alike = first_difference(before.maneuver, flying.maneuver)
    notes: list[str] = []
    kept = None
    if before.keeps_sheets == flying.keeps_sheets:
        kept = folder.latest(flying.sim, alike, notes)
    for text in notes:
        progress(f"note: {text}")
    at_start = found.at_start
    kept = at_start if kept is None else replace(kept, phase=at_start.phase if at_start else None)
    if asked is not given or folder.by_hand:
        folder.change(asked, found.start, at_start)
    elif kept is None:
        folder.keep_trim(found.start)
    if kept is not None:
        progress(f"goes on from t = {flying.sim.clock.time(kept.snapshot.step):.4f} s")
    return flying.go(folder, kept)


def _elsewhere(
    found: _Found, flying: Flying, asked: FlightInput, progress: Progress | Silent, out: str | Path | None
) -> Flight:
    """From the start of a flight into another folder, or into memory."""
    if out is None:
        return flying.go(None, found.at_start)
    with RunFolder(out) as other:
        note = other.begin(asked)
        if note:
            progress(f"note: {note}")
        other.keep_trim(found.start)
        if found.at_start is not None:
            other.keep_start(found.start, found.at_start)
        return flying.go(other, found.at_start)


@dataclass(frozen=True)
class _Found:
    """The trim of a flight, kept or made again, and the moment at which the flight begins, where it is kept."""

    start: Trim
    at_start: Kept | None

    @classmethod
    def of(cls, folder: RunFolder, given: FlightInput, progress: Progress | Silent) -> _Found:
        start, at_start, notes = folder.found(given)
        for text in notes:
            progress(f"note: {text}")
        if start is None:
            start = given.asked.trim(given.aircraft, progress)
        return cls(start, at_start)


def opened(path: str | Path, every: float | None = None, read_only: bool = False) -> RunFolder:
    """The folder of a flight, locked; InputError where there is none."""
    folder = Path(path)
    if folder.name == RUN:
        folder = folder.parent
    if not folder.is_dir():
        raise InputError.of("folder", str(path), "no such folder; allowed: the folder of a flight")
    return RunFolder(folder, every, read_only)


def first_difference(a: Maneuver, b: Maneuver) -> float:
    """Time [s] up to which two manoeuvres move the sticks alike, infinite where they always do."""
    times = sorted({t for maneuver in (a, b) for _, corners in maneuver.corners_of for t, _ in corners})
    alike = 0.0
    for t in times:
        if not np.array_equal(a.offset(t), b.offset(t)):
            return alike
        alike = t
    return float("inf")


@reporting
@checked
def recover(path: str | Path, progress: Reported = None) -> Path:
    """Make `run.nc` of the log of a flight that died, up to its last whole row; it can still be gone on with.

    A result of a flight that came to its end is left as it is: what was flown then goes to `run-incomplete.nc`.
    """
    progress = heard(progress)
    with opened(path) as folder:
        flight = _as_logged(folder, "ended without a word", progress)
        if flight is None:
            raise InputError.of("folder", str(folder.folder), "holds no rows of a flight that died")
        return folder.save(flight.data, ended=False)


@checked
def open_run(path: str | Path) -> xr.Dataset:
    """The run in a folder as far as it has been flown: that of a flight that goes on, or that died, or its result.

    A flight that goes on is not disturbed; `finished` is 0 and `failure` says how far it is.
    """
    folder = Path(path)
    if folder.is_file():
        return load(folder)
    if not folder.is_dir():
        raise InputError.of("folder", str(path), "no such folder; allowed: the folder of a flight, or its run.nc")
    flight = _as_logged(RunFolder(folder, read_only=True), "is being flown, or died", Silent())
    if flight is not None:
        return flight.data
    for name in (RUN, INCOMPLETE):
        if (folder / name).is_file():
            return load(folder / name)
    raise InputError.of("folder", str(path), "holds no run, and no flight whose trim has been found")


def _as_logged(folder: RunFolder, how: str, progress: Progress | Silent) -> Flight | None:
    """The flight of a log as far as it goes, None where there is none."""
    if not (folder.restart / "rows.log").exists():
        return None
    given = folder.input()
    start, at_start, notes = folder.found(given)
    if start is None or at_start is None:
        return None
    flying = Flying(start, given, Silent())
    log = folder.log(flying.sim, notes)
    for text in notes:
        progress(f"note: {text}")
    if log is None or not len(log.records):
        return None
    kept = folder.latest(flying.sim, float("inf"), []) or at_start
    flying.sim.go_on(kept.snapshot, at_start.phase, kept.seconds)
    rows, wakes = LoggedRows(log.arrays()), LoggedWakes(folder.restart / "wakes.log")
    n, lattice = len(log.records), given.plan.lattice
    recorder = Recorder(flying.sim, flying.maneuver, flying.n_steps, rows, wakes, n, lattice)
    flown, end = float(log.records["time"][-1]), flying.sim.clock.time(flying.n_steps)
    said = f"flight of {flying.maneuver.name} {how}: rows up to t = {flown:.4f} s of {end:.4f} s"
    return flying.flight(recorder, said)


@dataclass(frozen=True)
class Comparison:
    """A run and the same input flown again: variables that differ, with the largest difference over the largest value."""

    flight: Flight
    differing: dict[str, float]
    told: tuple[str, ...]

    @property
    def same(self) -> bool:
        """Whether every bit of every number agrees."""
        return not self.differing


@reporting
@checked
def rerun(path: str | Path, progress: Reported = None, control: Any = None) -> Comparison:
    """Fly the input that a run's file carries once more and compare, bit by bit; control: as for `resume`.

    Of a run that was ended by a failure (contact with the ground is one) it is what was flown until then.
    """
    progress = heard(progress)
    data = load(path)
    text = data.attrs.get("input")
    if text is None:
        said = f"a file of schema {data.attrs.get('schema', 1)} does not carry its input; flown again it can be from schema 2 on"
        raise InputError.of("input", "missing", said, path)
    given = FlightInput.from_text(text, path, _given(control))
    start = given.asked.trim(given.aircraft, progress)
    again = FlightInput.of(given.aircraft, given.asked, given.plan)
    try:
        flight = Flying(start, again, progress).go()
    except NumericalFailure as reason:
        if not data.attrs.get("failure") or reason.partial is None:
            raise
        flight = reason.partial
    told = tuple(
        f"{name.replace('_', ' ')}: {before} then, {now} now"
        for name, before, now in _circumstances(given.made, again.made)
        if before != now
    )
    return Comparison(flight, differences(data, flight.data), told)


def _circumstances(before: Any, now: Any) -> list[tuple[str, Any, Any]]:
    """What may change the last bits."""
    names = ("program_version", "commit")
    of_machine = ("processor", "instruction_set")
    return [
        *((name, before.get(name), now.get(name)) for name in names),
        *((name, before["machine"].get(name), now["machine"].get(name)) for name in of_machine),
    ]


def differences(a: xr.Dataset, b: xr.Dataset) -> dict[str, float]:
    """Variables in which two runs differ: largest difference over the largest value, infinite where they do not compare."""
    found: dict[str, float] = {}
    for name in sorted({*a.data_vars, *b.data_vars}):
        if name not in a or name not in b or a[name].shape != b[name].shape:
            found[str(name)] = float("inf")
            continue
        one, two = a[name].values, b[name].values
        if not np.array_equal(one, two, equal_nan=True):
            found[str(name)] = float(np.nanmax(np.abs(one - two)) / max(np.nanmax(np.abs(one)), 1e-300))
    return found
