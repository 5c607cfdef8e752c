"""Inputs that engineers fly: shapes of the manoeuvres, recorded sticks, flights that begin beside their trim."""

import numpy as np
import pytest
from lines_run import lines_run

import wakeflight as wf
from wakeflight import cli
from wakeflight.attitude import euler_angles, quaternion_of
from wakeflight.results import load
from wakeflight.simulation import Simulation
from wakeflight.sticks import INCH

AIRCRAFT = wf.load_aircraft("uh60a").with_rigid_blades()
START = wf.trim(AIRCRAFT, wf.FlightCondition(speed="80 kt", flight_path="0 deg"), inflow="dynamic")


def test_a_step_goes_there_and_stays():
    step = wf.step("lateral", "0.5 in", at="1 s", rise="0.2 s", seconds="3 s")
    at = [step.offset(t)[0] for t in (0.0, 1.0, 1.1, 1.2, 3.0)]
    assert at == pytest.approx([0.0, 0.0, 0.25, 0.5, 0.5])
    pulse = wf.step("pedal", "-12.7 mm", at="0 s", back="1 s")
    assert pulse.offset(0.5)[3] == pytest.approx(-0.5) and pulse.offset(2.0)[3] == 0.0


@pytest.mark.parametrize(("made", "lasting"), [(wf.doublet, (1.0, 1.0)), (wf.three_two_one_one, (1.5, 1.0, 0.5, 0.5))])
def test_multisteps_alternate_as_long_as_they_should(made, lasting):
    maneuver = made("longitudinal", "0.4 in", at="1 s", rise="0.01 s")
    t, side = 1.0, 1.0
    for length in lasting:
        assert maneuver.offset(t + 0.5 * length)[1] == pytest.approx(0.4 * side)
        t, side = t + length, -side
    assert maneuver.offset(t + 0.02)[1] == 0.0


def test_a_frequency_sweep_is_its_sine():
    maneuver = wf.frequency_sweep("lateral", "0.5 in", "0.5 rad/s", "2 Hz", seconds="41 s", at="1 s", fade="0 s")
    times = np.linspace(1.0, 40.9, 4000)
    octave = np.log(4 * np.pi / 0.5) / 40.0
    phase = 0.5 / octave * np.expm1(octave * (times - 1.0))
    found = np.array([maneuver.offset(t)[0] for t in times])
    assert np.abs(found - 0.5 * np.sin(phase)).max() < 0.009 * 0.5
    # it begins and ends at trim, softly where it is faded
    soft = wf.frequency_sweep("lateral", "0.5 in", seconds="20 s")
    assert soft.offset(0.0)[0] == soft.offset(20.0)[0] == 0.0 and abs(soft.offset(1.2)[0]) < 0.06


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: wf.step("stick", "1 in"),
        lambda: wf.step("lateral", 1.0),
        lambda: wf.step("lateral", "0 in"),
        lambda: wf.step("lateral", "1 in", at="6 s"),
        lambda: wf.step("lateral", "1 in", at="1 s", back="1.01 s"),
        lambda: wf.doublet("lateral", "1 in", width="0.05 s"),
        lambda: wf.frequency_sweep("lateral", "1 in", "3 rad/s", "2 rad/s"),
        lambda: wf.frequency_sweep("lateral", "1 in", "3 kt"),
        lambda: wf.frequency_sweep("lateral", "1 in", seconds="5 s", fade="3 s"),
    ],
)
def test_what_is_no_input_is_refused(wrong):
    with pytest.raises(wf.InputError):
        wrong()


# --- recorded sticks -------------------------------------------------------------------------------------------------------


def _record(path, rate, columns="time_s,lateral_in,pedal_mm", offset=0.0, seconds=1.0):
    t = np.arange(0.0, seconds + 0.5 / rate, 1.0 / rate)
    lateral, pedal = 0.3 * np.sin(2 * t) + offset, 5.0 * t
    rows = [f"{a:.6f},{b:.9f},{c:.9f}" for a, b, c in zip(t + 7.0, lateral, pedal, strict=True)]
    path.write_text("\n".join(["# a recorder", columns, *rows]) + "\n")
    return path


