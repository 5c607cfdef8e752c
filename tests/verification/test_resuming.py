"""A flight that was cut goes on to the bits of the uncut one; what is damaged is not read; a full disk ends in one line."""

import contextlib
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import atomic, flight, flight_folder, results, runlog
from wakeflight.flight_folder import RunFolder
from wakeflight.progress import Silent
from wakeflight.resuming import differences

INFLOW = ("dynamic", "relaxation", "time-marching")
REVOLUTIONS = 1.25


def options(starts, inflow, blades="rigid", integrator="fixed", revolutions=REVOLUTIONS):
    start = starts[blades, inflow]
    model = start.inflow
    if inflow == "time-marching":
        model = wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", convergence_revolutions=1)
    return start, wf.roll_reversal(), {"inflow": model, "integrator": integrator, "revolutions": revolutions}


@pytest.fixture
def often(monkeypatch):
    """A checkpoint and rows to the file at every exchange where that is possible."""
    monkeypatch.setattr(flight_folder, "EVERY", 0.0)
    monkeypatch.setattr(flight_folder, "FLUSH_EVERY", 0.0)


def cut_after(monkeypatch, steps):
    """A signal comes in after so many exchanges from here."""
    left = [steps]

    def asked():
        left[0] -= 1
        return signal.SIGTERM if left[0] == 0 else None

    monkeypatch.setattr(flight, "asked", asked)


def killed(action):
    """Do it in a child; the number of the signal that ended that, 0 where it came to its end."""
    child = os.fork()
    if child == 0:
        code = 1
        try:
            action()
            code = 0
        finally:
            os._exit(code)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    assert code <= 0, "the child fell over"
    return -code


@pytest.mark.parametrize("blades", ["rigid", "flexible"])
@pytest.mark.parametrize("integrator", ["fixed", "ida"])
@pytest.mark.parametrize("inflow", INFLOW)
def test_a_flight_cut_three_times_has_the_bits_of_the_whole(
    starts, tmp_path, monkeypatch, often, inflow, integrator, blades
):
    start, maneuver, more = options(starts, inflow, blades, integrator)
    whole = wf.fly(start, maneuver, **more).data
    rng = np.random.default_rng([INFLOW.index(inflow), integrator == "ida", blades == "rigid"])
    n = whole.sizes["time"] - 1
    cuts = np.diff([0, *np.sort(rng.choice(np.arange(1, n), 3, replace=False))])
    cut_after(monkeypatch, cuts[0])
    with pytest.raises(wf.Interrupted, match="interrupted by SIGTERM") as said:
        wf.fly(start, maneuver, out=tmp_path / "run", **more)
    assert said.value.exit_code == 143
    kept = results.load(tmp_path / "run" / "run.nc")
    assert kept.attrs["finished"] == 0 and kept.sizes["time"] == cuts[0]
    for steps in cuts[1:]:
        cut_after(monkeypatch, steps)
        # ida goes on from the last revolution: it may be there again before it is cut
        with contextlib.suppress(wf.Interrupted):
            wf.resume(tmp_path / "run")
    monkeypatch.setattr(flight, "asked", lambda: None)
    again = wf.resume(tmp_path / "run")
    assert differences(whole, again.data) == {}
    assert differences(whole, results.load(tmp_path / "run" / "run.nc")) == {}
    counted = ("jacobians", "residual_evaluations", "segment_evaluations", "relaxation_iterations")
    for name in {*counted} & {*whole.attrs}:
        assert again.data.attrs[name] == whole.attrs[name], name
    assert sorted(path.name for path in (tmp_path / "run" / "restart").iterdir()) == [
        "input.json",
        "owner",
        "start.ckpt",
    ]


def dying(monkeypatch, countdown):
    """Kill this process at the n-th place where something is written or flown."""
    left = [countdown]

    def or_die(action):
        def done(*arguments, **named):
            left[0] -= 1
            if left[0] == 0:
                os.kill(os.getpid(), signal.SIGKILL)
            return action(*arguments, **named)

        return done

    for owner, name in (
        (os, "fsync"),
        (os, "write"),
        (Path, "replace"),
        (Path, "unlink"),
        (atomic, "write_bytes"),
        (runlog.LogWriter, "done"),
        (RunFolder, "beat"),
        (RunFolder, "save"),
    ):
        monkeypatch.setattr(owner, name, or_die(getattr(owner, name)))


