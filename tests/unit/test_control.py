"""Blocks, servos and files of controllers by themselves, against scipy and closed forms, without a flight."""

import math
import pickle

import numpy as np
import pytest
from scipy.signal import lsim

import wakeflight as wf
from wakeflight._core import ControlChain, limited_lag, smoothed
from wakeflight.control import Sensors
from wakeflight.control.servos import Servos, mounted
from wakeflight.control.state import packed, unpacked
from wakeflight.sticks import INCH
from wakeflight.units import convert

TIME = np.arange(0.0, 4.0, 0.0065)
SIGNALS = {
    "step": np.where(TIME > 0.5, 1.0, 0.0),
    "ramp": np.clip(TIME - 0.3, 0.0, 1.2),
    "sine": np.sin(3.0 * TIME),
}


def sensors(t=0.0, **values):
    """A flight at rest at 40 m/s but for some values."""
    y = np.zeros(13)
    y[0], y[6] = 40.0, 1.0
    names = ("u", "v", "w", "p", "q", "r")
    for name in [name for name in values if name in names]:
        y[names.index(name)] = values.pop(name)
    roll, pitch = values.pop("roll", 0.0), values.pop("pitch", 0.0)
    c, s = (f(0.5 * roll) for f in (math.cos, math.sin))
    d, e = (f(0.5 * pitch) for f in (math.cos, math.sin))
    y[6:10] = c * d, s * d, c * e, -s * e
    y[12] = values.pop("down", 0.0)
    assert not values
    return Sensors(y, 1000.0, 27.0, lambda: (np.zeros(13), {"torque": 1.0}))


class Trimmed:
    """Of a trim what controllers ask for."""

    def __init__(self, aircraft):
        self.aircraft, self.pitch, self.roll, self.yaw = aircraft, 0.0, 0.0, 0.0


@pytest.mark.parametrize("name", SIGNALS)
@pytest.mark.parametrize(
    "lag, washout, system",
    [
        (0.05, None, ([1.0], [0.05, 1.0])),
        (None, 2.0, ([2.0, 0.0], [2.0, 1.0])),
        (0.1, 1.5, ([1.5, 0.0], np.polymul([0.1, 1.0], [1.5, 1.0]))),
    ],
)
def test_filters_answer_as_scipy_does(name, lag, washout, system):
    # lsim takes its input as straight between samples: exactly what a filter here is advanced for
    u = SIGNALS[name]
    found = smoothed(u, np.diff(TIME, prepend=TIME[0]), lag, washout)
    assert np.abs(found - lsim(system, u, TIME)[1]).max() < 1e-8


def test_a_lag_within_its_rate_is_the_linear_one():
    x, y = 0.0, 0.0
    for a, b in zip(SIGNALS["sine"][:-1], SIGNALS["sine"][1:], strict=True):
        (x, limited), (y, _) = (
            limited_lag(each, a, b, 0.0065, 0.03, rate) for each, rate in ((x, 10.0), (y, math.inf))
        )
        assert not limited
    assert x == pytest.approx(y, abs=1e-12)


def test_a_rate_limited_lag_follows_a_fast_sine_as_a_triangle():
    # a sine far beyond the rate: the servo runs at its limit all the time and turns where it meets the input
    rate, omega, amplitude = 1.0, 20.0, 1.0
    t = np.arange(0.0, 6.0, 1e-3)
    u = amplitude * np.sin(omega * t)
    x, found = 0.0, [0.0]
    for a, b in zip(u[:-1], u[1:], strict=True):
        x, _ = limited_lag(x, a, b, 1e-3, 0.0, rate)
        found.append(x)
    # a quarter of a period's travel to either side of a mean that dies away
    period = 2 * np.pi / omega
    late = np.array(found)[t > t[-1] - period]
    assert 0.5 * np.ptp(late) == pytest.approx(rate * period / 4, rel=2e-3)


@pytest.mark.parametrize("step", [0.31, 0.031, 0.0031])
def test_a_step_beyond_the_rate_is_met_in_closed_form_whatever_the_steps(step):
    # straight at the limit until the lag alone is slower, exponential from there
    tau, rate, size = 0.05, 2.0, 1.0
    x, t = 0.0, 0.0
    while t < 0.62 - 1e-12:
        x, _ = limited_lag(x, size, size, step, tau, rate)
        t += step
    turn = (size - tau * rate) / rate
    assert x == pytest.approx(size - tau * rate * math.exp(-(t - turn) / tau), abs=1e-12)


