# SPDX-License-Identifier: MIT OR Apache-2.0
"""Free wakes of a rotor whose speed changes, given or a state: against constant speed, and kept flights to the bit."""

import pickle

import numpy as np
import pytest

import wakeflight as wf

NOTHING = wf.Maneuver("nothing", (), seconds=10.0)


@pytest.fixture(scope="module")
def start(uh60a):
    coarse = wf.RelaxationWake(turns=2, azimuth_step="15 deg", update_interval="90 deg")
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg")
    return wf.trim(uh60a.with_rigid_blades(), condition, inflow=coarse)


def wake(start, inflow):
    if inflow == "relaxation":
        return start.inflow
    return wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", convergence_revolutions=1)


@pytest.mark.parametrize("inflow", ["relaxation", "time-marching"])
def test_a_history_that_stays_is_the_flight_at_constant_speed(start, inflow):
    maneuver, model = wf.arrested_descent(), wake(start, inflow)
    constant = wf.fly(start, maneuver, model, revolutions=2, integrator="fixed").data
    steady = [(f"{k * float(constant.time[1])!r} s", 1.0) for k in (12, 30)]
    same = wf.fly(start, maneuver, model, revolutions=2, integrator="fixed", rotor_speed=steady).data
    for name in ("w", "q", "roll", "inflow", "power", "wake"):
        scale = np.abs(constant[name].values).max()
        assert np.abs(same[name].values - constant[name].values).max() < 1e-8 * scale, name


def test_a_slower_rotor_loses_the_lift_above_every_wake_that_it_loses_in_dynamic_inflow(uh60a, start):
    dynamic = wf.trim(uh60a.with_rigid_blades(), start.condition, inflow="dynamic")
    droop, lost = [("0.05 s", 1.0), ("0.25 s", 0.9)], {}
    for trimmed, inflow in ((dynamic, "dynamic"), (start, start.inflow), (start, wake(start, "time-marching"))):
        constant, slow = (
            wf.fly(trimmed, NOTHING, inflow, revolutions=2, integrator="fixed", rotor_speed=speed).data
            for speed in ("constant", droop)
        )
        # a revolution after the speed has begun to fall, when blades and inflow have followed and the aircraft sinks slowly
        then = (slow.time.values > 0.35) & (slow.time.values < 0.45)
        lift = [-run.force_z.interp(time=slow.time.values[then]).values.mean() for run in (constant, slow)]
        lost[wf.inflow_model(inflow).name] = 1.0 - lift[1] / lift[0]
    # less than the 19 % of the square: the inflow falls too
    assert 0.11 < lost["dynamic"] < 0.19
    assert max(lost.values()) - min(lost.values()) < 0.03, lost


@pytest.mark.parametrize("inflow", ["relaxation", "time-marching"])
@pytest.mark.parametrize("integrator", ["fixed", "ida"])
def test_engines_fail_above_a_wake_and_a_kept_flight_goes_on(start, inflow, integrator):
    sim = wf.Simulation(start, wake(start, inflow), integrator, rotor_speed=wf.GovernedEngine(failure="0.05 s"))
    speed = sim.model.layout["turn"][0] + 1

    def flown(sim):
        rows = []
        for _ in range(7):
            sim.step({"collective": 0.5})
            rows.append(np.concatenate([sim.y, [sim.t], sim.wake.ravel()]))
        return np.array(rows)

    flown(sim)
    for _ in range(12):
        sim.step({"collective": 0.5})
    kept = sim.snapshot()
    rest = flown(sim)
    sim.restore(wf.Snapshot.from_bytes(kept.to_bytes()))
    copy = pickle.loads(pickle.dumps(sim))
    assert np.array_equal(flown(sim), rest) and np.array_equal(flown(copy), rest)
    # the lag of the engines gives their power away slowly
    assert 0.95 < sim.y[speed] / sim.model.omega < 0.9999


def test_an_engine_failure_above_a_marching_wake_is_that_of_dynamic_inflow_in_the_mean(uh60a, start):
    dynamic = wf.trim(uh60a.with_rigid_blades(), start.condition, inflow="dynamic")
    falls = []
    for trimmed, inflow in ((dynamic, "dynamic"), (start, wake(start, "time-marching"))):
        fails = wf.FreeEngine(failure="0 s")
        run = wf.fly(trimmed, NOTHING, inflow, revolutions=4, integrator="fixed", rotor_speed=fails).data
        falls.append(float(run.rotor_speed[-1] - run.rotor_speed[0]) / float(run.time[-1]) / run.attrs["power"])
    assert falls[1] == pytest.approx(falls[0], rel=0.1)
