"""Options of the exchange between wake and flight: what each does to a wake at frozen states, and in a short flight."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.exchange import Exchange
from wakeflight.flight_start import flight_model


def loop(start, **options):
    return Exchange.marching(flight_model(start, wf.TimeMarchingWake(**options)), start.wake)


def test_recorrection_brings_circulation_and_inflow_together(baseline_relaxation):
    # with frozen states the far inflow that belongs to the circulation just solved is that of the next recorrection:
    # passes contract, so that the third changes less than the first
    start = baseline_relaxation
    maps = []
    for passes in (0, 1, 2, 3):
        exchange = loop(start, recorrect=passes)
        for _ in range(3):
            exchange.frozen_step(start.problem, start.x)
        maps.append(exchange.inflow)
    changes = [np.abs(a - b).max() for a, b in zip(maps[1:], maps[:-1], strict=True)]
    assert changes[0] > 1e-5
    assert changes[2] < 0.5 * changes[0]


def test_recorrection_brings_marching_closer_to_relaxation(baseline_relaxation):
    # what separates pcc from relaxation is the step by which circulation lags its inflow; recorrection takes it away
    start = baseline_relaxation
    distance = []
    for passes in (0, 1):
        exchange = loop(start, scheme="pcc", recorrect=passes)
        for _ in range(5):
            inflow, _ = exchange.turn(start.problem, start.x)
        distance.append(np.sqrt(np.mean((inflow - start.inflow_map) ** 2 @ exchange.model.area_weights)))
    assert distance[1] < 0.8 * distance[0]


def test_extrapolation_is_linear_in_the_last_two_far_inflows(baseline_relaxation):
    start = baseline_relaxation
    plain, ahead = loop(start), loop(start, extrapolate=True)
    for exchange in (plain, ahead):
        before = exchange.lambda_far
        exchange.frozen_step(start.problem, start.x)
        # the first step has no past but that of the trim
        exchange.step = exchange.lambda_far - before
    # the first wake step used the same circulation, so the far inflows agree to the bit
    assert np.array_equal(plain.lambda_far, ahead.lambda_far)
    # half a step more far inflow, less what the near wake answers
    gained = ahead.inflow - plain.inflow
    asked = 0.5 * ahead.step
    correlation = np.sum(gained * asked) / np.sqrt(np.sum(gained**2) * np.sum(asked**2))
    assert correlation > 0.9
    assert 0.3 < np.sqrt(np.sum(gained**2) / np.sum(asked**2)) <= 1.0


def test_a_held_map_is_renewed_at_its_interval_alone(baseline_relaxation):
    start = baseline_relaxation
    exchange = loop(start, update_interval="90 deg")
    first, _ = exchange.held(0)
    means = []
    for step in range(19):
        means.append(exchange.held(step)[1])
        exchange.frozen_step(start.problem, start.x)
    assert len(set(means[:9])) == 1
    assert len(set(means[9:18])) == 1
    assert means[0] != means[9] != means[18]
    # over a step the map stands at the mean of its two ends
    assert np.allclose(first, 0.5 * (start.inflow_map[[0, 9, 18, 27]] + start.inflow_map[[1, 10, 19, 28]]))


@pytest.mark.parametrize(("interval", "updates"), [("360 deg", 1), ("90 deg", 4)])
def test_a_relaxation_wake_is_renewed_as_often_as_asked(baseline_relaxation, interval, updates):
    wake = wf.RelaxationWake(update_interval=interval)
    flight = wf.fly(baseline_relaxation, wf.arrested_descent(), inflow=wake, revolutions=1, integrator="fixed")
    assert flight.data.attrs["relaxation_updates"] == updates


def test_the_monitors_say_what_they_watch(baseline_relaxation):
    data = wf.fly(
        baseline_relaxation, wf.arrested_descent(), inflow="time-marching", revolutions=4, integrator="fixed"
    ).data
    # four turns of wake under a descending rotor pass within a few cores of the blades, never at no distance
    assert 0.0 < data["vortex_blade_distance"].min() < 20.0
    assert np.array_equal(data["alpha_max"], data["alpha"].max(("blade", "station")))
    assert float(data["mach_max"].max()) < 1.0
    # airframe energy: the work of the loads at 36 points a revolution misses a part of what they exchange, no more
    exchanged = np.ptp(data["energy"].values)
    balance = np.abs(data["energy_balance"].values).max()
    assert balance < 0.01 * exchanged
    # a monitor that cannot fail watches nothing: loads three per cent too large would not pass
    power = sum(
        data[f"{load}_{axis}"].values * data[rate].values
        for load, rates in (("force", "uvw"), ("moment", "pqr"))
        for axis, rate in zip("xyz", rates, strict=True)
    )
    work = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(data["time"].values))])
    energy = data["energy"].values - data["energy"].values[0]
    assert np.allclose(energy - work, data["energy_balance"].values, atol=1e-6 * exchanged)
    assert np.abs(energy - 1.03 * work).max() > 0.01 * exchanged
