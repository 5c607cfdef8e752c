"""The fixed-step integrator: its order, its agreement with IDA, its Newton iteration, its failures."""

import json

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import _core
from wakeflight.flight import Sticks
from wakeflight.integrators import FixedIntegrator, absolute_tolerances, consistent_rate
from wakeflight.model import resolution, setting


@pytest.fixture(scope="module")
def smooth(baseline_dynamic):
    """The aircraft in vacuum without lag dampers: F has no kink of a table, and every step shows the method's order."""
    model = baseline_dynamic.model
    data = json.loads(json.dumps(model.data))
    data["rotor"]["lag_damper"] = None
    d = model.aircraft.discretisation
    core = _core.System.aircraft(json.dumps(data), setting((1.0, 330.0), True, resolution(d, 20), 9.81))
    y = np.delete(baseline_dynamic.state(), slice(*model.layout["inflow"]))
    inputs = _core.Inputs(baseline_dynamic.stick_si, np.zeros(4), 0.0, None, 0.0, 0.0, vacuum=True)
    return core, y, inputs, model.omega, np.delete(absolute_tolerances(model), slice(*model.layout["inflow"]))


def flown(smooth, n_steps, share=1e-2):
    """State after a quarter of a revolution in `n_steps` steps, and the counters."""
    core, y, inputs, omega, atol = smooth
    solver = _core.FixedStep(core, 0.0, y, 1e-9, 1e-4 * atol, share)
    t1 = 0.5 * np.pi / omega
    solver.advance(core, t1, inputs, n_steps)
    return solver.state(), solver.counters()


