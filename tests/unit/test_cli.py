# SPDX-License-Identifier: MIT OR Apache-2.0
"""Command line: whatever is wrong gets one line and exit code 2, and nothing is started."""

import os
import shutil
import subprocess
import sys
from importlib import resources
from pathlib import Path

import pytest

from wakeflight import cli
from wakeflight.cli import outcome
from wakeflight.errors import InputError, NumericalFailure

FLY = ["fly", "arrested-descent"]
CONVERGE = ["converge", "trim", "--vary"]


def _run(capsys, arguments):
    with pytest.raises(SystemExit) as caught:
        cli.main(arguments)
    streams = capsys.readouterr()
    return caught.value.code, streams.out, streams.err


@pytest.fixture(autouse=True)
def _nothing_starts(monkeypatch):
    # whatever gets past the checks fails the test
    def started(*_args):
        raise AssertionError("started")

    monkeypatch.setattr(outcome, "fly_once", started)
    monkeypatch.delenv("WAKEFLIGHT_THREADS", raising=False)


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ([*FLY, "--speed", "80"], "speed"),
        ([*FLY, "--speed", "80 kg"], "speed"),
        ([*FLY, "--speed", "-5 kt"], "speed"),
        ([*FLY, "--flight-path", "6"], "flight_path"),
        ([*FLY, "--altitude", "5250 kt"], "altitude"),
        ([*FLY, "--weight", "0 lbf"], "weight"),
        ([*FLY, "--weight", "500 lbf"], "blades"),
        (["fly", "no-such-manoeuvre"], "no-such-manoeuvre"),
        ([*FLY, "--aircraft", "/nowhere.toml"], "/nowhere.toml"),
        ([*FLY, "--control", "/nowhere.toml"], "control = '/nowhere.toml': no such file"),
        ([*FLY, "--loading", "empty"], "loading"),
        ([*FLY, "--condition", "nowhere"], "condition"),
        ([*FLY, "--inflow", "magic"], "inflow"),
        ([*FLY, "--azimuth-step", "7 deg"], "azimuth_step"),
        ([*FLY, "--azimuth-step", "8 deg"], "azimuth_step"),
        ([*FLY, "--azimuth-step", "10"], "azimuth_step"),
        ([*FLY, "--wake-turns", "0"], "turns"),
        ([*FLY, "--wake-scheme", "euler"], "scheme"),
        ([*FLY, "--wake-scheme", "pcc", "--inflow", "dynamic"], "--wake-scheme"),
        ([*FLY, "--wake", "core_raduis=0.03"], "nearest: core_radius"),
        ([*FLY, "--wake", "colour=blue"], "allowed: turns, azimuth_step"),
        ([*FLY, "--wake", "core_radius=0.5"], "core_radius = 0.5: must be a number between 0 and 0.2"),
        ([*FLY, "--wake", "n_stations=20.5"], "must be a whole number between 5 and 200"),
        ([*FLY, "--wake", "near_wake_angle=30"], "near_wake_angle"),
        ([*FLY, "--wake", "rates=perhaps"], "allowed: true, false"),
        ([*FLY, "--wake", "trailers=all"], "allowed: tip, full-span"),
        ([*FLY, "--wake", "turns=3", "--wake-turns", "4"], "turns is given twice"),
        ([*FLY, "--wake", "turns=3", "--wake", "turns=4"], "turns is given twice"),
        ([*FLY, "--wake", "best"], "allowed: standard, paper, reference"),
        ([*FLY, "--wake", "paper", "--wake", "standard"], "one preset at a time"),
        ([*FLY, "--wake", "scheme=pcc", "--inflow", "relaxation"], "not an option of relaxation inflow"),
        ([*FLY, "--wake", "tip_loss=none"], "not an option of time-marching inflow"),
        (["trim", "--wake", "far_wake=cylinder", "--wake", "inboard_wake=sheet"], "far_wake"),
        (["tunnel", "--wake", "turns=2.01"], "turns"),
        (["compare", "arrested-descent", "--wake", "colour=blue"], "colour"),
        ([*CONVERGE, "modes", "--values", "3, 4", "--wake", "rotor=1"], "rotor"),
        ([*FLY, "--integrator", "rk4"], "integrator"),
        ([*FLY, "--revolutions", "0"], "revolutions"),
        ([*FLY, "--revolutions", "many"], "revolutions"),
        ([*FLY, "--threads", "0"], "threads"),
        ([*FLY, "--out", str(Path(__file__) / "run")], "--out"),
        ([*FLY, "--nonsense"], "--nonsense"),
        (["fly"], "MANEUVER"),
        (["sail"], "sail"),
        (["tunnel", "--collective", "8"], "collective"),
        (["tunnel", "--then", "0.1 s, 12 deg"], "--duration"),
        (["validate", "--cases", "/nowhere"], "/nowhere"),
        (["validate", "K99", "--cases", "validation"], "K99"),
        (["converge", "azimuth"], "--vary"),
        ([*CONVERGE, "modes", "--values", "5"], "two or more"),
        ([*CONVERGE, "modes", "--values", "5, 5"], "twice"),
        ([*CONVERGE, "modes", "--values", "5, 8.5"], "whole"),
        ([*CONVERGE, "modes", "--values", "5, many"], "many"),
        ([*CONVERGE, "modes", "--values", "5, 40"], "n_modes"),
        ([*CONVERGE, "modes", "--values", "5, 25"], "modes"),
        ([*CONVERGE, "colour", "--values", "1, 2"], "colour"),
        ([*CONVERGE, "modes,elements", "--values", "1, 2"], "one discretisation at a time"),
        ([*CONVERGE, "azimuth-step", "--values", "10, 5"], "azimuth_step"),
        ([*CONVERGE, "azimuth-step", "--values", "10 deg, 7 deg"], "azimuth_step"),
        ([*CONVERGE, "azimuth-step", "--values", "9 deg, 10 deg"], "near_wake_angle"),
        ([*CONVERGE, "tolerance", "--values", "1e-4, 1e-5"], "not a discretisation of a trim"),
        ([*CONVERGE, "wake-turns", "--values", "3, 4", "--inflow", "dynamic"], "wake-turns"),
        ([*CONVERGE, "modes", "--values", "3, 4", "--revolutions", "2"], "revolutions"),
        (["converge", "modes", "--vary", "modes", "--values", "3, 4"], "elements"),
        ([*CONVERGE, "modes", "--values", "3, 4", "--collective", "8 deg"], "collective"),
        (["converge", "tunnel", "--vary", "tolerance", "--values", "1e-4, 1e-5"], "stand"),
        (["converge", "tunnel", "--vary", "modes", "--values", "3, 4", "--bank", "3 deg"], "bank"),
        (["converge", "tunnel", "--vary", "modes", "--values", "3, 4", "--collective", "8"], "collective"),
        (["converge", "sailing", "--vary", "modes", "--values", "3, 4"], "sailing"),
        (["converge", "roll-reversal", "--vary", "tolerance", "--values", "0, 1e-4"], "tolerance"),
        (["paper", "--jobs", "0"], "--jobs"),
        (["compare", "arrested-descent", "--speed", "80"], "speed"),
        (["trim", "--speed", "80"], "speed"),
        (["trim", "--sideslip", "5 deg", "--bank", "5 deg"], "sideslip"),
        (["modes", "--aircraft", "uh61"], "uh61"),
        (["modes", "--modes", "0"], "--modes"),
        (["linearize", "--speed", "80"], "speed"),
        (["linearize", "--order", "small"], "--order"),
        (["linearize", "--inputs", "lateral,rudder"], "rudder"),
        (["linearize", "--linear-wake", "magic"], "wake = 'magic'"),
        (["linearize", "--inflow", "relaxation", "--linear-wake", "dynamic"], "must be said of"),
        (["modes", "--out", "a" * 400], "must be a folder that can be written to: File name too long"),
        (["linearize", "--method", "guess"], "guess"),
        (["report", "/nowhere/run.nc"], "/nowhere/run.nc"),
        (["export", "/nowhere/run.nc"], "/nowhere/run.nc"),
        (["export", __file__, "--to", "matlab"], "did you mean mat?"),
        (["list", "aircrafts"], "did you mean aircraft?"),
        (["run", "/nowhere/case.toml"], "/nowhere/case.toml"),
        ([*FLY, "--aircraft", "uh6oa"], "did you mean uh60a?"),
        (["fly", "roll-reverse"], "did you mean roll-reversal?"),
        ([*FLY, "--inflow", "relaxtion"], "did you mean relaxation?"),
        ([*FLY, "--wake-scheme", "bdf"], "did you mean bdf2?"),
        ([*FLY, "--wake", "papers"], "did you mean paper?"),
        ([*FLY, "--figure-format", "jpg"], "--figure-format"),
        (["trimm"], "Did you mean 'trim'"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(capsys, arguments, named):
    code, out, err = _run(capsys, arguments)
    assert code == 2
    assert out == ""
    assert err.count("\n") == 1
    assert named in err


def test_controllers_are_read_and_checked_before_anything_starts(capsys, monkeypatch, tmp_path):
    path = tmp_path / "sas.toml"
    for text, named in (
        ("[control.rate_damping]\nroll = '2'\n", "RateDamping.roll = '2'"),
        ("[control.damper]\nroll = '2'\n", "control.damper"),
        ("[control.pitch_bias_actuator]\n", "PitchBiasActuator = 'BO-105'"),
    ):
        path.write_text(text)
        code, _, err = _run(capsys, [*FLY, "--aircraft", "bo105", "--control", str(path)])
        assert code == 2 and named in err and err.count("\n") == 1
    asked = []
    monkeypatch.setattr(outcome, "fly_once", lambda request, *_rest: asked.append(request.control))
    path.write_text("[control.rate_damping]\nroll = '2 in/(rad/s)'\n")
    for given in ([], ["--control", "none"], ["--control", str(path)]):
        _run(capsys, [*FLY, "--inflow", "dynamic", "--out", str(tmp_path), *given])
    assert asked[0] is None and asked[1].nothing and len(asked[2].controllers) == 1


def test_a_manoeuvre_before_zero_is_refused(capsys, tmp_path):
    path = tmp_path / "early.toml"
    path.write_text('name = "early"\nduration = { seconds = 2 }\n[controls]\ncollective = [[-0.1, 0], [1, 1]]\n')
    code, _, err = _run(capsys, ["fly", str(path)])
    assert (code, err.count("\n")) == (2, 1)
    assert "must start at 0 s or later" in err


def test_a_users_manoeuvre_that_cannot_fit_between_the_stops_is_refused(capsys, tmp_path):
    path = tmp_path / "wide.toml"
    path.write_text('name = "wide"\nduration = { seconds = 2 }\n[controls]\ncollective = [[0, 0], [1, 11]]\n')
    code, _, err = _run(capsys, ["fly", str(path)])
    assert (code, err.count("\n")) == (2, 1)
    assert "travel" in err


@pytest.mark.parametrize(
    ("file", "old", "new", "named"),
    [
        ("uh60a.toml", "[drive]\n", "[drive]\nspare = 1\n", "drive.spare"),
        ("sc1095_cl.csv", "\n-180,0,0,0,0,0,0,0,0,0,0,0", "", "-180 to 180 deg"),
    ],
)
def test_a_wrong_aircraft_file_is_refused(capsys, tmp_path, file, old, new, named):
    folder = tmp_path / "uh60a"
    shutil.copytree(Path(str(resources.files("wakeflight.aircraft"))) / "uh60a", folder)
    (folder / file).write_text((folder / file).read_text().replace(old, new, 1))
    code, _, err = _run(capsys, [*FLY, "--aircraft", str(folder / "uh60a.toml")])
    assert (code, err.count("\n")) == (2, 1)
    assert named in err


def test_wrong_threads_in_the_environment_are_refused(capsys, monkeypatch):
    monkeypatch.setenv("WAKEFLIGHT_THREADS", "two")
    code, _, err = _run(capsys, FLY)
    assert code == 2
    assert "WAKEFLIGHT_THREADS" in err


def test_a_checked_request_is_handed_on(monkeypatch, tmp_path):
    seen = {}

    def record(request, revolutions, integrator, out, progress, every, rotor_speed, wind):
        seen.update(request=request, revolutions=revolutions, integrator=integrator, out=out)

    monkeypatch.setattr(outcome, "fly_once", record)
    typed = ["--speed", "60 kt", "--revolutions", "2", "--azimuth-step", "5 deg", "--wake-turns", "3"]
    with pytest.raises(SystemExit) as caught:
        cli.main([*FLY, *typed, "--wake-scheme", "pc2b", "--out", str(tmp_path / "a" / "b")])
    assert caught.value.code == 0
    request = seen["request"]
    assert request.condition.speed == pytest.approx(60 * 1852 / 3600)
    assert request.condition.is_complete
    assert (request.inflow.name, request.inflow.turns, request.inflow.scheme) == (
        "time-marching",
        3.0,
        "pc2b",
    )
    assert request.inflow.steps_per_revolution == 72
    assert (seen["revolutions"], seen["integrator"]) == (2.0, "ida")
    # nothing is written before there is something to write
    assert not (tmp_path / "a").exists()


@pytest.mark.parametrize(
    ("error", "code"),
    [(NumericalFailure("flight: 1.2 s,\nazimuth 40 deg, blade 2: no solution"), 3), (InputError("no"), 2)],
)
def test_errors_become_one_line_and_their_exit_code(capsys, monkeypatch, error, code):
    def fail(*_args):
        raise error

    monkeypatch.setattr(outcome, "fly_once", fail)
    found, _, err = _run(capsys, FLY)
    assert found == code
    assert err.strip().splitlines()[-1].startswith("wakeflight: ")


def test_a_failed_flight_is_saved_before_exit_code_3(capsys, monkeypatch, tmp_path):
    from wakeflight import results
    from wakeflight.simulation import Simulation

    follow = Simulation.follow

    def fails(sim, sticks, observer=None):
        if sim.steps == 5:
            raise ArithmeticError("no step possible")
        follow(sim, sticks, observer)

    monkeypatch.undo()
    monkeypatch.setattr(Simulation, "follow", fails)
    typed = ["fly", "roll-reversal", "--inflow", "dynamic", "--no-figures", "--out", str(tmp_path)]
    code, _, err = _run(capsys, typed)
    assert code == 3
    assert err.strip().splitlines()[-1].startswith("wakeflight: numerical failure: flight of roll-reversal stopped")
    data = results.load(tmp_path / "run.nc")
    assert (data.sizes["time"], data.attrs["finished"]) == (5, 0) and "no step possible" in data.attrs["failure"]


def test_help_needs_no_heavy_import():
    code = (
        "import sys; sys.argv = ['wakeflight', '--help']\n"
        "from wakeflight.cli import main\n"
        "try:\n    main()\nexcept SystemExit as end:\n    assert end.code == 0, end.code\n"
        "heavy = {'pydantic', 'numpy', 'pint', 'xarray', 'matplotlib', 'scipy'} & set(sys.modules)\n"
        "assert not heavy, heavy"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    for command in (
        "fly",
        "compare",
        "trim",
        "modes",
        "tunnel",
        "report",
        "validate",
        "converge",
        "paper",
        "run",
        "list",
    ):
        assert command in done.stdout


def test_the_version_is_told(capsys):
    code, out, err = _run(capsys, ["--version"])
    assert (code, err) == (0, "")
    assert out.startswith("wakeflight ")


def test_what_there_is_is_listed_by_name(capsys):
    code, out, _ = _run(capsys, ["list", "--cases", str(Path(__file__).resolve().parents[2] / "validation")])
    assert code == 0
    for name in (
        "uh60a",
        "bo105",
        "arrested-descent",
        "roll-reversal",
        "time-marching",
        "annular",
        "paper",
        "vtk",
        "H01",
    ):
        assert f"  {name} " in out


def test_a_shell_completes_commands_and_values():
    def completed(*words):
        asked = {
            "_WAKEFLIGHT_COMPLETE": "complete_bash",
            "COMP_WORDS": " ".join(words),
            "COMP_CWORD": str(len(words) - 1),
        }
        command = [sys.executable, "-m", "wakeflight"]
        return subprocess.run(
            command, env={**os.environ, **asked}, capture_output=True, text=True, check=False
        ).stdout.split()

    assert completed("wakeflight", "tr") == ["trim"]
    assert completed("wakeflight", "fly", "arr") == ["arrested-descent"]
    assert completed("wakeflight", "trim", "--inflow", "re") == ["relaxation"]


CASE = """
command = "fly"
aircraft = "bo105"
integrator = "fixed"
[condition]
speed = "60 kt"
flight_path = "0 deg"
[inflow]
model = "time-marching"
preset = "paper"
turns = 3
[maneuver]
duration = { seconds = 0.5 }
controls = { longitudinal = [[0.1, 0.0], [0.2, 0.5], [0.4, 0.0]] }
[outputs]
folder = "FOLDER"
figures = false
"""


def test_a_case_file_asks_for_what_its_options_would(capsys, monkeypatch, tmp_path):
    seen = {}

    def record(request, revolutions, integrator, out, progress, every, rotor_speed, wind):
        seen.update(request=request, integrator=integrator, out=out)

    monkeypatch.setattr(outcome, "fly_once", record)
    path = tmp_path / "pulse.toml"
    path.write_text(CASE.replace("FOLDER", str(tmp_path / "out")))
    code, out, _ = _run(capsys, ["run", str(path)])
    request = seen["request"]
    assert code == 0
    # the condition is told, what was given before what the aircraft's file gives
    assert out == "BO-105: speed 60 kt, flight path 0 deg; of its file: altitude 0 ft, weight 4850.17 lbf\n"
    assert (request.aircraft.name, seen["integrator"], seen["out"]) == ("BO-105", "fixed", tmp_path / "out")
    assert (request.inflow.turns, request.inflow.trailers, request.drawing.figures) == (3, "tip", False)
    assert (request.maneuver.name, request.maneuver.seconds) == ("pulse", 0.5)


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("speed =", "sped =", "key of [condition] = 'sped': did you mean speed?"),
        ('"60 kt"', "60", "speed = '60'"),
        ('"fly"', '"fli"', "command = 'fli': did you mean fly?"),
        ("turns = 3", "turn = 3", "nearest: turns"),
        ("figures = false", 'export = "matlab"', "did you mean mat?"),
        ('aircraft = "bo105"', 'plane = "bo105"', "key = 'plane'"),
        ("[inflow]", "[inflow", "not readable as TOML"),
    ],
)
def test_a_wrong_case_file_is_one_line_that_names_it(capsys, tmp_path, old, new, named):
    path = tmp_path / "wrong.toml"
    path.write_text(CASE.replace("FOLDER", str(tmp_path / "out")).replace(old, new))
    code, out, err = _run(capsys, ["run", str(path)])
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert str(path) in err
    assert named in err


