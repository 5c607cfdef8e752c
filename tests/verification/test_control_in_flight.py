"""Controllers in flight: nothing done is today's flight, times are met, memory is kept, whatever goes wrong says where."""

import pickle

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.control import Servos
from wakeflight.control.sensors import SIGNALS
from wakeflight.flight import Sticks
from wakeflight.sticks import INCH

STEP = wf.Maneuver("step", {"lateral": [(0.05, 0.0), (0.15, 0.5)], "pedal": [(0.1, 0.0), (0.2, -0.2)]}, seconds=0.7)


class Idle(wf.Controller):
    """Adds nothing."""

    def step(self, t, sensors, stick):
        return dict.fromkeys(self.outputs, 0.0)


class Damper(wf.Controller):
    """A user's own, with a memory."""

    outputs = ("lateral", "pedal")

    def __init__(self, gain=2.0, rate=None):
        self.gain, self.rate = gain, rate

    def reset(self, start):
        self.sum, self.times = 0.0, []

    def step(self, t, sensors, stick):
        self.sum += 0.01 * sensors.p
        self.times.append(t)
        return {"lateral": -self.gain * sensors.p - self.sum, "pedal": -self.gain * sensors.r}


class Broken(wf.Controller):
    """Does something else from 0.1 s on."""

    def __init__(self, answer):
        self.answer = answer

    def step(self, t, sensors, stick):
        return {} if t < 0.1 else self.answer(self)


def fly(start, control=None, **more):
    return wf.fly(start, STEP, integrator="fixed", control=control, **more)


def same(a, b):
    names = [name for name in a.data.data_vars if name in b.data]
    return all(np.array_equal(a.data[name], b.data[name], equal_nan=True) for name in names)


@pytest.mark.parametrize("integrator", ["fixed", "ida"])
def test_controllers_that_do_nothing_are_todays_flight_to_the_bit(baseline_dynamic, integrator):
    bare = wf.fly(baseline_dynamic, STEP, integrator=integrator)
    idle = wf.fly(baseline_dynamic, STEP, integrator=integrator, control=[Idle(), Idle()])
    assert same(bare, idle)
    assert "sas_lateral" not in bare.data and "authority" not in bare.data.attrs["configuration"]
    assert not idle.data["sas_lateral"].any()
    assert np.array_equal(idle.data["actuator_pedal"], bare.data["pedal"])
    assert same(bare, wf.fly(baseline_dynamic, STEP, integrator=integrator, control=[]))


def test_servos_without_lag_or_limits_are_todays_flight_but_for_rounding(baseline_dynamic):
    bare, unity = fly(baseline_dynamic), fly(baseline_dynamic, actuators=Servos(lag="0 s"))
    for name in ("p", "q", "r", "roll"):
        assert np.abs(bare.data[name] - unity.data[name]).max() < 1e-11


def test_with_a_wake_too(baseline_relaxation):
    coarse = wf.RelaxationWake(turns=2, azimuth_step="15 deg")
    start = wf.trim(baseline_relaxation.aircraft, baseline_relaxation.condition, inflow=coarse)
    model = wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", convergence_revolutions=1)
    bare, idle, damped = (fly(start, control, inflow=model) for control in (None, [Idle()], [Damper()]))
    assert same(bare, idle)
    assert abs(damped.data["p"]).max() < 0.95 * abs(bare.data["p"]).max()


def test_what_is_recorded_is_what_was_done(baseline_dynamic):
    damped = fly(baseline_dynamic, [wf.RateDamping(roll="4 in/(rad/s)", authority="0.2 in")], actuators="generic")
    data = damped.data
    sticks = Sticks(STEP, baseline_dynamic.stick_si)
    asked = np.array([sticks.at(t) for t in data["time"].values]) / INCH
    assert np.allclose(data["lateral"], asked[:, 0], atol=1e-12)
    expected = np.clip(-4.0 * (data["p"] - data["p"][0]), -0.2, 0.2)
    # where a coupling step begins the controller has seen the state that is recorded there; the last row is not a beginning
    assert np.allclose(data["sas_lateral"][:-1], expected[:-1], atol=1e-12)
    assert not data["sas_pedal"].any()
    seconds = data.attrs["sas_saturated.lateral"]
    assert seconds == pytest.approx(float((abs(expected[:-1]) >= 0.2 - 1e-12).sum() * data["time"][1]), abs=1e-9)
    # servos are behind what they are told, by about their lag times its rate
    told = data["lateral"] + data["sas_lateral"]
    behind = (told - data["actuator_lateral"])[10]
    assert abs(behind) > 0.0 and float(abs(told - data["actuator_lateral"]).max()) < 0.03 * 6.0
    assert data["actuator_lateral"].attrs["units"] == "in"
    assert '"authority": "0.2 in"' in data.attrs["configuration"]


