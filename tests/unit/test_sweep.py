"""Sweeps: cases checked before any runs; the same table for any number of workers; failures as values; resumed after a kill."""

import os
import signal
import subprocess
import sys
import time
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import sweep_cases
import xarray as xr

import wakeflight as wf
from wakeflight import cli
from wakeflight.results import load, save

HERE = Path(__file__).parent
FLAT = {"flight_path": "0 deg", "altitude": "0 ft", "inflow": "dynamic"}


# --- cases -----------------------------------------------------------------------------------------------------------


def test_a_grid_has_every_combination_in_order_with_labels_and_numbers():
    cases = wf.grid(speed=wf.arange("0 kt", "40 kt", "20 kt"), n=[4, 5], inflow="dynamic")
    assert len(cases) == 6 and cases.shape == (("speed", 3), ("n", 2))
    assert cases.cases[3] == {"inflow": "dynamic", "speed": "20 kt", "n": 5}
    assert cases.label(3) == "speed = 20 kt, n = 5"
    np.testing.assert_array_equal(cases.coordinates["speed_value"][1], [0.0, 20.0, 40.0])
    assert cases.coordinates["speed_value"][2] == {"units": "kt"}


@pytest.mark.parametrize(
    ("given", "values"),
    [
        (("0 kt", "160 kt", "10 kt"), [f"{k} kt" for k in range(0, 161, 10)]),
        (("0 m/s", "36 km/h", "5 m/s"), ["0 m/s", "5 m/s", "10 m/s"]),
        ((0.0, 0.3, 0.1), [0.0, 0.1, 0.2, pytest.approx(0.3)]),
        (("6 deg", "2 deg", "-2 deg"), ["6 deg", "4 deg", "2 deg"]),
    ],
)
def test_a_range_has_both_ends(given, values):
    assert wf.arange(*given) == values


@pytest.mark.parametrize(
    "given", [("0 kt", "15 kt", "10 kt"), ("0 kt", "15 kt", "0 kt"), ("0 kt", "15 ft", "5 kt"), (0, "15 kt", "5 kt")]
)
def test_a_range_that_does_not_end_is_refused(given):
    with pytest.raises(wf.InputError):
        wf.arange(*given)


def test_a_sample_depends_on_seed_and_name_alone():
    weight, speed = wf.Normal("16000 lbf", "300 lbf"), wf.Uniform("70 kt", "90 kt")
    few = wf.sample(3, seed=7, weight=weight)
    more = wf.sample(50, seed=7, speed=speed, weight=weight)
    assert [case["weight"] for case in few.cases] == [case["weight"] for case in more.cases][:3]
    speeds = more.coordinates["speed_value"][1]
    assert speeds.min() >= 70.0 and speeds.max() <= 90.0 and speeds.std() == pytest.approx(20 / 12**0.5, rel=0.3)
    assert wf.sample(3, seed=8, weight=weight).cases != few.cases
    # drawn in the unit of the mean
    assert wf.sample(1, x=wf.Normal("1 m", "100 ft")).cases[0]["x"].endswith(" m")


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: wf.grid(speed=[]),
        lambda: wf.grid(speed=["1 kt", "1 kt"]),
        lambda: wf.grid(**{"a/b": [1]}),
        lambda: wf.sample(0),
        lambda: wf.sample(2, x=[1]),
        lambda: wf.Normal("16000 lbf", 300),
        lambda: wf.Normal("16000 lbf", "3 ft"),
        lambda: wf.Uniform("90 kt", "70 kt"),
        lambda: wf.sweep("hover", wf.grid(x=[1])),
        lambda: wf.sweep(sweep_cases.doubled, [1]),
        lambda: wf.sweep(sweep_cases.doubled, wf.grid(x=[1]), workers=0),
        lambda: wf.sweep(sweep_cases.doubled, wf.grid(x=[1]), client=object()),
        lambda: wf.sweep(sweep_cases.doubled, wf.grid(x=[1]), resume=True),
        lambda: wf.sweep(sweep_cases.doubled, wf.grid(x=[1]), x=2),
        lambda: wf.sweep(lambda x: x, wf.grid(x=[1])),
    ],
)
def test_what_is_no_sweep_is_refused(wrong):
    with pytest.raises(wf.InputError):
        wrong()


