# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim to a power, a collective, a load factor: autorotation, climbs, turns, each seen in an independent way."""

import numpy as np
import pytest
from test_balances import trimmed_revolution

import wakeflight as wf
from wakeflight import _core
from wakeflight.trim.table import HORSEPOWER
from wakeflight.units import STANDARD_GRAVITY

AIRCRAFT = {name: wf.load_aircraft(name) for name in ("uh60a", "bo105")}
WEIGHTS = {"uh60a": "16000 lbf", "bo105": "5000 lbf"}
FOOT_PER_MINUTE = 0.00508


def condition(name="uh60a", **given):
    given = {"speed": "80 kt", "altitude": "0 ft", "flight_path": "0 deg", "weight": WEIGHTS[name], **given}
    return wf.FlightCondition(**given)


def trimmed(name="uh60a", inflow="dynamic", asked=None, **given):
    return wf.trim(AIRCRAFT[name], condition(name, **given), inflow=inflow, **(asked or {}))


def without_blades(start):
    """Share of the gross mass that is not the blades'."""
    rotor = start.model.rotor
    return 1.0 - rotor["n_blades"] * rotor["blade_mass"] / start.condition.gross_mass


def averaged(start, quantity):
    return np.mean([out[quantity] for _, out in start.instants()], axis=0)


@pytest.mark.parametrize("inflow", ["dynamic", "relaxation", "time-marching"])
@pytest.mark.parametrize("name", AIRCRAFT)
def test_in_autorotation_the_air_drives_main_rotor_tail_rotor_and_accessories(name, inflow):
    start = trimmed(name, inflow, {"power": "0 hp"})
    mean = start.mean_outputs()
    accessories = start.model.accessory_power
    assert mean["power_main"] == pytest.approx(-(mean["power_tail"] + accessories), abs=1.0)
    assert mean["power_main"] < 0.0
    # what gravity gives the airframe without its blades is what the loads on it take
    weight = start.condition.weight
    given = without_blades(start) * weight * start.rate_of_descent
    assert averaged(start, "load_power") == pytest.approx(-given, rel=1e-6)
    # about the power of level flight: less of the tail rotor, more of what meets the air from below
    level = trimmed(name, "dynamic").mean_outputs()["power"]
    assert weight * start.rate_of_descent == pytest.approx(level, rel=0.35)


@pytest.mark.parametrize("inflow", ["dynamic", "relaxation"])
def test_the_shaft_of_an_autorotating_rotor_takes_what_the_air_gives_the_blades(inflow):
    # torque never enters the equations of the blades: energy of motion, air, dampers and structure, counted by particles
    start = trimmed("uh60a", inflow, {"power": "0 hp"})
    energy = np.mean([balance.shaft(np.zeros(3)) for _, balance in trimmed_revolution(start)])
    assert energy == pytest.approx(start.mean_outputs()["power_main"], rel=1e-4)


def test_the_uh60a_descends_at_80_knots_without_engines_at_some_2500_feet_a_minute():
    # the models agree within six per cent, and the least descent lies at 65 to 75 kt
    rates = [trimmed(inflow=each, asked={"power": "0 hp"}).rate_of_descent for each in ("dynamic", "relaxation")]
    assert np.array(rates) / FOOT_PER_MINUTE == pytest.approx(2600.0, rel=0.05)
    by_speed = [trimmed(speed=f"{v} kt", asked={"power": "0 hp"}).rate_of_descent for v in (55, 70, 85)]
    assert by_speed[1] < min(by_speed[0], by_speed[2])


@pytest.mark.parametrize("inflow", ["dynamic", "relaxation"])
@pytest.mark.parametrize("name", AIRCRAFT)
def test_the_path_that_was_found_given_back_is_the_same_trim(name, inflow):
    start = trimmed(name, inflow, {"power": "0 hp"})
    back = wf.trim(AIRCRAFT[name], start.condition, inflow=inflow)
    # trims on a free wake know their controls to the tolerance they rest at, 1e-3 rad, and power to a per cent of level flight's
    exact = inflow == "dynamic"
    assert back.mean_outputs()["power"] == pytest.approx(0.0, abs=1.0 if exact else 8e3)
    assert list(back.stick.values()) == pytest.approx(list(start.stick.values()), abs=1e-9 if exact else 0.05)


