# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim, stand and flight say the same of themselves: limits are told, what no rotor can give ends them by name."""

import dataclasses
from importlib import import_module

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.exchange import Exchange
from wakeflight.monitors import vortices
from wakeflight.trim import physical

HOLD = wf.Maneuver("hold", (("lateral", ((0.0, 0.0), (0.1, 0.0))),), seconds=0.5)
WATCHED = ("inflow_max", "inflow_bound", "mach_max", "mach_bound", "alpha_min", "alpha_max", "stalled_share")
WATCHED += ("reversed_share", "hover_inflow", "mu_z")


@pytest.fixture(scope="module")
def fast(uh60a):
    return wf.trim(uh60a, wf.FlightCondition(speed="190 kt", flight_path="0 deg"), inflow="dynamic")


@pytest.fixture(scope="module")
def stand():
    return wf.tunnel("uh60a", ct=0.006, speed="60 kt", flapping="zero", inflow="relaxation", blades="rigid")


def test_every_monitor_is_in_the_dataset_with_unit_and_meaning(baseline_relaxation, stand):
    flight = wf.fly(baseline_relaxation, HOLD, inflow="time-marching", integrator="fixed").data
    for data in (baseline_relaxation.to_dataset(), stand.data, flight):
        for name in WATCHED:
            assert np.isfinite(data[name]).all(), name
            assert data[name].attrs["units"] and data[name].attrs["long_name"]
        assert data.attrs["failure"] == ""
    assert flight["stick_margin"].dims == flight["height"].dims == ("time",)
    assert float(flight["height"][0]) == pytest.approx(baseline_relaxation.condition.altitude)


def test_a_trim_beyond_the_stops_is_told_and_so_is_a_flight_from_it(fast):
    assert fast.stick["collective"] > fast.aircraft.stick_travel_in[2]
    (told,) = (text for text in fast.warnings if "collective" in text)
    assert "beyond its stop at 10 in" in told and told in fast.table()
    assert told in fast.to_dataset().attrs["warnings"]
    assert float(fast.to_dataset().stick_margin) == pytest.approx(10.0 - fast.stick["collective"])
    flight = wf.fly(fast, HOLD, inflow="dynamic", integrator="fixed")
    assert f"trim: {told}" in flight.warnings
    assert any(text.startswith(told) and "from t = 0.00 s" in text for text in flight.warnings)


def test_power_beyond_the_stated_limit_is_told(fast):
    limit = fast.aircraft.limits.power
    assert limit is not None and float(fast.to_dataset().power) > limit
    assert any(text.startswith("power ") and "beyond the aircraft's 2109 kW" in text for text in fast.warnings)


def test_ordinary_flight_has_nothing_to_be_told(baseline_dynamic, baseline_relaxation):
    assert baseline_dynamic.warnings == baseline_relaxation.warnings == ()
    assert wf.fly(baseline_dynamic, HOLD, inflow="dynamic", integrator="fixed").warnings == ()


def test_a_trim_beyond_physics_is_raised_and_kept(baseline_relaxation):
    spoiled = baseline_relaxation.inflow_map.copy()
    spoiled[18, 0] = -0.98
    found = dataclasses.replace(baseline_relaxation, inflow_map=spoiled)
    with pytest.raises(wf.NumericalFailure, match=r"trim: .* 0\.98 of the tip speed at psi = 180 deg") as caught:
        physical(found)
    assert caught.value.partial is found
    assert "0.98 of the tip speed" in found.to_dataset().attrs["failure"]
    assert physical(baseline_relaxation) is baseline_relaxation


def test_a_stand_beyond_physics_ends_with_what_it_computed(stand, monkeypatch):
    # an inflow map no vortex can give: the solution is kept, and is no result
    spoiled = stand.solution.inflow_map.copy()
    spoiled[9, -1] = 0.98
    false = dataclasses.replace(stand.solution, inflow_map=spoiled)
    monkeypatch.setattr(import_module("wakeflight.tunnel"), "solution", lambda *_: false)
    with pytest.raises(wf.NumericalFailure, match=r"0\.98 of the tip speed at psi = 90 deg, r/R = 0\.999") as caught:
        wf.tunnel("uh60a", ct=0.006, speed="60 kt", flapping="zero", inflow="relaxation", blades="rigid")
    assert "0.98 of the tip speed" in caught.value.partial.data.attrs["failure"]


