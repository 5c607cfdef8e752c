"""Flights of an hour: memory does not grow, kills lose nothing, and the rows are those of the uncut flight."""

import gc
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import results, runlog

FLIGHT = """
import wakeflight as wf


def start():
    aircraft = wf.load_aircraft("uh60a")
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="5250 ft")
    if {free}:
        return wf.trim(aircraft, condition, inflow=wf.RelaxationWake.preset("paper"))
    return wf.trim(aircraft.with_rigid_blades(), condition, inflow="dynamic")


def sticks(seconds):
    # a doublet on one stick after the other, one every quarter of a minute
    corners = {{stick: [(0.0, 0.0)] for stick in ("lateral", "longitudinal", "collective", "pedal")}}
    for k in range(int(seconds / 15)):
        own = corners[("lateral", "longitudinal", "collective", "pedal")[k % 4]]
        own += [(15.0 * k + 1.0 + t, x) for t, x in ((0, 0), (0.2, 0.3), (1, 0.3), (1.4, -0.3), (2.2, -0.3), (2.4, 0))]
    moved = {{stick: own for stick, own in corners.items() if len(own) > 1}}
    return wf.Maneuver("soak", moved, seconds=seconds)


def control():
    return [
        wf.AttitudeHold(
            **dict(roll="5 in/rad", roll_rate="2 in/(rad/s)", pitch="5 in/rad", pitch_rate="3 in/(rad/s)"),
            **dict(heading="5 in/rad", yaw_rate="3 in/(rad/s)"),
        ),
        wf.AltitudeHold(altitude="0.1 in/m", climb_rate="0.1 in/(m/s)"),
    ]


def fly(seconds, out=None):
    return wf.fly(start(), sticks(seconds), integrator="fixed", control=control(), actuators="generic", out=out)
"""
RESUME = "import sys, wakeflight as wf; wf.resume(sys.argv[1])"


@dataclass(frozen=True)
class Life:
    """What was seen of a process that flew: rows at its end, memory [MB] while it flew, how it ended."""

    rows: int
    anonymous: tuple[float, ...]
    code: int


def anonymous(process: int) -> float:
    """Memory of a process that no file stands behind [MB]."""
    for line in Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("RssAnon"):
            return int(line.split()[1]) / 1000
    return 0.0


def watched(program: list[str], log: Path, until: float, rows: int) -> Life:
    """Run a program until its log has so many rows, when it is killed, or to its end at `rows`."""
    child = subprocess.Popen(program, env={**os.environ, "WAKEFLIGHT_THREADS": "1"})
    seen: list[float] = []
    n = first = size = 0
    while child.poll() is None:
        time.sleep(0.05)
        try:
            memory, n = anonymous(child.pid), log.stat().st_size // max(size, 1)
            if not size:
                # how long a row is stands in the head of the log
                size = runlog.read(log).records.dtype.itemsize
                n = first = log.stat().st_size // size
        except (OSError, wf.WakeflightError):
            # before the first row, and when the log has become a result
            continue
        if n > until:
            child.send_signal(signal.SIGKILL)
            break
        # the window of rows is filled by then, and the rows of before have been read; none comes while the result is written
        if n < rows and n > first + 3 * runlog.LogWriter.WINDOW / size:
            seen.append(memory)
    return Life(n, tuple(seen), child.wait())


def soak(folder: Path, free: bool, seconds: float, kills: tuple[float, ...]) -> None:
    """Fly so long, killed at these shares of it and gone on with; the first half minute is flown uncut beside."""
    flight, began = FLIGHT.format(free=free), time.monotonic()
    uncut, run = folder / "uncut", folder / "run"
    subprocess.run([sys.executable, "-c", f"{flight}\nfly(30.0, {str(uncut)!r})"], check=True)
    first = results.load(uncut / "run.nc")
    rate = (first.sizes["time"] - 1) / float(first.time[-1])
    lives: list[Life] = []
    program = f"{flight}\nfly({seconds}, {str(run)!r})"
    while not lives or lives[-1].code:
        until = kills[len(lives)] * seconds * rate if len(lives) < len(kills) else np.inf
        lives.append(
            watched([sys.executable, "-c", program], run / "restart" / "rows.log", until, round(seconds * rate))
        )
        assert lives[-1].code in (0, -signal.SIGKILL), lives[-1]
        program = f"import wakeflight as wf; wf.resume({str(run)!r})"
    flown = results.load(run / "run.nc")
    for life in lives:
        print(f"{life.rows} rows, {min(life.anonymous):.1f} to {max(life.anonymous):.1f} MB, ended with {life.code}")
    size = (run / "run.nc").stat().st_size / 1e6
    print(f"{flown.sizes['time']} rows, {size:.0f} MB, {(time.monotonic() - began) / 60:.1f} min of wall clock")
    assert len(lives) == len(kills) + 1 and all(life.anonymous for life in lives)
    # flat: what comes and goes within a second may differ, what stays may not grow
    assert all(max(life.anonymous) - life.anonymous[0] < 4.0 for life in lives), lives
    n = first.sizes["time"] - 1
    for name, values in first.data_vars.items():
        if values.dims[:1] == ("time",):
            assert np.array_equal(values[:n], flown[name][:n], equal_nan=True), name
    time_s = flown.time.values
    assert flown.attrs["finished"] == 1 and flown.sizes["time"] == round(seconds * rate) + 1
    assert np.allclose(np.diff(time_s), 1 / rate, rtol=1e-6) and abs(time_s[-1] - seconds) < 1 / rate
    # it is still flying as it was trimmed to
    assert np.ptp(flown.down.values) < 30.0 and np.abs(flown["roll"].values).max() < 0.5


@pytest.mark.slow
def test_an_hour_of_flight(tmp_path):
    soak(tmp_path, free=False, seconds=3600.0, kills=(20 / 3600, 0.3, 0.7))


@pytest.mark.slow
def test_two_minutes_of_flight_on_a_free_wake(tmp_path):
    soak(tmp_path, free=True, seconds=120.0, kills=(0.2, 0.6))


@pytest.mark.slow
def test_thirty_flights_in_one_process_take_no_more_memory_than_six(uh60a):
    starts = {"dynamic": wf.trim(uh60a, inflow="dynamic"), "time-marching": wf.trim(uh60a, inflow="relaxation")}
    seen = []
    for k in range(30):
        inflow, integrator = ("dynamic", "time-marching")[k % 2], ("fixed", "ida")[k // 2 % 2]
        wf.fly(starts[inflow], wf.arrested_descent(), inflow=inflow, integrator=integrator, revolutions=3)
        gc.collect()
        seen.append(anonymous(os.getpid()))
    assert seen[-1] - seen[5] < 2.0, seen
