# SPDX-License-Identifier: MIT OR Apache-2.0
"""Air that moves of its own: a steady wind is a Galilean shift, a gust is met where the parts of the aircraft are."""

import pickle

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.attitude import body_to_inertial
from wakeflight.results.frames import earth_of_body
from wakeflight.wind import Surroundings, wind_of

WIND = wf.SteadyWind("25 kt", from_="40 deg", up="1 m/s")


@pytest.fixture(scope="module")
def start(uh60a):
    return wf.trim(uh60a.with_rigid_blades(), wf.FlightCondition(speed="80 kt"), inflow="dynamic")


@pytest.fixture(scope="module")
def on_wake(uh60a):
    # in single precision the last bit of a marker's place can turn one velocity by 1e-10 of the tip speed, flights by 1e-8
    coarse = wf.RelaxationWake(turns=2, azimuth_step="15 deg", precision="double")
    return wf.trim(uh60a.with_rigid_blades(), wf.FlightCondition(speed="80 kt"), inflow=coarse)


def over_ground(run):
    """Velocity over ground (time, 3), north, east, down."""
    turned = earth_of_body(*(run[name].values for name in ("roll", "pitch", "yaw")))
    body = np.stack([run[name].values for name in "uvw"], axis=1)
    return np.einsum("tij,tj->ti", turned, body)


def same_flight(still, windy, within):
    velocity = WIND.velocity
    assert np.abs(windy.wind.values - velocity).max() < 1e-12
    for name in ("p", "q", "r", "roll", "pitch", "yaw", "modal", "inflow", "force_z", "moment_y", "power"):
        a, b = still[name].values, windy[name].values
        assert np.abs(a - b).max() < within * max(1.0, np.abs(a).max()), name
    assert np.abs(over_ground(windy) - velocity - over_ground(still)).max() < 100 * within
    for name, speed in zip(("north", "east", "down"), velocity, strict=True):
        assert np.abs(windy[name].values - still[name].values - speed * still.time.values).max() < 100 * within, name


def test_a_steady_wind_is_a_galilean_shift(start):
    runs = [
        wf.fly(start, wf.roll_reversal(), revolutions=4, integrator="fixed", rtol=1e-9, wind=wind).data
        for wind in (None, WIND)
    ]
    same_flight(*runs, 1e-10)
    assert "wind" not in runs[0]


def test_elastic_blades_and_a_servo_shift_too(uh60a):
    start = wf.trim(uh60a, wf.FlightCondition(speed="80 kt"), inflow="dynamic")
    runs = [
        wf.fly(
            start,
            wf.arrested_descent(),
            revolutions=2,
            integrator="fixed",
            rtol=1e-11,
            wind=wind,
            stabilator="scheduled",
        ).data
        for wind in (None, WIND)
    ]
    same_flight(*runs, 1e-9)


def test_controllers_know_the_speed_through_the_air(start):
    # of a pitch-bias actuator and a turn coordination airspeed and sideslip are inputs
    control = [wf.PitchBiasActuator(), wf.TurnCoordination(sideslip="5 in/rad", yaw_rate="2 in/(rad/s)")]
    runs = [
        wf.fly(start, wf.roll_reversal(), revolutions=4, integrator="fixed", rtol=1e-9, wind=wind, control=control).data
        for wind in (None, WIND)
    ]
    same_flight(*runs, 1e-10)
    assert np.abs(runs[0].sas_pedal).max() > 0.01


@pytest.mark.parametrize(("inflow", "steps"), [("time-marching", 72), ("relaxation", 24)])
def test_the_wind_carries_the_wake(on_wake, inflow, steps):
    # three revolutions at a tight tolerance: the integrator weighs velocities and positions over ground, so that at its usual one
    # Newton's iteration ends elsewhere in a wind, and the flights differ by what it may leave; a wake that is relaxed anew every
    # revolution differs by what that leaves, 2e-8 of its nodes
    model = on_wake.inflow
    if inflow == "time-marching":
        model = wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", convergence_revolutions=1, precision="double")
    still, windy = (wf.Simulation(on_wake, model, rtol=1e-9, wind=wind) for wind in (None, WIND))
    for step in range(steps):
        for sim in (still, windy):
            sim.step({"lateral": 1.0} if step > 3 else None)
        apart = windy.y - still.y
        apart[:3] -= body_to_inertial(still.y[6:10]).T @ WIND.velocity
        apart[10:13] -= WIND.velocity * still.t
        assert np.abs(apart).max() < 1e-10
        assert np.abs(windy.wake - still.wake).max() < 1e-10


