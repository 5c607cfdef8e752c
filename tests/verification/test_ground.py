# SPDX-License-Identifier: MIT OR Apache-2.0
"""Ground: no air through it, hover near it against what is published, nothing of it far above, a stop that has a name."""

import re

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.results.frames import body_of_hub

RADIUS = 8.1778


def hover(height):
    return wf.FlightCondition(speed="0 kt", height=None if height is None else f"{height * RADIUS} m")


@pytest.fixture(scope="module")
def rigid(uh60a):
    return uh60a.with_rigid_blades()


def mean_inflow(start):
    return float(start.state(0.0)[start.model.layout["inflow"][0]])


def test_hover_with_dynamic_inflow_gains_what_cheeseman_and_bennett_say(rigid):
    free = wf.trim(rigid, hover(None), inflow="dynamic")
    for height in (0.6, 1.0, 2.0, 4.0):
        start = wf.trim(rigid, hover(height), inflow="dynamic")
        expected = (1.0 - 1.0 / (4.0 * height) ** 2) ** 1.5
        # the download of the wash goes with the inflow, and the thrust with it
        assert mean_inflow(start) / mean_inflow(free) == pytest.approx(expected, rel=3e-3)


def test_the_wind_of_forward_flight_takes_the_ground_away(rigid):
    speed = 0.07 * 27.0 * RADIUS
    power = [
        wf.trim(
            rigid, wf.FlightCondition(speed=f"{speed} m/s", flight_path="0 deg", height=height), inflow="dynamic"
        ).mean_outputs()["power"]
        for height in (None, f"{RADIUS} m")
    ]
    assert 0.98 < power[1] / power[0] < 1.0


@pytest.mark.slow
@pytest.mark.parametrize("height", [1.25, 1.5, 2.0])
def test_hover_with_the_marched_wake_needs_the_inflow_that_is_published(uh60a, marched_away, height):
    near = wf.trim(uh60a, hover(height), inflow="time-marching")
    published = 1.0 / (0.9926 + 0.0379 * (2.0 / height) ** 2)  # Hayden's fit of flight tests, induced power
    ratio = near.mean_outputs()["inflow_mean"] / marched_away.mean_outputs()["inflow_mean"]
    assert ratio == pytest.approx(published, rel=0.05)


@pytest.fixture(scope="module")
def marched_away(uh60a):
    return wf.trim(uh60a, hover(None), inflow="time-marching")


def plane_of(sim):
    """Points of the ground around the rotor (n, 3) [m] and its normal, hub axes."""
    from wakeflight.attitude import body_to_inertial

    y, rotor = sim.y, sim.model.data["rotor"]
    turned = body_to_inertial(y[6:10])
    hub = y[10:13] + turned @ np.array(rotor["position"])
    to_hub = (turned @ body_of_hub(rotor["shaft_tilt_forward"], rotor["shaft_tilt_lateral"])).T
    ground = sim.start.condition.height + rotor["position"][2]
    at = np.random.default_rng(3).uniform(-15.0, 15.0, (60, 2))
    points = np.column_stack([at, np.full(60, ground)])
    return (points - hub) @ to_hub.T, to_hub @ np.array([0.0, 0.0, -1.0])


@pytest.mark.parametrize("pedal", [0.0, 1.0])
def test_no_air_goes_through_the_ground(rigid, pedal):
    coarse = {"turns": 2, "azimuth_step": "30 deg", "far_wake_turns": 0}
    start = wf.trim(rigid, hover(0.8), inflow=wf.RelaxationWake(**coarse))
    sim = wf.Simulation(start, wf.TimeMarchingWake(**coarse, convergence_revolutions=1))
    for _ in range(6):
        sim.step({"pedal": pedal, "collective": 0.5})
    # the velocity is that of the images of the level that has just been reached
    points, normal = plane_of(sim)
    velocity = sim.exchange.core.wake().wake_velocity(points)
    speed = np.linalg.norm(velocity, axis=1).max()
    assert speed > 2.0
    assert np.abs(velocity @ normal).max() < 1e-13 * speed


def test_a_flight_that_reaches_the_ground_ends_by_name(rigid, tmp_path):
    start = wf.trim(rigid, hover(0.7), inflow="dynamic")
    drop = wf.Maneuver("drop", (("collective", ((0.1, 0.0), (0.3, -3.0))),), seconds=5.0)
    with pytest.raises(wf.GroundContact, match="flight of drop ended: contact with the ground at t = ") as stop:
        wf.fly(start, drop, integrator="fixed")
    run = stop.value.partial.data
    assert 0.5 < float(run.time[-1]) < 4.0 and float(run.down[-1]) > 2.0
    sinking = float(re.search(r"sinking at ([0-9.]+) m/s", str(stop.value))[1])
    assert sinking == pytest.approx(float(run.down[-1] - run.down[-2]) / float(run.time[-1] - run.time[-2]), rel=0.05)
    # flown again it ends there too, with the same bits
    again = wf.rerun(stop.value.partial.save(tmp_path / "run.nc"))
    assert again.same and again.flight.data.attrs["failure"] == run.attrs["failure"]
    away = wf.trim(rigid, hover(None), inflow="dynamic")
    assert float(wf.fly(away, drop, integrator="fixed", revolutions=4).data.down[-1]) > 0.0


def test_a_flight_above_ground_is_kept_and_goes_on(rigid):
    sim = wf.Simulation(wf.trim(rigid, hover(1.0), inflow="dynamic"))
    for _ in range(5):
        sim.step({"collective": 0.3})
    kept = sim.snapshot()
    rest = [sim.step({"collective": 0.3}).y for _ in range(5)]
    sim.restore(kept)
    assert np.array_equal([sim.step({"collective": 0.3}).y for _ in range(5)], rest)


def test_heights_that_are_none_are_refused_by_name(rigid):
    for height in ("-1 m", "2 km", "10", 3.0):
        with pytest.raises(wf.InputError, match="height"):
            wf.FlightCondition(speed="0 kt", height=height)
    with pytest.raises(wf.InputError, match="far_wake = 'cylinder'"):
        wf.trim(rigid, hover(1.0), inflow=wf.RelaxationWake(far_wake="cylinder"))


def test_a_hub_so_low_that_the_airframe_is_in_the_ground_is_refused(rigid):
    with pytest.raises(wf.InputError, match=r"height = '1 m': must be above 1\.803 m"):
        wf.trim(rigid, wf.FlightCondition(speed="0 kt", height="1 m"), inflow="dynamic")
    low = wf.trim(rigid, wf.FlightCondition(speed="0 kt", height="1.9 m"), inflow="dynamic")
    assert wf.Simulation(low).t == 0.0
