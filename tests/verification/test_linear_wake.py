"""Linear models of a trim on a free wake: frozen, and following at once as the relaxation wake does."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.linear.quasi_static import wake_gains

COARSE = {"azimuth_step": "15 deg", "turns": 2, "trailers": "tip"}


@pytest.fixture(scope="module")
def start():
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
    return wf.trim(wf.load_aircraft("uh60a"), condition, inflow=wf.RelaxationWake(**COARSE))


@pytest.fixture(scope="module")
def models(start):
    return {wake: wf.linearize(start, wake=wake) for wake in ("frozen", "quasi-static")}


def derivative(model, row, column):
    return float(model.reduce(8).A.sel(state=row, state_=column))


def test_inflow_that_follows_takes_a_third_of_the_heave_damping(models):
    frozen, following = (derivative(models[wake], "w", "w") for wake in ("frozen", "quasi-static"))
    assert frozen < following < 0.0 and following / frozen == pytest.approx(0.65, abs=0.12)


def test_inflow_that_follows_is_like_dynamic_inflow_and_frozen_inflow_is_not(models, start):
    dynamic = wf.linearize(wf.trim(start.aircraft, start.condition, inflow="dynamic"))
    # a lone tip vortex answers the moments of the disk less than thrust
    for row, column, share in (("w", "w", 0.5), ("q", "q", 0.8)):
        known = derivative(dynamic, row, column)
        off = {wake: abs(derivative(model, row, column) - known) for wake, model in models.items()}
        assert off["quasi-static"] < share * off["frozen"], (row, column, known, off)


def test_a_frozen_wake_has_the_sections_of_a_frozen_dynamic_inflow(models):
    assert len(models["frozen"].states) == len(models["quasi-static"].states)
    assert not [name for name, _ in models["frozen"].states if name.startswith("inflow")]
    assert models["quasi-static"].attributes["wake_curvature"] < 0.25


def test_the_wakes_answer_is_that_of_momentum_theory_in_the_mean(start):
    # more collective pitch, more thrust, more inflow; a climb's own flow through the disk takes some of it away
    gains = wake_gains(start).first_harmonics(start.model)
    assert gains["theta_0"][0] > 0.0 and gains["w"][0] > 0.0
    # a pitch rate makes the disk lag behind and its own wake curve: more inflow over the tail
    assert gains["q"][1] > 0.0


def test_the_wake_flown_answers_as_the_following_one_does_and_not_as_the_frozen_one(start, models):
    time, flown = None, []
    for side in (0.2, -0.2):
        step = wf.Maneuver("step", {"longitudinal": [(0.1, 0.0), (0.15, side), (2.0, side)]}, seconds=1.5)
        wake = wf.TimeMarchingWake(**COARSE)
        data = wf.fly(start, step, inflow=wake, integrator="fixed").data
        time, flown = data["time"].values, [*flown, {name: data[name].values for name in ("p", "q", "w")}]
    fine = np.linspace(0.0, time[-1], 3001)
    off = {}
    for wake, model in models.items():
        found = model.response(fine, {"longitudinal": 0.2 * np.clip((fine - 0.1) / 0.05, 0.0, 1.0)})
        for name in ("p", "q", "w"):
            real = 0.5 * (flown[0][name] - flown[1][name])
            off[wake, name] = np.abs(np.interp(time, fine, found[name].values) - real).max() / np.abs(real).max()
    assert off["quasi-static", "q"] < 0.08 and off["quasi-static", "w"] < 0.08
    for name in "pw":
        assert off["quasi-static", name] < 0.6 * off["frozen", name], off


def test_a_wake_must_be_chosen_of_those_that_there_are(start):
    for wake, said in (
        (None, "states, identified, quasi-static, frozen"),
        ("dynamic", "quasi-static"),
    ):
        with pytest.raises(wf.InputError, match=said):
            wf.linearize(start, wake=wake)
    with pytest.raises(wf.InputError, match="azimuths"):
        wf.linearize(start, wake="frozen", azimuths=36)


def test_in_hover_no_periodic_wake_is_found_and_it_is_said_how_far_one_was():
    aircraft = wf.load_aircraft("uh60a")
    condition = wf.FlightCondition(speed="10 kt", flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
    try:
        start = wf.trim(aircraft, condition, inflow=wf.RelaxationWake(**COARSE))
    except wf.NumericalFailure:
        pytest.skip("no trim on this wake here")
    try:
        found = wf.linearize(start, wake="quasi-static")
    except wf.NumericalFailure as reason:
        assert "no periodic wake" in str(reason) and "an iteration" in str(reason)
    else:
        assert np.isfinite(found.attributes["wake_curvature"])