@pytest.mark.parametrize(
    ("verb", "axes", "said"),
    [
        ("trim", {"speed": ["80 kt", "80 ft"]}, "case speed = 80 ft: speed = '80 ft'"),
        ("trim", {"sped": ["80 kt"]}, "did you mean speed"),
        ("trim", {"inflow": ["dynamic", "frozen"]}, "case inflow = frozen"),
        ("trim", {"inflow.turns": [-1], "inflow": ["relaxation"]}, "turns"),
        ("trim", {"aircraft.rotor.omga": ["26 rad/s"]}, "is omega meant"),
        ("trim", {"aircraft": ["dc3"]}, "aircraft = 'dc3'"),
        ("trim", {"n_harmonics": ["many"]}, "n_harmonics"),
        ("trim", {"power": ["3 kt"]}, "power"),
        ("fly", {"speed": ["80 kt"]}, "maneuver = 'missing'"),
        ("fly", {"maneuver": ["loop"]}, "maneuver = 'loop'"),
        ("linearize", {"method": ["guessing"]}, "method"),
        ("linearize", {"inputs": ["throttle"]}, "inputs"),
        ("tunnel", {"collective": ["8 deg", "8 ft"]}, "collective = '8 ft'"),
        ("tunnel", {"collectiv": ["8 deg"]}, "did you mean collective"),
        (sweep_cases.doubled, {"w": [1]}, "sweep_cases.doubled"),
    ],
)
def test_every_case_is_checked_before_the_first_runs(verb, axes, said, monkeypatch):
    # an engine that is begun would fail the test
    monkeypatch.setattr(import_module("wakeflight.sweep"), "local", None)
    with pytest.raises(wf.InputError, match=said.replace("'", ".")):
        wf.sweep(verb, wf.grid(**axes), workers=1)


# --- the table --------------------------------------------------------------------------------------------------------


def test_functions_of_a_case_become_a_table():
    table = wf.sweep(sweep_cases.doubled, wf.grid(x=[1.0, 2.0], flavour=["sweet", "salt"]), workers=2, y=0.5)
    np.testing.assert_array_equal(table.z, [[2.5, 2.5], [4.5, 4.5]])
    assert table.taste.sel(x=2.0, flavour="salt") == "salt"
    assert table.attrs["cases"] == 4 and table.attrs["failed"] == 0


def test_a_case_that_fails_is_a_value_with_its_reason():
    table = wf.sweep(sweep_cases.moody, [{"x": 1}, {"x": 2}, {"x": 3}], workers=1)
    np.testing.assert_array_equal(table.z, [1.0, np.nan, 3.0])
    assert list(table.failure.values[[0, 2]]) == ["", ""] and "ValueError: no answer at 2" in str(
        table.failure.values[1]
    )
    foreseen = wf.sweep(sweep_cases.unusable, wf.grid(x=[1]), workers=1)
    assert str(foreseen.failure.values[0]) == "blade 2 left at psi = 90 deg" and not foreseen.attrs["failed"] - 1


def test_results_of_different_length_and_names_stand_side_by_side(tmp_path):
    table = wf.sweep(sweep_cases.history, wf.grid(x=[1, 3]), workers=1)
    assert table.v.dims == ("x", "time_step") and table.time.dims == ("x", "time_step")
    np.testing.assert_array_equal(table.time.sel(x=1).values[:3], [0.0, 0.1, 0.2])
    assert np.isnan(table.v.sel(x=1).values[3:]).all() and np.isfinite(table.v.sel(x=3)).all()
    assert list(table.name.values) == ["a", "b", "c"] and list(table.same.values) == [0.5, 1.5]
    assert np.isnan(table.m.sel(x=1, name="c")).all() and (table.m.sel(x=3, name="b") == 3.0).all()
    # one length alone keeps its coordinate
    alone = wf.sweep(sweep_cases.history, wf.grid(x=[1]), workers=1)
    assert alone.v.dims == ("x", "time")
    assert load(save(table, tmp_path / "table.nc")).equals(table)


def test_numbers_of_other_kinds_become_plain_ones():
    table = wf.sweep(sweep_cases.root, wf.grid(x=[1, 2]), workers=1)
    np.testing.assert_array_equal(table.root_imag, [1.0, 1.0])
    np.testing.assert_array_equal(table.good, [0.0, 1.0])
    assert {table[name].dtype.kind for name in ("root_real", "n", "good")} == {"f"}


