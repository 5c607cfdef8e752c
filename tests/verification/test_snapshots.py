"""A flight that was kept goes on to the same bits: here, in a copy, in another process."""

import multiprocessing
import pickle

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.flight import Sticks
from wakeflight.recorder import Recorder
from wakeflight.thinning import thinned

INFLOW = ("dynamic", "relaxation", "time-marching")
MANEUVERS = {"arrested_descent": wf.arrested_descent, "roll_reversal": wf.roll_reversal}


def simulation(start, inflow, integrator, **more):
    model = inflow
    if inflow == "time-marching":
        model = wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", convergence_revolutions=1, **more)
        return wf.Simulation(start, model, integrator)
    return wf.Simulation(start, start.inflow if inflow == "relaxation" else model, integrator)


def sticks_of(sim, name):
    start = sim.start
    maneuver = MANEUVERS[name]().for_aircraft(start.aircraft.stick_travel_in, sim.model.omega)
    return Sticks(thinned(maneuver, sim.clock, 10_000), start.stick_si)


def flown(sim, sticks, n):
    """States of the next `n` steps, what the wake tells, and the counts at their end."""
    rows = []
    for _ in range(n):
        sim.follow(sticks)
        rows.append(np.concatenate([sim.y, *([] if sim.wake is None else [sim.wake.ravel()])]))
    return np.array(rows), sim.exchange.counters | sim.solver.statistics


def same(a, b):
    return np.array_equal(a[0], b[0]) and a[1] == b[1]


def check(sim, sticks, at, ahead):
    """Fly to every step of `at`, keep the flight there, go on; the kept ones follow the same bits."""
    kept = []
    for step in at:
        flown(sim, sticks, step - sim.steps)
        snapshot = sim.snapshot()
        kept.append((step, snapshot, flown(sim, sticks, ahead)))
    for step, snapshot, rest in reversed(kept):
        sim.restore(snapshot)
        assert sim.steps == step and sim.t == step * sim.delta_t
        assert same(flown(sim, sticks, ahead), rest), f"restored at step {step}"
    step, snapshot, rest = kept[0]
    sim.restore(wf.Snapshot.from_bytes(pickle.loads(pickle.dumps(snapshot)).to_bytes()))
    copy = pickle.loads(pickle.dumps(sim))
    for each in (sim, copy):
        assert same(flown(each, sticks, ahead), rest), f"pickled at step {step}"


@pytest.mark.parametrize("blades", ["flexible", "rigid"])
@pytest.mark.parametrize("integrator", ["fixed", "ida"])
@pytest.mark.parametrize("inflow", INFLOW)
def test_a_kept_flight_goes_on_to_the_same_bits(starts, inflow, integrator, blades):
    rng = np.random.default_rng([INFLOW.index(inflow), integrator == "ida", blades == "rigid"])
    sim = simulation(starts[blades, inflow], inflow, integrator)
    for name in MANEUVERS:
        sim = sim if sim.steps == 0 else simulation(starts[blades, inflow], inflow, integrator)
        gaps = rng.integers(1, 6, 3)
        # each flight goes on 4 steps beyond where it was kept
        check(sim, sticks_of(sim, name), np.cumsum(gaps + 4) - 4, 4)


@pytest.mark.parametrize(
    "options",
    [
        {"inboard_wake": "sheet"},
        {"update_interval": "90 deg", "extrapolate": True},
        {"recorrect": 1, "scheme": "pc2b", "time_filter": 0.05},
        {"evaluation": "pec"},
    ],
    ids=lambda options: next(iter(options)),
)
def test_every_state_of_the_marching_wake_is_kept(starts, uh60a, options):
    start = starts["rigid", "relaxation"]
    if "inboard_wake" in options:
        coarse = wf.RelaxationWake(turns=2, azimuth_step="15 deg", inboard_wake="sheet")
        start = wf.trim(uh60a.with_rigid_blades(), start.condition, inflow=coarse)
    sim = simulation(start, "time-marching", "fixed", **options)
    check(sim, sticks_of(sim, "roll_reversal"), [7], 5)


def test_a_kept_servo_goes_on(starts):
    sim = wf.Simulation(starts["rigid", "dynamic"], stabilator="scheduled")
    check(sim, sticks_of(sim, "arrested_descent"), [9, 40], 5)
    assert sim.snapshot().scalars["stabilator"] != sim.start.stabilator_incidence