@pytest.mark.parametrize("inflow", ["dynamic", "relaxation", "time-marching"])
@pytest.mark.parametrize("name", AIRCRAFT)
def test_a_load_factor_is_that_of_the_loads_and_of_the_coordinated_turn(name, inflow):
    turns = [trimmed(name, inflow, load_factor=1.5, turn=side) for side in ("right", "left")]
    for start, side in zip(turns, (1.0, -1.0), strict=True):
        c = start.condition
        assert start.load_factor == pytest.approx(1.5, rel=1e-12)
        assert start.turn_rate * c.speed == pytest.approx(side * STANDARD_GRAVITY * np.sqrt(1.5**2 - 1.0), rel=1e-12)
        # the loads on the airframe, to which the blades hand on their weight and inertia, carry what is left of the weight
        load = np.linalg.norm(averaged(start, "force")) / c.weight
        assert load == pytest.approx(1.5 * without_blades(start), rel=1e-3)
        assert start.rate_of_descent == pytest.approx(0.0, abs=1e-9)
    # 1/cos(bank), but for side forces, which lean the one turn as much as the other
    assert 0.5 * (turns[0].roll - turns[1].roll) == pytest.approx(np.arccos(1 / 1.5), abs=np.radians(0.15))
    assert all(abs(abs(each.roll) - np.arccos(1 / 1.5)) < np.radians(2.5) for each in turns)
    # no sideslip
    assert all(abs(each.state()[1]) < 1e-6 * each.speed for each in turns)


def test_a_load_factor_of_one_is_straight_flight():
    one, straight = trimmed(load_factor=1.0), trimmed(turn_rate="0 deg/s")
    assert one.x[:7] == pytest.approx(straight.x[:7], abs=1e-9)
    assert one.turn_rate == pytest.approx(0.0, abs=1e-12)


def test_power_more_than_that_of_level_flight_is_climb():
    level = trimmed().mean_outputs()["power"]
    for asked in ("1500 hp", "2000 hp", "2500 hp"):
        start = trimmed(asked={"power": asked})
        more = start.mean_outputs()["power"] - level
        assert start.mean_outputs()["power"] / HORSEPOWER == pytest.approx(float(asked[:-3]), rel=1e-9)
        # a rotor climbs with some 85 % of its excess power
        assert 0.75 < -start.rate_of_descent * start.condition.weight / more < 1.0


def test_a_power_in_level_flight_has_a_fast_and_a_slow_speed():
    fast, slow = (trimmed(speed=speed, asked={"power": "1400 hp", "free": "speed"}) for speed in ("120 kt", "30 kt"))
    assert slow.speed < trimmed(speed="70 kt").speed < fast.speed
    for start in (fast, slow):
        assert start.flight_path == 0.0
        assert wf.trim(AIRCRAFT["uh60a"], start.condition, inflow="dynamic").mean_outputs()["power"] == pytest.approx(
            1400 * HORSEPOWER, rel=1e-6
        )


def test_a_collective_given_is_the_one_trimmed_with_and_lower_ones_descend():
    descents = []
    for asked in (16.0, 14.0, 12.0):
        start = trimmed(asked={"collective": f"{asked} deg"})
        assert np.degrees(start.theta_0) == pytest.approx(asked, abs=1e-9)
        descents.append(start.rate_of_descent)
    assert np.all(np.diff(descents) > 0.0)


def test_an_autorotating_turn_has_both_its_power_and_its_load_factor():
    start = trimmed(load_factor=1.3, asked={"power": "0 hp"})
    assert start.mean_outputs()["power"] == pytest.approx(0.0, abs=1.0)
    assert start.load_factor == pytest.approx(1.3, rel=1e-12)
    assert start.rate_of_descent > trimmed(asked={"power": "0 hp"}).rate_of_descent