def test_a_ramp_faster_than_the_rate_is_followed_at_the_rate():
    tau, rate, slope = 0.05, 1.0, 3.0
    x, limited = limited_lag(0.0, 0.0, slope * 1.0, 1.0, tau, rate)
    # inside until tau times the lag's own speed is the rate, then straight
    until = -tau * math.log(1.0 - rate / slope)
    assert limited and x == pytest.approx(slope * until - tau * rate + rate * (1.0 - until), abs=1e-12)


def test_servos_stop_at_their_stops_and_say_so():
    matrix = np.diag([1.0, 2.0, 3.0, 4.0])
    given = Servos(lag="0 s", limits={"theta_0": ("-10 deg", "0.1 rad")})
    servos = mounted(given, np.zeros(4), matrix, np.zeros(4))
    chain = ControlChain([], ([1.0] * 4, [1.0] * 4, [10.0] * 4), servos, np.zeros(4))
    target = np.full(4, 0.2)
    _, before, after = chain.advance(target, target, 0.1)
    assert before == pytest.approx(np.zeros(4)) and after == pytest.approx([0.2, 0.2, 0.1 / 3.0, 0.2])
    assert chain.seconds == [[0.0] * 4, [0.0] * 4, [0.0, 0.0, 0.1, 0.0]]


def test_servos_that_cannot_be_are_refused():
    for given, named in (
        ({"lag": "-1 s"}, "actuators.lag"),
        ({"rate": "0 deg/s"}, "actuators.rate"),
        ({"limits": {"theta": ("0 deg", "1 deg")}}, "theta_1c, theta_1s"),
        ({"limits": {"theta_0": ("2 deg", "1 deg")}}, "lower one must lie below"),
        ({"limits": {"theta_0": "1 deg"}}, "pair of angles"),
    ):
        with pytest.raises(wf.InputError, match=named):
            Servos(**given)
    with pytest.raises(wf.InputError, match="can be inverted"):
        mounted(Servos(), np.zeros(4), np.zeros((4, 4)) + 1.0, np.zeros(4))


def test_units_of_gains_are_read():
    assert convert(1.0, "in/(rad/s)", "m s/rad") == pytest.approx(INCH)
    assert convert(1.0, "in/(deg/s)", "m s/rad") == pytest.approx(INCH * 180.0 / np.pi)
    assert convert(1.0, "in/(ft s)", "1/s") == pytest.approx(1.0 / 12.0)
    assert convert(1.0, "% s/deg", "s/rad") == pytest.approx(0.01 * 180.0 / np.pi)
    assert convert(50.0, "Hz", "1/s") == 50.0


def test_rates_are_damped_within_the_authority(uh60a):
    damper = wf.RateDamping(roll="2 in/(rad/s)", pitch="3 in/(rad/s)", yaw="1 in/(rad/s)", authority="1 in")
    damper.reset(Trimmed(uh60a))
    rest = damper.step(0.0, sensors(p=0.1), {})
    assert rest == {"lateral": 0.0, "longitudinal": 0.0, "pedal": 0.0}
    moved = damper.step(0.01, sensors(p=0.3, q=-0.2, r=2.0), {})
    # counted from the rates of the beginning
    assert moved == pytest.approx({"lateral": -0.4, "longitudinal": 0.6, "pedal": -1.0})
    assert damper.saturated == ("pedal",)
    shares = wf.RateDamping(yaw="1 in/(rad/s)", authority="10 %")
    shares.reset(Trimmed(uh60a))
    shares.step(0.0, sensors(), {})
    assert shares.step(0.01, sensors(r=2.0), {}) == {"pedal": pytest.approx(-0.538)}


def test_attitude_is_held_the_short_way_round(uh60a):
    hold = wf.AttitudeHold(roll="1 in/rad", pitch="5 in/rad", pitch_rate="3 in/(rad/s)")
    hold.reset(Trimmed(uh60a))
    hold.step(0.0, sensors(roll=3.0), {})
    moved = hold.step(0.01, sensors(roll=-3.0, pitch=0.1, q=0.1), {})
    assert moved == {"lateral": pytest.approx(6.0 - 2 * np.pi), "longitudinal": pytest.approx(-0.8)}


