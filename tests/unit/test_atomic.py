"""Files are there whole or not at all, figures look the same on every machine, older results are read."""

import hashlib
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import wakeflight as wf
from wakeflight import atomic, report, results
from wakeflight.errors import StorageFailure

STORED = Path(__file__).parent / "data" / "run-schema-1.nc"


@pytest.fixture(scope="module")
def run():
    return results.load(STORED)


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_what_is_written_half_leaves_the_old_file(tmp_path):
    path = atomic.write_text(tmp_path / "deep" / "a.txt", "old")
    with pytest.raises(RuntimeError), atomic.written(path) as stream:
        stream.write(b"new")
        raise RuntimeError
    assert path.read_text() == "old"
    assert names(path.parent) == ["a.txt"]


def test_a_link_is_followed(tmp_path):
    target = atomic.write_text(tmp_path / "there" / "a.txt", "old")
    link = tmp_path / "a.txt"
    link.symlink_to(target)
    atomic.write_text(link, "new")
    assert link.is_symlink() and target.read_text() == "new"


def test_what_a_killed_write_left_is_swept(tmp_path):
    code = (
        "import sys, os\nfrom wakeflight import atomic\nwith atomic.written(sys.argv[1]) as s: os.kill(os.getpid(), 9)"
    )
    assert subprocess.run([sys.executable, "-c", code, str(tmp_path / "a.nc")]).returncode == -signal.SIGKILL
    (tmp_path / ".of-the-user.part").write_text("")
    assert len(names(tmp_path)) == 2
    atomic.sweep(tmp_path)
    assert names(tmp_path) == [".of-the-user.part"]


def test_where_nothing_can_be_written_one_line_says_so(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(StorageFailure, match=r"file/a\.txt: cannot be written") as said:
        atomic.write_text(tmp_path / "file" / "a.txt", "new")
    assert said.value.exit_code == 3 and "\n" not in str(said.value)


SAVE = f"""
import resource, signal, sys
from wakeflight import results
from wakeflight.errors import StorageFailure
run = results.load({str(STORED)!r})
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]),) * 2)
try:
    results.save(run, sys.argv[1])
except StorageFailure as reason:
    print(reason)
    sys.exit(3)
"""


@pytest.mark.parametrize("limit", [0, 5_000, 100_000])
def test_a_full_disk_leaves_the_old_run(tmp_path, run, limit):
    # HDF5 falls over a failing write, some versions with a segmentation fault at the end of the process
    path = results.save(run, tmp_path / "run.nc")
    before = path.read_bytes()
    done = subprocess.run([sys.executable, "-c", SAVE, str(path), str(limit)], capture_output=True, text=True)
    assert done.returncode == 3 and done.stdout == f"{path}: cannot be written: File too large\n"
    assert path.read_bytes() == before
    assert names(tmp_path) == ["run.nc"]


def test_whoever_reads_keeps_what_he_opened(tmp_path, run):
    path = results.save(run, tmp_path / "run.nc")
    with xr.open_dataset(path, engine="h5netcdf") as held:
        results.save(run.isel(time=slice(0, 2)), path)
        assert np.array_equal(held.u.values, run.u.values)
    assert results.load(path).sizes["time"] == 2


def test_a_result_of_the_first_schema_is_read_and_of_a_newer_one_refused(tmp_path, run):
    assert "schema" not in run.attrs and run.sizes["time"] == 10
    assert run.attrs["aircraft"] and np.isfinite(run.u).all()
    newer = run.assign_attrs(schema=99)
    with pytest.raises(results.ResultsError, match=r"newer\.nc: schema = 99: this program reads 1 to"):
        results.load(results.save(newer, tmp_path / "newer.nc"))


DRAW = f"""
import sys
from wakeflight import report, results
report.write(results.load({str(STORED)!r}), sys.argv[1])
"""

ODD = {
    "no-home": {"HOME": None, "DISPLAY": None, "XDG_CONFIG_HOME": None, "MPLCONFIGDIR": None},
    "notebook": {"MPLBACKEND": "module://no_such_package.backend_inline"},
    "backend": {"MPLBACKEND": "nonsense"},
    "locale": {"LC_ALL": "de_DE.ISO-8859-1", "LANG": "de_DE.ISO-8859-1"},
    "settings": {"MATPLOTLIBRC": "text.usetex: True\nfont.size: 40\nfigure.facecolor: red\nsavefig.bbox: tight\n"},
    "unreadable": {"MATPLOTLIBRC": "font.size: \udcff\n"},
}


TOGETHER = (("no-home", "notebook", "settings"), ("locale", "backend", "unreadable"))
"""A process draws seconds: one of these for oddities of different kinds, that have nothing in common."""


def drawn(folder, more=()):
    environment = {**os.environ, **dict(more)}
    environment = {name: value for name, value in environment.items() if value is not None}
    subprocess.run([sys.executable, "-c", DRAW, str(folder)], env=environment, check=True)
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in folder.iterdir()}


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    return drawn(tmp_path_factory.mktemp("plain") / "figures")


@pytest.mark.parametrize("odd", TOGETHER, ids="+".join)
def test_figures_are_the_same_on_every_machine(tmp_path, plain, odd):
    more = {name: value for each in odd for name, value in ODD[each].items()}
    assert len(more) == sum(len(ODD[each]) for each in odd), "one of them would hide another"
    if "MATPLOTLIBRC" in more:
        (tmp_path / "matplotlibrc").write_bytes(more["MATPLOTLIBRC"].encode(errors="surrogateescape"))
        more["MATPLOTLIBRC"] = str(tmp_path / "matplotlibrc")
    assert len(plain) > 5
    assert drawn(tmp_path / "figures", more) == plain


def test_every_oddity_of_a_machine_is_met():
    assert sorted(name for odd in TOGETHER for name in odd) == sorted(ODD)


def test_a_figure_that_cannot_be_drawn_stops_itself_alone(tmp_path, run, monkeypatch):
    def falling(_):
        raise RuntimeError("no such <font>")

    plots = report.page.FIGURES
    broken = report.page.Plot("sticks", falling, "", lambda _: True)
    monkeypatch.setattr(report.page, "FIGURES", (broken, *plots[1:3]))
    page = report.write(run, tmp_path).read_text()
    assert "figure sticks could not be drawn: RuntimeError: no such &lt;font&gt;" in page
    assert names(tmp_path) == [".drawn", "body-states.png", "forces-moments.png", "report.html"]


def test_errors_are_one_family():
    assert issubclass(StorageFailure, wf.WakeflightError)


def test_a_device_is_not_replaced(tmp_path):
    # a write that renames over /dev/null would take it from the machine
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for there in (pipe, tmp_path):
        with pytest.raises(StorageFailure, match="not a plain file"):
            atomic.write_text(there, "new")
    assert pipe.is_fifo()
