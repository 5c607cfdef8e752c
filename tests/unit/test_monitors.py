# SPDX-License-Identifier: MIT OR Apache-2.0
"""The monitors: what they call beyond a limit is beyond it, what they call no answer no rotor gives, the rest passes."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.limits import StallAngles
from wakeflight.monitors import Bounds, Places, airframe, failures, rotor, warnings

OMEGA, RADIUS, SOUND = 27.0, 8.0, 340.0
STATION = np.linspace(0.15, 1.0, 18)
PSI = 2 * np.pi * np.arange(36) / 36
MAP = Places(STATION, PSI)
TRAVEL = (10.0, 10.0, 10.0, 5.4)


def blades(core=0.02, lift_max=1.4, twist=0.0, chord=0.065):
    """Four untwisted blades of constant chord."""
    return Bounds(
        4,
        OMEGA,
        RADIUS,
        SOUND,
        STATION,
        np.full(18, chord),
        np.full(18, twist),
        lift_max,
        core,
    )


# --- bounds ------------------------------------------------------------------------------------------------------


def test_the_ring_of_largest_lift_is_that_of_momentum_theory_in_hover():
    # blade element against annular momentum, dT = 4 pi rho v^2 r dr, written out in SI for the outermost ring
    rho, lift, chord = 1.2, 1.4, 0.065 * RADIUS
    per_metre = 4 * 0.5 * rho * (OMEGA * RADIUS) ** 2 * chord * lift
    v = np.sqrt(per_metre / (4 * np.pi * rho * RADIUS))
    assert blades().ring(0.0) == pytest.approx(v / (OMEGA * RADIUS), rel=1e-12)
    # the same in the field's words: sqrt(sigma cl/8) at the tip
    sigma = 4 * 0.065 / np.pi
    assert blades().ring(0.0) == pytest.approx(np.sqrt(sigma * lift / 8), rel=1e-12)


def test_the_vortex_of_largest_lift_is_the_peak_of_a_long_vortex_with_the_wakes_core():
    # 1/2 U c cl at the tip in hover; largest velocity of a straight vortex, asked of the program's own segments
    gamma, core = 0.5 * OMEGA * RADIUS * 0.065 * RADIUS * 1.4, 0.02 * RADIUS
    filament = np.array([[-1e4, 0.0, 0.0], [1e4, 0.0, 0.0]])
    distance = core * np.linspace(0.5, 1.5, 201)
    points = np.stack([np.zeros(201), distance, np.zeros(201)], axis=1)
    speed = np.linalg.norm(wf.induced_velocity(points, [filament], [gamma], [core]), axis=1)
    assert distance[np.argmax(speed)] == pytest.approx(core, rel=0.01)
    assert blades(core=0.02).vortex(0.0) == pytest.approx(speed.max() / (OMEGA * RADIUS), rel=1e-6)


def test_a_section_is_not_turned_past_its_zero_lift_by_its_own_near_wake():
    # a blade at 20 deg in hover: velocity across the zero-lift line at the tip is sin(20 deg), the margin of angle on top
    across = blades().section([0.0, 0.0, 0.0], [np.radians(20.0), 0.0, 0.0])
    assert np.sin(np.radians(20.0)) < across < np.radians(20.0) + 0.1 + 1e-12
    # advancing blade of a rotor in forward flight (hub axes: x aft): pitch counts where the blade is fast
    forward = [-0.3, 0.0, 0.0]
    fast, slow = (blades().section(forward, [0.0, 0.0, sign * 0.2]) for sign in (1.0, 0.0))
    assert fast == pytest.approx(1.3 * 0.3, rel=1e-9) and slow == pytest.approx(1.3 * 0.1, rel=1e-9)


def test_bounds_of_a_history_are_those_of_its_instants():
    velocity = np.array([[0.0, 0.0, 0.0], [-0.2, 0.05, 0.03], [-0.4, 0.0, -0.1]])
    theta = np.array([[0.2, 0.0, 0.0], [0.25, 0.03, -0.1], [0.4, 0.0, -0.2]])
    usual, bound = blades(twist=-0.1).inflow(velocity, theta)
    for k in range(3):
        assert blades(twist=-0.1).inflow(velocity[k], theta[k]) == pytest.approx((usual[k], bound[k]), rel=1e-12)
    assert np.all(usual <= bound) and np.all(bound >= blades().least_inflow)


@pytest.mark.parametrize("name", ["baseline_dynamic", "baseline_relaxation", "baseline_marching"])
def test_an_ordinary_trim_is_well_within_what_motion_can_give(name, request):
    data = request.getfixturevalue(name).to_dataset()
    assert float(data.inflow_max) < 0.5 * float(data.inflow_bound)
    # the advancing tip is as fast as motion makes it: the margin above it is what velocities across the disk may add
    assert 1 / 1.1 - 0.02 < float(data.mach_max) / float(data.mach_bound) < 1 / 1.1 + 0.02
    assert np.array_equal(data.inflow_max, np.abs(data.inflow).max())
    assert np.array_equal(data.mach_max, data.mach.max())


# --- fields ------------------------------------------------------------------------------------------------------


def test_an_induced_velocity_that_nothing_gives_is_a_failure_with_its_place():
    inflow = np.full((36, 18), 0.05)
    usual, bound = blades().inflow([-0.2, 0.0, 0.0], [0.2, 0.0, -0.1])
    assert not failures([rotor.induced_velocity(inflow, usual, bound, MAP)])
    assert not warnings([rotor.induced_velocity(inflow, usual, bound, MAP)])
    inflow[27, 0] = -0.98
    found = rotor.induced_velocity(inflow, usual, bound, MAP)
    assert "0.98 of the tip speed at psi = 270 deg, r/R = 0.150" in found.failure
    assert f"{bound:.3g}" in found.failure and found.warning is None
    # between what one cause gives and what all give together: told, no failure
    inflow[27, 0] = 0.5 * (usual + bound)
    found = rotor.induced_velocity(inflow, usual, bound, MAP)
    assert found.failure is None and "alone can give" in found.warning


def test_a_history_says_when_and_on_which_blade():
    places = Places(STATION, np.broadcast_to(PSI[[0, 9, 18, 27]], (5, 4)), 0.1 * np.arange(5))
    inflow = np.full((5, 4, 18), 0.05)
    inflow[3, 1, 17] = 5.0
    found = rotor.induced_velocity(inflow, 0.3, 0.5, places)
    assert "t = 0.300 s, blade 2 at psi = 90 deg, r/R = 1.000" in found.failure
    assert found.values["inflow_max"] == pytest.approx([0.05, 0.05, 0.05, 5.0, 0.05])


def test_mach_beyond_the_tables_is_told_and_beyond_the_motion_is_a_failure():
    bound = blades().mach(40.0)
    assert bound == pytest.approx(np.hypot(1.0, 0.45) * (OMEGA * RADIUS + 40.0) / SOUND)
    assert bound == pytest.approx(blades().least_mach(40.0, 0.0))
    mach = np.outer(1 + 0.2 * np.sin(PSI), STATION) * OMEGA * RADIUS / SOUND
    assert rotor.mach_number(mach, bound, 1.0, MAP).warning is None
    found = rotor.mach_number(mach, bound, 0.7, MAP)
    assert found.failure is None and "beyond the 0.7 of the section tables (held there), at psi = 90" in found.warning
    assert "at most" in rotor.mach_number(1.6 * mach, bound, 1.0, MAP).failure


def test_stall_is_counted_by_area_where_it_matters():
    weights = STATION / STATION.sum()
    angles = StallAngles(np.array([0.0, 1.0]), np.array([0.2, 0.2]), np.array([-0.1, -0.1]))
    tip_mach = OMEGA * RADIUS / SOUND
    mach, alpha = np.tile(STATION * tip_mach, (36, 1)), np.full((36, 18), 0.05)

    def stall(alpha):
        return rotor.stall(angles, alpha, mach, weights, tip_mach, MAP)

    assert stall(alpha).values["stalled_share"] == 0.0 and stall(alpha).warning is None
    # a quarter of the disk at 15 deg
    beyond = alpha.copy()
    beyond[18:27] = 0.26
    fast = weights[STATION >= rotor.SLOW].sum()
    assert stall(beyond).values["stalled_share"] == pytest.approx(0.25 * fast)
    assert "% of the disk beyond stall" in stall(beyond).warning and "negative" not in stall(beyond).warning
    assert "at negative angles" in stall(-beyond).warning
    # the root, too slow to matter, and reversed flow, where the nose of the section is its tail
    root = alpha.copy()
    root[:, :2] = 0.5
    assert stall(root).values["stalled_share"] == 0.0
    reverse = alpha.copy()
    reverse[27, :6] = np.pi - 0.3
    assert stall(reverse).values["stalled_share"] == 0.0
    assert stall(reverse).values["reversed_share"] == pytest.approx(weights[:6].sum() / 36)


def test_a_history_is_averaged_over_a_passage_of_the_blades():
    # over the last nine values, or as many as there are
    values = np.arange(20.0)
    mean = rotor.over_passage(values, 9)
    assert mean[0] == 0.0 and mean[3] == np.mean(values[:4]) and mean[-1] == np.mean(values[-9:])


# --- pitch and axial flow ----------------------------------------------------------------------------------------


def test_pitch_beyond_sixty_degrees_from_the_flow_is_no_answer():
    assert rotor.pitch({"collective": 0.3, "cyclic": 0.3}, 0.0, "").failure is None
    found = rotor.pitch({"cyclic": np.radians(902.0)}, 0.0, "mu = 1.42")
    assert "cyclic pitch of 902 deg, beyond 60 deg" in found.failure and "mu = 1.42" in found.failure
    # a propeller in a fast climb has its pitch about the angle of the flow
    assert rotor.pitch({"collective": np.radians(70.0)}, np.radians(62.0), "").failure is None
    assert rotor.pitch({}, 0.0, "").text == "given"


@pytest.mark.parametrize(
    ("descent", "across", "ct", "told"),
    [
        (0.3, 0.0, 0.005, False),
        (0.9, 0.0, 0.005, True),
        (-0.9, 0.0, 0.005, False),
        (0.9, 1.5, 0.005, False),
        (2.4, 0.0, 0.005, False),
        # thrust down: air from above is then what a descent is otherwise
        (-0.9, 0.0, -0.005, True),
        (0.0, 0.0, 0.0, False),
    ],
)
def test_descent_in_the_vortex_ring_range_is_told(descent, across, ct, told):
    hover = np.sqrt(0.5 * abs(ct))
    by_momentum, by_wake = (rotor.axial_flow(across * hover, descent * hover, ct, each) for each in (True, False))
    assert (by_momentum.warning is not None) == told and (by_wake.warning is not None) == told
    if told:
        assert "scattered tests" in by_momentum.warning and "0.90 times" in by_momentum.warning
        assert "turns kept" in by_wake.warning


# --- airframe ----------------------------------------------------------------------------------------------------


def test_each_stick_beyond_a_stop_is_named():
    stick = {"lateral": 5.0, "longitudinal": 0.2, "collective": 11.4, "pedal": -0.57}
    found = airframe.sticks(stick, TRAVEL)
    told = warnings(found)
    assert len(told) == 3
    assert "longitudinal at 0.20 in, 2.0 % of its travel from its stop at 0 in" in told
    assert "collective at 11.40 in, beyond its stop at 10 in" in told
    assert "pedal at -0.57 in, beyond its stop at 0 in" in told
    assert found[0].values["stick_margin"] == pytest.approx(-1.4)
    assert not warnings(airframe.sticks(dict.fromkeys(stick, 2.7), TRAVEL))


def test_a_stick_that_moves_beyond_its_stop_is_told_with_its_time():
    time = np.linspace(0.0, 1.0, 11)
    stick = {
        "lateral": 5.0 + 6.0 * time,
        "longitudinal": 5 + 0 * time,
        "collective": 5 + 0 * time,
        "pedal": 2 + 0 * time,
    }
    (told,) = warnings(airframe.sticks(stick, TRAVEL, time))
    assert told == "lateral at 11.00 in, beyond its stop at 10 in, from t = 0.90 s"


def test_a_tail_rotor_beyond_its_thrust_is_told():
    assert airframe.tail_rotor(None, 0.15).text == "none"
    assert airframe.tail_rotor(0.1, 0.15).warning is None
    assert "tail rotor at C_T/sigma -0.210" in airframe.tail_rotor(-0.21, 0.15).warning


def test_power_is_held_against_a_limit_only_where_one_is_stated():
    assert airframe.power(2.5e6, None).warning is None
    assert airframe.power(2.0e6, 2.1e6).warning is None
    assert airframe.power(2.5e6, 2.1e6).warning == "power 2500 kW, beyond the aircraft's 2100 kW"


def test_the_ground_is_sea_level_or_where_a_flight_starts_on_it():
    time = np.linspace(0.0, 2.0, 21)
    # 30 m lost from 10 m: through the ground in the middle of the first second
    found = airframe.ground(15.0 * time, 10.0, time)
    assert found.warning.startswith("the aircraft sinks 20.0 m below sea level, from t = 0.80 s")
    assert found.values["height"][[0, -1]] == pytest.approx([10.0, -20.0])
    assert airframe.ground(15.0 * time, 1600.0, time).warning is None
    # from an altitude of zero, which stands for the air as well as for a place: a metre is nothing, ten are
    assert airframe.ground(0.4 * time, 0.0, time).warning is None
    assert "where it started" in airframe.ground(5.0 * time, 0.0, time).warning
    # a start below sea level is not below the ground
    assert airframe.ground(0.0 * time, -300.0, time).values["height"][0] == pytest.approx(0.0)


def test_only_what_a_trim_found_is_called_extreme():
    assert airframe.attitude(0.1, 0.2, False).warning is None
    assert "roll 40.1 deg" in airframe.attitude(0.7, 0.2, False).warning
    assert airframe.attitude(0.7, 0.2, True).warning is None
    slipping = [40.0, 23.1]
    assert "sideslip of 30.0 deg found" in airframe.sideslip(slipping, False).warning
    assert airframe.sideslip(slipping, True).warning is None
    assert airframe.sideslip([0.0, 0.0], False).values["sideslip"] == 0.0