GUST = wf.Gust(amplitude="4 m/s", length="60 m", ahead="25 m")


def test_a_gust_from_below_lifts_the_aircraft_as_it_passes(start):
    nothing = wf.Maneuver("nothing", (), seconds=5.0)
    still, gusty = (wf.fly(start, nothing, revolutions=8, integrator="fixed", wind=wind).data for wind in (None, GUST))
    lift = -(gusty.force_z.values - still.force_z.values)
    inside = np.abs(gusty.wind.values[:, 2]) > 0.5
    # the rotor meets it before the body's origin does
    before = np.flatnonzero(np.abs(lift) > 1.0)[0]
    assert before < np.flatnonzero(np.abs(gusty.wind.values[:, 2]) > 0.0)[0]
    assert lift[inside].max() > 0.1 * 9.81 * 7000
    assert gusty.wind.values[:, 2].min() == pytest.approx(-4.0, abs=0.01)


def test_places_that_feel_a_gust_are_where_they_are(start):
    asked = []

    def shear(points, t):
        """Upward wind that grows to the north, and one to the east that does."""
        asked.append(points)
        return np.stack([0 * points[:, 0], 0.02 * points[:, 0], -0.05 * points[:, 0]], axis=1)

    model = start.model
    y = start.state(0.0)
    y[6:10] = [1.0, 0.0, 0.0, 0.0]
    air = Surroundings(model, wind_of(shear)).at(0.0, y, 0.3)
    places = asked[0]
    radius = np.linalg.norm(places[3:] - places[1], axis=1).reshape(model.n_blades, -1)
    assert np.abs(radius - model.stations).max() < 1e-12
    # blade 1 at azimuth 0.3 is aft and, of a counter-clockwise rotor, to the right
    first = places[3 + model.stations.size - 1] - places[1]
    assert first[0] < 0.0 < first[1]
    assert air.at_hub[2] - air.origin[2] == pytest.approx(-0.05 * (places[1] - places[0])[0])
    # more from below in front: less inflow there, and the air noses up with it; to the right in front: it yaws to the right
    assert air.stations[0, -1] > 0.0 > air.stations[2, -1]
    assert air.turn == pytest.approx([0.0, 0.05, 0.02])


def test_a_flight_in_a_gust_is_kept_and_goes_on(on_wake, start):
    marched = wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", convergence_revolutions=1, precision="double")
    near = wf.Gust(amplitude="4 m/s", length="30 m", ahead="5 m")
    for trimmed, inflow in ((start, "dynamic"), (on_wake, marched)):
        sim = wf.Simulation(trimmed, inflow, wind=near)

        def flown(sim):
            return np.array([np.concatenate([sim.step({"pedal": 0.2}).y, [sim.t]]) for _ in range(5)])

        for _ in range(10):
            sim.step()
        kept = sim.snapshot()
        rest = flown(sim)
        sim.restore(kept)
        copy = pickle.loads(pickle.dumps(sim))
        assert np.array_equal(flown(sim), rest) and np.array_equal(flown(copy), rest)
        with pytest.raises(wf.InputError, match="snapshot wind"):
            wf.Simulation(trimmed, inflow, wind=GUST).restore(kept)


def test_what_is_no_wind_is_refused_by_name(start):
    for make, named in (
        (lambda: wf.SteadyWind("10"), "wind speed"),
        (lambda: wf.SteadyWind("-10 kt"), "between 0 and 100"),
        (lambda: wf.SteadyWind("10 kt", from_="north"), "wind from_"),
        (lambda: wf.Gust(shape="square"), "gust shape"),
        (lambda: wf.Gust(length="0 m"), "gust length"),
        (lambda: wf.Gust(direction="left"), "gust direction"),
        (lambda: wf.Gust(amplitude="500 m/s"), "gust amplitude"),
        (lambda: wf.Simulation(start, wind="10 kt"), "or a function of points"),
        (lambda: wf.Simulation(start, wind=lambda points, t: points[0]), r"must be \(83, 3\)"),
    ):
        with pytest.raises(wf.InputError, match=named):
            make()
    with pytest.raises(wf.NumericalFailure, match="not finite"):
        wf.Simulation(start, wind=lambda points, t: points * np.nan)
