# SPDX-License-Identifier: MIT OR Apache-2.0
"""The machine around the rotor: what the core does in one call is what was asked piece by piece, and everything on is kept."""

import pickle

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import _core
from wakeflight.flight_start import flight_model
from wakeflight.integrators import consistent_rate
from wakeflight.wind import Surroundings, wind_of

AIR = [wf.SteadyWind("10 kt", from_="30 deg"), wf.Dryden("1.5 m/s", "150 m", seed=1), wf.Gust(ahead="-10 m")]
BLOCKS = (
    wf.RateDamping(roll="2 in/(rad/s)", pitch="2 in/(rad/s)", lag="0.05 s", washout="5 s", authority="0.01 in"),
    wf.AttitudeHold(roll="3 in/rad", heading="2 in/rad", rate="70 Hz"),
    wf.TurnCoordination(sideslip="1 in/rad", lateral_acceleration="0.1 in/(m/s2)", yaw_rate="1 in/(rad/s)"),
    wf.AltitudeHold(altitude="0.1 in/m", climb_rate="0.1 in/(m/s)"),
)
EVERYTHING = {
    "control": wf.Augmentation(BLOCKS, actuators="generic"),
    "rotor_speed": "governed",
    "wind": AIR,
    "stabilator": "scheduled",
}


def flown(sim, n):
    return np.array([sim.step({"lateral": 0.3, "pedal": -0.1 * (k % 3)}).y for k in range(n)])


@pytest.mark.parametrize("inflow", ["dynamic", "time-marching"])
def test_everything_on_is_kept_and_goes_on_to_the_same_bits(baseline_dynamic, uh60a, inflow):
    start = baseline_dynamic
    if inflow == "time-marching":
        coarse = {"turns": 2, "azimuth_step": "15 deg", "precision": "double"}
        condition = wf.FlightCondition(speed="80 kt")
        start = wf.trim(uh60a.with_rigid_blades(), condition, inflow=wf.RelaxationWake(**coarse))
        inflow = wf.TimeMarchingWake(convergence_revolutions=1, **coarse)
    sim = wf.Simulation(start, inflow, **EVERYTHING)
    flown(sim, 11)
    kept, copy = sim.snapshot(), pickle.loads(pickle.dumps(sim))
    rest = flown(sim, 15)
    sim.restore(wf.Snapshot.from_bytes(kept.to_bytes()))
    assert np.array_equal(flown(sim, 15), rest)
    assert np.array_equal(flown(copy, 15), rest)


@pytest.mark.parametrize("name", ["uh60a", "bo105"])
def test_a_wind_in_closed_form_is_felt_as_by_its_points(name):
    aircraft = wf.load_aircraft(name)
    model = wf.trim(aircraft, wf.FlightCondition(speed="60 kt"), inflow="dynamic").model
    y = np.zeros(model.layout["size"])
    y[:13] = 30.0, 2.0, -1.0, 0.1, 0.0, 0.2, 0.9, 0.2, -0.3, 0.4, 120.0, -35.0, -12.0
    wind = wind_of(AIR)
    closed = Surroundings(model, wind).at(3.0, y, 0.7, 0.01)
    asked = Surroundings(model, wind_of(lambda points, t: wind(points, t))).at(3.0, y, 0.7, 0.01)
    assert np.abs(closed.stations).max() > 1e-4
    for part in ("origin", "at_hub", "turn", "stations"):
        assert np.abs(getattr(closed, part) - getattr(asked, part)).max() < 1e-12, part
    assert closed.largest == pytest.approx(asked.largest, abs=1e-12)


def test_a_wind_that_is_no_number_ends_the_flight_by_name(baseline_dynamic):
    def torn(points, t):
        return np.full(points.shape, np.nan if t > 0.02 else 0.5)

    sim = wf.Simulation(baseline_dynamic, wind=torn)
    with pytest.raises(wf.NumericalFailure, match=r"wind .*torn at t = 0\.0.* is not finite, or beyond 100 m/s"):
        flown(sim, 9)


class Asked(wf.RateDamping):
    """A block that is asked in Python, as one of a user's own is."""

    def step(self, t, sensors, stick):
        return super().step(t, sensors, stick)


def test_a_block_in_the_core_is_the_block_that_is_asked(baseline_dynamic):
    given = {"roll": "2 in/(rad/s)", "yaw": "1 in/(rad/s)", "lag": "0.05 s", "authority": "0.02 in"}
    inside, outside = (wf.Simulation(baseline_dynamic, control=[kind(**given)]) for kind in (wf.RateDamping, Asked))
    assert inside.chain.members[0].feedback is not None and outside.chain.members[0].feedback is None
    assert np.array_equal(flown(inside, 30), flown(outside, 30))
    assert inside.chain.counted() == outside.chain.counted()
    assert inside.chain.counted()["sas_saturated"]["lateral"] > 0.0


