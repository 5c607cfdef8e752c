# SPDX-License-Identifier: MIT OR Apache-2.0
"""The rotor on a stand: its files, what it is asked for, what it gives."""

from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.trim.equations import trim_problem
from wakeflight.tunnel.solve import StandOnWake

ROTORS = Path(__file__).parent / "data" / "rotors"
CARADONNA = ROTORS / "caradonna-tung.toml"

SHORT = """
format = 1
name = "Hinged"

[rotor]
n_blades = 3
radius = "4 m"
omega = "350 rpm"

[rotor.blade]
root = "{root}"
flexible = false
root_station = "{e} m"
root_cutout = "0.5 m"
{mass}
geometry = {{ columns = {{ r_R = [0.0, 1.0], chord_m = [0.3, 0.3], twist_deg = [0.0, -8.0] }} }}

[rotor.airfoil]
name = "polar"
polar = {{ lift_curve_slope = "5.73 1/rad", cd = [0.01, 0.0, 0.0] }}
"""


HEAVY = """
[condition]
weight = { value = 9000.0, unit = "N", source = "test", confidence = "A" }
[sources.test]
text = "A test"
references = []
"""


def written(folder, root="flapping", e=0.0, mass='flap_inertia = "150 kg m2"', text=SHORT):
    path = folder / "rotor.toml"
    path.write_text(text.format(root=root, e=e, mass=mass))
    return path


def test_a_clamped_rigid_rotor_has_no_modes_and_works():
    stand = wf.tunnel(CARADONNA, collective="8 deg", inflow="dynamic")
    assert stand.data.attrs["n_modes"] == 0
    assert stand.flapping == (0.0, 0.0, 0.0)
    assert 0.004 < stand.ct < 0.008
    # uniform momentum inflow of the thrust found, but for the profile of the sections
    assert stand.data.inflow_mean == pytest.approx(np.sqrt(stand.ct / 2), rel=1e-9)


def test_every_variable_has_a_unit_and_a_meaning():
    data = wf.tunnel(CARADONNA, inflow="dynamic").data
    assert all("units" in v.attrs and "long_name" in v.attrs for v in data.variables.values())
    assert data.ct == data.attrs["averaged"] + data.ct  # means of a periodic solution have no revolutions
    for name in ("cl", "cl_m2", "cn", "alpha", "mach", "circulation", "inflow"):
        assert data[name].dims == ("azimuth", "station")


def test_hub_loads_are_the_sum_of_the_section_loads():
    # thrust and torque of a clamped rigid rotor, from section coefficients alone
    stand = wf.tunnel(CARADONNA, inflow="dynamic", collective="6 deg")
    d = stand.data
    speed = d.mach * d.attrs["speed_of_sound"]
    # the angle of attack is that of the 3/4 chord: a coned blade pitches as it turns, Omega sin(precone)
    radius = d.station * d.attrs["radius"]
    inflow_angle = d.theta - d.alpha + np.sin(np.radians(0.5)) * 0.5 * d.chord / radius
    q = 0.5 * d.attrs["density"] * speed**2 * d.chord * d.width
    cone = np.cos(np.radians(0.5))
    up = (q * (d.cl * np.cos(inflow_angle) - d.cd * np.sin(inflow_angle))).mean("azimuth").sum("station") * cone
    back = q * (d.cl * np.sin(inflow_angle) + d.cd * np.cos(inflow_angle)) * d.station * d.attrs["radius"] * cone
    assert 2 * up == pytest.approx(stand.thrust, rel=1e-4)
    assert 2 * back.mean("azimuth").sum("station") == pytest.approx(stand.torque, rel=1e-4)


def test_power_is_that_of_the_hub_loads():
    # air torque against hub torque with the blades' inertia: a periodic motion takes no power of its own
    stand = wf.tunnel("uh60a", ct=0.006, speed="80 kt", shaft_angle="-3 deg", flapping="zero", inflow="dynamic")
    assert -stand.hub_moment[2] * stand.model.omega == pytest.approx(stand.power, rel=1e-6)
    assert stand.ct == pytest.approx(0.006, rel=1e-6)
    assert abs(stand.beta_1c) < 1e-7 and abs(stand.beta_1s) < 1e-7