VEHICLE = ["aircraft", "loading", "condition"]
STRAIGHT = ["speed", "flight-path", "altitude", "weight"]
CONDITION = [*STRAIGHT, "sideslip", "turn-rate", "bank"]
WAKE = ["azimuth-step", "wake-turns", "wake-scheme"]
RUN = ["threads", "out"]


@pytest.mark.parametrize(
    ("command", "names"),
    [
        ("fly", ["inflow", *VEHICLE, *CONDITION, "revolutions", *WAKE, "integrator", "blades", *RUN]),
        ("compare", [*VEHICLE, *STRAIGHT, "revolutions", *WAKE, "integrator", *RUN]),
        ("trim", ["inflow", *VEHICLE, *CONDITION, *WAKE, "blades", *RUN]),
        ("modes", ["aircraft", "modes", "out"]),
        ("report", ["out"]),
        ("validate", ["cases", "fast", *RUN]),
        ("paper", ["redraw", "studies", "jobs", "out"]),
    ],
)
def test_the_options_of_a_command_stand_in_their_order(command, names):
    from typer.testing import CliRunner

    shown = CliRunner().invoke(cli.app, [command, "--help"], env={"COLUMNS": "200"}).output
    found = [line.split()[0].removeprefix("--") for line in shown.splitlines() if line.strip().startswith("--")]
    assert [name for name in found if name in names] == names


