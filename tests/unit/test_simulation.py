"""A simulation by its face: what a step takes, what a snapshot refuses, how things show and pickle themselves."""

import pickle

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import _core
from wakeflight.flight_start import flight_model


@pytest.fixture(scope="module")
def sim(baseline_dynamic):
    return wf.Simulation(baseline_dynamic)


def test_a_step_goes_to_sticks_about_trim(sim):
    sim.step({"lateral": 0.5, "pedal": -0.1})
    assert sim.state.stick == pytest.approx({"lateral": 0.5, "longitudinal": 0.0, "collective": 0.0, "pedal": -0.1})
    sim.step([0.0, 0.2, 0.0, 0.0])
    assert sim.state.stick["longitudinal"] == pytest.approx(0.2)
    sim.step()
    assert sim.state.stick == dict.fromkeys(sim.state.stick, 0.0)


def test_time_is_the_number_of_steps_times_their_length(sim):
    before = sim.steps
    state = sim.step(dt="20 ms")
    assert sim.steps - before == round(0.02 / sim.delta_t) == 3
    assert state.t == sim.t == sim.steps * sim.delta_t


@pytest.mark.parametrize(
    "sticks, named",
    [
        ({"rudder": 1.0}, "rudder"),
        ([0.0, 0.0], "four finite numbers"),
        ([0.0, 0.0, 0.0, np.nan], "four finite numbers"),
        ({"lateral": "left"}, "inches about trim"),
        ({"lateral": 40.0}, "lateral = .* must lie between 0 and"),
    ],
)
def test_sticks_that_cannot_be_are_refused(sim, sticks, named):
    before = sim.y
    with pytest.raises(wf.InputError, match=named):
        sim.step(sticks)
    assert np.array_equal(sim.y, before)


def test_options_that_cannot_be_are_refused(baseline_dynamic):
    for options, named in (
        ({"integrator": "euler"}, "integrator"),
        ({"control": 1.0}, "control"),
        ({"stabilator": "free"}, "stabilator"),
        ({"inflow": "relaxation"}, "inflow"),
    ):
        with pytest.raises(wf.InputError, match=named):
            wf.Simulation(baseline_dynamic, **options)


def test_a_snapshot_of_another_flight_is_refused(sim, uh60a, baseline_dynamic):
    kept = sim.snapshot()
    for other, named in (
        (wf.Simulation(baseline_dynamic, integrator="ida"), "snapshot integrator"),
        (wf.Simulation(baseline_dynamic, stabilator="scheduled"), "snapshot stabilator"),
        (wf.Simulation(wf.trim(uh60a.with_rigid_blades(), inflow="dynamic")), "snapshot aircraft data"),
        (wf.Simulation(wf.trim(uh60a, wf.FlightCondition(speed="40 kt"), inflow="dynamic")), "snapshot"),
    ):
        with pytest.raises(wf.InputError, match=named):
            other.restore(kept)
    with pytest.raises(wf.InputError, match=r"must be what Simulation\.snapshot returned"):
        sim.restore(b"")


def test_a_snapshot_block_that_was_cut_or_changed_is_refused(sim):
    block = sim.snapshot().to_bytes()
    assert wf.Snapshot.from_bytes(block) == sim.snapshot()
    for spoiled in (block[:-1], block[:50] + bytes([block[50] ^ 1]) + block[51:], b"", b"WKFL"):
        with pytest.raises(wf.InputError, match="snapshot"):
            wf.Snapshot.from_bytes(spoiled)


def test_aircraft_trim_and_flight_are_pickled_by_value(uh60a, baseline_dynamic, baseline_relaxation):
    for start in (baseline_dynamic, baseline_relaxation):
        copy = pickle.loads(pickle.dumps(start))
        assert copy.to_dataset().identical(start.to_dataset())
        hold = wf.Maneuver("hold", {"lateral": [(0.0, 0.0), (0.1, 0.5)]}, revolutions=0.2)
        one, two = (wf.fly(each, hold, inflow=start.inflow, integrator="fixed") for each in (start, copy))
        assert all(np.array_equal(one.data[name], two.data[name], equal_nan=True) for name in one.data.data_vars)
        assert pickle.loads(pickle.dumps(one)).data.identical(one.data)
    again = pickle.loads(pickle.dumps(uh60a))
    assert np.array_equal(wf.trim(again, inflow="dynamic").x, baseline_dynamic.x)


def test_things_show_themselves(uh60a, sim, baseline_dynamic):
    hold = wf.Maneuver("hold", {"lateral": [(0.0, 0.0), (0.1, 0.0)]}, revolutions=0.1)
    flight = wf.fly(baseline_dynamic, hold, integrator="fixed")
    for each in (uh60a, baseline_dynamic, flight, sim):
        assert len(repr(each)) < 120 and "\n" not in repr(each)
        html = each._repr_html_()
        assert html.startswith("<table>") and uh60a.name in html


def test_wrong_shapes_and_numbers_are_refused_by_the_exchange(baseline_relaxation):
    start = baseline_relaxation
    model, core = start.model, start.model.core
    y, n = start.state(), model.steps_per_revolution
    motion = core.trim_motion(start.problem, start.x, n)
    exchange = _core.Exchange.marching(core, start.wake.core, flight_model(start, "time-marching").wake_options)
    good = dict(y=y, stick=start.stick_si, stick_rate=np.zeros(4))
    for bad, named in (
        ({"y": y[:5]}, "y has 5 numbers"),
        ({"y": np.full(y.size, np.nan)}, "y is not finite"),
        ({"stick": np.zeros(3)}, "stick has 3 numbers, 4 needed"),
        ({"stick_rate": np.zeros(3)}, "stick_rate has 3 numbers, 4 needed"),
        ({"stick": np.full(4, np.inf)}, "stick is not finite"),
        ({"motion": motion}, "q has the shape"),
    ):
        given = good | bad
        sticks = given.pop("stick"), given.pop("stick_rate")
        with pytest.raises(ValueError, match=named):
            exchange.advance(core, 1, sticks=sticks, **given)
    with pytest.raises(ValueError, match="q has the shape"):
        exchange.turn(core, y, start.stick_si, (motion[0][:3], motion[1][:3]))
    with pytest.raises(ValueError, match="inflow has the shape"):
        _core.SteadyWake(core, model.wake_options, False, np.zeros((3, 3)))
    for kind in (_core.Exchange, _core.SteadyWake, _core.TrimProblem):
        with pytest.raises(ValueError, match="cannot be read"):
            kind.from_bytes(b"nothing")