def test_a_table_keeps_what_is_asked_for():
    cases = wf.grid(speed=["80 kt"])
    table = wf.sweep("trim", cases, workers=1, keep=["power", "inflow"], **FLAT)
    assert set(table.data_vars) == {"power", "inflow", "failure", "warnings"}
    assert table.inflow.dims == ("speed", "azimuth", "station")
    # what no trim has is refused before the first is run
    with pytest.raises(wf.InputError, match="keep = 'powr': did you mean power"):
        wf.sweep("trim", cases, workers=1, keep="powr", **FLAT)
    assert wf.sweep("trim", cases, workers=1, keep=["azimuth", "inflow"], **FLAT).sizes["azimuth"] > 1


# --- engines -----------------------------------------------------------------------------------------------------------


def test_workers_have_one_thread():
    table = wf.sweep(sweep_cases.threads, wf.grid(x=[1]), workers=1)
    assert str(table.wakeflight_threads.values[0]) == str(table.openblas_num_threads.values[0]) == "1"


def test_a_process_that_dies_is_replaced_and_its_case_given_once_more(tmp_path):
    cases = wf.grid(x=[0, 1, 2, 3])
    table = wf.sweep(sweep_cases.murdered_once, cases, workers=2, folder=str(tmp_path))
    np.testing.assert_array_equal(table.z, [0.0, 1.0, 2.0, 3.0])


def test_a_case_that_kills_twice_has_the_signal_as_its_reason():
    table = wf.sweep(sweep_cases.murdered, wf.grid(x=[0, 1, 2, 3]), workers=2)
    np.testing.assert_array_equal(table.z, [0.0, np.nan, 2.0, 3.0])
    assert "SIGKILL" in str(table.failure.values[1])


@pytest.fixture(scope="module")
def trims():
    """Trims of one worker, one of which has no answer."""
    cases = wf.grid(speed=["0 kt", "80 kt", "300 kt"], **{"aircraft.rotor.omega": ["26 rad/s", "27 rad/s"]})
    return cases, wf.sweep(wf.trim, cases, workers=1, **FLAT)


def test_one_worker_and_two_give_the_same_file(trims, tmp_path):
    cases, one = trims
    two = wf.sweep("trim", cases, workers=2, **FLAT)
    files = [save(each, tmp_path / f"{k}.nc").read_bytes() for k, each in enumerate((one, two))]
    assert files[0] == files[1] and one.attrs["failed"] == 2
    assert "no trim found" in str(one.failure.sel(speed="300 kt").values[0])


def test_a_sweep_is_what_the_verb_gives_alone(trims):
    _, table = trims
    aircraft = wf.load_aircraft("uh60a").with_({"rotor.omega": "26 rad/s"})
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft")
    alone = wf.trim(aircraft, condition, inflow="dynamic").to_dataset()
    at = table.sel(speed="80 kt").isel({"aircraft.rotor.omega": 0})
    for name in ("power", "collective", "pitch", "ct"):
        assert float(at[name]) == float(alone[name])


def test_dask_gives_the_same_bits(trims, tmp_path):
    distributed = pytest.importorskip("distributed")
    cases, one = trims
    with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        other = wf.sweep("trim", cases, client=client, **FLAT)
        failing = wf.sweep(sweep_cases.moody, wf.grid(x=[1, 2]), client=client)
    assert save(one, tmp_path / "a.nc").read_bytes() == save(other, tmp_path / "b.nc").read_bytes()
    assert "no answer at 2" in str(failing.failure.values[1])


def test_flights_and_stands_are_swept():
    hands = wf.Maneuver("step", {"lateral": [(0.0, 0.0), (0.1, 0.3)]}, seconds=0.2)
    sample = wf.sample(2, seed=3, weight=wf.Normal("16000 lbf", "300 lbf"))
    flown = wf.sweep(wf.fly, sample, workers=1, maneuver=hands, integrator="fixed", blades="rigid", **FLAT)
    assert flown.p.dims == ("member", "time") and np.isfinite(flown.p).all() and "inflow" not in flown
    stand = wf.sweep(
        "tunnel",
        wf.grid(collective=["12 deg", "14 deg"]),
        workers=1,
        inflow="annular",
        keep=["ct", "cq"],
        blades="rigid",
    )
    assert stand.ct[1] > stand.ct[0] > 0.0