def test_a_positive_shaft_angle_meets_the_air_from_below():
    angles = {
        angle: wf.tunnel(CARADONNA, collective="8 deg", speed="20 m/s", shaft_angle=angle, inflow="dynamic")
        for angle in ("-5 deg", "5 deg")
    }
    assert angles["5 deg"].data.mu_z > 0 > angles["-5 deg"].data.mu_z
    assert angles["5 deg"].ct > angles["-5 deg"].ct
    descent = wf.tunnel(CARADONNA, speed="5 m/s", shaft_angle="90 deg", inflow="dynamic")
    same = wf.tunnel(CARADONNA, climb="-5 m/s", inflow="dynamic")
    assert descent.ct == pytest.approx(same.ct, rel=1e-9)
    assert descent.data.attrs["regime"] == "descent"


def test_higher_harmonics_turn_the_blade_as_asked():
    pitch = wf.tunnel(
        CARADONNA,
        "8 deg",
        inflow="dynamic",
        higher_harmonics=[{"order": 3, "amplitude": "0.8 deg", "phase": "300 deg"}],
    ).data.theta
    expected = np.radians(8.0) + np.radians(0.8) * np.cos(3 * pitch.azimuth - np.radians(300))
    assert np.allclose(pitch, expected, atol=1e-12)


def test_the_collective_may_be_stated_at_a_radius():
    root = wf.tunnel("uh60a", collective="18 deg", inflow="dynamic", blades="rigid")
    twist = np.degrees(root.data.theta_75.item()) - 18.0
    at_75 = wf.tunnel(
        "uh60a", collective=f"{18.0 + twist} deg", collective_at="0.75 R", inflow="dynamic", blades="rigid"
    )
    assert at_75.ct == pytest.approx(root.ct, rel=1e-9)


def test_autorotation_has_no_torque():
    stand = wf.tunnel(
        "uh60a", torque="zero", speed="70 kt", shaft_angle="18 deg", inflow="dynamic", blades="rigid", flapping="zero"
    )
    assert abs(stand.cq) < 1e-9
    assert stand.ct > 0.002


def test_rigid_flapping_in_hover_follows_the_cyclic_ninety_degrees_later(tmp_path):
    # central hinge: the tip-path plane is parallel to the no-feathering plane, beta_1c = -theta_1s, beta_1s = theta_1c
    path = written(tmp_path)
    stand = wf.tunnel(path, "10 deg", lateral_cyclic="1 deg", longitudinal_cyclic="-2 deg", inflow="dynamic")
    assert stand.model.rotor["frequencies"] == pytest.approx([stand.model.omega])
    assert np.degrees(stand.beta_1s) == pytest.approx(1.0, abs=0.05)
    assert np.degrees(stand.beta_1c) == pytest.approx(2.0, abs=0.05)


def test_a_wake_of_three_blades_and_its_velocity(tmp_path):
    short = wf.RelaxationWake(turns=2, azimuth_step="20 deg", near_wake_angle="20 deg", n_stations=10)
    stand = wf.tunnel(written(tmp_path), "10 deg", speed="30 m/s", flapping="zero", inflow=short)
    assert stand.data.wake.sizes == {"blade": 3, "age": 37, "xyz": 3}
    assert stand.data.wake_path.dims == ("azimuth", "age", "xyz")
    velocity = stand.wake_velocity([[0.0, 0.0, 1.0], [8.0, 0.0, -0.5]])
    assert velocity.shape == (2, 3) and np.all(velocity[:, 2] < 0)


