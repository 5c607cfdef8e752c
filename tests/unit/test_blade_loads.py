"""Loads along the blade of a flight add up to what the core integrates; displacements are those of its modes; probes, wakes."""

import json

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.blade_loads import mode_shapes, section_coefficients
from wakeflight.flight_input import FlightInput
from wakeflight.results import frames

CONDITION = wf.FlightCondition(speed="80 kt", flight_path="0 deg")
HANDS = wf.step("lateral", "0.3 in", at="0.05 s", seconds="0.2 s")
LEFT = wf.step("lateral", "-0.3 in", at="0.05 s", seconds="0.2 s")


@pytest.fixture(scope="module", params=["uh60a", "bo105"])
def flown(request):
    """Trim, flight and loads of an aircraft."""
    start = wf.trim(wf.load_aircraft(request.param), CONDITION, inflow="dynamic")
    run = wf.fly(start, HANDS, integrator="fixed").data
    return start, run, wf.blade_loads(run)


def test_the_tables_give_the_lift_that_was_recorded(flown):
    _, run, loads = flown
    cl, cd, cm = section_coefficients(FlightInput.from_text(run.attrs["input"]), run.alpha.values, run.mach.values)
    assert np.array_equal(cl, run.cl.values)
    assert np.array_equal(cd, loads.cd.values) and np.array_equal(cm, loads.cm.values)


def test_a_clockwise_rotor_has_the_loads_of_its_mirror_image():
    aircraft, found = wf.load_aircraft("uh60a").with_rigid_blades(), []
    for each, hands in ((aircraft, HANDS), (aircraft.mirrored(), LEFT)):
        start = wf.trim(each, CONDITION, inflow="dynamic")
        found.append(wf.blade_loads(wf.fly(start, hands, revolutions=1, integrator="fixed").data))
    # the trims differ by the rounding of half a turn
    for name in ("up_force", "in_plane_force", "section_moment", "pitch_section", "flap_displacement"):
        twin, image = (each[name].values for each in found)
        assert np.abs(twin - image).max() < 1e-8 * np.abs(twin).max()


def test_loads_along_the_blades_add_up_to_the_rotors(flown):
    start, run, loads = flown
    at_start = wf.Simulation(start).loads
    r = run.station.values * run.attrs["radius"]
    thrust = float((loads.up_force[0] * loads.width).sum())
    torque = float((loads.in_plane_force[0] * loads.width * r).sum())
    # flapping tilts sections by a few degrees: a blade's own plane is not quite that of the hub
    assert thrust == pytest.approx(at_start["aero_force"][2], rel=4e-3)
    assert torque == pytest.approx(-at_start["aero_moment"][2], rel=0.05)


def test_coefficients_belong_together(flown):
    _, run, loads = flown
    np.testing.assert_allclose(loads.cn, run.cl * np.cos(run.alpha) + loads.cd * np.sin(run.alpha))
    q = 0.5 * json.loads(run.attrs["geometry"])["density"]
    speed = run.mach * json.loads(run.attrs["geometry"])["speed_of_sound"]
    np.testing.assert_allclose(loads.section_moment, q * speed**2 * loads.chord**2 * loads.cm)
    assert (loads.cd > 0.0).all() and loads.normal_force.attrs["units"] == "N/m"


def test_displacements_are_those_of_the_modes(flown):
    start, run, loads = flown
    aircraft, radius = start.aircraft, run.attrs["radius"]
    blade = aircraft.rotor.blade
    tip = mode_shapes(aircraft, np.array([radius]))
    arm, precone = radius - float(blade.root_station), float(blade.precone)
    w, v = (np.einsum("tbk,k->tb", run.modal.values, tip[part][:, 0]) for part in ("flap", "lead"))
    # the rigid blade with the same tip, as the core has it; what the blade loses in length by bending is not in w and v
    height = radius * np.sin(precone) + w * np.cos(precone)
    out = radius * np.cos(precone) - w * np.sin(precone) - float(blade.root_station)
    assert np.abs(np.arcsin(height / arm) - run.flap.values).max() < (1e-9 if precone == 0.0 else 3e-4)
    assert np.abs(np.arctan2(v, out) - run.lead.values).max() < 0.01 * np.abs(run.lead.values).max()
    assert loads.shape.sizes["mode"] == run.sizes["mode"]


