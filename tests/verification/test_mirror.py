# SPDX-License-Identifier: MIT OR Apache-2.0
"""A clockwise helicopter is the mirror image of its counter-clockwise twin: trims and flights are mirrored to the last bit."""

from dataclasses import replace

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.aircraft import core_data
from wakeflight.attitude import quaternion_of
from wakeflight.model import ROLL, YAW
from wakeflight.trim.limits import tail_flow

ODD = {"v", "p", "r", "roll", "bank", "yaw", "east", "force_y", "moment_x", "moment_z"}
"""Variables that change their sign in the mirror; blades, sticks and inflow count in the rotor's own sense."""
COARSE = {"azimuth_step": "15 deg", "turns": 2}


def mirrored(name, values):
    """Values of a variable seen in the mirror; vectors along the last axis."""
    if name in ODD:
        return -values
    if name in ("hub_force", "wake", "wake_sheet"):
        return values * np.array([1.0, -1.0, 1.0])
    if name == "hub_moment":
        return values * np.array([-1.0, 1.0, -1.0])
    return values


def same(twin, image, ignored=()):
    """Names of numeric variables of which the image is not exactly the mirrored twin."""
    names = [name for name in twin.data_vars if twin[name].dtype.kind == "f" and name not in ignored]
    return [
        name
        for name in names
        if not np.array_equal(mirrored(name, twin[name].values), image[name].values, equal_nan=True)
    ]


@pytest.fixture(scope="module")
def twins():
    aircraft = wf.load_aircraft("uh60a")
    return aircraft, aircraft.mirrored()


@pytest.fixture
def same_stops(monkeypatch):
    """Sticks of the image that count from the same stop as those of the twin: without that, the last bit of pitch is another."""
    monkeypatch.setattr(core_data, "other_stops", lambda rigging, travel: rigging)


@pytest.mark.parametrize("inflow", ["dynamic", "time-marching"])
def test_the_mirrored_helicopter_flies_the_mirrored_maneuver_to_the_bit(twins, inflow, same_stops):
    models = {
        "dynamic": (wf.DynamicInflow(),) * 2,
        "time-marching": (wf.RelaxationWake(**COARSE), wf.TimeMarchingWake(**COARSE)),
    }
    trimming, flying = models[inflow]
    twin, image = (wf.trim(each, inflow=trimming) for each in twins)
    turned = twin.x * np.where(np.isin(np.arange(twin.x.size), [ROLL, YAW]), -1.0, 1.0)
    # angles are brought within half a turn, which rounds
    assert np.abs(turned - image.x).max() < 1e-12
    starts = (twin, replace(image, x=turned, inflow_map=twin.inflow_map, circulation=twin.circulation, wake=twin.wake))
    # the roll reversal goes right and then left; here the lateral stick of the mirror counts from the other stop
    flights = [
        wf.fly(each, wf.roll_reversal(), inflow=flying, revolutions=3, integrator="fixed").data for each in starts
    ]
    assert np.abs(flights[0]["roll"].values).max() > np.radians(0.1)
    assert same(*flights) == []


def test_flight_in_a_side_wind_is_mirrored_with_what_is_watched_of_it(twins):
    twin, image = (
        wf.trim(aircraft, wf.FlightCondition(speed="60 kt", sideslip=sideslip), inflow="dynamic")
        for aircraft, sideslip in zip(twins, ("12 deg", "-12 deg"), strict=True)
    )
    assert abs(twin.roll) > np.radians(1.0)
    assert (image.roll, image.yaw) == pytest.approx((-twin.roll, -twin.yaw), abs=1e-9)
    travel = [twin.aircraft.stick_travel_in[k] * 0.0254 for k in (0, 3)]
    assert image.stick_si[[1, 2]] == pytest.approx(twin.stick_si[[1, 2]], abs=1e-9)
    assert image.stick_si[[0, 3]] == pytest.approx(travel - twin.stick_si[[0, 3]], abs=1e-9)
    flows = [tail_flow(each.model, each.problem, each.x) for each in (twin, image)]
    assert flows[1] == pytest.approx(flows[0], abs=1e-9)
    # the engine turns either rotor
    shafts = [-each.model.hand * each.mean_outputs()["hub_moment"][2] for each in (twin, image)]
    assert shafts[0] > 0.0
    assert shafts[1] == pytest.approx(shafts[0], rel=1e-9)


def test_the_mirror_image_of_the_mirror_image_is_the_aircraft(twins):
    aircraft, image = twins
    assert image.mirrored().core_data() == aircraft.core_data()
    assert image.core_data()["rotor"]["rotation"] == "cw"