def test_an_answer_that_is_no_number_is_told():
    feedback = _core.Feedback([(0, 1.0, "p", False)], (None, None), None, False, [np.inf] * 4)
    chain = _core.ControlChain([(feedback, "series")], ([1.0] * 4, [1.0] * 4, [10.0] * 4), None, np.zeros(4))
    y = np.eye(1, 13, 6)[0]
    assert chain.ask(0.0, [0], _core.Sensed(y, 0.0, 27.0), 0.0) is None
    y[3] = np.nan
    assert chain.ask(0.1, [0], _core.Sensed(y, 0.0, 27.0), 0.0) == 0


def test_what_feedback_cannot_be_is_refused():
    for terms in ([(4, 1.0, "p", False)], [(0, 1.0, "warp", False)]):
        with pytest.raises(wf.InputError, match="neither may be new"):
            _core.Feedback(terms, (None, None), None, False, [1.0] * 4)
    with pytest.raises(wf.InputError, match="allowed: series, own, parallel"):
        _core.ControlChain([(None, "both")], ([1.0] * 4,) * 3, None, np.zeros(4))


def test_a_governed_rotor_keeps_its_derivatives_as_long_as_one_of_constant_speed(baseline_dynamic):
    maneuver = wf.arrested_descent()
    runs = [
        wf.fly(baseline_dynamic, maneuver, revolutions=3, integrator="fixed", rotor_speed=speed).data
        for speed in ("constant", "governed")
    ]
    assert abs(float(runs[1].rotor_speed[-1] / runs[1].rotor_speed[0]) - 1.0) > 1e-4
    assert runs[1].attrs["jacobians"] <= runs[0].attrs["jacobians"] + 1


@pytest.mark.parametrize("rotor_speed", ["governed", "free", [("0 s", 1.0), ("0.1 s", 0.97)]])
def test_ida_keeps_derivatives_over_an_azimuth_whatever_the_speed(baseline_dynamic, rotor_speed):
    # the age of dF/dy counts in azimuth turned: by the nominal speed's clock a slower rotor outlives it within a step
    maneuver = wf.arrested_descent()
    constant, turned = (
        wf.fly(baseline_dynamic, maneuver, revolutions=8, integrator="ida", rotor_speed=speed).data
        for speed in ("constant", rotor_speed)
    )
    assert float(abs(turned.rotor_speed / turned.rotor_speed[0] - 1.0).max()) > 1e-3
    assert abs(turned.attrs["jacobians"] / constant.attrs["jacobians"] - 1.0) < 0.05


@pytest.mark.parametrize("rotor_speed", ["constant", "governed"])
def test_derivatives_in_a_wind_are_those_by_differences(baseline_dynamic, rotor_speed):
    # one direction of the attitude is left to the others in each of two attitudes
    sim = wf.Simulation(baseline_dynamic, wind=AIR, rotor_speed=rotor_speed)
    model = flight_model(baseline_dynamic, None, sim.turning)
    for attitude in ([0.9, 0.2, -0.3, 0.25], [0.2, -0.3, 0.9, 0.25]):
        y = np.array(sim.y)
        y[6:10] = np.array(attitude) / np.linalg.norm(attitude)
        air = Surroundings(model, wind_of(AIR)).at(0.01, y, 0.3)
        bare = _core.Inputs(baseline_dynamic.stick_si, np.zeros(4), 0.0, None, 0.0, 0.0)
        inputs = bare.under(sim._engine, air)
        y_dot = consistent_rate(model, 0.0, y, inputs)
        exact, n = np.empty((y.size, y.size)), y.size
        model.core.jacobian(0.0, y, y_dot, inputs, (1.0, 0.0), exact)
        up, down = np.empty(n), np.empty(n)
        for i in (0, 1, 2, 6, 7, 8, 9):
            step = 1e-6 * max(1.0, abs(y[i]))
            for sign, out in ((1.0, up), (-1.0, down)):
                moved = y.copy()
                moved[i] += sign * step
                model.core.residual(0.0, moved, y_dot, inputs, out)
            differences = (up - down) / (2.0 * step)
            assert np.abs(exact[:, i] - differences).max() < 2e-6 * max(1.0, np.abs(differences).max()), (attitude, i)