def test_rings_of_annular_inflow_carry_the_lift_of_their_blade_elements(tmp_path):
    # flapping blades in a climb: N_b Gamma Omega = 4 pi F lambda (lambda + lambda_c) (Omega R)^2, Prandtl's F; and the sum of
    # the rings is the thrust, but for the drag and the tilt of the lift
    stand = wf.tunnel(written(tmp_path), "16 deg", climb="5 m/s", inflow="annular")
    data, omega, radius = stand.data, stand.model.omega, stand.radius
    r, lam, gamma = data.station.values, data.inflow.values[0], data.circulation.values.mean(axis=0)
    through = lam + 5.0 / (omega * radius)
    loss = 2 / np.pi * np.arccos(np.exp(-1.5 * (1 - r) / through))
    np.testing.assert_allclose(3 * gamma / omega, 4 * np.pi * loss * lam * through * radius**2, rtol=1e-7)
    rings = 4 * loss * lam * through * r * data.width.values / radius
    assert rings.sum() == pytest.approx(stand.ct, rel=0.02)
    assert stand.beta_0 > 0.01 and stand.settled
    assert wf.tunnel(written(tmp_path), ct=stand.ct, climb="5 m/s", inflow="annular").theta_0 == pytest.approx(
        np.radians(16.0), abs=1e-6
    )
    free = wf.tunnel(written(tmp_path), "16 deg", climb="5 m/s", inflow=wf.AnnularInflow(tip_loss="none"))
    assert 1.02 < free.ct / stand.ct < 1.15


@pytest.mark.parametrize("given", [{"speed": "5 m/s"}, {"climb": "-1 m/s"}, {"roll_rate": "5 deg/s"}])
def test_rings_are_refused_where_they_do_not_hold(given, tmp_path):
    with pytest.raises(wf.InputError, match="hover and axial climb"):
        wf.tunnel(written(tmp_path), inflow="annular", **given)


def test_dynamic_inflow_knows_the_windmill_brake_state_and_has_an_answer_before_it(tmp_path):
    # v_i/v_h = x/2 - sqrt(x^2/4 - 1) at a descent of x v_h beyond 2
    path, ct = written(tmp_path), 0.005
    tip_speed = wf.tunnel(path, inflow="dynamic").model.tip_speed
    for rate in (2.2, 3.0):
        stand = wf.tunnel(path, ct=ct, climb=f"{-rate * np.sqrt(ct / 2) * tip_speed} m/s", inflow="dynamic")
        exact = rate / 2 - np.sqrt(rate**2 / 4 - 1)
        assert float(stand.data.inflow_mean) / np.sqrt(ct / 2) == pytest.approx(exact, rel=1e-6)
    for rate, tests in ((1.0, 1.816), (1.5, 2.0828125)):
        stand = wf.tunnel(path, ct=ct, climb=f"{-rate * np.sqrt(ct / 2) * tip_speed} m/s", inflow="dynamic")
        assert float(stand.data.inflow_mean) / np.sqrt(ct / 2) == pytest.approx(tests, rel=1e-6)
        assert any("curve through scattered tests" in text for text in stand.warnings)


def test_a_rotor_of_which_nothing_is_asked_carries_its_aircraft_without_flapping():
    # the report's case: a wind of 80 kt and nothing else ended at -27.5 kN of thrust
    stand = wf.tunnel("uh60a", speed="80 kt", inflow="dynamic")
    weight = wf.load_aircraft("uh60a").condition.weight
    assert stand.thrust == pytest.approx(weight, rel=1e-9)
    assert np.abs(stand.flapping[1:]).max() < 1e-9
    assert [text.split(" = ")[0] for text in stand.assumed] == ["thrust", "no first-harmonic flapping"]
    assert all(text in stand.table() and text in stand.data.attrs["assumed"] for text in stand.assumed)
    # the same asked for by name is the same, and nothing is assumed
    asked = wf.tunnel("uh60a", speed="80 kt", inflow="dynamic", thrust=f"{weight} N", flapping="zero")
    assert np.array_equal(asked.x, stand.x)
    assert asked.assumed == () and asked.data.attrs["assumed"] == ""
    # without a wind across the shaft there is nothing to flap from: cyclic pitch stays zero
    hover = wf.tunnel("uh60a", inflow="dynamic")
    assert hover.thrust == pytest.approx(weight, rel=1e-9)
    assert (hover.theta_1c, hover.theta_1s) == pytest.approx((0.0, 0.0), abs=1e-12) and len(hover.assumed) == 1