def test_a_controller_is_asked_at_its_own_times(baseline_dynamic):
    sim = wf.Simulation(baseline_dynamic, control=Damper(rate="80 Hz"))
    for _ in range(40):
        sim.step({"lateral": 0.3})
    times = np.array(sim.chain.members[0].controller.times)
    assert np.allclose(times, np.arange(times.size) / 80.0, atol=1e-12)
    assert times.size == int(sim.t * 80.0) + 1


def test_a_discrete_controller_does_not_depend_on_the_coupling_step(uh60a):
    # dynamic inflow is in the states: what is left of the coupling step, beside its trim, is when controllers are asked
    hold = wf.Maneuver("step", {"lateral": [(0.05, 0.0), (0.15, 0.5)]}, seconds=0.9)

    steps = (10, 5, 2.5, 1.25)
    starts = {degrees: wf.trim(uh60a, inflow=wf.DynamicInflow(azimuth_step=f"{degrees} deg")) for degrees in steps}

    def differences(control):
        found = []
        for degrees, start in starts.items():
            data = wf.fly(start, hold, integrator="fixed", rtol=1e-7, control=control).data
            found.append(np.array([data[name].values[:: int(40 / degrees)] for name in ("p", "q", "roll")]))
        return [np.abs(a - b).max() for a, b in zip(found[:-1], found[1:], strict=True)]

    def damped(rate):
        return differences(wf.RateDamping(roll="4 in/(rad/s)", pitch="4 in/(rad/s)", rate=rate))

    bare, own, every = differences([]), damped("100 Hz"), damped(None)
    # at its own rate: of second order, and no more than the flight without it differs
    assert all(a < 1.1 * b for a, b in zip(own, bare, strict=True)) and own[0] > 3.5 * own[1]
    # where coupling steps begin: half a step late, of first order
    assert all(1.7 < a / b < 2.6 for a, b in zip(every[:-1], every[1:], strict=True))
    assert every[1] > 10 * own[1]


CHAINS = {
    "path": wf.follow(load_factor=[("0 s", 1.0), ("0.5 s", 1.2)], climb_rate=[("0 s", "1 m/s")], rate="60 Hz"),
    "own": [Damper()],
    "own, at its rate": [Damper(rate="90 Hz")],
    "blocks and servos": wf.Augmentation(
        (
            wf.RateDamping(roll="2 in/(rad/s)", lag="0.02 s", washout="3 s"),
            wf.AttitudeHold(pitch="5 in/rad", pitch_rate="3 in/(rad/s)", rate="50 Hz"),
            wf.TurnCoordination(lateral_acceleration="0.1 in/(m/s2)"),
            wf.AltitudeHold(altitude="0.1 in/m", climb_rate="0.1 in/(m/s)"),
            wf.PitchBiasActuator(),
        ),
        authority="10 %",
        actuators=Servos("0.03 s", "30 deg/s"),
    ),
}


