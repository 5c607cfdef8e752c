# SPDX-License-Identifier: MIT OR Apache-2.0
"""The folder of a flight: who writes there, the log of its rows, its checkpoints, and the result that comes of them.

`run.nc` and what is drawn of it stand in the folder; below it in `restart/` stand `input.json`, the whole input; `trim.ckpt` and
`start.ckpt`, what the phases before the flight found; `rows.log` and `wakes.log`, what has been flown; `at-STEP.ckpt`, the last
two moments from which it goes on. A flight by hand keeps its sticks in `sticks.log`, until they are in the input. Logs and
moments go when the flight has ended and its result is on the disk.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import sys
import time
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np

from . import atomic
from .errors import InputError, StorageFailure, WakeflightError
from .flight_input import FlightInput
from .flight_start import ConvergencePhase
from .folder_lock import FolderLock
from .recorder import fields_of
from .results import finished, forget_drawn, load, save
from .runlog import FileRows, FileWakes, Log, LogWriter, layout, read
from .simulation import Simulation
from .snapshot import Snapshot, packed, unpacked
from .stick_samples import sampled
from .trim import Trim
from .trim.packing import packed as packed_trim
from .trim.packing import unpacked as unpacked_trim

if TYPE_CHECKING:
    import xarray as xr

    from .control import Augmentation

RUN = "run.nc"
INCOMPLETE = "run-incomplete.nc"
"""Where a flight that did not come to its end is written when the folder holds the result of one that did."""
RESTART = "restart"
SAMPLES = "sticks.log"
"""Sticks of a flight by hand, one sample where every coupling step begins."""
CHECKPOINTS = 2
"""How many moments are kept."""
FLUSH_EVERY = 0.25
"""Seconds of wall clock after which rows go to the file."""
EVERY = 1.0
"""Seconds of wall clock between checkpoints, unless something else is asked."""
SHARE = 0.02
"""Most of the wall clock that checkpoints may take: on a slow disk they come less often; rows reach the log all the same."""
LARGEST = 1 << 30
"""Bytes of the largest checkpoint that is read."""


@dataclass(frozen=True)
class Kept:
    """Where a flight goes on: the moment, rows and wakes that were flown before it, what the phases before found."""

    snapshot: Snapshot
    phase: ConvergencePhase | None
    seconds: dict[str, float]
    rows: int = 0
    wakes: int = 0


def read_checkpoint(path: Path) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Header and parts of a checkpoint; InputError where it is damaged or there is none."""
    try:
        if path.stat().st_size > LARGEST:
            raise InputError.of("checkpoint", str(path), f"must be at most {LARGEST >> 20} MiB")
        return unpacked(path.read_bytes())
    except OSError as reason:
        raise InputError.of("checkpoint", str(path), f"cannot be read: {reason.strerror}") from reason
    except InputError as reason:
        raise InputError(f"{path}: {reason}") from reason


