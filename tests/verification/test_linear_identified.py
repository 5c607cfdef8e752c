"""The wake identified from sweeps: signals, the fit, hover against flights, and what is no model."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.linear import identified
from wakeflight.linear.coherent import following, given
from wakeflight.linear.identified import regression
from wakeflight.linear.marched import Orbit, causes_of
from wakeflight.linear.names import places
from wakeflight.linear.realisation import laguerre
from wakeflight.linear.response import time_response
from wakeflight.linear.sweeps import Driven, Signals


def hover(**wake):
    condition = wf.FlightCondition(speed="0 kt", altitude="0 ft", weight="16000 lbf")
    aircraft = wf.load_aircraft("uh60a").discretised(n_modes=3, n_elements=4)
    return wf.trim(aircraft, condition, inflow=wf.TimeMarchingWake(azimuth_step="15 deg", **wake))


@pytest.fixture(scope="module")
def start():
    return hover()


@pytest.fixture(scope="module")
def orbit(start):
    return Orbit(start, places(start.model), 3)


def test_signals_repeat_themselves_and_are_known_with_their_rates_and_what_filters_make_of_them():
    omega, n, revolutions = 25.0, 36, 60
    signals = Signals.by_chance(3, revolutions, n, omega, 2)
    steps = np.arange(1, 2 * signals.steps + 1)
    value = signals.at(steps)
    assert np.mean(value**2, axis=0) == pytest.approx(1.0) and np.allclose(
        value[: signals.steps], value[signals.steps :]
    )
    together = value[: signals.steps].T @ value[: signals.steps] / signals.steps
    assert np.abs(together - np.eye(3)).max() < 0.3
    dt = 2 * np.pi / omega / n
    slope = (value[2:] - value[:-2]) / (2 * dt)
    assert np.abs(signals.rates(steps)[1:-1] - slope).max() < 6e-3 * np.abs(slope).max()
    # after the functions have forgotten that they began at rest
    pole, count = 0.6 * omega, 4
    filtered = signals.filtered(steps, pole, count)[:, :, 1]
    fine = np.linspace(dt, 2 * signals.steps * dt, 4 * (steps.size - 1) + 1)
    values = np.interp(fine, steps * dt, value[:, 1])
    answer = time_response(laguerre(pole, count), fine, values[:, None])[0][::4]
    assert np.abs(answer - filtered)[signals.steps :].max() < 2e-3 * np.abs(filtered).max()


def test_a_regression_finds_what_made_the_answers_and_leaves_out_noise():
    rng = np.random.default_rng(3)
    functions, c = rng.standard_normal((400, 5, 4)), rng.standard_normal((5, 4, 6))
    functions[:, 4] = functions[:, 3] * (1.0 + 1e-6)
    answers = np.einsum("tkc,kco->to", functions, c) + 7.0
    found, level = regression(functions, answers)
    assert np.allclose(np.einsum("tkc,kco->to", functions, found) + level, answers, atol=2e-3 * np.abs(answers).max())
    noise = regression(functions, rng.standard_normal((400, 6)))[0]
    assert np.abs(noise).max() < 0.25


def test_blades_driven_by_causes_are_what_causes_at_once_say(orbit):
    slow, quick = causes_of(orbit.where, [0, 1, 2])
    signals = Signals.by_chance(len(slow), 60, orbit.n, orbit.omega, 1)
    steps = np.arange(1, 50)
    driven = Driven.by(orbit, slow, steps, signals.at(steps), signals.rates(steps))
    values = driven.quick(orbit, quick, steps)
    for step in (7, 12, 30, 44):
        angle, rate = np.zeros_like(driven.angle[0]), np.zeros_like(driven.angle[0])
        for cause, value in zip(quick, values[step - 1], strict=True):
            if cause.of_blades:
                # the map of a passage is that of a coordinate that has kept its sign
                odd = cause.name.split("_rate")[0].endswith("_d") and step % orbit.n // orbit.passage % 2
                shape, slope = orbit.shapes(cause, step)
                sign = -1.0 if odd else 1.0
                rate[:, cause.index] += sign * value * (shape if cause.rate_alone else orbit.omega * slope)
                angle[:, cause.index] += 0.0 if cause.rate_alone else sign * value * shape
        assert np.allclose(angle, driven.angle[step - 1]) and np.allclose(rate, driven.angle_rate[step - 1])


def test_modes_that_are_not_given_follow_those_that_are(start, orbit):
    causes, quick = causes_of(orbit.where, [0, 1, 2])
    chosen = given(causes, orbit.where)
    assert [causes[i].name for i in chosen][-3:] == ["flap_1_0", "flap_1_1c", "flap_1_1s"] and len(chosen) == 12
    maps = quick, np.zeros((orbit.n, orbit.exchange.inflow.shape[1], len(quick)))
    shapes = following(start, orbit, causes, maps)
    assert np.allclose(shapes[chosen], np.eye(len(chosen)), atol=1e-12)
    # blade pitch does not bring up the disk, that is given, but lag by the drag it makes
    lag, theta_0 = [cause.name for cause in causes].index("lag_1_0"), [causes[i].name for i in chosen].index("theta_0")
    assert -3.0 < shapes[lag, theta_0] < -0.3


def flown(start, stick, inches):
    """Half the difference of the flights after steps to either side."""
    both = []
    for side in (inches, -inches):
        step = wf.Maneuver("step", {stick: [(0.1, 0.0), (0.15, side), (2.0, side)]}, seconds=1.5)
        both.append(wf.fly(start, step, integrator="fixed").data)
    return both[0]["time"].values, {name: 0.5 * (both[0][name] - both[1][name]).values for name in ("p", "q", "w")}


@pytest.mark.slow
def test_hover_is_identified_and_answers_as_the_flown_wake_does(start):
    models = {wake: wf.linearize(start, wake=wake) for wake in ("identified", "frozen")}
    told = models["identified"].attributes
    assert told["wake_orbit"] > 1e-5, "the wake repeats itself: nothing is shown"
    assert told["wake_coherence"] > 0.9 and told["wake_residual"] < 0.35
    off = {}
    for stick, inches in (("collective", 0.1), ("longitudinal", 0.1)):
        time, real = flown(start, stick, inches)
        fine = np.linspace(0.0, time[-1], 3001)
        for wake, model in models.items():
            found = model.response(fine, {stick: inches * np.clip((fine - 0.1) / 0.05, 0.0, 1.0)})
            for name, values in real.items():
                error = np.abs(np.interp(time, fine, found[name].values) - values).max()
                off[stick, wake, name] = float(error / np.abs(values).max())
    for stick, name in (("collective", "w"), ("longitudinal", "q")):
        assert off[stick, "identified", name] < 0.1, off
        assert off[stick, "identified", name] < 0.7 * off[stick, "frozen", name], off


def test_what_does_not_predict_what_was_held_back_is_refused_with_how_far_off_it_is(monkeypatch):
    monkeypatch.setattr(identified, "RECORD", 60)
    with pytest.raises(wf.NumericalFailure, match=r"identified: .* coherence of 0\.\d\d \(at least 0\.8\)"):
        wf.linearize(hover(turns=2, trailers="tip"), wake="identified")
