# SPDX-License-Identifier: MIT OR Apache-2.0
"""A collective that moves on the stand: the blades' own motion in time, thrust that overshoots and comes to rest."""

import numpy as np
import pytest
from climbing_rotor import CARADONNA, WAKE

import wakeflight as wf
from wakeflight import _core
from wakeflight.integrators import FixedIntegrator
from wakeflight.plotting import tunnel as drawing
from wakeflight.results import load, save
from wakeflight.trim.equations import resample


@pytest.fixture(scope="module")
def climbing():
    """The clamped rotor of Caradonna and Tung in a climb, where its wake is periodic."""
    return wf.tunnel(CARADONNA, "12 deg", climb="15 m/s", inflow=wf.TimeMarchingWake(**WAKE))


def test_blades_marched_in_time_find_the_periodic_motion_of_the_harmonic_balance():
    # elastic blades of the UH-60A in a wind, inflow of mid-step held over each step: two methods, one motion
    given = {"speed": "80 kt", "shaft_angle": "-4 deg", "lateral_cyclic": "2 deg", "longitudinal_cyclic": "-5 deg"}
    stand = wf.tunnel("uh60a", "14 deg", inflow=wf.RelaxationWake(**WAKE), **given)
    core, problem, x = stand.model.core, stand.solution.problem, stand.solution.x
    n = stand.model.steps_per_revolution
    mid = resample(stand.solution.inflow_map, 2 * n)[1::2]
    y = core.trim_state(problem, x, 0.0)[0]
    step, apart = 2 * np.pi / stand.model.omega / n, n // stand.model.n_blades * np.arange(stand.model.n_blades)
    solver, flap = FixedIntegrator(stand.model), []
    for k in range(4 * n):
        inputs = _core.Inputs([*x[:3], 0.0], np.zeros(4), k * step, mid[(k + apart) % n], 0.0, 0.0)
        rate = solver.consistent(k * step, y, inputs)
        if k == 0:
            solver.start(0.0, y, rate)
        solver.advance_to((k + 1) * step, inputs)
        y = solver.state
        flap.append(core.equivalent_angles(stand.model.modal(y)[0])[0][0])
    balance = core.equivalent_angles(core.trim_motion(problem, x, n)[0])[0]
    difference = np.array(flap[-n:]) - np.roll(balance, -1)
    assert np.ptp(balance) > np.radians(5.0)
    assert np.abs(difference).max() < np.radians(0.005)


def test_a_collective_that_is_held_changes_nothing(climbing):
    data = climbing.transient([], "0.1 s")
    assert np.ptp(data.ct.values) < 1e-5 * climbing.ct
    assert data.ct.values[0] == pytest.approx(climbing.ct, rel=1e-5)


def test_thrust_overshoots_a_ramp_and_ends_where_the_stand_is_at_the_new_collective(climbing, tmp_path):
    turn = 2 * np.pi / climbing.model.omega
    data = climbing.transient([("0.01 s", "14 deg")], f"{8 * turn} s")
    after = wf.tunnel(CARADONNA, "14 deg", climb="15 m/s", inflow=wf.TimeMarchingWake(**WAKE))
    assert np.degrees(data.theta_0.values[[0, -1]]) == pytest.approx([12.0, 14.0])
    assert data.ct.values[-1] == pytest.approx(after.ct, rel=1e-3)
    assert data.cq.values[-1] == pytest.approx(after.cq, rel=1e-3)
    # inflow follows the wake, which takes its time: the first thrust is that of the old inflow
    assert data.ct.values.max() > after.ct * 1.05
    assert data.inflow_mean.values[0] < data.inflow_mean.values[-1]
    assert data.wake.dims == ("time", "blade", "age", "xyz")
    assert load(save(data, tmp_path / "transient.nc")).equals(data)
    assert drawing.write_transient(data, tmp_path).stat().st_size > 10_000
    # the stand keeps its own wake
    assert climbing.transient([("0.01 s", "14 deg")], "0.02 s").ct.values[1] == data.ct.values[1]


@pytest.mark.parametrize(
    ("collective", "duration", "named"),
    [
        ("14 deg", "1 s", "pairs"),
        ([("0.1 s", "14")], "1 s", "collective"),
        ([("0.1 s", "14 deg"), ("0.05 s", "12 deg")], "1 s", "ascend"),
        ([("0 s", "14 deg")], "1 s", "does not jump"),
        ([("0.1 s", "14 deg")], "1", "duration"),
        ([("0.1 s", "14 deg")], "0 s", "duration"),
    ],
)
def test_bad_histories_name_the_field(climbing, collective, duration, named):
    with pytest.raises(wf.InputError, match=named):
        climbing.transient(collective, duration)


def test_states_of_inflow_are_carried_from_one_steady_rotor_to_the_other():
    # dynamic inflow in hover: what is held stays, a ramp overshoots and ends at the thrust of the new collective
    stand = wf.tunnel("uh60a", ct=0.004, inflow="dynamic")
    turn = 2 * np.pi / stand.model.omega
    assert np.ptp(stand.transient([], f"{turn} s").ct.values) < 1e-9
    target = float(np.degrees(stand.theta_0)) + 5.0
    data = stand.transient([("0.025 s", f"{target!r} deg")], f"{10 * turn} s")
    after = wf.tunnel("uh60a", f"{target!r} deg", inflow="dynamic")
    assert data.ct.values[-1] == pytest.approx(after.ct, rel=2e-3)
    assert 1.1 < data.ct.values.max() / after.ct < 1.4
    assert "wake" not in data


def test_a_transient_needs_inflow_that_moves():
    stand = wf.tunnel(CARADONNA, inflow="annular")
    with pytest.raises(wf.InputError, match="time-marching or dynamic"):
        stand.transient([], "0.1 s")