class RunFolder:
    """A folder while a flight is written to it, locked against another one; closed by `with`."""

    def __init__(self, folder: str | Path, every: float | None = None, read_only: bool = False):
        """Lock the folder, which is made; InputError where somebody else writes there.

        every: seconds between checkpoints, `EVERY` by default. read_only: only look, whoever writes there.
        """
        self.folder, self.every = Path(folder), EVERY if every is None else every
        self.restart = self.folder / RESTART
        self.text = ""
        self._rows: FileRows | None = None
        self._wakes: FileWakes | None = None
        self._samples: LogWriter | None = None
        self._last_flush = self._last_kept = time.perf_counter()
        self._pause = self.every
        self.saved: Path | None = None
        """Where the result has been written."""
        self.had_ended = False
        """Whether there was nothing left to fly."""
        self._lock = None if read_only else FolderLock(self.folder, self._taken)

    def _taken(self) -> str:
        """Who writes here."""
        who = "another process"
        with contextlib.suppress(OSError, UnicodeDecodeError):
            who = (self.restart / "owner").read_text(encoding="utf-8")
        return f"a flight is being written there ({who})"

    def __enter__(self) -> RunFolder:
        """Locked already."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Write what is complete, as far as that goes, and let others in."""
        with contextlib.suppress(WakeflightError):
            self._flush()
        for log in (self._samples, self._rows, self._wakes):
            if log is not None:
                log.close()
        if self._lock is not None:
            self._lock.release()

    def begin(self, given: FlightInput) -> str:
        """A new flight; returns what is to be said of an unfinished one that was here, which is put aside."""
        note = ""
        try:
            atomic.sweep(self.folder)
            if (self.restart / "rows.log").exists():
                aside = self.folder / f"{RESTART}.old"
                shutil.rmtree(aside, ignore_errors=True)
                self.restart.replace(aside)
                note = f"{self.folder} held a flight that did not come to its end: put aside into {aside.name}"
            shutil.rmtree(self.restart, ignore_errors=True)
            self.restart.mkdir(exist_ok=True)
        except OSError as reason:
            raise StorageFailure.of(self.restart, reason) from reason
        self.text = given.text
        atomic.write_text(self.restart / "input.json", self.text)
        self._sign()
        return note

    def abandon(self) -> None:
        """There is nothing to go on from: the folder is as if nothing had been begun."""
        shutil.rmtree(self.restart, ignore_errors=True)
        with contextlib.suppress(OSError):
            self.folder.rmdir()

    def input(self, control: Augmentation | None = None) -> FlightInput:
        """What the flight that is here is made of; InputError where there is none. control: in place of what is written down."""
        path = self.restart / "input.json"
        try:
            self.text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as reason:
            said = "holds no flight that could go on: `wakeflight fly ... --out` begins one"
            raise InputError.of("folder", str(self.folder), said) from reason
        given = FlightInput.from_text(self.text, path, control)
        if not self.by_hand:
            return given
        log = read(self.restart / SAMPLES)
        times, inches = (log.records[name] for name in ("time", "inches"))
        if len(times) < 2:
            raise InputError.of("folder", str(self.folder), "holds a flight by hand that died before its first step")
        maneuver = given.plan.maneuver
        return given.with_plan(maneuver=sampled(maneuver.name, times, inches, maneuver.notes))

    @property
    def by_hand(self) -> bool:
        """Whether the sticks of the flight that is here are still in a log."""
        return (self.restart / SAMPLES).exists()

    def reopen(self, control: Augmentation | None = None) -> FlightInput:
        """The flight that is here goes on."""
        given = self.input(control)
        atomic.sweep(self.folder)
        atomic.sweep(self.restart)
        self._sign()
        return given

    def change(self, given: FlightInput, start: Trim, at_start: Kept | None) -> None:
        """The flight that is here is to be another one from the same start."""
        self.text = given.text
        atomic.write_text(self.restart / "input.json", self.text)
        self.keep_trim(start)
        if at_start is not None:
            self.keep_start(start, at_start)
        # they are in the input now
        atomic.remove(self.restart / SAMPLES)

    def result(self) -> xr.Dataset | None:
        """The result of the flight that is here, None where it has not come to its end."""
        if not finished(self.folder / RUN):
            return None
        data = load(self.folder / RUN)
        return data if data.attrs.get("input") == self.text else None

    def _sign(self) -> None:
        since = datetime.now(UTC).isoformat(timespec="seconds")
        atomic.write_text(self.restart / "owner", f"process {os.getpid()} since {since}: {' '.join(sys.argv)[:200]}")

    # --- what the phases before a flight found ---------------------------------------------------------------

    def _write(self, name: str, header: dict[str, Any], parts: dict[str, bytes]) -> None:
        own = {"input": hashlib.sha256(self.text.encode()).hexdigest(), **header}
        atomic.write_bytes(self.restart / name, packed(own, parts))

    def _read(self, name: str) -> tuple[dict[str, Any], dict[str, bytes]]:
        header, parts = read_checkpoint(self.restart / name)
        if header.get("input") != hashlib.sha256(self.text.encode()).hexdigest():
            raise InputError.of("checkpoint", name, "belongs to another input", self.restart)
        return header, parts

    def keep_trim(self, start: Trim) -> None:
        """The trim has been found."""
        self._write("trim.ckpt", *_of_trim(start))

    def keep_start(self, start: Trim, at_start: Kept) -> None:
        """The wake has converged: the flight begins."""
        header, parts = _of_trim(start)
        more, others = _of_moment(at_start)
        phase, maps = _of_phase(at_start.phase or ConvergencePhase())
        self._write("start.ckpt", header | more | {"phase": phase}, parts | others | maps)
        with contextlib.suppress(OSError):
            (self.restart / "trim.ckpt").unlink()

    def found(self, given: FlightInput) -> tuple[Trim | None, Kept | None, list[str]]:
        """The trim, and the moment at which the flight begins, as far as they are kept; and what is damaged."""
        notes = []
        for name in ("start.ckpt", "trim.ckpt"):
            if not (self.restart / name).exists():
                continue
            try:
                header, parts = self._read(name)
                start = unpacked_trim(given.aircraft, given.asked.inflow, header["trim"], _below("trim", parts))
            except (WakeflightError, KeyError, ValueError) as reason:
                notes.append(f"not used: {reason}")
                continue
            return start, _moment(header, parts) if name == "start.ckpt" else None, notes
        return None, None, notes

    # --- the flight ------------------------------------------------------------------------------------------

    def rows(self, sim: Simulation, kept: int) -> FileRows:
        """Where rows go, after the first `kept` that are there."""
        self._rows = FileRows(self.restart / "rows.log", fields_of(sim), kept or None)
        return self._rows

    def samples(self) -> LogWriter:
        """Where the sticks of a flight by hand go: time [s], inches about trim."""
        self._samples = LogWriter(self.restart / SAMPLES, {"time": (), "inches": (4,)})
        return self._samples

    def wakes(self, kept: int) -> FileWakes:
        """Where wakes go."""
        if kept == 0:
            atomic.remove(self.restart / "wakes.log")
        self._wakes = FileWakes(self.restart / "wakes.log", kept)
        return self._wakes

    def beat(self, sim: Simulation, last: bool = False) -> None:
        """An exchange has passed: rows to the file and a checkpoint where they are due; last: both, none follows."""
        now = time.perf_counter()
        if last or now - self._last_flush > FLUSH_EVERY:
            self._flush()
            self._last_flush = now
        if (last or now - self._last_kept > self._pause) and sim.solver.restarts(sim.steps):
            self._flush(to_disk=True)
            self._write(f"at-{sim.steps:08d}.ckpt", *_of_moment(Kept(sim.snapshot(), None, sim.seconds)))
            for path in self._moments()[CHECKPOINTS:]:
                atomic.remove(path)
            self._last_kept = time.perf_counter()
            self._pause = max(self.every, (self._last_kept - now) / SHARE) if self.every else 0.0

    def _flush(self, to_disk: bool = False) -> None:
        # a row counts when it is there, so that its wake and its sticks must be there first
        for log in (self._samples, self._wakes, self._rows):
            if log is not None:
                log.flush(to_disk)

    def _moments(self) -> list[Path]:
        """Checkpoints in flight, the latest first."""
        return sorted(self.restart.glob("at-*.ckpt"), reverse=True)

    def latest(self, sim: Simulation, before: float, notes: list[str]) -> Kept | None:
        """The latest moment not after the time `before` [s] from which the flight can go on; `notes` gets what is damaged."""
        log, model = self.log(sim, notes), sim.model
        if log is None:
            return None
        try:
            wakes = read(self.restart / "wakes.log").steps if model.inflow.is_free_wake else np.array([])
        except InputError as reason:
            notes.append(f"not used: {reason}")
            return None
        for path in self._moments():
            try:
                kept = _moment(*self._read(path.name))
            except (WakeflightError, KeyError, ValueError) as reason:
                notes.append(f"not used: {reason}")
                continue
            step = kept.snapshot.step
            if model.clock.time(step) > before:
                continue
            if step > len(log.records):
                notes.append(f"not used: {path}: the log has {len(log.records)} rows of the {step} before it")
                continue
            n = int(np.searchsorted(wakes, step))
            if model.inflow.is_free_wake and n < _wakes_before(sim, step):
                notes.append(f"not used: {path}: the log of wakes does not reach it")
                continue
            return replace(kept, rows=step, wakes=n)
        return None

    def log(self, sim: Simulation, notes: list[str]) -> Log | None:
        """The log of rows, None where there is none that fits the flight; `notes` gets what is damaged."""
        path = self.restart / "rows.log"
        if not path.exists():
            return None
        try:
            log = read(path)
            if log.records.dtype != layout(fields_of(sim)):
                raise InputError.of("log", str(path), "must have the fields of this aircraft's rows")
        except InputError as reason:
            notes.append(f"not used: {reason}")
            return None
        if log.damage:
            notes.append(log.damage)
        return log

    def save(self, data: xr.Dataset, ended: bool) -> Path:
        """Write the result; a result that is whole is replaced by one that is. Logs go where the flight has `ended`."""
        path = self.folder / RUN
        if not data.attrs["finished"] and finished(path):
            path = self.folder / INCOMPLETE
        else:
            forget_drawn(self.folder)
        self.saved = save(data, path)
        if ended:
            with contextlib.suppress(OSError):
                if path.name == RUN:
                    (self.folder / INCOMPLETE).unlink(missing_ok=True)
                for name in ("rows.log", "wakes.log", "trim.ckpt"):
                    (self.restart / name).unlink(missing_ok=True)
                for each in self._moments():
                    each.unlink(missing_ok=True)
        return path


