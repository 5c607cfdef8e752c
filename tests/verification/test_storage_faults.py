"""A quota that is used up, a file system that turns read-only, a folder that may no more be written: one line, nothing lost."""

import errno
import os
import shutil
from pathlib import Path

import pytest

import wakeflight as wf
from wakeflight import flight_folder, report, results
from wakeflight.cli import main
from wakeflight.flight_folder import RunFolder
from wakeflight.resuming import differences

FAULTS = {"quota": errno.EDQUOT, "read-only": errno.EROFS, "no right": errno.EACCES, "full": errno.ENOSPC}
WRITES = ((os, "write"), (os, "fsync"), (os, "ftruncate"), (Path, "replace"), (Path, "unlink"), (Path, "mkdir"))


class Storage:
    """Counts what is written below a folder, and refuses it from a moment on."""

    def __init__(self, folder, monkeypatch):
        self.folder, self.number, self.left, self.counted = folder, 0, None, 0
        for owner, name in WRITES:
            monkeypatch.setattr(owner, name, self.guarded(getattr(owner, name)))
        for owner, name in ((os, "open"), (Path, "open")):
            monkeypatch.setattr(owner, name, self.guarded(getattr(owner, name), self.to_be_written))

    @staticmethod
    def to_be_written(how):
        if not how:
            return False
        return bool(how[0] & (os.O_WRONLY | os.O_RDWR)) if isinstance(how[0], int) else how[0][:1] in "wxa"

    def inside(self, what):
        if isinstance(what, int):
            what = Path(f"/proc/self/fd/{what}").readlink()
        return str(what).startswith(str(self.folder))

    def guarded(self, action, counts=lambda how: True):
        def done(what, *how, **more):
            if counts(how) and self.inside(what):
                self.counted += 1
                if self.left is not None and self.counted > self.left:
                    raise OSError(self.number, os.strerror(self.number), str(what))
            return action(what, *how, **more)

        return done

    def refuse(self, number, after):
        """From the `after`-th write on."""
        self.number, self.left, self.counted = number, after, 0

    def allow(self):
        """As if nothing had been."""
        self.left = None


@pytest.fixture
def often(monkeypatch):
    monkeypatch.setattr(flight_folder, "EVERY", 0.0)
    monkeypatch.setattr(flight_folder, "FLUSH_EVERY", 0.0)


def flown(starts, out=None):
    return wf.fly(starts["rigid", "dynamic"], wf.roll_reversal(), integrator="fixed", revolutions=0.2, out=out).data


@pytest.mark.parametrize("every", [24, pytest.param(1, marks=pytest.mark.slow)])
@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_at_any_write_ends_in_one_line_and_loses_nothing(starts, tmp_path, monkeypatch, often, fault, every):
    whole, storage = flown(starts), Storage(tmp_path, monkeypatch)
    flown(starts, tmp_path / "counted")
    writes, refused, went_on = storage.counted, 0, 0
    # each fault at other places
    for after in range(list(FAULTS).index(fault) * every // 4, writes, every):
        run = tmp_path / f"{after}"
        storage.refuse(FAULTS[fault], after)
        try:
            flown(starts, run)
        except wf.StorageFailure as said:
            refused += 1
            assert said.exit_code == 3 and str(said).endswith(os.strerror(FAULTS[fault])), said
            assert "\n" not in str(said) and str(run) in str(said)
        finally:
            storage.allow()
        if (run / "run.nc").exists():
            assert differences(whole, results.load(run / "run.nc")) == {}
        if (run / "restart" / "input.json").exists():
            assert differences(whole, wf.resume(run).data) == {}, after
            went_on += 1
        shutil.rmtree(run, ignore_errors=True)
    assert refused > 2 and went_on > 2


@pytest.mark.parametrize("after", [0, 5, 30, "figures", "gone"])
def test_the_command_line_says_one_line(tmp_path, monkeypatch, capsys, often, after):
    run = tmp_path / "run"
    told = ["fly", "roll-reversal", "--inflow", "dynamic", "--blades", "rigid", "--integrator", "fixed"]
    storage, beat, drawn = Storage(tmp_path, monkeypatch), RunFolder.beat, report.write

    def gone(folder, sim, last=False):
        if after == "gone" and sim.steps == 4:
            shutil.rmtree(run)
        beat(folder, sim, last)

    def full(*arguments, **named):
        storage.refuse(errno.EDQUOT, 2)
        return drawn(*arguments, **named)

    monkeypatch.setattr(RunFolder, "beat", gone)
    if after == "figures":
        monkeypatch.setattr(report, "write", full)
    elif after != "gone":
        storage.refuse(errno.EROFS, after)
    with pytest.raises(SystemExit) as ended:
        main([*told, "--revolutions", "0.2", "--out", str(run)])
    said = capsys.readouterr().err.strip().splitlines()
    lines = [line for line in said if "cannot be written" in line]
    assert ended.value.code == 3 and len(lines) == 1 and lines[0] == said[-1], said
    assert "Traceback" not in "".join(said)
    if after == "figures":
        assert results.load(run / "run.nc").attrs["finished"] == 1