def test_a_rotor_file_without_a_weight_has_a_stated_blade_loading(tmp_path):
    flapping = wf.tunnel(written(tmp_path), speed="30 m/s", inflow="dynamic")
    assert float(flapping.data.ct_sigma) == pytest.approx(0.07, rel=1e-9)
    assert np.abs(flapping.flapping[1:]).max() < 1e-9
    assert "0.07" in flapping.assumed[0]
    # blades that cannot flap have their hub moments taken away instead
    clamped = wf.tunnel(CARADONNA, speed="20 m/s", inflow="dynamic")
    assert float(clamped.data.ct_sigma) == pytest.approx(0.07, rel=1e-9)
    assert np.abs(clamped.hub_moment[:2]).max() < 1e-6 * clamped.torque
    assert clamped.assumed[1].startswith("no hub moments")
    # a weight in the file goes before
    heavy = tmp_path / "heavy.toml"
    heavy.write_text(SHORT.format(root="flapping", e=0.0, mass='flap_inertia = "150 kg m2"') + HEAVY)
    stand = wf.tunnel(heavy, speed="30 m/s", inflow="dynamic")
    assert stand.thrust == pytest.approx(9000.0, rel=1e-9)
    assert stand.assumed[0].startswith("thrust = 9000 N")


@pytest.mark.parametrize(
    "given",
    [
        {"collective": "8 deg"},
        {"ct": 0.005},
        {"thrust": "9 kN"},
        {"torque": "2 kN m"},
        {"collective": "8 deg", "lateral_cyclic": "1 deg"},
    ],
)
def test_what_is_given_is_not_added_to(given, tmp_path):
    stand = wf.tunnel(written(tmp_path), speed="30 m/s", inflow="dynamic", **given)
    assert stand.assumed == ()
    cyclic = np.radians(1.0) if "lateral_cyclic" in given else 0.0
    assert (stand.theta_1c, stand.theta_1s) == pytest.approx((cyclic, 0.0), abs=1e-12)
    # a collective alone is the only thing solved for: pitch is as typed
    if "collective" in given:
        assert stand.theta_0 == pytest.approx(np.radians(8.0), abs=1e-12)


def test_cyclic_pitch_that_is_given_is_kept_where_the_load_is_assumed(tmp_path):
    stand = wf.tunnel(written(tmp_path), speed="30 m/s", longitudinal_cyclic="-3 deg", inflow="dynamic")
    assert np.degrees(stand.theta_1s) == pytest.approx(-3.0, abs=1e-12)
    assert len(stand.assumed) == 1 and float(stand.data.ct_sigma) == pytest.approx(0.07, rel=1e-9)


def test_weissinger_wings_have_the_known_lift():
    slope = wf.wing(6.0, 1.0, "5.7106 deg").cl / np.radians(5.7106)
    assert slope == pytest.approx(4.1743, abs=1e-4)
    line = wf.wing(6.0, 1.0, "0.1 rad", blade_model="lifting-line").cl / np.sin(0.1)
    assert line == pytest.approx(4.53042499, rel=3e-4)