def rolled(aircraft, side, *, inches, **options):
    """A second from trim, to the right (side 1) or to the left."""
    start = wf.trim(aircraft, inflow="dynamic")
    return wf.fly(
        start, wf.step("lateral", f"{side * inches} in", at="0.1 s", seconds="1 s"), integrator="fixed", **options
    ).data


@pytest.mark.parametrize("augmented", [False, True])
def test_right_is_right_for_a_clockwise_helicopter(twins, augmented):
    blocks = [
        wf.RateDamping(roll="2 in/(rad/s)", yaw="3 in/(rad/s)"),
        wf.AttitudeHold(roll="2 in/rad", heading="2 in/rad"),
        wf.TurnCoordination(sideslip="1 in/rad", yaw_rate="1 in/(rad/s)"),
    ]
    options = {"control": blocks, "actuators": "generic"} if augmented else {}
    twin, image = (
        rolled(aircraft.with_rigid_blades(), side, inches=0.3, **options)
        for aircraft, side in zip(twins, (1, -1), strict=True)
    )
    assert twin.p.max() > 0.02 and image.p.min() < -0.02
    for name in ("p", "q", "r", "roll", "yaw", "pitch", "w"):
        one, other = mirrored(name, twin[name].values), image[name].values
        assert np.abs(one - other).max() < 1e-6 * np.abs(one).max(), name


@pytest.mark.parametrize("kind", ["gust", "slanting gust", "field"])
def test_a_wind_that_differs_from_place_to_place_is_mirrored(twins, kind):
    def field(side):
        def blows(points, time):
            x, y, _ = points.T
            return np.stack([0.05 * side * y, side * 0.05 * x + 0.1 * y, 0.1 * side * y], axis=1)

        return blows

    def wind(side):
        if kind == "field":
            return field(side)
        toward = 0 if kind == "gust" else 30 * side
        return wf.Gust(
            amplitude="5 m/s", length="30 m", ahead="2 m", toward=f"{toward} deg", direction=f"{90 * side} deg"
        )

    twin, image = (
        rolled(aircraft.with_rigid_blades(), side, inches=0.3, wind=wind(side))
        for aircraft, side in zip(twins, (1, -1), strict=True)
    )
    for name in ("p", "q", "r", "v", "w"):
        one, other = mirrored(name, twin[name].values), image[name].values
        assert np.abs(one - other).max() < 1e-9 * np.abs(one).max(), name


def test_a_clockwise_helicopter_follows_a_bank_to_the_right(twins):
    start = wf.trim(twins[1].with_rigid_blades(), wf.FlightCondition(speed="60 kt"), inflow="dynamic")
    path = wf.follow(bank=[("0 s", "0 deg"), ("1.5 s", "15 deg")])
    flight = wf.fly(start, wf.Maneuver("bank", {}, seconds=2.0), control=path, integrator="fixed")
    assert np.degrees(flight.data["roll"].values[-1]) == pytest.approx(15.0, abs=3.0)


def test_a_clockwise_helicopter_has_the_handling_qualities_of_its_twin(twins):
    one, other = (
        wf.handling_qualities(wf.linearize(wf.trim(aircraft.with_rigid_blades(), inflow="dynamic"))).table()
        for aircraft in twins
    )
    bandwidth = [[line.split() for line in table.splitlines() if ".bandwidth " in line] for table in (one, other)]
    assert bandwidth[0] == bandwidth[1] and len(bandwidth[0]) == 3


def test_a_clockwise_rotor_on_the_stand_is_its_twin():
    # axes of the stand point to the advancing side
    aircraft = wf.load_aircraft("uh60a")
    one, other = (wf.tunnel(each, "8 deg", speed="80 kt", inflow="dynamic") for each in (aircraft, aircraft.mirrored()))
    assert (one.ct, one.cq, one.beta_1s) == (other.ct, other.cq, other.beta_1s)


def test_a_mirrored_aircraft_touches_the_ground_with_its_mirrored_places(twins):
    aside, heights = {"stabilator.position": ["700 in", "40 in", "230 in"]}, {}
    for aircraft, side in zip(twins, (1.0, -1.0), strict=True):
        varied = aircraft.with_rigid_blades().with_(aside)
        start = wf.trim(varied, wf.FlightCondition(speed="0 kt", height="30 ft"), inflow="dynamic")
        y = start.state(0.0)
        for bank in (0.6, -0.6):
            y[6:10] = quaternion_of(side * bank, 0.1, 0.0)
            heights.setdefault(bank, []).append(start.model.core.least_height(y))
    assert all(one == pytest.approx(other, abs=1e-9) for one, other in heights.values())
    # banked to its side it is lower
    assert heights[0.6][0] < heights[-0.6][0] - 0.1
