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
        exchange = loop(start, scheme="pcc", recorrect=passes, extrapolate=False)
        for _ in range(5):
            inflow, _ = exchange.turn(start.problem, start.x)
        distance.append(np.sqrt(np.mean((inflow - start.inflow_map) ** 2 @ exchange.model.area_weights)))
    assert distance[1] < 0.8 * distance[0]


def test_over_a_step_inflow_goes_on_to_where_the_wake_then_is(baseline_relaxation):
    # in a wake that repeats itself the blade before has met what the next one meets
    start = baseline_relaxation
    exchange = loop(start)
    for _ in range(10):
        exchange.turn(start.problem, start.x)
    off, moved = [], []
    for _ in range(9):
        here, _, change = exchange.held(exchange.step_index)
        exchange.frozen_step(start.problem, start.x)
        there = exchange.inflow
        off.append(there - here - change)
        moved.append(there - here)
    assert np.linalg.norm(off) < 0.02 * np.linalg.norm(moved)
    # held, a step misses all of it
    assert loop(start, extrapolate=False).held(0)[2] is None


def test_inflow_that_goes_on_brings_marching_closer_to_relaxation(baseline_relaxation):
    # the circulation that is released is then found with the far inflow of its own step
    start = baseline_relaxation
    distance = []
    for extrapolate in (False, True):
        exchange = loop(start, scheme="pcc", extrapolate=extrapolate)
        for _ in range(5):
            inflow, _ = exchange.turn(start.problem, start.x)
        distance.append(np.sqrt(np.mean((inflow - start.inflow_map) ** 2 @ exchange.model.area_weights)))
    assert distance[1] < 0.8 * distance[0]


def test_sticks_held_the_flight_stays_nearer_to_its_relaxed_trim(uh60a):
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
    start = wf.trim(uh60a, condition, inflow="relaxation")
    moved = []
    for extrapolate in (False, True):
        wake = wf.TimeMarchingWake(extrapolate=extrapolate)
        data = wf.fly(start, wf.Maneuver("held", {}, seconds=1.0), inflow=wake, integrator="fixed").data
        moved.append([float(np.abs(data[name] - data[name][0]).max()) for name in ("p", "q", "r", "roll", "pitch")])
    assert np.all(np.array(moved[1]) < 0.6 * np.array(moved[0]))


def test_a_held_map_is_renewed_at_its_interval_alone(baseline_relaxation):
    start = baseline_relaxation
    exchange = loop(start, update_interval="90 deg")
    first, _, change = exchange.held(0)
    means = []
    for step in range(19):
        means.append(exchange.held(step)[1])
        exchange.frozen_step(start.problem, start.x)
    assert len(set(means[:9])) == 1
    assert len(set(means[9:18])) == 1
    assert means[0] != means[9] != means[18]
    # over a step the map goes from its value at one end to that at the other
    assert np.allclose(first, start.inflow_map[[0, 9, 18, 27]])
    assert np.allclose(first + change, start.inflow_map[[1, 10, 19, 28]])


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
