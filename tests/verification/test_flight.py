"""Flight: a trimmed aircraft stays, the coupling adds nothing of its own, threads change no bit, solvers agree."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import _core
from wakeflight.flight import Sticks
from wakeflight.integrators import IdaIntegrator, consistent_rate
from wakeflight.model import Model
from wakeflight.report.load_factor import load_factor

STILL = wf.Maneuver("hands off", (("lateral", ((0.0, 0.0), (1.0, 0.0))),), seconds=1.0)


def largest(flight, names, about_start=False):
    values = [np.degrees(flight.data[name].values) for name in names]
    return max(np.abs(v - v[0]).max() if about_start else np.abs(v).max() for v in values)


def test_trimmed_flight_with_sticks_held_stays_for_a_second(baseline_dynamic):
    flight = wf.fly(baseline_dynamic, STILL, inflow="dynamic")
    assert largest(flight, "pqr") < 0.5
    assert largest(flight, ("roll", "pitch", "yaw"), about_start=True) < 0.5


@pytest.mark.parametrize("inflow", ["time-marching", "relaxation"])
def test_trimmed_flight_with_a_free_wake_drifts_slowly(baseline_relaxation, inflow):
    # the marching wake drifts from the relaxation trim by its own inflow; bounds are twice what was measured
    flight = wf.fly(baseline_relaxation, STILL, inflow=inflow)
    assert largest(flight, "pqr") < 1.2
    assert largest(flight, ("roll", "pitch", "yaw"), about_start=True) < 0.8


def test_a_trim_on_the_marched_wake_is_where_its_flight_stays_as_one_on_dynamic_inflow(
    baseline_dynamic, baseline_marching
):
    # what is left with dynamic inflow is that a trim holds the body still, which in flight shakes at four per revolution
    moved = []
    for start, inflow in ((baseline_dynamic, "dynamic"), (baseline_marching, "time-marching")):
        run = wf.fly(start, STILL, inflow=inflow, integrator="fixed").data
        turn = round(2 * np.pi / 27.0 / float(run.time[1] - run.time[0]))
        rates = np.degrees([run[name].values[: len(run.time) // turn * turn] for name in "pqr"])
        means = rates.reshape(3, -1, turn).mean(axis=2)
        moved.append(np.abs(means - means[:, :1]).max())
        assert all(np.degrees(np.ptp(run[name].values)) < 0.2 for name in ("roll", "pitch", "yaw"))
    # deg/s; 0.9 where inflow that a flight holds was trimmed on as the wake gives it
    assert moved[1] < 1.2 * moved[0] < 0.2


def test_the_result_has_the_same_bits_with_one_thread_and_with_two(baseline_relaxation):
    flights = []
    for threads in (1, 2):
        _core.set_threads(threads)
        flights.append(wf.fly(baseline_relaxation, wf.arrested_descent(), inflow="time-marching", revolutions=1))
    for name in flights[0].data.data_vars:
        assert np.array_equal(flights[0].data[name].values, flights[1].data[name].values), name


def test_ida_agrees_with_an_explicit_solver_of_high_order_over_a_coupling_step(baseline_paper):
    from scipy.integrate import solve_ivp

    start = baseline_paper
    model = start.model
    sticks = Sticks(wf.arrested_descent(), start.stick_si)
    t0, t1 = 0.6, 0.6 + np.radians(10) / model.omega
    held = start.inflow_map[[0, 9, 18, 27]]
    inputs = _core.Inputs(sticks.at(t0), sticks.rate(t0), t0, held, model.disk_mean(held), start.stabilator_incidence)
    y0 = start.state(t0)
    solver = IdaIntegrator(model, rtol=1e-8, atol_scale=1e-3)
    solver.start(t0, y0, consistent_rate(model, t0, y0, inputs))
    solver.advance_to(t1, inputs)
    reference = solve_ivp(
        lambda t, y: consistent_rate(model, t, y, inputs), (t0, t1), y0, method="DOP853", rtol=1e-10, atol=1e-12
    ).y[:, -1]
    scale = np.maximum(np.abs(reference - y0), 1e-6)
    assert np.max(np.abs(solver.state - reference) / scale) < 1e-4


@pytest.mark.parametrize(
    ("maneuver", "stick", "low", "high"),
    [(wf.arrested_descent, "collective", 0.0, 3.7), (wf.roll_reversal, "lateral", 2.59 - 7.72, 2.59)],
)
def test_stick_histories_are_those_of_the_paper(maneuver, stick, low, high):
    # [ribera2004, Fig. 5a, 12a]: extremes about trim, and where they are reached
    history = maneuver()
    times = np.linspace(0, history.duration(27.0), 2000)
    offsets = np.array([history.offset(t) for t in times])
    column = ("lateral", "longitudinal", "collective", "pedal").index(stick)
    assert offsets[:, column].min() == pytest.approx(low, abs=0.02)
    assert offsets[:, column].max() == pytest.approx(high, abs=0.02)
    others = np.delete(offsets, column, axis=1)
    assert np.all(others == 0)


def test_a_flight_of_the_wrong_inflow_model_is_refused(baseline_dynamic):
    with pytest.raises(wf.InputError, match="needs a trim with inflow='relaxation'"):
        wf.fly(baseline_dynamic, STILL, inflow="time-marching")


def test_wake_options_that_differ_from_those_of_the_trim_are_refused(baseline_relaxation):
    with pytest.raises(wf.InputError, match="turns = 3"):
        wf.fly(baseline_relaxation, STILL, inflow=wf.TimeMarchingWake(turns=3.0))


def test_a_failure_in_flight_keeps_what_was_computed(baseline_dynamic, monkeypatch):
    # a solver that gives up in the second revolution leaves the first in the partial flight
    steps = {"n": 0}
    original = IdaIntegrator.advance_to

    def fails(self, t, inputs):
        steps["n"] += 1
        if steps["n"] > 40:
            raise wf.NumericalFailure("made to fail")
        original(self, t, inputs)

    monkeypatch.setattr(IdaIntegrator, "advance_to", fails)
    with pytest.raises(wf.NumericalFailure, match=r"revolution 1\.11: made to fail") as caught:
        wf.fly(baseline_dynamic, STILL, inflow="dynamic")
    data = caught.value.partial.data
    assert data.attrs["finished"] == 0
    assert "made to fail" in data.attrs["failure"]
    assert data.sizes["time"] == 41
    assert np.isfinite(data["u"].values).all()


def test_the_exact_jacobian_is_that_of_the_whole_aircraft(baseline_dynamic):
    # directional derivative through all states and their rates against central differences
    start, model = baseline_dynamic, baseline_dynamic.model
    assert isinstance(model, Model)
    y = start.state()
    inputs = start.inputs()
    y_dot = consistent_rate(model, 0.0, y, inputs)
    n = y.size
    jacobian = np.empty((n, n))
    model.core.jacobian(0.0, y, y_dot, inputs, (1.0, 37.0), jacobian)
    rng = np.random.default_rng(3)
    for _ in range(5):
        d = rng.standard_normal(n) * 1e-3
        f = [np.empty(n), np.empty(n)]
        h = 1e-4
        for sign, out in zip((1, -1), f, strict=True):
            model.core.residual(0.0, y + sign * h * d, y_dot + sign * h * 37.0 * d, inputs, out)
        difference = (f[0] - f[1]) / (2 * h)
        exact = jacobian @ d
        assert np.max(np.abs(exact - difference)) < 1e-6 * np.max(np.abs(exact))


def test_a_scheduled_stabilator_moves_no_faster_than_its_servo(baseline_dynamic):
    flight = wf.fly(baseline_dynamic, wf.arrested_descent(), inflow="dynamic", revolutions=6, stabilator="scheduled")
    incidence, time = np.degrees(flight.data["stabilator"].values), flight.data["time"].values
    rate = np.abs(np.diff(incidence) / np.diff(time))
    assert rate.max() == pytest.approx(7.0, rel=1e-6)
    # the pitch-up and the raised collective ask for more incidence
    assert incidence[-1] > incidence[0] + 1.0


def test_a_flight_without_a_convergence_phase_is_recorded(baseline_relaxation):
    # the wake has not been stepped when the first record is made
    wake = wf.TimeMarchingWake(convergence_revolutions=0)
    data = wf.fly(baseline_relaxation, wf.arrested_descent(), inflow=wake, revolutions=0.25).data
    assert np.all(np.isfinite(data["vortex_blade_distance"].values))


def test_the_load_factor_of_the_report_is_what_the_sensors_show(baseline_dynamic):
    # in a steady descent g cos theta cos phi, one per cent below 1; the loads on the airframe have the blades' weight in them
    flight = wf.fly(baseline_dynamic, wf.arrested_descent(), inflow="dynamic", revolutions=5, integrator="fixed")
    found = load_factor(flight.data)
    assert found[:36].mean() == pytest.approx(np.cos(baseline_dynamic.pitch) * np.cos(baseline_dynamic.roll), abs=3e-3)
    assert found.max() > 1.3
    seen = []

    class Watch(wf.Controller):
        outputs = ()

        def step(self, t, sensors, stick):
            seen.append(sensors.load_factor)
            return {}

    wf.fly(
        baseline_dynamic,
        wf.arrested_descent(),
        inflow="dynamic",
        revolutions=5,
        integrator="fixed",
        control=Watch(),
    )
    steps = min(len(seen), found.size - 1)
    assert np.abs(found[2:steps] - np.array(seen[2:steps])).max() < 0.03 * found.max()
