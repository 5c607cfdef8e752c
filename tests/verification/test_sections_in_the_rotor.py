# SPDX-License-Identifier: MIT OR Apache-2.0
"""Blades whose sections remember: in trim, in flight, on the stand; refused where the wake sheds the same vorticity."""

import numpy as np
import pytest

import wakeflight as wf

MODELS = ("attached", "oye", "hgm")
HELD = {"lateral": 0.0}


def dynamic(model, **options):
    return wf.DynamicInflow(unsteady=model, **options)


def tip(kind=wf.RelaxationWake, **options):
    return kind(trailers="tip", turns=2, n_stations=12, azimuth_step="15 deg", **options)


@pytest.fixture(scope="module")
def rigid(uh60a):
    return uh60a.with_rigid_blades()


@pytest.fixture(scope="module")
def trims(rigid):
    condition = wf.FlightCondition(speed="80 kt")
    models = ("quasi-steady", *MODELS)
    return {model: wf.trim(rigid, condition, inflow=dynamic(model)) for model in models}


@pytest.mark.parametrize("model", MODELS)
def test_a_trim_meets_its_equations_and_a_flight_stays_in_it(trims, model):
    start = trims[model]
    problem, x = start.problem, start.x
    assert np.max(np.abs(start.model.core.trim_residual(problem, x))) < 1e-4
    sim = wf.Simulation(start, integrator="fixed")
    first = sim.state
    for _ in range(sim.model.steps_per_revolution):
        state = sim.step(HELD)
    rest = wf.Simulation(trims["quasi-steady"], integrator="fixed")
    before = rest.state
    for _ in range(rest.model.steps_per_revolution):
        after = rest.step(HELD)
    drift = np.max(np.abs(state.rates - first.rates))
    # no more than the quasi-steady flight's own, and the time step's
    assert drift < np.max(np.abs(after.rates - before.rates)) + 2e-3


def test_sections_in_time_change_the_trim_by_what_they_lag(trims):
    # attached lift at once per revolution lags: lateral cyclic and power move, the thrust does not
    steady = trims["quasi-steady"]
    for model in MODELS:
        moved = np.degrees(trims[model].theta_1c - steady.theta_1c)
        assert 1e-4 < abs(moved) < 1.5, (model, moved)
        assert trims[model].theta_0 == pytest.approx(steady.theta_0, abs=np.radians(0.5))


@pytest.mark.parametrize("model", MODELS)
def test_a_flight_goes_on_from_a_snapshot_to_the_last_bit(trims, model):
    sim = wf.Simulation(trims[model], integrator="fixed")
    for _ in range(5):
        sim.step({"lateral": 0.4})
    kept = sim.snapshot()
    ahead = [sim.step({"lateral": 0.4, "longitudinal": -0.2}).y for _ in range(5)]
    again = wf.Simulation(trims[model], integrator="fixed")
    again.restore(wf.Snapshot.from_bytes(kept.to_bytes()))
    assert np.array_equal(ahead, [again.step({"lateral": 0.4, "longitudinal": -0.2}).y for _ in range(5)])


def test_a_free_wake_trims_and_flies_with_them(rigid):
    condition = wf.FlightCondition(speed="80 kt")
    start = wf.trim(rigid, condition, inflow=tip(unsteady="hgm"))
    assert start.settled
    inflow = tip(wf.TimeMarchingWake, unsteady="hgm", convergence_revolutions=1)
    sim = wf.Simulation(start, inflow=inflow, integrator="fixed")
    for _ in range(3):
        sim.step({"lateral": 0.2})
    kept = sim.snapshot()
    ahead = [sim.step().y for _ in range(3)]
    sim.restore(kept)
    assert np.array_equal(ahead, [sim.step().y for _ in range(3)])
    assert np.all(np.isfinite(ahead))
    with pytest.raises(wf.InputError, match="unsteady"):
        wf.Simulation(start, inflow=tip(wf.TimeMarchingWake, convergence_revolutions=1))


def test_the_shed_wake_is_not_counted_twice():
    for model in ("attached", "hgm"):
        with pytest.raises(wf.InputError, match=rf"unsteady = '{model}'.*trailers = tip.*shed_wake = none"):
            wf.TimeMarchingWake(trailers="full-span", unsteady=model)
        wf.TimeMarchingWake(trailers="tip", unsteady=model)
        wf.RelaxationWake(trailers="full-span", shed_wake="none", unsteady=model)
    # separation alone sheds nothing
    wf.TimeMarchingWake(trailers="full-span", unsteady="oye")


def test_thin_sections_do_not_remember():
    with pytest.raises(wf.InputError, match="unsteady"):
        wf.tunnel("uh60a", speed="80 kt", inflow=tip(unsteady="oye"), blade_model="second-order", blades="rigid")


def test_on_the_stand_harmonic_pitch_lags_and_the_mean_stays():
    arguments = {"collective": "8 deg", "collective_at": "0.75 R", "blades": "rigid"}
    arguments["higher_harmonics"] = [(4, "1 deg", "0 deg")]
    loads, thrust = {}, {}
    for model in ("quasi-steady", *MODELS):
        stand = wf.tunnel("uh60a", inflow=dynamic(model), **arguments)
        loads[model] = stand.data.circulation.values
        thrust[model] = stand.ct
    assert all(ct == pytest.approx(thrust["quasi-steady"], rel=0.01) for ct in thrust.values())
    psi = 2 * np.pi * np.arange(loads["hgm"].shape[0]) / loads["hgm"].shape[0]

    def fourth(values):
        return np.exp(-4j * psi) @ values

    for model in ("attached", "hgm"):
        share = (fourth(loads[model]) / fourth(loads["quasi-steady"]))[8:-2]
        # the reduced frequency of 4/rev at these stations: 0.06 to 0.25
        assert np.all(np.abs(share) < 1.0), (model, share)
        assert np.all(np.abs(share) > 0.5), (model, share)


def test_a_transient_on_the_stand_begins_where_the_stand_is():
    stand = wf.tunnel("uh60a", inflow=dynamic("hgm"), collective="8 deg", blades="rigid", speed="60 kt")
    held = stand.transient([("0 s", "8 deg")], "0.1 s")
    ct = held.ct.values
    assert np.ptp(ct) < 0.05 * abs(ct.mean())
    moved = stand.transient([("0 s", "8 deg"), ("0.05 s", "9 deg")], "0.1 s")
    assert moved.ct.values[-1] > ct[-1]