def kills(starts, folder, monkeypatch, inflow, integrator, seeds):
    """Kill flights and their resumption at random places; each ends with the bits of the whole; how many died."""
    # ida keeps a checkpoint each revolution, fixed here at every exchange
    places = {"ida": 150, "fixed": 400}[integrator]
    start, maneuver, more = options(starts, inflow, integrator=integrator)
    whole = wf.fly(start, maneuver, **more).data
    died = 0
    for seed in seeds:
        rng, run = np.random.default_rng(seed), folder / f"{seed}"

        def begin(run=run, rng=rng):
            dying(monkeypatch, int(rng.integers(1, places)))
            wf.fly(start, maneuver, out=run, **more)

        def go_on(run=run, rng=rng):
            rng.integers(1, places)
            dying(monkeypatch, int(rng.integers(1, places)))
            wf.resume(run)

        died += killed(begin) == signal.SIGKILL
        if not (run / "restart" / "input.json").exists():
            # killed before anything of the flight was there
            wf.fly(start, maneuver, out=run, **more)
        else:
            died += killed(go_on) == signal.SIGKILL
        assert differences(whole, wf.resume(run).data) == {}, f"seed {seed}"
        shutil.rmtree(run)
    return died


@pytest.mark.parametrize("inflow, integrator", [("dynamic", "fixed"), ("dynamic", "ida"), ("time-marching", "fixed")])
def test_a_flight_killed_anywhere_is_resumed_to_the_same_bits(starts, tmp_path, monkeypatch, often, inflow, integrator):
    assert kills(starts, tmp_path, monkeypatch, inflow, integrator, range(4)) >= 2


@pytest.mark.slow
@pytest.mark.parametrize("inflow", INFLOW)
@pytest.mark.parametrize("integrator", ["fixed", "ida"])
def test_fifty_kills(starts, tmp_path, monkeypatch, often, inflow, integrator):
    assert kills(starts, tmp_path, monkeypatch, inflow, integrator, range(100, 150)) >= 50


@pytest.fixture(scope="module")
def cut(starts, tmp_path_factory):
    """Folders of flights that were killed in flight, and the whole ones."""
    found = {}
    for inflow in ("dynamic", "time-marching"):
        start, maneuver, more = options(starts, inflow)
        folder = tmp_path_factory.mktemp("cut") / inflow
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(flight_folder, "EVERY", 0.0)
            patch.setattr(flight_folder, "FLUSH_EVERY", 0.0)
            cut_after(patch, 20)

            def flown(folder=folder, start=start, maneuver=maneuver, more=more):
                with contextlib.suppress(wf.Interrupted):
                    wf.fly(start, maneuver, out=folder, **more)
                os.kill(os.getpid(), signal.SIGKILL)

            assert killed(flown) == signal.SIGKILL
        (folder / "run.nc").unlink()
        found[inflow] = folder, wf.fly(start, maneuver, **more).data
    return found


def spoiled(folder, rng, files):
    """Cut one of the files at a random byte, or flip one."""
    path = folder / "restart" / files[rng.integers(len(files))]
    content = bytearray(path.read_bytes())
    at = int(rng.integers(len(content)))
    if rng.random() < 0.5:
        path.write_bytes(content[:at])
        return f"{path.name} cut at {at}"
    content[at] ^= 1 << int(rng.integers(8))
    path.write_bytes(content)
    return f"{path.name} flipped at {at}"


def damages(cut, folder, seeds):
    """What becomes of a flight one of whose files is damaged: the same bits, or one line."""
    went_on = 0
    for seed in seeds:
        rng = np.random.default_rng(seed)
        source, whole = cut[("dynamic", "time-marching")[seed % 2]]
        run = folder / f"{seed}"
        shutil.copytree(source, run)
        files = sorted(path.name for path in (run / "restart").iterdir() if path.name != "owner")
        how, told = spoiled(run, rng, files), []
        try:
            again = wf.resume(run, progress=Told(told))
        except wf.WakeflightError as reason:
            assert "input" in how and "\n" not in str(reason), (how, reason)
        else:
            assert differences(whole, again.data) == {}, how
            went_on += 1
            unseen = ("00000019", "rows.log cut", "input")
            assert any("not used" in text or "damaged" in text for text in told) or any(
                each in how for each in unseen
            ), how
        shutil.rmtree(run)
    return went_on


class Told(Silent):
    """Progress that keeps what it is told."""

    def __init__(self, lines):
        self.lines = lines

    def __call__(self, text):
        self.lines.append(text)


def test_what_is_damaged_is_not_used_and_said(cut, tmp_path):
    assert damages(cut, tmp_path, range(12)) >= 8


@pytest.mark.slow
def test_two_hundred_damages(cut, tmp_path):
    assert damages(cut, tmp_path, range(100, 300)) >= 150


