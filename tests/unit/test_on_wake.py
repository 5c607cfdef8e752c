# SPDX-License-Identifier: MIT OR Apache-2.0
"""The loops that bring a trim and its wake together, with a rotor and wakes of one number each."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.progress import Silent
from wakeflight.trim.on_wake import TrimOnWake


class Linear(TrimOnWake):
    """Unknown x = 1 + inflow/2: with a wake that gives inflow = x the two agree at 2."""

    passes = 60
    where = "here: "
    moving = "pitch"
    given_up_after = 1000

    def __init__(self):
        super().__init__(None, Silent(), 1e-9)
        self.before = []

    def solve(self, inflow_map, x, before=None):
        self.before.append(before)
        return "problem", 1.0 + 0.5 * inflow_map

    def none_found(self, problem, x, inflow_map):
        raise AssertionError("every inflow has its trim here")

    def moved(self, problem, before, after):
        return after - before

    def hopeless(self, wake, history):
        return len(history) >= self.given_up_after

    def ended(self, found):
        return found


class Follows:
    """A wake that gives the unknowns back, and stops the numbers where it is told to."""

    circulation = in_trim = None

    def __init__(self, fails_in=None):
        self.inflow_map, self.change, self.passes, self.fails_in = np.zeros(1), np.inf, 0, fails_in

    @property
    def converged(self):
        return self.change < 1e-9

    @property
    def last(self):
        return {"inflow_change": self.change}

    def converge(self, problem, x):
        self.passes += 1
        if self.passes == self.fails_in:
            raise ArithmeticError("not finite")
        self.change, self.inflow_map = float(np.abs(x - self.inflow_map).max()), x
        return x


def test_trim_and_wake_go_on_until_both_rest():
    trimming, wake = Linear(), Follows()
    found = trimming.on_periodic(wake, np.zeros(1), np.zeros(1))
    assert found.settled and found.x == pytest.approx(2.0, abs=1e-8)
    assert found.inflow_map == pytest.approx(2.0, abs=1e-8)
    assert found.history[-1]["control_change"] < 1e-9
    # each trim is told the inflow of the one before, the first that there is none
    assert trimming.before[0] is None and trimming.before[1] == 0.0 and trimming.before[2] == 1.0


def test_rest_of_the_first_trim_says_nothing():
    # started at its own answer the trim does not move, and the wake has not been asked yet
    found = Linear().on_periodic(wake := Follows(), np.ones(1), np.zeros(1))
    assert wake.passes > 1 and found.x == pytest.approx(2.0, abs=1e-8)


def test_what_is_given_up_is_not_settled():
    trimming = Linear()
    trimming.given_up_after = 3
    found = trimming.on_periodic(Follows(), np.zeros(1), np.zeros(1))
    assert not found.settled and len(found.history) == 3


def test_a_wake_that_leaves_the_numbers_is_named_with_its_pass():
    with pytest.raises(wf.NumericalFailure, match="here: relaxation wake, pass 2: not finite"):
        Linear().on_periodic(Follows(fails_in=2), np.zeros(1), np.zeros(1))


class EverySecond:
    """A marching wake of which every second revolution is trimmed on."""

    told = ""
    wash = None
    longest = 9

    def __init__(self):
        self.marched, self.trims = [], []

    def turn(self, revolution, problem, x):
        self.marched.append(revolution)
        return x if revolution % 2 == 0 else None

    def trimmed(self, problem, x, change):
        self.trims.append((float(x[0]), change))
        return change < 0.3

    def found(self, rests):
        return rests


def test_revolutions_without_an_inflow_to_trim_on_are_marched_on():
    trimming, turns = Linear(), EverySecond()
    start = Linear().on_periodic(Follows(), np.zeros(1), np.zeros(1))
    start = type(start)(**vars(start) | {"x": np.zeros(1)})
    assert trimming.on_turns(turns, start)
    assert turns.marched == [1, 2, 3, 4, 5, 6]
    assert turns.trims == [(1.0, 1.0), (1.5, 0.5), (1.75, 0.25)]