def test_a_record_counts_from_its_first_sample(tmp_path):
    maneuver = wf.recorded_sticks(_record(tmp_path / "sticks.csv", 100, offset=4.2))
    assert maneuver.name == "sticks" and maneuver.duration(27.0) == pytest.approx(1.0)
    assert maneuver.offset(0.5) == pytest.approx([0.3 * np.sin(1.0), 0.0, 0.0, 2.5 / 25.4], abs=1e-6)
    assert wf.load_maneuver(tmp_path / "sticks.csv") == maneuver


def test_absolute_sticks_are_led_from_trim_to_their_record(tmp_path):
    trim = START.stick["lateral"]
    maneuver = wf.recorded_sticks(
        _record(tmp_path / "s.csv", 100, "time_s,lateral_in,note", trim + 0.1), "stop", "0.4 s"
    )
    flown = maneuver.about(START.stick_si / INCH)
    assert flown.offset(0.0)[0] == 0.0 and not flown.absolute
    assert flown.offset(0.2)[0] == pytest.approx(0.05 + 0.3 * np.sin(0.4), abs=1e-4)
    assert flown.offset(0.8)[0] == pytest.approx(0.1 + 0.3 * np.sin(1.6), abs=1e-6)
    assert "led there within 0.4 s" in flown.adapted[0]
    flight = wf.fly(START, maneuver, integrator="fixed", revolutions=2)
    assert float(flight.data.lateral[0]) == pytest.approx(trim)
    # what is written down is the record, and flies again to the bit
    again = wf.rerun(flight.save(tmp_path / "run.nc"))
    assert not again.differing


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("time_s,lateral\n0,0\n1,1\n", "lateral_in"),
        ("time_s,lateral_kg\n0,0\n1,1\n", "lateral_kg"),
        ("time_s,latral_in\n0,0\n1,1\n", "latral_in"),
        ("lateral_in,pedal_in\n0,0\n1,1\n", "time"),
        ("time_s,lateral_in,lateral_mm\n0,0,0\n1,1,1\n", "missing or twice"),
        ("time_s,lateral_in\n0,0\n0,1\n", "ascend"),
        ("time_s,lateral_in\n0,0\n1\n", "line 3"),
        ("time_s,lateral_in\n0,0\n1,nan\n", "finite"),
        ("time_s,lateral_in\n", "two lines"),
        ("", "time"),
    ],
)
def test_a_damaged_record_is_refused_by_name(text, said, tmp_path):
    (tmp_path / "s.csv").write_text(text)
    with pytest.raises(wf.InputError, match=said) as refused:
        wf.recorded_sticks(tmp_path / "s.csv")
    assert "s.csv" in str(refused.value)


def test_a_record_about_trim_must_begin_there(tmp_path):
    path = _record(tmp_path / "s.csv", 10, offset=0.2)
    with pytest.raises(wf.InputError, match="must start from trim"):
        wf.recorded_sticks(path, "trim")
    with pytest.raises(wf.InputError, match="about"):
        wf.recorded_sticks(path, "hover")


def test_a_fine_record_costs_what_a_coarse_one_costs(tmp_path):
    seconds, found = 2.0, {}
    for rate in (20, 1000, 10000):
        maneuver = wf.recorded_sticks(_record(tmp_path / f"{rate}.csv", rate, seconds=seconds))
        if not found:
            # what a first flight imports
            wf.fly(START, maneuver, integrator="fixed")
        found[rate] = lines_run(lambda flown=maneuver: wf.fly(START, flown, integrator="fixed").data)
    # samples are read and checked once, which takes some forty lines; each asked for at every step would take hundreds
    steps = found[20][1].sizes["time"]
    assert steps > 300
    for coarse, fine in ((20, 1000), (1000, 10000)):
        more = 2 * seconds * (fine - coarse)
        assert (found[fine][0] - found[coarse][0]) / more < steps / 4