def test_a_dead_flight_is_recovered_and_still_goes_on(cut, tmp_path):
    source, whole = cut["time-marching"]
    run = tmp_path / "run"
    shutil.copytree(source, run)
    with (run / "restart" / "rows.log").open("ab") as stream:
        stream.write(b"torn")
    assert wf.recover(run) == run / "run.nc"
    data = results.load(run / "run.nc")
    assert data.attrs["finished"] == 0 and "ended without a word: rows up to t =" in data.attrs["failure"]
    n = data.sizes["time"]
    assert n == 20 and data.sizes["snapshot"] == 4
    for name in ("p", "modal", "inflow", "wake"):
        assert np.array_equal(data[name], whole[name][: data[name].shape[0]]), name
    assert differences(whole, wf.resume(run).data) == {}
    with pytest.raises(wf.InputError, match="holds no rows of a flight that died"):
        wf.recover(run)


def test_a_result_that_is_whole_is_not_replaced_by_one_that_is_not(starts, tmp_path, monkeypatch, often):
    start, maneuver, more = options(starts, "dynamic")
    whole = wf.fly(start, maneuver, out=tmp_path, **more).data
    (tmp_path / "notes.txt").write_text("of the user")
    before = (tmp_path / "run.nc").read_bytes()
    cut_after(monkeypatch, 9)
    with pytest.raises(wf.Interrupted):
        wf.fly(start, wf.arrested_descent(), out=tmp_path, **more)
    assert (tmp_path / "run.nc").read_bytes() == before
    assert results.load(tmp_path / "run-incomplete.nc").attrs["maneuver"] == "arrested-descent"
    monkeypatch.setattr(flight, "asked", lambda: None)
    again = wf.resume(tmp_path).data
    assert results.load(tmp_path / "run.nc").attrs["maneuver"] == "arrested-descent"
    assert not (tmp_path / "run-incomplete.nc").exists() and (tmp_path / "notes.txt").exists()
    assert again.attrs["finished"] == 1 and differences(whole, again) != {}


def test_a_new_flight_puts_an_unfinished_one_aside(starts, tmp_path, monkeypatch, often):
    start, maneuver, more = options(starts, "dynamic")
    cut_after(monkeypatch, 9)
    with pytest.raises(wf.Interrupted):
        wf.fly(start, maneuver, out=tmp_path, **more)
    monkeypatch.setattr(flight, "asked", lambda: None)
    told = []
    wf.fly(start, maneuver, out=tmp_path, progress=Told(told), **more)
    assert any("did not come to its end: put aside into restart.old" in text for text in told)
    assert (tmp_path / "restart.old" / "rows.log").exists()


def test_what_was_drawn_goes_with_its_run(starts, tmp_path):
    start, maneuver, more = options(starts, "dynamic", revolutions=0.25)
    wf.fly(start, maneuver, out=tmp_path, **more)
    for name in ("sticks.png", "report.html", "mine.png"):
        (tmp_path / name).write_text("")
    results.drawn(tmp_path, ["sticks.png", "report.html", "../escaped"])
    wf.fly(start, maneuver, out=tmp_path, **more)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.png", "restart", "run.nc"]


def test_a_folder_takes_one_flight_at_a_time(starts, tmp_path):
    start, maneuver, more = options(starts, "dynamic", revolutions=0.25)
    with RunFolder(tmp_path) as folder:
        folder.begin(wf.flight.FlightInput.of(start.aircraft, flight.Asked.of(start), flight.Plan(maneuver)))
        for second in (
            lambda: wf.fly(start, maneuver, out=tmp_path, **more),
            lambda: wf.resume(tmp_path),
            lambda: wf.recover(tmp_path),
        ):
            with pytest.raises(wf.InputError, match=rf"a flight is being written there \(process {os.getpid()} since"):
                second()
    wf.fly(start, maneuver, out=tmp_path, **more)


WATCH = """
import sys
import wakeflight as wf
data = wf.open_run(sys.argv[1])
print(data.sizes["time"], data.attrs["finished"], data.attrs["failure"])
"""