def test_weissinger_lifts_less_than_the_lifting_line_on_a_short_blade():
    # flow tangency at 3/4 chord: some per cent less lift at an aspect ratio of six, the same rotor otherwise
    wake = wf.RelaxationWake(turns=2, n_stations=12)
    line = wf.tunnel(CARADONNA, "8 deg", inflow=wake)
    weissinger = wf.tunnel(CARADONNA, "8 deg", inflow=wake, blade_model="weissinger")
    assert 0.85 < weissinger.ct / line.ct < 0.98
    with pytest.raises(wf.InputError, match="free wake"):
        wf.tunnel(CARADONNA, inflow="dynamic", blade_model="weissinger")


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"collective": 8}, "collective = 8"),
        ({"collective": "8 deg", "thrust": "100 N"}, "thrust"),
        ({"speed": "20 deg"}, "speed"),
        ({"shaft_angle": "100 deg"}, "shaft_angle"),
        ({"flapping": "zero"}, "clamped and rigid"),
        ({"inflow": "vortex"}, "inflow"),
        ({"higher_harmonics": [(1, "1 deg", "0 deg")]}, "order"),
        ({"rpm": -3}, "rpm"),
        ({"blades": "soft"}, "blades"),
        ({"density": "1.2"}, "density"),
        ({"revolutions": 3, "inflow": "dynamic"}, "revolutions"),
        ({"ct": "much"}, "ct"),
        ({"collective": "8 deg", "collective_at": "0.75"}, "collective_at"),
        ({"thrust": "9 kN", "collective_at": "0.75 R"}, "collective_at"),
    ],
)
def test_bad_requests_name_the_field(given, named):
    with pytest.raises(wf.InputError, match=named) as error:
        wf.tunnel(CARADONNA, **{"inflow": "dynamic", **given})
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("n_blades = 3", "n_blades = 9", "rotor.n_blades"),
        ("n_blades = 3", "", "rotor.n_blades"),
        ('radius = "4 m"', 'radius = "4"', "rotor.radius"),
        ('"350 rpm"', '"350 kt"', "rotor.omega"),
        ('flap_inertia = "150 kg m2"', "", "needs structure, mass or flap_inertia"),
        ("flexible = false", "flexible = true", "structure is missing"),
        ("chord_m = [0.3, 0.3]", "chord_m = [0.3]", "different length"),
        ("r_R = [0.0, 1.0]", "r_R = [0.3, 1.0]", "must cover"),
        ("cd = [0.01, 0.0, 0.0]", "cd = [0.01]", "polar.cd"),
        ('root = "flapping"', 'root = "teetering"', "rotor.blade.root"),
        ("format = 1", "format = 1\nspan = 3", "span"),
    ],
)
def test_a_bad_rotor_file_names_file_and_key(tmp_path, old, new, named):
    path = written(tmp_path)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    with pytest.raises(wf.InputError, match=named) as error:
        wf.load_rotor(path)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_a_hovering_wake_settles_at_little_thrust():
    # little inflow keeps the wake in the disk, where a full share of each change of inflow overshoots
    stand = wf.tunnel("uh60a", collective="10.5 deg", blades="rigid", flapping="zero", inflow="relaxation")
    assert stand.settled
    assert 0.0 < stand.ct < 0.003


@pytest.mark.filterwarnings("ignore")
def test_a_marching_rotor_answers_like_a_relaxed_one_in_forward_flight():
    # two wakes with one steady state: thrust within the spread of the schemes, inflow asked for off the blades too
    common = {"collective": "12 deg", "speed": "80 kt", "blades": "rigid", "flapping": "zero"}
    relaxed = wf.tunnel("uh60a", inflow="relaxation", **common)
    marched = wf.tunnel("uh60a", inflow="time-marching", revolutions=6, averaged=2, **common)
    assert marched.ct == pytest.approx(relaxed.ct, rel=0.03)
    probe = [[0.5 * relaxed.radius, 0.0, -0.5 * relaxed.radius]]
    assert marched.wake_velocity(probe)[0, 2] == pytest.approx(relaxed.wake_velocity(probe)[0, 2], rel=0.1)


def test_the_circulation_of_a_wide_blade_in_hover_is_not_one_far_beyond_stall():
    # started without near wake its tip stalls; the slope of a stalled section leads to solutions of thousands of m/s
    run = wf.tunnel(CARADONNA, collective="8 deg", rpm=1250, inflow="relaxation")
    solved = run.solution
    assert solved.settled
    psi = 2 * np.pi * np.arange(4) / 4
    passages = solved.model.core.passages(solved.problem, solved.x, psi, solved.inflow_map[::9])
    assert np.abs(passages["alpha"]).max() < np.radians(12.0)
    assert passages["speed"].max() < 1.1 * 1250 * 2 * np.pi / 60 * 1.143


def test_a_relaxation_that_is_given_up_leaves_the_motion_that_belongs_to_its_inflow(monkeypatch):
    # the last inflow of the wake is what the results are made of: the blades must have been solved on it
    monkeypatch.setattr(StandOnWake, "hopeless", lambda self, wake, history: True)
    short = wf.RelaxationWake(turns=2, azimuth_step="30 deg", near_wake_angle="30 deg", n_stations=10)
    run = wf.tunnel("uh60a", ct=0.006, speed="60 kt", flapping="zero", inflow=short, blades="rigid")
    solved = run.solution
    assert not run.settled and "did not settle" in run.notes[0]
    residual = solved.model.core.trim_residual(trim_problem(solved.model, solved.inflow_map), solved.x)
    assert np.abs(residual).max() < 1e-6
    assert np.array_equal(solved.inflow_map, solved.wake.inflow_map)
