# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim over the envelope: vertical, rearward, sideward, turning; continuous where physics is, refused in words where it ends."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.model import Model
from wakeflight.trim.equations import residual_norms, trim_problem
from wakeflight.trim.newton import Work, newton
from wakeflight.trim.solve import solve_condition
from wakeflight.trim.start import first_guess
from wakeflight.trim.table import HORSEPOWER

WEIGHTS = {"uh60a": "16000 lbf", "bo105": "5000 lbf"}
AIRCRAFT = {name: wf.load_aircraft(name) for name in WEIGHTS}


def trimmed(name="uh60a", inflow="dynamic", **given):
    condition = {"altitude": "0 ft", "flight_path": "0 deg", "weight": WEIGHTS[name], **given}
    return wf.trim(AIRCRAFT[name], wf.FlightCondition(**condition), inflow=inflow)


def power(start):
    return start.mean_outputs()["power"] / HORSEPOWER


def state(start):
    """Sticks [in], attitude [deg], power [hp]."""
    attitude = np.degrees([start.roll, start.pitch, start.yaw])
    return np.array([*start.stick.values(), *attitude, power(start)])


@pytest.mark.parametrize("name", WEIGHTS)
@pytest.mark.parametrize(
    ("speed", "path"),
    [("1 m/s", "90 deg"), ("10 m/s", "90 deg"), ("5 m/s", "89 deg"), ("2 m/s", "-90 deg"), ("4 m/s", "-86 deg")],
)
def test_vertical_and_steep_flight_is_trimmed_at_the_heading_given(name, speed, path):
    start = trimmed(name, speed=speed, flight_path=path)
    residuals = start.residuals
    assert (residuals["linear"], residuals["angular"]) < (1e-4, 1e-4)
    assert residuals["harmonics"] < 1e-6
    assert start.yaw == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", WEIGHTS)
def test_a_vertical_climb_costs_between_half_and_all_of_the_rise_of_the_weight(name):
    # momentum theory: dP = W V/2 to first order, W V where the climb is much faster than the induced velocity
    hover, speed = trimmed(name, speed="0 kt"), 5.0
    more = power(trimmed(name, speed=f"{speed} m/s", flight_path="90 deg")) - power(hover)
    assert 0.5 < more * HORSEPOWER / (hover.condition.weight * speed) < 1.0


@pytest.mark.parametrize("name", WEIGHTS)
def test_hover_does_not_depend_on_the_heading(name):
    north = state(trimmed(name, speed="0 kt"))
    for sideslip in (90.0, 180.0, -90.0):
        turned = state(trimmed(name, speed="0 kt", sideslip=f"{sideslip} deg"))
        assert np.abs(np.remainder(turned[6] + sideslip + 180.0, 360.0) - 180.0) < 1e-6
        assert np.delete(turned, 6) == pytest.approx(np.delete(north, 6), abs=1e-5)


@pytest.mark.parametrize("name", WEIGHTS)
def test_slow_flight_is_continuous_with_hover_from_every_side(name):
    # controls and power are smooth functions of the velocity: at 0.05 m/s an eighth of what 0.4 m/s does, or less
    hover = np.delete(state(trimmed(name, speed="0 kt")), 6)
    for sideslip in (0, 90, 180, -90):
        near, far = (
            np.abs(np.delete(state(trimmed(name, speed=speed, sideslip=f"{sideslip} deg")), 6) - hover)
            for speed in ("0.05 m/s", "0.4 m/s")
        )
        # a ten-thousandth of the power: its first and second order may cancel at 0.4 m/s
        slack = np.append(np.full(near.size - 1, 0.01), 1e-4 * hover[-1])
        assert np.all(near < 0.25 * far + slack)