@pytest.mark.parametrize("integrator", ["fixed", "ida"])
@pytest.mark.parametrize("name", CHAINS)
def test_a_kept_flight_with_controllers_goes_on_to_the_same_bits(baseline_dynamic, name, integrator):
    def flown(sim, n):
        rows = [sim.step({"lateral": 0.3, "pedal": -0.1 * (k % 3)}).y for k in range(n)]
        return np.array([*rows, np.pad(sim.chain.reached, (0, rows[0].size - 4))])

    sim = wf.Simulation(baseline_dynamic, integrator=integrator, control=CHAINS[name])
    flown(sim, 17)
    kept = sim.snapshot()
    copy = pickle.loads(pickle.dumps(sim))
    rest = flown(sim, 20)
    sim.restore(wf.Snapshot.from_bytes(kept.to_bytes()))
    assert np.array_equal(flown(sim, 20), rest)
    assert np.array_equal(flown(copy, 20), rest)
    other = wf.Simulation(baseline_dynamic, integrator=integrator, control=CHAINS[name])
    other.restore(kept)
    assert np.array_equal(flown(other, 20), rest)
    with pytest.raises(wf.InputError, match="snapshot control"):
        wf.Simulation(baseline_dynamic, integrator=integrator).restore(kept)


def test_a_simulation_flies_a_copy_of_its_controllers(baseline_dynamic):
    mine = Damper()
    one, two = (wf.Simulation(baseline_dynamic, control=mine) for _ in range(2))
    one.step()
    assert not hasattr(mine, "times")
    assert two.chain.members[0].controller.times == [] != one.chain.members[0].controller.times


def test_a_controller_whose_memory_cannot_be_kept_says_what(baseline_dynamic):
    class Opaque(Idle):
        def reset(self, start):
            self.filter = object()

    sim = wf.Simulation(baseline_dynamic, control=Opaque())
    sim.step()
    with pytest.raises(wf.InputError, match=r"Opaque.*filter.*is a object.*state\(\) and restore"):
        sim.snapshot()


@pytest.mark.parametrize(
    "answer, named",
    [
        (lambda self: 1 / 0, "ZeroDivisionError: division by zero"),
        (lambda self: {"lateral": np.nan}, "lateral = nan, must be finite"),
        (lambda self: {"lateral": np.inf}, "lateral = inf, must be finite"),
        (
            lambda self: {"rudder": 1.0},
            "moved 'rudder', allowed are its outputs: lateral, longitudinal, collective, pedal",
        ),
        (lambda self: {"lateral": "left"}, "lateral = 'left', must be a number"),
        (lambda self: {"lateral": [1.0, 2.0]}, "must be a number"),
        (lambda self: None, "returned NoneType, must be a dict"),
        (lambda self: self.nothing, "AttributeError"),
    ],
)
def test_what_goes_wrong_in_a_controller_names_it_and_keeps_the_flight(baseline_dynamic, answer, named):
    with pytest.raises(wf.NumericalFailure) as caught:
        fly(baseline_dynamic, Broken(answer))
    assert named in str(caught.value) and "controller Broken at t = 0.10" in str(caught.value)
    partial = caught.value.partial
    assert 0.09 < float(partial.data["time"][-1]) < 0.11 and not partial.finished
    sim = wf.Simulation(baseline_dynamic, control=Broken(answer))
    with pytest.raises(wf.NumericalFailure, match="controller Broken"):
        sim.step(dt="0.2 s")


def test_a_reset_that_fails_says_so(baseline_dynamic):
    class Bad(Idle):
        def reset(self, start):
            raise KeyError("gain")

    with pytest.raises(wf.InputError, match="Bad': its reset raised KeyError"):
        wf.Simulation(baseline_dynamic, control=Bad())


def test_sensors_are_those_of_the_flight(baseline_dynamic):
    rows = []

    class Look(Idle):
        def step(self, t, sensors, stick):
            rows.append((t, {name: sensors[name] for name in SIGNALS}, dict(stick)))
            return {}

    data = fly(baseline_dynamic, Look()).data
    for k in (0, 50, 60):
        t, seen, stick = rows[k]
        assert t == pytest.approx(float(data["time"][k]))
        for name in ("u", "v", "w", "p", "q", "r", "roll", "pitch", "yaw", "north", "east", "down"):
            assert seen[name] == pytest.approx(float(data[name][k]), abs=1e-9)
        assert stick["lateral"] == pytest.approx(float(data["lateral"][k] - data["lateral"][0]), abs=1e-9)
        assert seen["torque"] == pytest.approx(-float(data["hub_moment"][k, 2]), rel=2e-3)
    # at rest in trim the accelerometers show gravity, turned by the attitude, but for the blades' passage
    _, seen, _ = rows[0]
    g, theta, phi = 9.80665, seen["pitch"], seen["roll"]
    assert seen["az"] == pytest.approx(-g * np.cos(theta) * np.cos(phi), abs=0.5)
    assert seen["load_factor"] == pytest.approx(1.0, abs=0.06)
    assert seen["rotor_speed"] == 27.0 and seen["altitude"] == pytest.approx(baseline_dynamic.condition.altitude)