def test_a_run_is_watched_while_it_is_flown(starts, tmp_path, monkeypatch, often):
    start, maneuver, more = options(starts, "time-marching")
    whole = wf.fly(start, maneuver, **more).data
    seen, beat = [], RunFolder.beat

    def watched(folder, sim, last=False):
        beat(folder, sim, last)
        if sim.steps in (7, 12):
            data = wf.open_run(tmp_path)
            assert data.sizes["time"] == sim.steps
            assert np.array_equal(data.inflow, whole.inflow[: sim.steps])
            seen.append(sim.steps)
        if sim.steps == 12:
            # and from another process
            done = subprocess.run([sys.executable, "-c", WATCH, str(tmp_path)], capture_output=True, text=True)
            assert done.stdout.startswith("12 0 flight of roll-reversal is being flown, or died: rows up to t ="), done

    monkeypatch.setattr(RunFolder, "beat", watched)
    flown = wf.fly(start, maneuver, out=tmp_path, **more)
    assert seen == [7, 12] and differences(whole, flown.data) == {}
    assert wf.open_run(tmp_path).attrs["finished"] == 1


def test_a_flight_is_flown_further_and_branched(starts, tmp_path):
    start, maneuver, more = options(starts, "time-marching", revolutions=0.5)
    wf.fly(start, maneuver, out=tmp_path / "a", **more)
    whole = wf.fly(start, maneuver, **more | {"revolutions": 1.0}).data
    end = f"{float(whole.time[-1])!r} s"
    assert differences(whole, wf.resume(tmp_path / "a", until=end, out=tmp_path / "b").data) == {}
    assert results.load(tmp_path / "a" / "run.nc").sizes["time"] == 13
    assert differences(whole, wf.resume(tmp_path / "a", until=end).data) == {}
    other = wf.Maneuver("other", {"lateral": [(0.0, 0.0), (0.1, -0.3)]}, revolutions=1.0)
    branched = wf.branch(tmp_path / "a", other)
    assert differences(wf.fly(start, other, **more | {"revolutions": None}).data, branched.data) == {}
    assert differences(whole, results.load(tmp_path / "a" / "run.nc")) == {}
    with pytest.raises(wf.InputError, match="until"):
        wf.resume(tmp_path / "a", until=3.0)


@pytest.mark.parametrize("number, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_signal_ends_the_command_line_at_the_next_exchange(starts, tmp_path, number, code):
    from wakeflight.cli import main

    run = tmp_path / "run"
    child = os.fork()
    if child == 0:
        try:
            main(
                ["fly", "roll-reversal", "--inflow", "dynamic", "--blades", "rigid", "--no-figures", "--out", str(run)]
            )
        except SystemExit as end:
            os._exit(int(end.code or 0))
        finally:
            os._exit(99)
    while not (run / "restart" / "rows.log").exists() and os.waitpid(child, os.WNOHANG) == (0, 0):
        time.sleep(0.01)
    time.sleep(0.1)
    os.kill(child, number)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == code
    data = results.load(run / "run.nc")
    assert data.attrs["finished"] == 0 and f"interrupted by {number.name} at t =" in data.attrs["failure"]
    assert (run / "restart" / "rows.log").exists()


def limited(size, action):
    """Do it in a child whose files cannot grow beyond `size`; what it said."""
    read, write = os.pipe()

    def full():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        try:
            action()
        except wf.WakeflightError as reason:
            os.write(write, json.dumps([reason.exit_code, str(reason)]).encode())

    assert killed(full) == 0
    os.close(write)
    with os.fdopen(read) as stream:
        return json.loads(stream.read())


@pytest.mark.parametrize("kilobytes", [0, 4, 110, 200])
def test_a_full_disk_ends_in_one_line_and_keeps_what_is_there(starts, tmp_path, often, kilobytes):
    start, maneuver, more = options(starts, "dynamic")
    whole = wf.fly(start, maneuver, out=tmp_path, **more).data
    before = (tmp_path / "run.nc").read_bytes()
    code, said = limited(kilobytes * 1000, lambda: wf.fly(start, maneuver, out=tmp_path, **more))
    assert code == 3 and said.endswith("cannot be written: File too large") and "\n" not in said
    assert (tmp_path / "run.nc").read_bytes() == before
    if (tmp_path / "restart" / "rows.log").exists():
        (tmp_path / "run.nc").unlink()
        assert differences(whole, wf.resume(tmp_path).data) == {}


def test_a_folder_that_goes_in_flight_ends_in_one_line(starts, tmp_path, monkeypatch, often):
    start, maneuver, more = options(starts, "dynamic")
    beat = RunFolder.beat

    def gone(folder, sim, last=False):
        if sim.steps == 9:
            shutil.rmtree(tmp_path / "run")
        beat(folder, sim, last)

    monkeypatch.setattr(RunFolder, "beat", gone)
    with pytest.raises(wf.StorageFailure, match=r"rows\.log: cannot be written: the folder is gone"):
        wf.fly(start, maneuver, out=tmp_path / "run", **more)
    assert not (tmp_path / "run").exists()