def _wakes_before(sim: Simulation, step: int) -> int:
    """Wakes kept of the first `step` rows."""
    return -(-step // sim.wake_steps)


def _of_trim(start: Trim) -> tuple[dict[str, Any], dict[str, bytes]]:
    scalars, parts = packed_trim(start)
    return {"trim": scalars}, {f"trim.{name}": part for name, part in parts.items()}


def _of_moment(kept: Kept) -> tuple[dict[str, Any], dict[str, bytes]]:
    snapshot = kept.snapshot
    header = {"configuration": snapshot.configuration, "scalars": snapshot.scalars, "seconds": dict(kept.seconds)}
    return header, {f"at.{name}": part for name, part in snapshot.parts.items()}


def _moment(header: dict[str, Any], parts: dict[str, bytes]) -> Kept:
    """The moment of a checkpoint, with its convergence phase where that is in it."""
    snapshot = Snapshot(header["configuration"], header["scalars"], _below("at", parts))
    phase = _phase(header["phase"], _below("phase", parts)) if "phase" in header else None
    return Kept(snapshot, phase, header["seconds"])


MAPS = ("before", "after")


def _of_phase(phase: ConvergencePhase) -> tuple[dict[str, Any], dict[str, bytes]]:
    maps = {name: vars(phase)[name] for name in MAPS if vars(phase)[name] is not None}
    scalars = {name: value for name, value in vars(phase).items() if name not in MAPS}
    scalars["shapes"] = {name: list(values.shape) for name, values in maps.items()}
    return scalars, {f"phase.{name}": np.asarray(values, "<f8").tobytes() for name, values in maps.items()}


def _phase(scalars: dict[str, Any], parts: dict[str, bytes]) -> ConvergencePhase:
    own = dict(scalars)
    shapes = own.pop("shapes")
    maps = {name: np.frombuffer(parts[name], "<f8").reshape(shape).copy() for name, shape in shapes.items()}
    return ConvergencePhase(**(own | maps))


def _below(prefix: str, parts: dict[str, bytes]) -> dict[str, bytes]:
    """Parts whose names begin with `prefix`, by the rest of their names."""
    return {name.removeprefix(f"{prefix}."): part for name, part in parts.items() if name.startswith(f"{prefix}.")}
