# SPDX-License-Identifier: MIT OR Apache-2.0
"""The second-order lifting line in flight: what the blades feel is what the circulation was solved with, its derivatives are
those of the equations, trims and flights go through it and are kept with the same bits; what knows none of it says so by name."""

import pickle

import numpy as np
import pytest

import wakeflight as wf

COARSE = {"azimuth_step": "15 deg", "turns": 2, "n_stations": 12}
FAST = wf.FlightCondition(speed="80 kt", flight_path="0 deg")


@pytest.fixture(scope="module", params=["elastic", "rigid"])
def aircraft(request, uh60a):
    return uh60a if request.param == "elastic" else uh60a.with_rigid_blades()


@pytest.fixture(scope="module")
def trims(aircraft):
    models = ("lifting-line", "second-order")
    return [wf.trim(aircraft, FAST, inflow=wf.RelaxationWake(**COARSE, blade_model=model)) for model in models]


def test_a_trim_holds_two_lines_and_tells_the_first(trims):
    first, second = trims
    n = second.model.stations.size
    assert first.inflow_map.shape[1] == n and second.inflow_map.shape[1] == 2 * n
    data = second.to_dataset()
    assert np.array_equal(data["inflow"], second.inflow_map[:, :n])
    assert second.mean_outputs()["inflow_mean"] == second.model.disk_mean(second.inflow_map)
    # slender blades: power and thrust are nearly those of the lifting line, loads at the tip are not quite
    power = [each.mean_outputs()["power"] for each in trims]
    assert power[1] == pytest.approx(power[0], rel=0.05)
    tip = [np.mean(each.circulation[:, -1]) for each in trims]
    assert tip[1] < 0.98 * tip[0]


def test_blades_feel_the_air_that_their_circulation_was_solved_with(trims):
    _, start = trims
    wake = pickle.loads(pickle.dumps(start.wake))
    two_lines = wake.converge(start.problem, start.x)
    psi = 2 * np.pi * np.arange(two_lines.shape[0]) / two_lines.shape[0]
    felt = start.model.core.passages(start.problem, start.x, psi, two_lines)["circulation"]
    assert np.abs(felt - wake.circulation).max() < 1e-6 * np.abs(felt).max()


def test_derivatives_of_a_trim_on_two_lines_are_those_of_its_equations(trims):
    _, start = trims
    core, x = start.model.core, start.x
    exact = core.trim_jacobian(start.problem, x)
    for column in (0, 1, 2, 5, 8, x.size - 1):
        step = np.zeros_like(x)
        step[column] = 1e-7
        up, down = (core.trim_residual(start.problem, x + sign * step) for sign in (1.0, -1.0))
        difference = (up - down) / 2e-7
        # kinks of the section tables are in few azimuths
        assert np.abs(difference - exact[:, column]).max() < 2e-3 * np.abs(exact[:, column]).max()


def test_a_flight_goes_on_from_a_snapshot_with_the_same_bits_and_is_recorded(trims):
    _, start = trims
    marching = wf.TimeMarchingWake(**COARSE, blade_model="second-order", convergence_revolutions=1)
    sim = wf.Simulation(start, inflow=marching)
    for _ in range(4):
        sim.step({"lateral": 0.5})
    kept, seen = sim.snapshot(), []
    for _ in range(2):
        for _ in range(4):
            sim.step({"lateral": 0.5})
        seen.append(sim.y)
        sim.restore(kept)
    assert np.array_equal(*seen)
    data = wf.fly(start, wf.roll_reversal(), inflow=marching, revolutions=0.25, integrator="fixed").data
    assert data["inflow"].shape[1:] == (4, 12) and data["inflow_start"].shape == (24, 12)
    assert np.ptp(data["roll"].values) < np.radians(1.0)


def test_what_knows_no_second_line_says_so(trims):
    _, start = trims
    with pytest.raises(wf.InputError, match="blade_model = 'second-order': must be lifting-line for linearize"):
        wf.linearize(start)
    with pytest.raises(wf.InputError, match=r"blade_model = 'second-order'.* an argument of the stand itself"):
        wf.tunnel(wf.load_rotor("uh60a"), inflow=wf.RelaxationWake(blade_model="second-order"), thrust="70 kN")
    with pytest.raises(wf.InputError, match="blade_model"):
        wf.DynamicInflow(blade_model="second-order")
    with pytest.raises(wf.InputError, match="unsteady = 'oye': must be quasi-steady"):
        wf.RelaxationWake(blade_model="second-order", unsteady="oye")
    with pytest.raises(wf.InputError, match="near_wake_angle = 0 deg: must be above 0"):
        wf.RelaxationWake(blade_model="second-order", near_wake_angle="0 deg")