def test_flight_from_an_autorotation_stays_in_it():
    start = trimmed(asked={"power": "0 hp"})
    still = wf.Maneuver("still", {"lateral": [(0.0, 0.0), (1.0, 0.0)]}, seconds=1.0)
    data = wf.fly(start, still, inflow="dynamic", integrator="fixed").data
    descent = np.gradient(data["down"].values, data["time"].values)
    assert descent == pytest.approx(start.rate_of_descent, rel=1e-3)


@pytest.mark.parametrize(
    ("asked", "given", "words"),
    [
        ({"power": "0"}, {}, "power = '0': must be a number with a unit"),
        ({"power": "nan hp"}, {}, "power"),
        ({"power": "0 kt"}, {}, "power"),
        ({"power": "0 hp", "collective": "8 deg"}, {}, "give either power or collective"),
        ({"power": "0 hp", "free": "roll"}, {}, "free = 'roll': allowed: flight_path, speed"),
        ({"free": "speed"}, {}, "needs a power or a collective"),
        ({"power": "0 hp"}, {"speed": "0 kt"}, "at rest there is no path"),
        ({}, {"load_factor": 0.5}, "load_factor = 0.5: must be a number between 1 and 5"),
        ({}, {"load_factor": "2"}, "load_factor"),
        ({}, {"load_factor": float("nan")}, "load_factor"),
        ({}, {"load_factor": 1.5, "turn_rate": "3 deg/s"}, "trim finds it where a load factor is given"),
        ({}, {"load_factor": 1.5, "turn": "up"}, "turn = 'up': allowed: right, left"),
        ({}, {"turn": "left"}, "belongs to a load factor"),
        ({}, {"load_factor": 1.5, "speed": "0 kt"}, "no turn gives more"),
    ],
)
def test_what_cannot_be_asked_is_refused_with_what_is_allowed(asked, given, words):
    with pytest.raises(wf.InputError, match=words):
        trimmed(asked=asked, **given)


@pytest.mark.parametrize(
    ("asked", "given", "words"),
    [
        (
            {"power": "9000 hp"},
            {},
            r"tail rotor: .* power ends at \d+\.?\d* hp of 9000 hp with 80 kt on a path of \d\d",
        ),
        ({}, {"load_factor": 3.0}, r"beyond stall .* turns end at \d+ deg of bank, load factor 1\.\d"),
        ({"power": "0 hp"}, {"speed": "30 kt"}, r"power ends at \d+\.?\d* hp of 0 hp with 30 kt on a path of -\d\d"),
    ],
)
def test_what_cannot_be_flown_ends_with_what_limits(asked, given, words):
    with pytest.raises(wf.NumericalFailure, match=words):
        trimmed(asked=asked, **given)


def slopes_agree(core, problem, x, step=1e-7):
    jacobian = core.trim_jacobian(problem, x)
    for k, column in enumerate(jacobian.T):
        ahead, behind = x + step * np.eye(x.size)[k], x - step * np.eye(x.size)[k]
        slope = (core.trim_residual(problem, ahead) - core.trim_residual(problem, behind)) / (2 * step)
        # rounding of differences, and a kink of a table may lie within the step
        assert slope == pytest.approx(column, abs=2e-4 * np.abs(column).max())


@pytest.mark.parametrize(
    ("asked", "given"),
    [
        ({"power": "0 hp"}, {"load_factor": 1.3}),
        ({"collective": "18 deg", "free": "speed"}, {"load_factor": 1.2, "turn": "left"}),
        ({"power": "900 hp", "free": "speed"}, {"speed": "55 kt", "flight_path": "-5 deg"}),
    ],
)
def test_derivatives_by_a_free_path_are_those_of_the_residual(asked, given):
    start = trimmed(asked=asked, **given)
    slopes_agree(start.model.core, start.problem, start.x)


PITCH = ("collective", "lateral_cyclic", "longitudinal_cyclic")
STAND_EQUATIONS = (*PITCH, "thrust", "torque", "power", "beta_1c", "beta_1s", "hub_roll", "hub_pitch")