def test_turn_coordination_works_above_its_speed(uh60a):
    turn = wf.TurnCoordination(sideslip="5 in/rad", lateral_acceleration="0.1 in/(m/s2)", yaw_rate="2 in/(rad/s)")
    turn.reset(Trimmed(uh60a))
    turn.step(0.0, sensors(), {})
    # wind from the right: nose into it
    assert turn.step(0.01, sensors(v=2.0), {})["pedal"] > 0.0
    # at rest in a coordinated turn
    bank = 0.5
    rate = 9.80665 * math.sin(bank) / 40.0
    coordinated = turn.step(0.02, sensors(roll=bank, r=rate), {})["pedal"] + 0.1 * 0.0
    ball = -0.1 * sensors(roll=bank, r=rate).ay
    assert coordinated == pytest.approx(ball, abs=1e-12)
    assert turn.step(0.03, sensors(u=20.0, v=2.0), {}) == {"pedal": 0.0}


def test_altitude_is_held_along_the_path_of_the_beginning(uh60a):
    hold = wf.AltitudeHold(altitude="0.1 in/m", climb_rate="0.2 in/(m/s)")
    hold.reset(Trimmed(uh60a))
    hold.step(0.0, sensors(w=2.0), {})
    assert hold.step(1.0, sensors(w=2.0, down=2.0), {})["collective"] == pytest.approx(0.0, abs=1e-12)
    assert hold.step(2.0, sensors(w=3.0, down=5.0), {})["collective"] == pytest.approx(0.1 * 1.0 + 0.2 * 1.0)


def test_the_pitch_bias_actuator_has_the_numbers_of_the_file(uh60a):
    pba = wf.PitchBiasActuator()
    pba.reset(Trimmed(uh60a))
    assert pba.command(sensors()) == pytest.approx(-0.049)
    nose = pba.command(sensors(pitch=np.radians(10.0), q=np.radians(4.0)))
    assert nose == pytest.approx(-0.049 - 0.0375 - 0.00525)
    fast = sensors(u=convert(120.0, "kt", "m/s"))
    assert pba.command(fast) == pytest.approx(-0.049 + 0.0525 * 40.0 / 100.0)
    # 3 % of 10 in a second
    pba.step(0.0, sensors(), {})
    assert pba.step(0.5, sensors(pitch=0.3), {})["longitudinal"] == pytest.approx(-0.15, abs=0.02)
    assert pba.saturated == ("longitudinal",)
    with pytest.raises(wf.InputError, match="pitch_bias_actuator"):
        wf.PitchBiasActuator().reset(Trimmed(wf.load_aircraft("bo105")))


@pytest.mark.parametrize(
    "make, named",
    [
        (lambda: wf.RateDamping(), "needs at least one of roll, pitch, yaw"),
        (lambda: wf.RateDamping(roll="2"), "RateDamping.roll"),
        (lambda: wf.RateDamping(roll=2.0), "RateDamping.roll"),
        (lambda: wf.RateDamping(roll="2 in"), r"such as '2 in/\(rad/s\)'"),
        (lambda: wf.RateDamping(roll="2 in/(rad/s)", authority="-1 in"), "authority"),
        (lambda: wf.RateDamping(roll="2 in/(rad/s)", authority="1"), "inches or a share"),
        (lambda: wf.RateDamping(roll="2 in/(rad/s)", lag="0 s"), "RateDamping.lag"),
        (lambda: wf.RateDamping(roll="2 in/(rad/s)", lag="1 s", washout="1 s"), "must differ"),
        (lambda: wf.Augmentation((wf.RateDamping(roll="2 in/(rad/s)", rate="1 s"),)), "RateDamping.rate"),
        (lambda: wf.Augmentation((wf.RateDamping(roll="2 in/(rad/s)", acts="both"),)), "series, parallel"),
        (lambda: wf.Augmentation((wf.RateDamping,)), "not the class itself"),
        (lambda: wf.Augmentation((1.0,)), "wf.Controller"),
        (lambda: wf.Augmentation(authority="much"), "control.authority"),
        (lambda: wf.Augmentation(actuators="uh60"), "generic"),
        (lambda: wf.Augmentation(actuators=1.0), "actuators"),
    ],
)
def test_controllers_that_cannot_be_are_refused(make, named):
    with pytest.raises(wf.InputError, match=named):
        make()