def test_a_parallel_controller_moves_the_stick_and_stays_between_the_stops(baseline_dynamic):
    class Push(wf.Controller):
        outputs, acts = ("collective",), "parallel"

        def step(self, t, sensors, stick):
            return {"collective": 100.0 * t}

    data = fly(baseline_dynamic, Push()).data
    assert float(data["collective"].max()) == pytest.approx(10.0)
    assert not data["sas_collective"].any() and np.allclose(data["actuator_collective"], data["collective"])


def test_the_pitch_bias_actuator_slows_the_divergence_in_pitch(baseline_dynamic):
    nudge = wf.Maneuver("nudge", {"longitudinal": [(0.0, 0.0), (0.1, 0.2), (0.4, 0.2), (0.5, 0.0)]}, seconds=4.0)
    bare, helped = (
        wf.fly(baseline_dynamic, nudge, integrator="fixed", control=control).data
        for control in (None, [wf.PitchBiasActuator()])
    )
    change = [float(abs(data["pitch"] - data["pitch"][0])[-1]) for data in (bare, helped)]
    assert change[1] < 0.8 * change[0]


def test_the_second_reading_of_the_roll_reversal_ends_level(baseline_dynamic):
    flight = wf.fly(baseline_dynamic, wf.load_maneuver("roll-reversal-augmented"), integrator="fixed")
    bank = np.degrees(flight.data["roll"].values)
    assert 65.0 < bank.max() < 80.0 and -60.0 < bank.min() < -38.0 and abs(bank[-1]) < 15.0
    assert flight.data.attrs["sas_saturated.lateral"] > 1.0


