"""A short form of the case `envelope`: what ordinary flight returns is an answer, and what is no answer says so."""

import numpy as np
import pytest

import wakeflight as wf

KNOT = 0.514444


def level(speed, aircraft="uh60a", inflow="relaxation", **more):
    condition = wf.FlightCondition(**{"speed": f"{speed} kt", "flight_path": "0 deg", "altitude": "0 ft", **more})
    return wf.trim(wf.load_aircraft(aircraft), condition, inflow=inflow)


def largest_mach(flight):
    """Mach number that motion alone gives, with a tenth for induced velocity and blade motion."""
    model = flight.start.model
    return 1.1 * (model.tip_speed + flight.start.condition.speed) / model.speed_of_sound


def check_physical(flight):
    data = flight.data
    assert np.isfinite(data.inflow).all() and np.isfinite(data.force_z).all()
    # momentum theory in hover gives 0.05 of the tip speed; tip vortices passing close reach four times that
    assert float(abs(data.inflow).max()) < 0.3
    assert float(data.mach.max()) < largest_mach(flight)


@pytest.mark.parametrize("speed", [0, 100, 140])
def test_level_flight_with_sticks_held_stays_level(speed):
    # reverse flow carries trailers of the near wake across inner stations: 100 to 140 kt left with 30 tip speeds of inflow
    start = level(speed)
    hold = wf.Maneuver("hold", (("lateral", ((0.0, 0.0), (0.1, 0.0))),), seconds=1.0)
    flight = wf.fly(start, hold, inflow="time-marching", integrator="fixed")
    check_physical(flight)
    rates = np.degrees([flight.data[name].values for name in "pqr"])
    assert abs(rates).max() < 8.0
    load_factor = -flight.data.force_z.values / start.condition.weight
    assert load_factor.min() > 0.8 and load_factor.max() < 1.2


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_random_stick_motion_gives_physical_samples_or_a_named_stop(seed):
    start = level(100)
    random = np.random.default_rng(seed)
    times = (0.0, 0.1, 0.5, 0.9, 1.4)
    sticks = {"lateral": 1.0, "longitudinal": 1.0, "collective": 0.7, "pedal": 0.5}
    corners = tuple(
        (name, tuple((t, 0.0 if t < 0.2 else float(random.uniform(-a, a))) for t in times))
        for name, a in sticks.items()
    )
    try:
        flight = wf.fly(start, wf.Maneuver("random", corners, seconds=1.5), integrator="fixed")
    except wf.NumericalFailure as stop:
        assert "t = " in str(stop) or "azimuth" in str(stop)
        flight = stop.partial
    check_physical(flight)


def test_the_airframe_feels_the_disk_not_the_blades_azimuths():
    # the mean over four blades' present azimuths swings by a tenth at four per revolution in steady flight
    start = level(80)
    hold = wf.Maneuver("hold", (("lateral", ((0.0, 0.0), (0.1, 0.0))),), revolutions=1.0)
    data = wf.fly(start, hold, inflow="time-marching", integrator="fixed").data
    steps = start.model.steps_per_revolution // start.model.n_blades
    swing = np.ptp(data.inflow_mean.values[: steps + 1])
    assert swing < 0.01 * float(data.inflow_mean.mean())
