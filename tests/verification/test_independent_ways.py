# SPDX-License-Identifier: MIT OR Apache-2.0
"""Two ways to one number: solvers of the equations of motion, and the two free wakes at their common steady state."""

import numpy as np
import pytest
from climbing_rotor import CARADONNA, WAKE

import wakeflight as wf
from wakeflight import _core
from wakeflight.exchange import Exchange
from wakeflight.flight import Sticks
from wakeflight.flight_start import flight_model
from wakeflight.integrators import IdaIntegrator, absolute_tolerances, consistent_rate


@pytest.mark.parametrize("method", ["BDF", "Radau"])
def test_ida_agrees_with_another_implicit_solver_over_a_quarter_of_a_revolution(baseline_dynamic, method):
    # scipy_dae: other codes for F(t, y, y_dot) = 0, a backward difference formula and a Runge-Kutta method;
    # compared in units of what does not matter in flight, the absolute tolerances
    from scipy_dae.integrate import solve_dae

    start, model = baseline_dynamic, baseline_dynamic.model
    sticks = Sticks(wf.arrested_descent(), start.stick_si)
    t0 = 0.6
    t1 = t0 + 0.5 * np.pi / model.omega
    inputs = _core.Inputs(sticks.at(t0), sticks.rate(t0), t0, None, 0.0, start.stabilator_incidence)
    y0 = start.state(t0)
    y_dot0 = consistent_rate(model, t0, y0, inputs)
    solver = IdaIntegrator(model, rtol=1e-8, atol_scale=1e-3)
    solver.start(t0, y0, y_dot0)
    solver.advance_to(t1, inputs)

    def residual(t, y, y_dot):
        out = np.empty(y.size)
        model.core.residual(t, np.ascontiguousarray(y), np.ascontiguousarray(y_dot), inputs, out)
        return out

    def jacobian(t, y, y_dot, *_):
        by_y, by_rate = np.empty((y.size, y.size)), np.empty((y.size, y.size))
        held = (t, np.ascontiguousarray(y), np.ascontiguousarray(y_dot), inputs)
        model.core.jacobian(*held, (1.0, 0.0), by_y)
        model.core.jacobian(*held, (0.0, 1.0), by_rate)
        return by_y, by_rate

    atol = absolute_tolerances(model)
    other = solve_dae(residual, (t0, t1), y0, y_dot0, method=method, rtol=1e-8, atol=1e-3 * atol, jac=jacobian)
    assert other.success
    assert np.max(np.abs(solver.state - other.y[:, -1]) / atol) < 1.0


@pytest.fixture(scope="module")
def relaxed(uh60a):
    """Trim on a lone tip vortex at a coarse step, wake and controls in agreement more closely than by default."""
    wake = wf.RelaxationWake(trailers="tip", azimuth_step="15 deg", inflow_tolerance=1e-5, max_loops=100)
    return wf.trim(uh60a, inflow=wake, control_tolerance=1e-5)


@pytest.mark.parametrize(("scheme", "rms", "drift"), [("pcc", 0.035, 0.01), ("bdf2", 0.085, 0.013)])
def test_marching_settles_near_the_relaxed_wake_of_the_helicopter(relaxed, scheme, rms, drift):
    # relaxation is central in age and so is pcc: what is left is the step by which circulation lags its inflow in marching,
    # 3.0 per cent of the mean inflow at 15 deg, 1.7 at 7.5. bdf2 adds the error of a backward difference in age
    model = flight_model(
        relaxed, wf.TimeMarchingWake(trailers="tip", azimuth_step="15 deg", scheme=scheme, evaluation="pece")
    )
    loop = Exchange.marching(model, relaxed.wake)
    for _ in range(6):
        inflow, _ = loop.turn(relaxed.problem, relaxed.x)
    mean = model.disk_mean(relaxed.inflow_map)
    change = inflow - relaxed.inflow_map
    assert np.sqrt(np.mean(change**2 @ model.area_weights)) < rms * mean
    assert abs(model.disk_mean(change)) < drift * mean


@pytest.mark.parametrize("blade_model", ["lifting-line", "weissinger"])
def test_relaxed_and_marching_wakes_of_a_climbing_rotor_are_one(blade_model):
    # a climb carries the wake away and is steady for every blade: both solvers end at the same circulation, the central
    # scheme with the same truncation error as relaxation, bdf2 with its own
    given = {"collective": "12 deg", "climb": "15 m/s", "blade_model": blade_model}
    periodic = wf.RelaxationWake(**WAKE, inflow_tolerance=1e-8, max_loops=200)
    relaxed = wf.tunnel(CARADONNA, inflow=periodic, **given)
    crest = relaxed.data.circulation.values.max()
    for scheme, tolerance in (("pcc", 1e-5), ("bdf2", 1e-4)):
        marched = wf.tunnel(CARADONNA, inflow=wf.TimeMarchingWake(**WAKE, scheme=scheme), **given)
        assert marched.settled
        assert marched.ct == pytest.approx(relaxed.ct, rel=2e-5)
        assert marched.cq == pytest.approx(relaxed.cq, rel=2e-5)
        difference = marched.data.circulation.values - relaxed.data.circulation.values
        assert np.abs(difference).max() < tolerance * crest


def test_loads_of_a_marching_weissinger_blade_have_the_circulation_that_the_wake_was_given():
    # held at both lines of the chord, the inflow gives back the circulation it was found with, blade by blade; the exact
    # Jacobian on such a map is that of differences
    given = {"speed": "60 kt", "blade_model": "weissinger", "revolutions": 2}
    stand = wf.tunnel("uh60a", "8 deg", inflow=wf.TimeMarchingWake(**WAKE), **given)
    march, last = stand.solution.march, stand.solution.revolutions[-1]
    n = len(stand.model.stations)
    assert march.inflow.shape == (stand.model.n_blades, 2 * n)
    np.testing.assert_allclose(last.passages["circulation"][-1], march.circulation, rtol=1e-6, atol=1e-5)
    core, problem, x = stand.model.core, stand.solution.problem, stand.solution.x
    exact = core.trim_jacobian(problem, x)
    step = 1e-6
    for k in range(0, len(x), 7):
        ahead, behind = x.copy(), x.copy()
        ahead[k] += step
        behind[k] -= step
        difference = (core.trim_residual(problem, ahead) - core.trim_residual(problem, behind)) / (2 * step)
        np.testing.assert_allclose(exact[:, k], difference, rtol=1e-5, atol=1e-6 * np.abs(exact[:, k]).max())