def test_files_of_manoeuvres_and_cases_name_records(tmp_path, capsys):
    _record(tmp_path / "sticks.csv", 50, "time_s,lateral_in,note", 4.0)
    (tmp_path / "m.toml").write_text(
        'name = "flown"\nrecorded = { file = "sticks.csv", about = "stop", join = "0.3 s" }\nduration = { seconds = 0.5 }\n'
    )
    read = wf.load_maneuver(tmp_path / "m.toml")
    assert read.absolute and read.join == 0.3 and read.seconds == 0.5 and read.name == "flown"
    (tmp_path / "case.toml").write_text(
        'inflow = "dynamic"\nblades = "rigid"\nintegrator = "fixed"\nfigures = false\nspeed = "80 kt"\nperturb = ["q=2 deg/s"]\n'
        '[maneuver]\nrecorded = { file = "sticks.csv" }\nduration = { seconds = 0.2 }\n'
        f'[outputs]\nfolder = "{tmp_path / "out"}"\n'
    )
    with pytest.raises(SystemExit) as ended:
        cli.main(["run", str(tmp_path / "case.toml")])
    assert ended.value.code == 0, capsys.readouterr().err
    data = load(tmp_path / "out" / "run.nc")
    assert np.degrees(float(data.q[0])) == pytest.approx(2.0) and data.sizes["time"] > 25
    with pytest.raises(wf.InputError, match="about"):
        (tmp_path / "m.toml").write_text('name = "x"\nrecorded = { file = "sticks.csv", about = "me" }\n')
        wf.load_maneuver(tmp_path / "m.toml")
    with pytest.raises(wf.InputError, match="allowed: file, about, join"):
        (tmp_path / "m.toml").write_text('name = "x"\nrecorded = { file = "sticks.csv", abut = "stop" }\n')
        wf.load_maneuver(tmp_path / "m.toml")


# --- beside the trim -------------------------------------------------------------------------------------------------------


def test_angles_and_quaternions_belong_together():
    for angles in ((0.1, -0.4, 2.8), (-3.0, 1.2, -0.2), (0.0, 0.0, 0.0)):
        assert np.concatenate(euler_angles(quaternion_of(*angles)[None])) == pytest.approx(angles)


def test_a_flight_begins_beside_its_trim():
    hands = wf.Maneuver("hands off", {}, seconds=0.3)
    perturb = {"q": "2 deg/s", "pitch": "1 deg", "u": "-1 m/s", "rotor.main.inflow_0": 1e-3}
    flown = wf.fly(START, hands, integrator="fixed", perturb=perturb).data
    trimmed = wf.fly(START, hands, integrator="fixed").data
    moved = {
        name: float(flown[name][0] - trimmed[name][0])
        for name in ("q", "pitch", "u", "roll", "yaw", "p", "inflow_mean")
    }
    assert moved["q"] == pytest.approx(np.radians(2.0)) and moved["pitch"] == pytest.approx(np.radians(1.0))
    assert moved["u"] == pytest.approx(-1.0) and moved["inflow_mean"] == pytest.approx(1e-3)
    assert [moved[name] for name in ("roll", "yaw", "p")] == pytest.approx([0.0] * 3, abs=1e-12)
    sim = Simulation(START, perturb=perturb)
    np.testing.assert_array_equal(sim.y[:6], [flown[name][0] for name in "uvwpqr"])
    # nothing moved is the trim itself, to the bit
    np.testing.assert_array_equal(Simulation(START, perturb={}).y, Simulation(START).y)


def test_a_perturbed_flight_is_kept_resumed_and_flown_again(tmp_path):
    perturb = {"p": "3 deg/s", "roll": "-2 deg"}
    hands = wf.doublet("lateral", "0.3 in", at="0.1 s", width="0.1 s", rise="0.05 s", seconds="0.5 s")
    whole = wf.fly(START, hands, integrator="fixed", perturb=perturb)
    assert not wf.rerun(whole.save(tmp_path / "run.nc")).differing
    wf.fly(START, hands, integrator="fixed", perturb=perturb, out=tmp_path / "kept", revolutions=1)
    longer = wf.resume(tmp_path / "kept", until="0.5 s")
    np.testing.assert_array_equal(longer.data.p[:40], whole.data.p[:40])


@pytest.mark.parametrize(
    ("perturb", "said"),
    [
        ({"z": "1 m"}, "allowed: u, v, w"),
        ({"q": "2 deg"}, "perturb.q"),
        ({"q": 0.1}, "perturb.q"),
        ({"pitch": "95 deg"}, "within 90 deg"),
        ({"roll": "700 deg"}, "at most"),
        (3, "values by name"),
    ],
)
def test_what_is_no_perturbation_is_refused(perturb, said):
    with pytest.raises(wf.InputError, match=said):
        wf.fly(START, wf.step("lateral", "0.1 in"), perturb=perturb)
