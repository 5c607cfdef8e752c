"""Rigid blades in flight: what they are, the order of their explicit step, its agreement with IDA, its guard."""

import json

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import _core
from wakeflight.integrators import FixedIntegrator, absolute_tolerances
from wakeflight.model import resolution, setting


@pytest.fixture(scope="module")
def rigid(uh60a):
    return wf.trim(uh60a.with_rigid_blades(), inflow="dynamic")


def test_rigid_blades_have_their_hinge_modes_and_survive_other_choices(uh60a):
    rigid = uh60a.with_rigid_blades()
    assert uh60a.flexible and not rigid.flexible
    assert rigid.discretisation.n_modes == 2
    assert not rigid.discretised(n_gauss=6).flexible
    with pytest.raises(wf.InputError, match="hinges: lag and flap"):
        rigid.discretised(n_modes=3)
    with pytest.raises(wf.InputError, match="clamped"):
        wf.load_aircraft("bo105").with_rigid_blades()


def test_the_explicit_step_has_order_five(rigid):
    # in vacuum without lag dampers F has no kink of a table
    model, d = rigid.model, rigid.aircraft.discretisation
    data = json.loads(json.dumps(model.data))
    data["rotor"]["lag_damper"] = None
    core = _core.System.aircraft(json.dumps(data), setting((1.0, 330.0), True, resolution(d, 20), 9.81))
    inflow = slice(*model.layout["inflow"])
    y, atol = np.delete(rigid.state(), inflow), np.delete(absolute_tolerances(model), inflow)
    inputs = _core.Inputs(rigid.stick_si, np.zeros(4), 0.0, None, 0.0, 0.0, vacuum=True)

    def flown(n_steps):
        solver = _core.FixedStep.explicit(core, 0.0, y, 1e-5, atol)
        solver.advance(core, 0.5 * np.pi / model.omega, inputs, n_steps)
        assert solver.counters()[5] == 0
        return solver.state()

    reference = flown(144)
    errors = [np.max(np.abs(flown(n) - reference) / atol) for n in (6, 9, 18)]
    orders = np.log(np.divide(errors[:-1], errors[1:])) / np.log([1.5, 2.0])
    assert np.all(orders > 4.5) and np.all(orders < 6.5), (errors, orders)


def test_a_flight_with_rigid_blades_agrees_with_ida(rigid):
    # bounds: a few times the differences measured over six revolutions, 2e-5 to 8e-5
    flights = [
        wf.fly(rigid, wf.roll_reversal(), revolutions=6, integrator=name, rtol=rtol).data
        for name, rtol in (("ida", 1e-8), ("fixed", 1e-5))
    ]
    assert flights[1].attrs["integration_method"].startswith("explicit")
    assert flights[1].attrs["blades"] == "rigid"
    assert flights[1].attrs["halved_steps"] == 0
    for name, bound in (("p", 1e-4), ("q", 1e-4), ("beta_1c", 1e-4), ("ct", 1e-4), ("modal", 2e-4)):
        a, b = (flight[name].values for flight in flights)
        assert np.max(np.abs(a - b)) < bound * np.max(np.abs(a)), name


def test_rigid_blades_fly_on_a_free_wake(uh60a):
    start = wf.trim(uh60a.with_rigid_blades(), inflow="relaxation")
    # a stick that moves: beside its trim a flight hardly rolls
    step = wf.Maneuver("step", {"lateral": [(0.02, 0.0), (0.05, 0.2)]}, seconds=0.23)
    flights = [wf.fly(start, step, integrator=name, rtol=rtol).data for name, rtol in (("ida", 1e-7), ("fixed", 1e-5))]
    for name, bound in (("p", 2e-3), ("ct", 1e-3), ("beta_1c", 2e-3)):
        a, b = (flight[name].values for flight in flights)
        assert np.max(np.abs(a - b)) < bound * np.max(np.abs(a)), name


def test_a_step_too_long_is_halved_and_counted(rigid):
    # a quarter of a revolution at once: the guard halves it until it is as good as steps of its own size
    model, inputs = rigid.model, rigid.inputs()
    t1 = 0.5 * np.pi / model.omega
    solver = FixedIntegrator(model)
    solver.start(0.0, rigid.state(), np.zeros(0))
    solver.advance_to(t1, inputs)
    assert solver.statistics["halved_steps"] > 0
    fine = FixedIntegrator(model, parts=18)
    fine.start(0.0, rigid.state(), np.zeros(0))
    fine.advance_to(t1, inputs)
    weights = 1e-5 * np.abs(fine.state) + absolute_tolerances(model)
    assert np.sqrt(np.mean(((solver.state - fine.state) / weights) ** 2)) < 30.0


def test_a_state_that_cannot_be_flown_is_named(rigid):
    y = rigid.state()
    y[rigid.model.layout["modal"][0][0]] = np.nan
    with pytest.raises(
        ArithmeticError, match=r"fixed explicit step stopped at t = 0\.0000 s, .* worst in rotor.main.blade_0"
    ):
        FixedIntegrator(rigid.model).consistent(0.0, y, rigid.inputs())


def test_steps_do_not_go_on_from_the_memory_of_another_method(rigid):
    core, y = rigid.model.core, rigid.state()
    given = (core, 0.0, y, 1e-5, np.full(y.size, 1e-6))
    explicit, implicit = _core.FixedStep.explicit(*given), _core.FixedStep(*given, 0.3)
    for one, other in ((explicit, implicit), (implicit, explicit)):
        one.recall(core, one.memory())
        with pytest.raises(ValueError, match="memory of another method"):
            one.recall(core, other.memory())
        with pytest.raises(ValueError, match="cannot be read"):
            one.recall(core, b"nothing")
