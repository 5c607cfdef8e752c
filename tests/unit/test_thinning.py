# SPDX-License-Identifier: MIT OR Apache-2.0
"""Stick histories with more corners than coupling steps: what is flown instead, and that the states do not see it."""

import numpy as np
import pytest
from lines_run import lines_run

import wakeflight as wf
from wakeflight import flight
from wakeflight.maneuver_files import arrested_descent, roll_reversal
from wakeflight.rotor_speed import SteadyClock
from wakeflight.thinning import PIECES, nearest, thinned

STEP = 2 * np.pi / 27 / 36
CLOCK = SteadyClock(STEP)


def recorded(rate, seconds, noise, seed=1):
    """A lateral stick that goes 1 in to the right within 0.2 s, sampled at `rate` [Hz] with noise of `noise` [in]."""
    times = np.arange(0.0, seconds, 1.0 / rate)
    inches = np.clip((times - 0.5) / 0.2, 0.0, 1.0) + noise * np.random.default_rng(seed).standard_normal(times.size)
    inches[0] = 0.0
    corners = tuple((float(t), float(x)) for t, x in zip(times, inches, strict=True))
    return wf.Maneuver("recorded", (("lateral", corners),), seconds=seconds)


def test_a_history_with_few_corners_is_flown_corner_by_corner():
    for maneuver in (arrested_descent(), roll_reversal(), recorded(100.0, 2.0, 0.01)):
        assert thinned(maneuver, CLOCK, 400) is maneuver


def test_the_nearest_straight_pieces_differ_by_nothing_about_any_stop():
    rng = np.random.default_rng(2)
    times = np.sort(rng.uniform(0.0, 1.0, 500))
    inches, stops = rng.standard_normal(500), np.linspace(0.1, 0.9, 24)
    fit = nearest(times, inches, stops)
    fine = np.unique(np.concatenate([times, stops, np.linspace(0.1, 0.9, 400001)]))
    fine = fine[(fine >= 0.1) & (fine <= 0.9)]
    differs = np.interp(fine, stops, fit) - np.interp(fine, times, inches)
    for i in range(1, len(stops) - 1):
        hat = np.interp(fine, stops, np.eye(len(stops))[i])
        assert abs(np.trapezoid(differs * hat, fine)) < 1e-8
    # what is straight between the stops is kept
    assert nearest(stops, fit, stops) == pytest.approx(fit, abs=1e-12)


def test_stops_of_a_dense_history_are_bounded_and_said():
    maneuver = recorded(1000.0, 2.0, 0.01)
    n_steps = round(2.0 / STEP)
    thin = thinned(maneuver, CLOCK, n_steps)
    # every stop and the two ends
    assert len(thin.corners()) <= PIECES * n_steps + 1 + sum(t > n_steps * STEP for t in maneuver.corners())
    assert "straight pieces" in thin.adapted[-1]
    # the mean of the stick over a tenth of a second is that of the recorder
    fine = np.linspace(1.0, 1.1, 20001)
    means = [np.mean([each.offset(t)[0] for t in fine[::10]]) for each in (maneuver, thin)]
    assert means[1] == pytest.approx(means[0], abs=2e-4)


def test_a_single_dense_step_is_flown_by_its_own_pieces():
    # three corners within one step of 6.5 ms, none beside it: one stop between the step's two ends
    corners = ((0.0971, 0.0), (0.0985, 0.1), (0.1, -0.05), (0.1015, 0.0))
    maneuver = wf.Maneuver("tremor", (("lateral", corners),), seconds=1.0)
    thin = thinned(maneuver, CLOCK, 100)
    (_, flown), *_ = thin.corners_of
    inside = [t for t, _ in flown if 15 * STEP < t < 16 * STEP]
    assert inside == pytest.approx([15.5 * STEP])
    fine = np.linspace(15 * STEP, 16 * STEP, 20001)
    hat = 1.0 - np.abs(fine - 15.5 * STEP) / (0.5 * STEP)
    differs = [thin.offset(t)[0] - maneuver.offset(t)[0] for t in fine]
    assert abs(np.trapezoid(differs * hat, fine)) < 1e-8