def test_blades_of_a_case_are_those_of_the_aircraft_for_linear_models_too():
    table = wf.sweep(
        wf.linearize, wf.grid(speed=["60 kt"], blades=["rigid", "flexible"]), workers=1, order=8, keep=["A"], **FLAT
    )
    assert not any(table.failure.values.ravel()) and np.isfinite(table.A.values).all()
    assert not np.allclose(table.A.values[0, 0], table.A.values[0, 1])
    with pytest.raises(wf.InputError, match="blades = 'individual': allowed: rigid, flexible"):
        wf.sweep(wf.linearize, wf.grid(speed=["60 kt"], blades=["individual"]), workers=1, **FLAT)


def test_derivatives_over_speed_are_one_call():
    table = wf.sweep(wf.linearize, wf.grid(speed=["60 kt", "100 kt"]), workers=1, order=8, keep=["A"], **FLAT)
    damping = table.A.sel(state="p").isel({table.A.dims[-1]: list(table.state.values).index("p")})
    assert (damping < 0.0).all()
    metrics = wf.sweep(wf.handling_qualities, wf.grid(speed=["80 kt"]), workers=1, **FLAT)
    assert np.isfinite(metrics.bandwidth.sel(axis="roll")).all()


# --- folder ------------------------------------------------------------------------------------------------------------


def test_a_folder_keeps_finished_cases_and_only_the_rest_is_run(tmp_path):
    out, marks = tmp_path / "out", tmp_path / "marks"
    marks.mkdir()
    cases = wf.grid(x=[1, 2, 3, 4])
    whole = wf.sweep(sweep_cases.counted, cases, workers=1, folder=str(marks))
    kept = wf.sweep(sweep_cases.counted, cases, workers=1, folder=str(marks), out=out)
    with pytest.raises(wf.InputError, match="holds 4 finished cases"):
        wf.sweep(sweep_cases.counted, cases, workers=1, folder=str(marks), out=out)
    files = sorted((out / "cases").iterdir())
    files[0].unlink()
    files[1].write_bytes(files[1].read_bytes()[:100])
    resumed = wf.sweep(sweep_cases.counted, cases, workers=2, folder=str(marks), out=out, resume=True)
    assert len((marks / "runs.txt").read_text().split()) == 4 + 4 + 2
    assert whole.identical(kept) and whole.identical(resumed)
    assert load(out / "table.nc").equals(whole)
    # another case is another file: nothing is mixed up
    other = wf.sweep(sweep_cases.counted, wf.grid(x=[9]), workers=1, folder=str(marks), out=out, resume=True)
    assert float(other.z[0]) == 3.0


def test_one_sweep_at_a_time_writes_into_a_folder(tmp_path):
    from wakeflight.sweep.folder import SweepFolder

    with SweepFolder(tmp_path), pytest.raises(wf.InputError, match="another sweep is being written"):
        wf.sweep(sweep_cases.doubled, wf.grid(x=[1.0]), workers=1, out=tmp_path)


SWEEP = """
verb = "trim"
keep = ["power", "collective"]
[axes]
speed = { from = "20 kt", to = "120 kt", by = "20 kt" }
[fixed]
flight_path = "0 deg"
altitude = "0 ft"
inflow = "dynamic"
[figure]
y = "power"
"""


def test_killed_and_resumed_is_identical(tmp_path):
    file = tmp_path / "power.toml"
    file.write_text(SWEEP)
    asked = ["sweep", str(file), "--workers", "1", "--no-figures", "--out"]
    cut, whole = tmp_path / "cut", tmp_path / "whole"
    command = [sys.executable, "-m", "wakeflight", *asked, str(cut)]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    while process.poll() is None and len(list((cut / "cases").glob("*.npz"))) < 2:
        time.sleep(0.05)
    process.send_signal(signal.SIGKILL)
    process.wait()
    n_done = len(list((cut / "cases").glob("*.npz")))
    assert 2 <= n_done < 6 and not (cut / "table.nc").exists()
    for folder, more in ((cut, ["--resume"]), (whole, [])):
        assert _run([*asked, folder, *more]) == 0
    assert (cut / "table.nc").read_bytes() == (whole / "table.nc").read_bytes()


# --- command line and files ----------------------------------------------------------------------------------------------


def _run(arguments):
    with pytest.raises(SystemExit) as ended:
        cli.main([*map(str, arguments)])
    return ended.value.code


