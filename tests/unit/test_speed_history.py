# SPDX-License-Identifier: MIT OR Apache-2.0
"""Rotor speed in time: what is refused by name, and the clock that steps of azimuth make."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.rotor_speed import HistoryClock, SteadyClock, history, shares, unflown
from wakeflight.tunnel.transient import History

OMEGA = 27.0


class Rotor:
    """A speed that falls from 27 to 24.3 rad/s between 0.5 and 1.5 s, by numbers of its own."""

    fine = np.linspace(0.0, 5.0, 500001)

    def __init__(self):
        speed = OMEGA * np.interp(self.fine, [0.5, 1.5], [1.0, 0.9])
        self.psi = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(self.fine))])

    def turned(self, t):
        return float(np.interp(t, self.fine, self.psi))

    def time(self, psi):
        return float(np.interp(psi, self.psi, self.fine))


CORNERS = (("0.5 s", 1.0), ("1500 ms", 0.9))


def test_a_history_is_text_with_units_and_shares():
    assert history("constant") == ()
    assert history(CORNERS) == ((0.5, 1.0), (1.5, 0.9))
    assert shares(history(CORNERS), np.array([0.0, 1.0, 9.0])).tolist() == [1.0, 0.95, 0.9]
    assert shares((), np.zeros(2)).tolist() == [1.0, 1.0]


def test_corners_after_the_end_of_a_flight_are_told():
    assert unflown(history(CORNERS), 1.5) == [] and unflown((), 1.0) == []
    assert unflown(history(CORNERS), 1.2) == [
        "rotor_speed: the flight ends at 1.2 s; corners up to 1.5 s are not flown"
    ]


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ("free", "constant or pairs"),
        ([("0 s", 1.0)], "constant or pairs"),
        ([("0 s", 1.0), 0.9], "constant or pairs"),
        ([(0.0, 1.0), ("1 s", 0.9)], "rotor_speed time"),
        ([("0 s", 1.0), ("1 s", "0.9")], "must be a number between 0.5 and 1.25"),
        ([("0 s", 1.0), ("1 s", 1.3)], "rotor_speed = 1.3"),
        ([("0 s", 1.0), ("1 s", float("nan"))], "between 0.5 and 1.25"),
        ([("1 s", 1.0), ("1 s", 0.9)], "ascend strictly"),
        ([("-1 s", 1.0), ("1 s", 0.9)], "from 0 s"),
        ([("0 s", 0.9), ("1 s", 1.0)], "must begin at 1"),
    ],
)
def test_a_history_that_cannot_be_flown_is_refused_by_name(given, named):
    with pytest.raises(wf.InputError, match=named) as reason:
        history(given)
    assert "\n" not in str(reason.value)


def test_a_stand_above_a_free_wake_needs_a_constant_speed(uh60a):
    stand = wf.tunnel(uh60a, collective="8 deg", inflow=wf.TimeMarchingWake(turns=2, azimuth_step="30 deg"))
    refused = "rotor_speed = 'a history': must be constant on a stand with a free wake .inflow = time-marching."
    with pytest.raises(wf.InputError, match=refused):
        stand.transient([("0.1 s", "9 deg")], "1 s", rotor_speed=CORNERS)


def test_steps_of_azimuth_take_longer_as_the_rotor_slows():
    steps = 36
    clock = HistoryClock(Rotor(), 2 * np.pi / steps, history(CORNERS))
    steady = SteadyClock(2 * np.pi / OMEGA / steps)
    assert clock.time(40) == pytest.approx(steady.time(40), abs=1e-9)
    assert clock.duration(2) == pytest.approx(steady.duration(2), abs=1e-9)
    assert clock.duration(400) == pytest.approx(steady.duration(400) / 0.9, abs=1e-9)
    assert clock.steps(400, 5 * clock.duration(400)) == pytest.approx(5.0, abs=1e-6)
    times = clock.time(np.arange(300))
    assert times[150] == clock.time(150) and np.all(np.diff(times) > 0.0)


def test_a_step_is_cut_where_the_rate_of_the_speed_jumps():
    clock = HistoryClock(Rotor(), 2 * np.pi / 36, history(CORNERS))
    assert clock.cut([(0.49, 0.495), (0.495, 0.51)]) == [(0.49, 0.495), (0.495, 0.5), (0.5, 0.51)]
    assert clock.cut([(0.5, 0.51), (1.49, 1.5 + 1e-12)]) == [(0.5, 0.51), (1.49, 1.5 + 1e-12)]
    assert SteadyClock(0.1).cut([(0.0, 0.1)]) == [(0.0, 0.1)]


def test_the_collective_of_a_stand_is_linear_over_a_step_that_is_cut():
    clock = HistoryClock(Rotor(), 2 * np.pi / 36, history(CORNERS))
    moved = History(np.array([0.0, 0.4, 0.8]), np.array([0.1, 0.1, 0.3]), np.array([0.02, -0.03]), clock, 0)
    k = int(clock.steps(0, 0.5))
    ends = clock.time(np.array([k, k + 1]))
    assert ends[0] < 0.5 < ends[1]
    values = [moved.at(t) for t in ends]
    assert values[0].tolist() == [moved.collective_after(k), 0.02, -0.03, 0.0]
    assert moved.at(0.5)[0] == pytest.approx(np.interp(0.5, ends, [v[0] for v in values]), abs=1e-12)
    assert moved.rate(0.5)[0] == moved.rate(ends[0])[0] == pytest.approx(0.5, rel=1e-6)


def test_derivatives_by_wind_and_rotor_speed_have_names(uh60a):
    start = wf.trim(uh60a, inflow="dynamic")
    core, y = start.model.core, start.state(0.0)
    inputs = wf._core.Inputs(start.stick_si, np.zeros(4), 0.0, None, 0.0, start.stabilator_incidence)
    y_dot = core.consistent_rate(0.0, y, inputs)
    names, slopes = core.input_slopes(0.0, y, y_dot, inputs)
    units = dict(names)
    assert slopes.shape == (y.size, len(names))
    assert units["wind_north"] == "m/s" and units["rotor.main.speed"] == "rad/s"
    # a faster rotor thrusts more: the residual of w, mass times acceleration less force, over mass, falls with the force up
    column = [name for name, _ in names].index("rotor.main.speed")
    thrust = slopes[2, column]
    assert thrust < -0.5 or thrust > 0.5
    with pytest.raises(ValueError, match="y"):
        core.input_slopes(0.0, y[:-1], y_dot, inputs)


def test_a_core_refuses_a_history_that_is_none(uh60a):
    core = wf.trim(uh60a, inflow="dynamic").model.core
    for corners in ([], [(0.0, 0.0)], [(0.0, 27.0), (0.0, 26.0)], [(float("nan"), 27.0)]):
        with pytest.raises(ValueError, match="rotor_speed"):
            core.with_rotor_speed(corners)