def test_the_step_has_order_five(smooth):
    atol = smooth[-1]
    reference, _ = flown(smooth, 144)
    errors = [np.max(np.abs(flown(smooth, n)[0] - reference) / atol) for n in (9, 18, 36)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    # 10, 5 and 2.5 degrees; in the weights of the default tolerances the error at 10 degrees is of their own size
    assert np.all(orders > 4.5), (errors, orders)
    assert np.all(orders < 6.5), (errors, orders)


def test_energy_and_quaternion_stay(smooth):
    state, _ = flown(smooth, 9)
    assert np.linalg.norm(state[6:10]) == pytest.approx(1.0, abs=1e-14)


def test_newton_leaves_no_more_than_it_was_asked_to(smooth):
    atol = smooth[-1]
    tight, many = flown(smooth, 18, 1e-3)
    loose, few = flown(smooth, 18, 1.0)
    # no step was halved, iterations were saved
    assert few[5] == many[5] == 0
    assert few[3] < many[3]
    # what 18 steps leave adds up, each below the weights in the root mean square
    weights = 1e-4 * atol + 1e-9 * np.abs(tight)
    assert 1e-3 < np.sqrt(np.mean(((loose - tight) / weights) ** 2)) < 18.0


def test_keeping_derivatives_changes_nothing_that_the_tolerance_asks_for(baseline_dynamic, monkeypatch):
    flights = []
    for kept in (0.0, 20.0):
        monkeypatch.setattr(FixedIntegrator, "KEPT", kept)
        flights.append(wf.fly(baseline_dynamic, wf.roll_reversal(), revolutions=6, integrator="fixed").data)
    # a third of the linearisations, hardly more iterations: the dampers' kinks, which would cost them, are always new
    assert flights[1].attrs["jacobians"] <= 0.4 * flights[0].attrs["jacobians"]
    assert flights[1].attrs["newton_iterations"] < 1.1 * flights[0].attrs["newton_iterations"]
    for name in ("p", "q", "beta_1c", "ct"):
        a, b = (flight[name].values for flight in flights)
        assert np.max(np.abs(a - b)) < 5e-4 * np.max(np.abs(a)), name


def test_the_rate_it_finds_satisfies_the_equations(baseline_dynamic):
    start, model = baseline_dynamic, baseline_dynamic.model
    y, inputs, f = start.state(), start.inputs(), np.empty(model.layout["size"])
    for rate in (
        consistent_rate(model, 0.0, y, inputs),
        FixedIntegrator(model).consistent(0.0, y, inputs),
    ):
        model.core.residual(0.0, y, rate, inputs, f)
        assert np.max(np.abs(f)) < 1e-8


def test_a_coupling_step_agrees_with_an_explicit_solver_of_high_order(baseline_paper):
    from scipy.integrate import solve_ivp

    start = baseline_paper
    model = start.model
    sticks = Sticks(wf.arrested_descent(), start.stick_si)
    t0, t1 = 0.6, 0.6 + np.radians(10) / model.omega
    held = start.inflow_map[[0, 9, 18, 27]]
    inputs = _core.Inputs(sticks.at(t0), sticks.rate(t0), t0, held, model.disk_mean(held), start.stabilator_incidence)
    y0 = start.state(t0)
    reference = solve_ivp(
        lambda t, y: consistent_rate(model, t, y, inputs), (t0, t1), y0, method="DOP853", rtol=1e-10, atol=1e-12
    ).y[:, -1]
    scale = 1e-5 * np.abs(y0) + absolute_tolerances(model)
    errors = []
    for parts in (1, 4):
        solver = FixedIntegrator(model, rtol=1e-8, atol_scale=1e-3, parts=parts)
        solver.start(t0, y0, np.zeros_like(y0))
        solver.advance_to(t1, inputs)
        errors.append(np.sqrt(np.mean(((solver.state - reference) / scale) ** 2)))
    # kinks of the section tables inside the step take the order away; the error is still of the size of IDA's tolerance (in
    # the inflow of the standard wake 4.0 of its scale: other kinks are met)
    assert errors[0] < 3.0
    assert errors[1] < errors[0]


@pytest.mark.parametrize("inflow", ["dynamic", "time-marching"])
def test_a_flight_agrees_with_ida(inflow, request):
    # bounds: IDA's own error at its default tolerances, measured against tolerances a thousand times smaller
    start = request.getfixturevalue("baseline_dynamic" if inflow == "dynamic" else "baseline_relaxation")
    flights = [
        wf.fly(start, wf.roll_reversal(), inflow=inflow, revolutions=2, integrator=name, rtol=rtol).data
        for name, rtol in (("ida", 1e-7), ("fixed", 1e-5))
    ]
    for name, bound in (("u", 1e-5), ("p", 5e-3), ("beta_1c", 5e-3), ("ct", 2e-3), ("roll", 5e-3)):
        a, b = (flight[name].values for flight in flights)
        assert np.max(np.abs(a - b)) < bound * np.max(np.abs(a)), name


def test_a_corner_of_the_stick_inside_a_step_ends_a_piece(baseline_dynamic):
    # a ramp whose two corners lie inside steps of the 36: two pieces more
    model = baseline_dynamic.model
    corner = (18 + 1 / 3) * np.radians(10) / model.omega
    ramp = wf.Maneuver(
        "corner", (("collective", ((0.0, 0.0), (corner, 0.0), (corner + 0.1, 0.5), (1.0, 0.5))),), seconds=1.0
    )
    flights = [
        wf.fly(baseline_dynamic, ramp, inflow="dynamic", revolutions=1, integrator=name, rtol=rtol)
        for name, rtol in (("ida", 1e-8), ("fixed", 1e-5))
    ]
    assert flights[1].data.attrs["solver_steps"] == 38
    a, b = (flight.data["ct"].values for flight in flights)
    assert np.max(np.abs(a - b)) < 1e-3 * np.max(np.abs(a))


def test_a_state_that_cannot_be_flown_is_named(baseline_dynamic):
    model = baseline_dynamic.model
    y = baseline_dynamic.state()
    first = model.layout["modal"][0][0]
    y[first + model.rotor["flap_mode"]] = np.nan
    solver = FixedIntegrator(model)
    with pytest.raises(
        ArithmeticError, match=r"fixed step stopped at t = 0\.0000 s, azimuth .* equation of rotor.main.blade_0"
    ):
        solver.consistent(0.0, y, baseline_dynamic.inputs())


def test_a_failure_in_flight_keeps_what_was_computed(baseline_dynamic, monkeypatch):
    original = FixedIntegrator.advance_to
    steps = {"n": 0}

    def fails(self, t, inputs):
        steps["n"] += 1
        if steps["n"] > 12:
            raise ArithmeticError("made to fail")
        original(self, t, inputs)

    monkeypatch.setattr(FixedIntegrator, "advance_to", fails)
    with pytest.raises(wf.NumericalFailure, match="made to fail") as caught:
        wf.fly(baseline_dynamic, wf.roll_reversal(), inflow="dynamic", revolutions=1, integrator="fixed")
    assert caught.value.partial.data.sizes["time"] == 13