def test_the_pitch_of_a_section_is_that_of_the_controls(flown):
    start, run, loads = flown
    station = int(np.argmin(np.abs(run.station.values - 0.75)))
    twist = start.aircraft.core_data()["rotor"]["blade"]["twist"]
    built_in = np.interp(run.station.values[station] * run.attrs["radius"], twist["x"], twist["y"])
    mean = float((loads.pitch_section - loads.twist_elastic)[0, :, station].mean())
    assert mean == pytest.approx(start.theta_0 + built_in, abs=1e-9)


def test_what_is_no_flight_is_refused(flown):
    start, run, _ = flown
    for wrong in (start.to_dataset(), run.drop_vars("modal"), run.assign_attrs(input="{}")):
        with pytest.raises(wf.InputError):
            wf.blade_loads(wrong)
    with pytest.raises(wf.InputError, match="free wake"):
        wf.wake_velocity(run, [[0, 0, -1]])


def test_bank_and_load_factor_are_there(flown):
    start, run, _ = flown
    np.testing.assert_array_equal(run.bank, run["roll"])
    assert float(start.to_dataset().bank) == start.roll
    assert wf.load_factor(run)[0] == pytest.approx(1.0, abs=0.01)
    with pytest.raises(wf.InputError, match="must be the Dataset of a flight"):
        wf.load_factor(start.to_dataset())


@pytest.fixture(scope="module")
def marched():
    """A short flight with a coarse marching wake, kept at every step."""
    wake = wf.TimeMarchingWake(turns=1, azimuth_step="30 deg", convergence_revolutions=1)
    start = wf.trim(wf.load_aircraft("uh60a").with_rigid_blades(), CONDITION, inflow=wake.trim_model())
    hands = wf.Maneuver("hands off", {}, seconds=1.0)
    flight = wf.fly(start, hands, wake, revolutions=1, integrator="fixed", wakes_per_revolution=12)
    return start, wake, hands, flight


def test_wakes_are_kept_as_often_as_asked(marched):
    start, wake, hands, flight = marched
    assert flight.data.sizes["snapshot"] == 13
    np.testing.assert_allclose(np.diff(flight.data.snapshot_revolution), 1 / 12)
    usual = wf.fly(start, hands, wake, revolutions=1, integrator="fixed").data
    assert usual.sizes["snapshot"] == 5
    np.testing.assert_array_equal(usual.wake, flight.data.wake[::3])
    with pytest.raises(wf.InputError, match="must divide the 12 steps"):
        wf.fly(start, hands, wake, revolutions=1, wakes_per_revolution=5)


def test_probes_see_the_wake_that_is_kept(marched):
    data = marched[3].data
    shape = frames.geometry(data)
    points = np.array([[1.0, 2.0, -3.0], [0.0, -4.0, -1.5]])
    seen = wf.wake_velocity(data, points)
    assert seen.velocity.dims == ("snapshot", "point", "xyz") and (seen.velocity[:, 0, 2] < 0.0).all()
    last = data.isel(snapshot=-1)
    strength, core = last.wake_circulation.values, last.wake_core.values
    alone = wf.induced_velocity(
        points,
        list(last.wake.values),
        (0.5 * (strength[:, 1:] + strength[:, :-1])).ravel(),
        np.sqrt(0.5 * (core[:, 1:] ** 2 + core[:, :-1] ** 2)).ravel(),
    )
    np.testing.assert_allclose(seen.velocity[-1], alone)
    # the same points in body axes have the same velocity, turned
    turn = frames.body_of_hub(*shape["shaft_tilt"])
    of_body = wf.wake_velocity(data, points @ turn.T + np.array(shape["hub"]), axes="body")
    np.testing.assert_allclose(of_body.velocity.values, seen.velocity.values @ turn.T, atol=1e-12)
    for wrong in ({"points": [1, 2]}, {"points": "here"}, {"points": points, "axes": "earth"}):
        with pytest.raises(wf.InputError):
            wf.wake_velocity(data, **wrong)