@pytest.mark.parametrize("name", WEIGHTS)
@pytest.mark.parametrize("speed", ["10 kt", "30 kt"])
def test_rearward_flight_passes_through_180_degrees_without_a_step(name, speed):
    one_side, middle, other_side = (state(trimmed(name, speed=speed, sideslip=f"{s} deg")) for s in (179, 180, -179))
    across = np.abs(one_side - other_side)
    across[6] = 360.0 - across[6]
    # two degrees of wind: hundredths of an inch, a few horsepower, two degrees of heading
    assert np.all(across < [0.08, 0.08, 0.03, 0.05, 0.3, 0.1, 2.2, 3.0])
    assert np.all(np.array([one_side[6], middle[6], other_side[6]]) > -180.0)
    assert middle[:6] == pytest.approx(0.5 * (one_side + other_side)[:6], abs=0.02)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_path_can_be_as_steep_as_one_likes(sign):
    # from 80 to 90 degrees climb speed changes by 1.5 %: power, controls and attitude follow without a step
    paths = [80.0, 84.0, 85.0, 85.1, 88.0, 89.9, 90.0]
    states = np.array([state(trimmed(speed="6 m/s", flight_path=f"{sign * path} deg")) for path in paths])
    steps = np.abs(np.diff(states, axis=0)) / np.diff(paths)[:, None]
    # an inch, a degree, a horsepower for each degree of path at most
    assert np.all(steps < [0.05, 0.05, 0.05, 0.05, 0.1, 0.2, 0.1, 5.0])


def test_the_lateral_convention_passes_from_zero_sideslip_to_zero_bank_without_a_step():
    assert trimmed(speed="50 kt").roll < np.radians(-1.0)
    before, after = (state(trimmed(speed=speed)) for speed in ("59.9 kt", "60.1 kt"))
    assert before == pytest.approx(after, abs=0.7)
    assert after[4] == pytest.approx(0.0, abs=1e-6)
    assert abs(before[4]) < 0.02
    one, other = (trimmed(speed="55 kt", heading=heading) for heading in ("free", "aligned"))
    assert one.roll == pytest.approx(0.0, abs=1e-9)
    assert other.roll < trimmed(speed="55 kt").roll < one.roll
    # and with turns: a slow one is nearly straight flight
    straight, turning = (trimmed(speed="80 kt", turn_rate=rate) for rate in ("0 deg/s", "0.01 deg/s"))
    assert abs(straight.roll - turning.roll) < np.radians(0.1)


@pytest.mark.parametrize(("speed", "bank"), [("60 kt", 30.0), ("100 kt", -45.0)])
def test_a_turn_with_bank_and_rate_carries_its_load_factor(speed, bank):
    rate = np.degrees(9.80665 * np.tan(np.radians(bank)) / wf.FlightCondition(speed=speed).speed)
    start = trimmed(speed=speed, bank=f"{bank} deg", turn_rate=f"{rate} deg/s")
    assert np.degrees(start.roll) == pytest.approx(bank, abs=1e-6)
    # thrust: of weight over cos(bank), and what fuselage and tail push down; a pitched hub takes some of it
    mean, level = start.mean_outputs(), trimmed(speed=speed).mean_outputs()
    assert mean["ct"] / level["ct"] == pytest.approx(1.0 / np.cos(np.radians(bank)), rel=0.05)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (
            {"speed": "300 kt"},
            r"main rotor: \d+ % of the disk beyond stall at C_T/sigma 0\.0\d+;.* speeds end at \d+ kt of 300 kt",
        ),
        ({"speed": "300 kt"}, r"collective needs 1\d\.\d of 10 in"),
        ({"speed": "0 kt", "weight": "40000 lbf"}, r"main rotor: .*; tail rotor: .* weights end at 3\d{4} of 40000 lb"),
        (
            {"speed": "140 kt", "turn_rate": "13.5 deg/s"},
            r"beyond stall .* turns end at \d+ deg of bank, load factor 1\.\d",
        ),
        ({"speed": "20 kt", "bank": "20 deg"}, r"sideslip holds no bank beyond -?\d+\.\d of 20\.0 deg"),
    ],
)
def test_what_cannot_be_flown_ends_with_what_limits(given, words):
    with pytest.raises(wf.NumericalFailure, match=words):
        trimmed(**given)