def test_the_pieces_go_no_further_than_the_stick_did():
    # up to the stop within a sample: the nearest pieces alone would overshoot by a tenth of the jump
    times = np.arange(0.0, 1.0, 1e-3)
    corners = tuple((float(t), 5.0 if t > 0.5 else 0.0) for t in times)
    thin = thinned(wf.Maneuver("slam", (("lateral", corners),), seconds=1.0), CLOCK, 150)
    noisy = tuple((t, x + (1e-3 * (-1) ** i if t > 0.0 and x == 0.0 else 0.0)) for i, (t, x) in enumerate(corners))
    dense = thinned(wf.Maneuver("slam", (("lateral", noisy),), seconds=1.0), CLOCK, 150)
    assert dense.adapted and thin is not dense
    for flown in (thin, dense):
        inches = [x for _, x in flown.corners_of[0][1]]
        assert max(inches) <= 5.0
        assert min(inches) >= -1e-3


@pytest.fixture(scope="module")
def trimmed():
    return wf.trim(wf.load_aircraft("uh60a").with_rigid_blades(), inflow="dynamic")


def flown(start, maneuver, monkeypatch):
    """The flight as it is, and with a stop at every corner."""
    as_it_is = wf.fly(start, maneuver, integrator="fixed").data
    with monkeypatch.context() as patched:
        patched.setattr(flight, "thinned", lambda maneuver, *_: maneuver)
        return as_it_is, wf.fly(start, maneuver, integrator="fixed").data


def test_states_are_those_of_a_solver_that_stops_at_every_corner(trimmed, monkeypatch):
    # the noise of twelve bits over ten inches at 1 kHz: six corners a step, a rate of 3.5 in/s where the stick rests
    thin, every = flown(trimmed, recorded(1000.0, 2.0, 0.0025), monkeypatch)
    assert thin.attrs["solver_steps"] < 0.4 * every.attrs["solver_steps"]
    reached = {"attitude": every["roll"], "rate": every["p"]}
    reached = {name: float(np.abs(each - each[0]).max()) for name, each in reached.items()}
    assert reached["attitude"] > 0.2
    for kind, names, bound in (("attitude", ("roll", "pitch", "yaw"), 1e-3), ("rate", ("p", "q", "r"), 3e-3)):
        for name in names:
            assert float(np.abs(thin[name] - every[name]).max()) < bound * reached[kind], name


def test_what_noise_does_in_proportion_is_kept_and_what_is_lost_goes_with_its_square(trimmed, monkeypatch):
    # noise moves the aircraft by its slow part, in proportion, and by the square of its rates (sections stall inboard): half the
    # difference of flights with the noise and its negative is the one, half the sum the other
    clean = wf.fly(trimmed, recorded(1000.0, 2.0, 0.0), integrator="fixed").data["roll"].to_numpy()
    roll = {}
    for noise in (0.005, -0.005, 0.01, -0.01):
        thin, every = flown(trimmed, recorded(1000.0, 2.0, noise), monkeypatch)
        roll[noise] = np.array([thin["roll"], every["roll"]]) - clean
    odd = 0.5 * (roll[0.01] - roll[-0.01])
    assert np.abs(odd[0] - odd[1]).max() < 0.25 * np.abs(odd[1]).max()
    even = [0.5 * np.abs((roll[a] + roll[-a])[0] - (roll[a] + roll[-a])[1])[-1] for a in (0.005, 0.01)]
    assert even[1] / even[0] == pytest.approx(4.0, rel=0.3)
    assert even[1] < 3e-3 * np.abs(clean - clean[0]).max()


def test_a_finely_sampled_smooth_history_is_flown_as_it_is(trimmed, monkeypatch):
    times = np.arange(0.0, 2.0, 0.001)
    smooth = tuple((float(t), 0.5 * (1.0 - np.cos(np.pi * float(t)))) for t in times)
    maneuver = wf.Maneuver("smooth", (("lateral", smooth),), seconds=2.0)
    thin, every = flown(trimmed, maneuver, monkeypatch)
    # what is left is the solver's own tolerance of 1e-5 at another length of its steps
    assert float(np.abs(thin["p"] - every["p"]).max() / np.abs(every["p"]).max()) < 1e-4


def test_cost_does_not_grow_with_the_samples():
    found = []
    for rate in (1e2, 1e4):
        maneuver = recorded(rate, 10.0, 0.01)
        # what is made of the corners once
        maneuver.stick(0.0, (5.0,) * 4), maneuver.rate(0.0)
        found.append(
            lines_run(
                lambda flown=maneuver: [
                    (flown.stick(t, (5.0,) * 4), flown.rate(t)) for t in np.linspace(0.0, 10.0, 100)
                ]
            )[0]
        )
    assert found[1] < 1.1 * found[0]