def test_fixed_steps_do_not_notice_a_snapshot_and_ida_begins_anew_there(starts):
    for integrator, exact in (("fixed", True), ("ida", False)):
        one, two = (wf.Simulation(starts["flexible", "dynamic"], integrator=integrator) for _ in range(2))
        sticks = sticks_of(one, "roll_reversal")
        flown(one, sticks, 7), flown(two, sticks, 7)
        one.snapshot()
        a, b = flown(one, sticks, 7)[0], flown(two, sticks, 7)[0]
        assert np.array_equal(a, b) == exact
        # within what the solver's tolerances allow of body rates [rad/s]
        assert np.abs(a - b)[:, 3:6].max() < 1e-4


@pytest.mark.parametrize("integrator", ["fixed", "ida"])
def test_a_flight_is_its_steps(starts, integrator):
    # sticks held: stepped by hand and flown as a manoeuvre, the same bits
    start = starts["flexible", "dynamic"]
    hold = wf.Maneuver("hold", {"lateral": [(0.0, 0.0), (0.1, 0.0)]}, revolutions=0.5)
    data = wf.fly(start, hold, integrator=integrator).data
    sim = wf.Simulation(start, integrator=integrator)
    rows = [sim.y[:6], *(sim.step().y[:6] for _ in range(data.sizes["time"] - 1))]
    assert np.array_equal(np.array(rows), np.array([data[name].values for name in "uvwpqr"]).T)
    assert sim.t == float(data.time[-1])


def test_a_ramp_by_steps_is_the_manoeuvre_of_the_same_corners(starts):
    start = starts["rigid", "dynamic"]
    sim = wf.Simulation(start)
    dt, push = sim.delta_t, [0.1, 0.2, 0.3, 0.3, 0.1]
    corners = [(0.0, 0.0), *((dt * (k + 1), inches) for k, inches in enumerate(push))]
    data = wf.fly(start, wf.Maneuver("push", {"lateral": corners}, seconds=5 * dt), integrator="fixed").data
    for inches in push:
        sim.step({"lateral": inches})
    flown_by_steps = sim.y[:6]
    assert np.allclose(flown_by_steps, [data[name].values[-1] for name in "uvwpqr"], rtol=0, atol=1e-10)


def continued(packed):
    sim, steps = pickle.loads(packed)
    for _ in range(steps):
        sim.step({"pedal": 0.2})
    return sim.y.tobytes()


def test_another_process_goes_on_to_the_same_bits(starts):
    sims = [simulation(starts["flexible", inflow], inflow, "fixed") for inflow in INFLOW]
    for sim in sims:
        sim.step({"lateral": 0.3})
    packed = [pickle.dumps((sim, 6)) for sim in sims]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.map(continued, packed)
    assert there == [continued(each) for each in packed]
    for sim, y in zip(sims, there, strict=True):
        for _ in range(6):
            sim.step({"pedal": 0.2})
        assert sim.y.tobytes() == y


def test_what_hangs_on_a_simulation_does_not_change_it(starts):
    one, two = (simulation(starts["flexible", "time-marching"], "time-marching", "fixed") for _ in range(2))
    sticks = sticks_of(one, "roll_reversal")
    recorder = Recorder(one, MANEUVERS["roll_reversal"](), 12)
    for _ in range(12):
        one.follow(sticks, recorder.record)
        assert one.loads["force"] and one.state.t == one.t
        two.follow(sticks)
    assert np.array_equal(one.y, two.y)


@pytest.mark.slow
@pytest.mark.parametrize("blades", ["flexible", "rigid"])
@pytest.mark.parametrize("integrator", ["fixed", "ida"])
@pytest.mark.parametrize("inflow", INFLOW)
@pytest.mark.parametrize("name", MANEUVERS)
def test_twenty_moments_of_a_whole_manoeuvre(starts, name, inflow, integrator, blades):
    sim = simulation(starts[blades, inflow], inflow, integrator)
    rng = np.random.default_rng(7)
    check(sim, sticks_of(sim, name), np.sort(rng.choice(np.arange(1, 40), 20, replace=False)) * 9, 8)