def test_power_falls_through_the_vortex_ring_range_to_that_of_a_windmill():
    # one branch from hover on: powered, ideal autorotation near 1.7 v_h, braked beyond; the inflow between peaks as tests have it
    rates = (0.0, 5.0, 10.0, 15.0, 20.0, 24.0, 28.0)
    starts = [trimmed(speed=f"{rate} m/s", flight_path="-90 deg" if rate else "0 deg") for rate in rates]
    outputs = [start.mean_outputs() for start in starts]
    power, ct, inflow = (np.array([each[name] for each in outputs]) for name in ("power_main", "ct", "inflow_mean"))
    through = np.array(rates) / starts[0].model.tip_speed / np.sqrt(0.5 * ct)
    assert np.all(np.diff(power[1:]) < 0.0) and power[-1] < 0.0 < power[3]
    peak = np.argmax(inflow / np.sqrt(0.5 * ct))
    assert 1.2 < through[peak] < 1.7 and 1.9 < (inflow / np.sqrt(0.5 * ct))[peak] < 2.3


def test_a_heading_that_nothing_fixes_is_refused_as_input():
    with pytest.raises(wf.InputError, match="no heading changes the side force"):
        trimmed(speed="0 kt", bank="0 deg")


@pytest.mark.parametrize("given", [{"speed": "80 kt"}, {"speed": "20 kt", "sideslip": "135 deg"}])
def test_the_derivatives_of_the_trim_equations_are_those_of_their_residual(given):
    start = trimmed(**given)
    core, problem, x = start.model.core, start.problem, start.x
    jacobian = core.trim_jacobian(problem, x)
    h = 1e-7
    for k, column in enumerate(jacobian.T):
        step = h * np.eye(x.size)[k]
        slope = (core.trim_residual(problem, x + step) - core.trim_residual(problem, x - step)) / (2 * h)
        # rounding of differences, and a kink of a table may lie within the step
        assert slope == pytest.approx(column, abs=2e-4 * np.abs(column).max())


def test_other_starts_lead_to_the_same_trim():
    condition = wf.FlightCondition(speed="60 kt", flight_path="0 deg").completed(AIRCRAFT["uh60a"])
    model = Model.build(AIRCRAFT["uh60a"], condition, wf.DynamicInflow())
    problem, x = solve_condition(model)
    rng = np.random.default_rng(5)
    for _ in range(5):
        start = first_guess(model, problem)
        start[:4] += rng.uniform(-0.04, 0.04, 4)
        start[4:6] += rng.uniform(-0.15, 0.15, 2)
        other = newton(model, trim_problem(model, None), start, Work(60))
        assert other.met
        assert other.x == pytest.approx(x, abs=1e-7)
    assert residual_norms(model, problem, x)["linear"] < 1e-8


def test_wakes_that_circle_or_vary_are_trimmed_on_their_mean_and_say_so():
    # rearward flight at the speeds where the wake rolls up beside the rotor; balances are met on the mean
    coarse = {"trailers": "tip", "azimuth_step": "15 deg", "turns": 3}
    for wake, speed, words in (
        (wf.TimeMarchingWake(**coarse), "20 kt", "varies from turn to turn"),
        (wf.RelaxationWake(**coarse), "35 kt", "circles about its answer"),
    ):
        start = trimmed(inflow=wake, speed=speed, sideslip="180 deg")
        assert start.residuals["linear"] < 1e-4
        assert any(words in each for each in start.warnings)
        # not far from momentum theory, and from one another
        assert power(start) == pytest.approx(power(trimmed(speed=speed, sideslip="180 deg")), rel=0.15)


def test_a_wake_that_does_not_rest_is_refused_with_what_moves():
    wake = wf.RelaxationWake(azimuth_step="15 deg", turns=3, inflow_tolerance=1e-7, max_loops=12)
    with pytest.raises(
        wf.NumericalFailure, match=r"did not settle in \d+ passes, \d+ sweeps: inflow changes by"
    ) as caught:
        trimmed(inflow=wake, speed="35 kt", sideslip="180 deg")
    assert "(allowed " in str(caught.value)