def test_outputs_are_sticks():
    class Odd(wf.Controller):
        outputs = ("rudder",)

    with pytest.raises(wf.InputError, match=r"Odd\.outputs = 'rudder'"):
        wf.Augmentation((Odd(),))


def test_memory_is_kept_to_the_bit():
    state = {
        "none": None,
        "flag": True,
        "number": 0.1 + 0.2,
        "huge": 1e308 * 10,
        "text": "a",
        "list": [1, (2.5, "b"), {"k": np.arange(3)}],
        "array": np.array([[0.1, -0.0], [np.pi, np.nan]]),
        "scalar": np.float64(1 / 3),
    }
    again = unpacked(packed(state))
    assert pickle.dumps(again["array"]) == pickle.dumps(state["array"])
    assert {k: v for k, v in again.items() if k not in ("array", "list")} == {
        k: v for k, v in state.items() if k not in ("array", "list")
    }
    assert again["list"][1] == (2.5, "b") and np.array_equal(again["list"][2]["k"], np.arange(3))
    with pytest.raises(ValueError, match="servos is a Servos"):
        packed({"servos": Servos()})


FILE = """
[control]
authority = "10 %"
actuators = { lag = "0.02 s", rate = "40 deg/s" }

[control.rate_damping]
roll = "2 in/(rad/s)"

[[control.attitude_hold]]
pitch = "5 in/rad"

[[control.attitude_hold]]
heading = "1 in/rad"
acts = "parallel"

[control.pitch_bias_actuator]
"""


def test_a_file_has_the_same_blocks(tmp_path):
    path = tmp_path / "sas.toml"
    path.write_text(FILE)
    assert wf.load_control(path) == wf.Augmentation(
        (
            wf.RateDamping(roll="2 in/(rad/s)"),
            wf.AttitudeHold(pitch="5 in/rad"),
            wf.AttitudeHold(heading="1 in/rad", acts="parallel"),
            wf.PitchBiasActuator(),
        ),
        authority="10 %",
        actuators=Servos("0.02 s", "40 deg/s"),
    )


@pytest.mark.parametrize(
    "text, named",
    [
        (
            "[control]\n[control.damping]\nroll = '1'",
            "control.damping = 'unknown key': allowed: authority, actuators, rate_d",
        ),
        ("[control.rate_damping]\nrol = '1'", "control.rate_damping.rol = 'unknown key': allowed: roll"),
        ("[control.rate_damping]\nroll = '1'", "RateDamping.roll = '1'"),
        ("[control]\nrate_damping = 1", "control.rate_damping = 1: must be a table"),
        ("[control]", "must be a table with some of"),
        ("[other]", "other = 'unknown key': allowed: control"),
        ("[control", "not readable as TOML"),
    ],
)
def test_a_file_that_cannot_be_read_says_where(tmp_path, text, named):
    path = tmp_path / "sas.toml"
    path.write_text(text)
    with pytest.raises(wf.InputError) as caught:
        wf.load_control(path)
    assert named in str(caught.value) and str(path) in str(caught.value)
    with pytest.raises(wf.InputError, match="no such file"):
        wf.load_control(tmp_path / "none.toml")


def test_a_manoeuvre_has_its_augmentation_in_its_file(tmp_path, uh60a):
    shipped = wf.load_maneuver("roll-reversal-augmented")
    assert shipped.corners_of == wf.load_maneuver("roll-reversal").corners_of
    assert wf.load_maneuver("roll-reversal").control is None
    own = shipped.for_aircraft(uh60a.stick_travel_in, 27.0)
    assert own.control == shipped.control and not own.adapted
    # inches of the hand's sticks are shares of their travel, those of its augmentation too
    other = shipped.for_aircraft((8.0, 12.0, 9.0, 4.0), 27.0)
    assert other.control.scale == pytest.approx((0.8, 1.2, 0.9, 1.0)) and "augmentation" in other.adapted[-1]
    path = tmp_path / "own.toml"
    path.write_text(
        'name = "own"\nduration = { seconds = 1.0 }\n[controls]\npedal = [[0.0, 0.0], [0.1, 0.5]]\n'
        "[control.rate_damping]\nyaw = '1'\n"
    )
    with pytest.raises(wf.InputError, match=r"own\.toml.*RateDamping\.yaw"):
        wf.load_maneuver(path)