@pytest.mark.parametrize("inflow", ["dynamic", "relaxation"])
def test_derivatives_of_every_equation_of_the_stand_are_those_of_its_residual(inflow):
    stand = wf.tunnel(AIRCRAFT["uh60a"], thrust="70000 N", flapping="zero", speed="80 kt", inflow=inflow)
    model, x = stand.model, stand.x
    held = None if inflow == "dynamic" else stand.solution.inflow_map
    for k in range(0, len(STAND_EQUATIONS), 3):
        chosen = [(STAND_EQUATIONS[i % len(STAND_EQUATIONS)], (0.1,)) for i in range(k, k + 3)]
        mean = 0.0 if held is None else model.disk_mean(held)
        n = 40 if held is None else held.shape[0]
        slopes_agree(model.core, _core.TrimProblem((0, 0, 0), [], chosen, 8, n, held, mean), x)


def test_problems_that_fit_nothing_are_refused():
    start = trimmed()
    core, x = start.model.core, start.x
    balances = [(name, ()) for name in ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")]
    convention = [("convention", (0.0, 0.0, 1.0))]

    def problem(equations=(), free=(), path=(40.0, 0.0, 0.0), n=36, inflow=None):
        return _core.TrimProblem(path, free, [*balances, *convention, *equations], 8, n, inflow, 0.0)

    for bad, words in (
        (lambda: problem([("power", (0.0,))]), "7 controls.* 8 equations"),
        (lambda: problem(free=["speed"]), "8 controls.* 7 equations"),
        (lambda: problem(n=0), "no azimuths"),
        (lambda: problem(path=(float("nan"), 0.0, 0.0)), "not finite"),
        (lambda: problem(inflow=np.zeros((36, 3))), "inflow map has 108 values"),
        (lambda: problem([("speed", (0.0,))]), "'speed' is no equation"),
        (lambda: problem([("power", ())]), "'power' is no equation of a trim, or not with 0 numbers"),
        (lambda: problem(free=["roll"]), "'roll' is no part"),
    ):
        with pytest.raises(ValueError, match=words):
            core.trim_residual(bad(), x)
    for wrong in (x[:-1], np.append(x, 0.0), np.zeros(0)):
        for ask in (core.trim_residual, core.trim_jacobian):
            with pytest.raises(ValueError, match=r"unknowns, .* needed"):
                ask(start.problem, wrong)
        with pytest.raises(ValueError, match="needed"):
            core.trim_state(start.problem, wrong, 0.0)
    stand = wf.tunnel(AIRCRAFT["uh60a"], collective="14 deg", speed="0 kt", inflow="dynamic")
    with pytest.raises(ValueError, match="force_x belongs to an airframe"):
        stand.model.core.trim_residual(problem(), stand.x)


def test_unknowns_and_equations_have_names_and_units():
    start = trimmed(load_factor=1.3, asked={"power": "0 hp"})
    layout = start.model.core.trim_layout(start.problem)
    unknowns, equations = dict(layout.unknowns), dict(layout.equations)
    assert len(unknowns) == len(equations) == start.x.size
    assert {"lateral": "m", "roll": "rad", "flight_path": "rad", "turn_rate": "rad/s"}.items() <= unknowns.items()
    assert {"force_x": "m/s2", "moment_z": "rad/s2", "power": "1", "load_factor": "1"}.items() <= equations.items()
    assert list(unknowns).index("flight_path") == layout.path
    assert start.x[layout.path] == start.flight_path


def test_a_rotor_on_a_stand_finds_the_collective_for_a_shaft_power():
    stand = wf.tunnel(
        AIRCRAFT["uh60a"], power="1000 hp", speed="80 kt", shaft_angle="-5 deg", flapping="zero", inflow="dynamic"
    )
    assert stand.power / HORSEPOWER == pytest.approx(1000.0, rel=1e-6)
    with pytest.raises(wf.InputError, match="give one of collective, thrust, ct, torque, power; thrust is given"):
        wf.tunnel(AIRCRAFT["uh60a"], power="1000 hp", thrust="70000 N", inflow="dynamic")