def test_the_command_line_draws_and_says_what_failed(tmp_path, capsys):
    file = tmp_path / "s.toml"
    file.write_text(SWEEP.replace('{ from = "20 kt", to = "120 kt", by = "20 kt" }', '["80 kt", "300 kt"]'))
    assert _run(["sweep", file, "--workers", 1, "--out", tmp_path / "out"]) == 3
    told = capsys.readouterr()
    assert "1 of 2 cases have no answer" in told.err and (tmp_path / "out" / "sweep.png").is_file()
    assert load(tmp_path / "out" / "table.nc").sizes == {"speed": 2}


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        ('verb = "trim"', "", "verb"),
        ('verb = "trim"', 'verb = "trin"', "did you mean trim"),
        ("[axes]", "[axis]", "did you mean axes"),
        ('by = "20 kt"', 'by = "7 kt"', "whole number of steps"),
        ('"20 kt", to', '"20 ft", to', "power.toml"),
        ('flight_path = "0 deg"', 'flight_path = "0 ft"', "flight_path"),
        ('y = "power"', 'z = "power"', "figure"),
        ("[fixed]", "[sample]\nn = 3\n[fixed]", "axes, sample"),
        ("keep =", "kept =", "did you mean keep"),
    ],
)
def test_a_wrong_file_is_refused_in_one_line(before, after, said, tmp_path, capsys):
    file = tmp_path / "power.toml"
    file.write_text(SWEEP.replace(before, after))
    assert _run(["sweep", file, "--out", tmp_path / "out"]) == 2
    told = [line for line in capsys.readouterr().err.splitlines() if line.startswith("wakeflight:")]
    assert len(told) == 1 and said in told[0] and "power.toml" in told[0]
    assert not (tmp_path / "out" / "table.nc").exists()


def test_a_sample_in_a_file_is_that_of_python(tmp_path):
    from wakeflight.sweep.file import read_sweep

    file = tmp_path / "s.toml"
    file.write_text(
        'verb = "trim"\n[sample]\nn = 4\nseed = 2\nweight = { normal = ["16000 lbf", "300 lbf"] }\n'
        'aircraft.loading.cg_station = { uniform = ["352 in", "360 in"] }\n'
    )
    read = read_sweep(file)
    station = wf.Uniform("352 in", "360 in")
    given = {"weight": wf.Normal("16000 lbf", "300 lbf"), "aircraft.loading.cg_station": station}
    assert read.cases.cases == wf.sample(4, seed=2, **given).cases


def test_tables_are_drawn():
    from wakeflight.plotting import sweeps

    axes = xr.Dataset(
        {
            "power": (("speed", "inflow"), np.ones((3, 2)), {"units": "W"}),
            "failure": (("speed", "inflow"), [[""] * 2] * 3),
        },
        coords={"speed": ["a", "b", "c"], "inflow": ["dynamic", "relaxation"]},
    )
    figure = sweeps.figure(axes)
    assert figure.axes[0].get_ylabel() == "power [kW]" and len(figure.axes[0].lines) == 2
    members = xr.Dataset(
        {
            "p": (("member", "time"), np.random.default_rng(0).random((9, 5)), {"units": "rad/s"}),
            "failure": ("member", [""] * 9),
        },
        coords={"member": np.arange(9), "time": np.arange(5.0)},
    )
    assert sweeps.figure(members, "p").axes[0].get_ylabel() == "p [deg/s]"
    with pytest.raises(wf.InputError, match="did you mean power"):
        sweeps.figure(axes, "powr")


def test_processes_do_not_outlive_a_sweep(tmp_path):
    script = tmp_path / "s.py"
    script.write_text(
        "import sys, wakeflight as wf\n"
        f"sys.path.insert(0, {str(HERE)!r})\n"
        "import sweep_cases\n"
        'if __name__ == "__main__":\n'
        "    wf.sweep(sweep_cases.doubled, wf.grid(x=[1.0]), workers=1)\n"
        "    import multiprocessing\n"
        "    print(len(multiprocessing.active_children()))\n"
    )
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, env=dict(os.environ))
    assert done.stdout.strip() == "0", done.stderr


def test_a_script_without_a_guard_is_told_of_it(tmp_path):
    script = tmp_path / "s.py"
    script.write_text(
        "import sys, wakeflight as wf\n"
        f"sys.path.insert(0, {str(HERE)!r})\n"
        "import sweep_cases\n"
        "wf.sweep(sweep_cases.doubled, wf.grid(x=[1.0]), workers=1)\n"
    )
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, env=dict(os.environ))
    assert "__main__" in done.stderr.splitlines()[-1]