def test_a_stand_says_where_its_blades_leave_the_tables():
    found = wf.tunnel("uh60a", ct=0.004, speed="130 m/s", flapping="zero", inflow="dynamic", blades="rigid")
    (told,) = (text for text in found.warnings if "Mach" in text)
    assert "beyond the 1 of the section tables" in told and "psi = " in told and told in found.notes


def test_a_descent_in_the_vortex_ring_range_is_told_by_every_model():
    # half and twice the hover induced velocity of C_T 0.006: 6 to 24 m/s
    given = dict(ct=0.006, climb="-8 m/s", blades="rigid")
    (told,) = wf.tunnel("uh60a", inflow="dynamic", **given).warnings
    assert "curve through scattered tests" in told
    short = wf.RelaxationWake(turns=2, azimuth_step="30 deg", near_wake_angle="30 deg", n_stations=10)
    assert any("turns kept" in text for text in wf.tunnel("uh60a", inflow=short, **given).warnings)


def test_an_unphysical_sample_stops_the_flight_by_name(baseline_relaxation, monkeypatch):
    # inflow spoiled from the eleventh exchange on: everything before it is kept, nothing after
    true = Exchange.held

    def spoiled(self, step):
        inflow, *more = true(self, step)
        return inflow * (100.0 if step > 10 else 1.0), *more

    monkeypatch.setattr(Exchange, "held", spoiled)
    with pytest.raises(wf.NumericalFailure, match=r"of the tip speed at t = .* s, blade .* psi = .* r/R = ") as caught:
        wf.fly(baseline_relaxation, HOLD, inflow="relaxation", integrator="fixed")
    data = caught.value.partial.data
    assert data.sizes["time"] == 11 and data.attrs["finished"] == 0
    assert float(abs(data["inflow"]).max()) < float(data["inflow_bound"].min())


def test_a_flight_that_fails_before_its_first_sample_leaves_nothing(baseline_relaxation, monkeypatch):
    true = Exchange.held
    monkeypatch.setattr(Exchange, "held", lambda self, step: (100.0 * true(self, step)[0], *true(self, step)[1:]))
    with pytest.raises(wf.NumericalFailure, match=r"of the tip speed at t = 0\.000 s") as caught:
        wf.fly(baseline_relaxation, HOLD, inflow="relaxation", integrator="fixed")
    assert caught.value.partial is None


def test_a_flight_through_the_ground_says_so(uh60a):
    condition = wf.FlightCondition(speed="80 kt", flight_path="-20 deg", altitude="3 m")
    flight = wf.fly(wf.trim(uh60a, condition, inflow="dynamic"), HOLD, inflow="dynamic", integrator="fixed")
    assert any("below sea level, from t = 0.2" in text for text in flight.warnings)
    assert float(flight.data.height[-1]) == pytest.approx(3.0 - float(flight.data.down[-1]))


def test_the_closest_vortex_of_a_wake_is_found_as_the_marching_wake_finds_it(baseline_relaxation):
    # one instant of a marching wake, by the core and by the arrays that a periodic wake is looked at with
    start, model = baseline_relaxation, baseline_relaxation.model
    march = Exchange.marching(dataclasses.replace(model, inflow=wf.TimeMarchingWake().resolved("forward")), start.wake)
    march.frozen_step(start.problem, start.x)
    found = vortices.closest(
        march.position(),
        march.tips(march.step_index)[2],
        2 * np.pi * np.array(march.rows(march.step_index)) / march.n,
        model.n_blades,
        model.rotor["hinge_offset"],
        model.rotor_tables["blade"]["root_cutout"],
        model.rotor["radius"],
        model.rotor["radius"],
        round(start.inflow.near_wake_angle * march.n / (2 * np.pi)),
    )
    assert found == pytest.approx(march.monitors["vortex_blade_distance"], rel=1e-6)
