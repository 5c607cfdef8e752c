# SPDX-License-Identifier: MIT OR Apache-2.0
"""What turns a rotor whose speed is a state: what is refused by name, engines by themselves, the clock of a free speed."""

import math

import pytest

import wakeflight as wf
from wakeflight.cli.groups import ROTOR_SPEEDS
from wakeflight.engine import NAMES, FreeEngine, GovernedEngine, turning
from wakeflight.rotor_speed import FreeClock


def test_a_rotor_speed_is_a_name_a_history_or_an_engine():
    assert turning("constant").engine is None and turning("constant").name == "constant"
    assert turning([("0 s", 1.0), ("1 s", 0.9)]).corners == ((0.0, 1.0), (1.0, 0.9))
    assert turning("governed").engine.governed and not turning("free").engine.governed
    own = wf.Engine()
    assert turning(own).engine is own and turning(own).corners == ()
    assert turning(GovernedEngine("1 s")).name == "governed, failure 1.0 s, remaining 0.0"


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: turning("steady"), "allowed: constant, constant-over-ground, governed, free"),
        (lambda: turning(3.0), "constant or pairs"),
        (lambda: GovernedEngine(1.0), "failure"),
        (lambda: GovernedEngine("-1 s"), "failure"),
        (lambda: GovernedEngine("1 s", 1.5), "remaining"),
        (lambda: GovernedEngine("1 s", math.nan), "remaining"),
        (lambda: FreeEngine("soon"), "failure"),
    ],
)
def test_what_is_no_engine_is_refused_by_name(make, named):
    with pytest.raises(wf.InputError, match=named):
        make()


def test_engines_fail_when_they_are_told_to():
    governed, free = GovernedEngine("1 s", 0.5), FreeEngine("1 s")
    free.begin(4e4, 27.0)
    assert governed.given(0.9, 0.01, 27.0, 0.1) == (0.0, 1.0)
    assert governed.given(1.0, 0.01, 27.0, 0.1) == (0.0, 0.5)
    assert free.given(0.9, 0.01, 27.0, 0.1) == (4e4, 1.0)
    assert free.given(1.0, 0.01, 27.0, 0.1) == (0.0, 1.0)


@pytest.mark.parametrize("bad", [math.nan, math.inf, None, "much"])
def test_a_torque_that_is_no_number_ends_the_flight(bad):
    class Bad(wf.Engine):
        def torque(self, t, dt, rotor_speed, collective):
            return bad

    with pytest.raises(wf.NumericalFailure, match=r"Bad at t = 0.2000 s"):
        Bad().given(0.2, 0.01, 27.0, 0.1)
    with pytest.raises(
        wf.NumericalFailure, match=r"torque of Engine at t = 0.2000 s: NotImplementedError: Engine must define torque"
    ):
        wf.Engine().given(0.2, 0.01, 27.0, 0.1)


def test_an_engine_that_raises_ends_the_flight_by_name():
    class Short(wf.Engine):
        def torque(self, t, dt):
            return 1.0

    with pytest.raises(
        wf.NumericalFailure, match=r"torque of Short at t = 0.2000 s: TypeError: .* takes 3 positional"
    ) as stop:
        Short().given(0.2, 0.01, 27.0, 0.1)
    assert "\n" not in str(stop.value)


def test_a_clock_of_a_free_speed_ends_steps_where_the_rotor_has_turned_by_them():
    clock = FreeClock(27.0, 0.1)
    assert clock.time(3) == pytest.approx(0.3 / 27.0)
    # a rotor that slows down evenly: the steps are exact
    rate, t, azimuth = -5.0, 0.0, 0.0
    clock.reach(0, 0.0, (0.0, 27.0, rate))
    for step in range(200):
        t = clock.time(step + 1)
        azimuth = 27.0 * t + 0.5 * rate * t * t
        assert azimuth == pytest.approx(0.1 * (step + 1), abs=1e-12)
        assert clock.duration(step) == pytest.approx(t - clock.time(step))
        clock.reach(step + 1, t, (azimuth, 27.0 + rate * t, rate))
    again = clock.own()
    again.recall({"step": 200, **clock.memory()})
    assert again.time(201) == clock.time(201) and again.duration(199) == clock.duration(199)
    clock.reach(200, t, (azimuth, 0.1, -5.0))
    with pytest.raises(ArithmeticError, match="the rotor stops"):
        clock.time(201)


def test_the_aircraft_says_what_turns_with_its_rotor(uh60a):
    inertia, hub = uh60a.drive_inertia
    assert inertia == pytest.approx(1474.4, abs=0.1) and hub == pytest.approx(56.74, abs=0.01)
    gains, lag = uh60a.governor
    horsepower = 745.6998715822702
    assert gains == pytest.approx([1.75 * horsepower * k for k in (2000, 2500, 500)], rel=1e-9)
    assert lag == 1.25
    bo105 = wf.load_aircraft("bo105")
    with pytest.raises(wf.InputError, match=r"needs drive\.inertia_engines"):
        _ = bo105.drive_inertia
    with pytest.raises(wf.InputError, match=r"needs drive\.governor_proportional"):
        _ = bo105.governor


def test_the_command_line_offers_every_name():
    assert ROTOR_SPEEDS == NAMES