def test_importing_the_package_imports_nothing_heavy():
    code = (
        "import sys, wakeflight as wf\n"
        "assert not {'pydantic', 'numpy', 'pint', 'xarray'} & set(sys.modules)\n"
        "assert 'trim' in dir(wf) and wf.load_aircraft('uh60a').name == 'UH-60A'\n"
        "assert wf.roll_reversal().name == 'roll-reversal'"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_verb_is_not_hidden_by_its_module():
    from types import ModuleType

    import wakeflight

    # what the import system does after importing the submodule wakeflight.trim
    wakeflight.trim = ModuleType("wakeflight.trim")
    assert not isinstance(vars(wakeflight).get("trim"), ModuleType)


def test_a_trim_beyond_a_stop_says_so_and_is_written(capsys, tmp_path):
    import xarray as xr

    out = tmp_path / "trim"
    arguments = ["trim", "--inflow", "dynamic", "--speed", "190 kt", "--flight-path", "0 deg", "--out", str(out)]
    code, printed, _ = _run(capsys, arguments)
    assert code == 0
    (line,) = (each for each in printed.splitlines() if each.startswith("warning") and "collective" in each)
    with xr.open_dataset(out / "trim.nc") as data:
        assert line.removeprefix("warning").strip() in data.attrs["warnings"]


def test_what_a_verb_had_computed_is_saved_where_it_fails():
    saved = []

    def fails(partial):
        raise NumericalFailure("no answer", partial=partial)

    for partial in ("half", None):
        with pytest.raises(NumericalFailure):
            outcome.keeping(fails, saved.append)(partial)
    assert saved == ["half"]