def test_python_control_is_asked_for_in_one_line(monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(wf.InputError, match="needs the package python-control: pip install control"):
        wf.from_control(object())


def test_a_system_of_python_control_flies_as_the_block_does(baseline_dynamic):
    control = pytest.importorskip("control")
    lag, washout, gain = 0.05, 2.0, 3.0
    block = wf.RateDamping(roll=f"{gain} in/(rad/s)", lag=f"{lag} s", washout=f"{washout} s", authority="0.1 in")
    transfer = control.tf([-gain * washout, 0.0], np.polymul([lag, 1.0], [washout, 1.0]), inputs="p", outputs="lateral")
    same_one = fly(baseline_dynamic, block).data
    for system in (transfer, control.ss(transfer)):
        data = fly(baseline_dynamic, wf.from_control(system, authority="0.1 in")).data
        assert np.abs(data["p"] - same_one["p"]).max() < 1e-9
        assert data.attrs["sas_saturated.lateral"] == same_one.attrs["sas_saturated.lateral"] > 0.0
    # a gain by itself, discrete, at its own rate
    discrete = control.ss([], [], [], [[-gain]], 0.0125)
    named = wf.from_control(discrete, signals="p", outputs="lateral")
    assert named.rate == "80.0 Hz"
    own = fly(baseline_dynamic, wf.RateDamping(roll=f"{gain} in/(rad/s)", rate="80 Hz")).data
    assert np.abs(fly(baseline_dynamic, named).data["p"] - own["p"]).max() < 1e-12
    sim = wf.Simulation(baseline_dynamic, control=wf.from_control(transfer))
    sim.step({"lateral": 0.5})
    kept = sim.snapshot()
    rest = sim.step({"lateral": 0.5}, dt="0.1 s").y
    sim.restore(pickle.loads(pickle.dumps(kept)))
    assert np.array_equal(sim.step({"lateral": 0.5}, dt="0.1 s").y, rest)
    for make, named in (
        (lambda: wf.from_control(control.ss([], [], [], [[1.0]])), "signals = 'u\\[0\\]'"),
        (lambda: wf.from_control(discrete, signals="p", outputs="rudder"), "outputs = 'rudder'"),
        (lambda: wf.from_control(discrete, signals=("p", "q"), outputs="lateral"), "must be 1 different names"),
        (lambda: wf.from_control(discrete, signals="p", outputs="lateral", rate="10 Hz"), "is that of the system"),
        (lambda: wf.from_control("a", signals="p", outputs="lateral"), "state space or a transfer function"),
        (lambda: wf.from_control(control.ss([], [], [], [[1.0]], True), "p", "lateral"), "rate = None: must be given"),
    ):
        with pytest.raises(wf.InputError, match=named):
            make()


HOLD = {"lateral": [(0.0, 0.0), (1.0, 0.0)]}


@pytest.fixture(scope="module", params=["uh60a", "bo105"])
def level(request):
    return wf.trim(wf.load_aircraft(request.param), wf.FlightCondition(speed="80 kt"), inflow="dynamic")


def followed(start, seconds, **path):
    return wf.fly(start, wf.Maneuver("hold", HOLD, seconds=seconds), integrator="fixed", control=wf.follow(**path)).data


def test_a_bank_is_followed(level):
    data = followed(level, 7.0, bank=[("0.5 s", "0 deg"), ("2.5 s", "45 deg")])
    t, bank = data["time"].values, np.degrees(data["roll"].values)
    assert np.abs(bank - np.interp(t, [0.5, 2.5], [0.0, 45.0])).max() < 8.0
    assert np.abs(bank[t > 5.0] - 45.0).max() < 3.0
    # in a coordinated turn: r = g sin(phi) cos(theta)/V
    speed = np.sqrt(sum(data[name].values ** 2 for name in "uvw"))
    turn = 9.80665 * np.sin(data["roll"]) * np.cos(data["pitch"]) / speed
    assert np.abs(data["r"].values - turn.values)[t > 5.0].max() < 0.03


def test_a_load_factor_is_followed_late(level):
    data = followed(level, 5.0, load_factor=[("0.5 s", 1.0), ("1.5 s", 1.5), ("2.5 s", 1.5), ("3.5 s", 1.0)])
    u, v, w, p, q, roll, pitch, t = (data[name].values for name in ("u", "v", "w", "p", "q", "roll", "pitch", "time"))
    n = -(np.gradient(w, t) + p * v - q * u) / 9.80665 + np.cos(pitch) * np.cos(roll)
    n = np.convolve(np.pad(n, 4, mode="edge"), np.ones(9) / 9, "valid")
    assert 1.45 < n.max() < 1.66
    half = [t[np.argmax(n > 1.25)], t[np.flatnonzero(n > 1.25)[-1]]]
    late = [half[0] - 1.0, half[1] - 3.0]
    assert all(0.3 < each < 1.4 for each in late), late


def test_a_speed_is_followed_at_a_climb_rate(level):
    data = followed(level, 16.0, speed=[("0.5 s", "80 kt"), ("8 s", "100 kt")], climb_rate=[("0 s", "0 m/s")])
    speed = np.sqrt(sum(data[name].values ** 2 for name in "uvw")) / 0.514444
    assert speed[-1] == pytest.approx(100.0, abs=5.0)
    assert abs(float(data["down"][-1])) < 8.0


@pytest.mark.parametrize(
    "path, named",
    [
        ({}, "at least one of bank, load_factor"),
        ({"bank": [("0 s", 10.0)]}, "bank = 10.0"),
        ({"bank": "45 deg"}, "bank = '45 deg': must be a list"),
        ({"bank": [("1 s", "0 deg"), ("1 s", "5 deg")]}, "bank time = '1 s': must ascend"),
        ({"load_factor": [("0 s", "1 g")]}, "load_factor"),
        ({"load_factor": [("0 s", 1.0)], "speed": [("0 s", "80 kt")]}, "one of them"),
    ],
)
def test_a_path_that_cannot_be_is_refused(path, named):
    with pytest.raises(wf.InputError, match=named):
        wf.follow(**path)
    with pytest.raises(wf.InputError, match=r"hands\.roll"):
        wf.Hands(roll=-1.0)
