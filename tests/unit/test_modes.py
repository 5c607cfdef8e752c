# SPDX-License-Identifier: MIT OR Apache-2.0
"""Modes of any blade: of an aircraft or of a rotor file, turning or at rest; what is refused."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.errors import InputError
from wakeflight.modes import BladeModes, mode_labels, reference_table

BEAM = """
format = 1
name = "Uniform beam"

[rotor]
n_blades = 2
radius = "{radius} m"
omega = "6 rad/s"

[rotor.blade]
root = "{root}"
flexible = {flexible}
root_station = "{hub} m"
root_cutout = "{cutout} m"
control_stiffness = "1 N m/rad"
km1_over_ktheta = 0.0
ka_over_ktheta = 0.0
structural_damping_ratio = 0.0
pitch_axis_chord_fraction = 0.25
geometry = {{ columns = {{ r_R = [0.0, 1.0], chord_m = [0.1, 0.1], twist_deg = [0.0, 0.0] }} }}
{structure}

[rotor.airfoil]
name = "not used"
polar = {{ lift_curve_slope = "5.7 1/rad", cd = [0.0, 0.0, 0.0] }}
"""

STRUCTURE = (
    "structure = {{ columns = {{ r_in_m = [{hub}], r_out_m = [{radius}], mass_kg_m = [1.0], EI_flap_Nm2 = [1.0], "
    "EI_lag_Nm2 = [1e4], GJ_Nm2 = [1.0], I_theta_cg_kgm = [0.0], x_cg_m = [0.0] }} }}"
)


def beam(folder, root="clamped", hub=0.0, flexible="true"):
    radius = hub + 1.0
    structure = STRUCTURE.format(hub=hub, radius=radius) if flexible == "true" else ""
    text = BEAM.format(root=root, hub=hub, radius=radius, cutout=hub + 0.1, flexible=flexible, structure=structure)
    path = folder / f"{root}.toml"
    path.write_text(text)
    return wf.load_rotor(path)


def test_a_uniform_beam_at_rest_has_the_textbook_frequencies(tmp_path):
    found = wf.blade_modes(beam(tmp_path), n_modes=3, n_elements=8, rotor_speed=0.0, reference_pitch=0.0)
    assert found.natural_frequencies == pytest.approx([3.516015, 22.034492, 61.697214], rel=1e-3)
    with pytest.raises(InputError, match="natural_frequencies"):
        _ = found.frequencies


def test_a_hub_radius_stiffens_by_the_hinge_formula(tmp_path):
    # nearly rigid about its hinge: 1 + 3e/2(1 - e) with e the hub radius over R
    found = wf.blade_modes(beam(tmp_path, "hinged", 1.0), n_modes=2, rotor_speed=1e-3, reference_pitch=0.0)
    assert found.frequencies[found.labels.index("flap 1")] ** 2 == pytest.approx(2.5, rel=1e-5)


def test_modes_of_an_aircraft_are_those_of_its_rotor():
    aircraft = wf.load_aircraft("bo105")
    own, rotor = wf.blade_modes(aircraft), wf.blade_modes(wf.load_rotor(aircraft))
    assert np.array_equal(own.natural_frequencies, rotor.natural_frequencies)
    assert own.frequencies == pytest.approx(own.natural_frequencies / 44.4)


def made_of(shares, flap, lead, twist):
    """Modes of given shares and shapes, at frequencies 1, 2, 3 ... per revolution."""
    n = len(shares)
    shapes = {"flap": np.array(flap), "lead": np.array(lead), "twist": np.array(twist)}
    return BladeModes(np.arange(1.0, n + 1), np.array(shares), np.linspace(0, 1, 50), shapes, 1.0, 0.0)


R = np.linspace(0, 1, 50)
RIGID, ONE_NODE, TWO_NODES = R, np.sin(1.5 * np.pi * R), np.sin(2.5 * np.pi * R)


def test_a_mode_is_named_by_what_it_is_made_of_and_by_its_nodes_not_by_its_place():
    # torsion below the second flap mode, and a third flap mode without the second among those kept
    modes = made_of(
        [[0.02, 0.98, 0.0], [0.99, 0.01, 0.0], [0.05, 0.0, 0.95], [0.9, 0.1, 0.0]],
        flap=[RIGID, RIGID, ONE_NODE, TWO_NODES],
        lead=[RIGID, RIGID, RIGID, ONE_NODE],
        twist=[0.01 * R, 0.01 * R, R, 0.01 * R],
    )
    assert modes.labels == ["lag 1", "flap 1", "torsion 1", "flap 3"]
    assert modes.matched(["flap 3", "flap 2", "torsion 1"]) == {"flap 3": 3, "flap 2": None, "torsion 1": 2}


def test_modes_that_veer_carry_both_names_and_each_name_has_one_mode():
    modes = made_of(
        [[0.45, 0.52, 0.03], [0.53, 0.44, 0.03]],
        flap=[TWO_NODES, TWO_NODES],
        lead=[ONE_NODE, ONE_NODE],
        twist=[R, R],
    )
    assert modes.labels == ["lag 2/flap 3", "flap 3/lag 2"]
    assert modes.matched(["flap 3", "lag 2"]) == {"flap 3": 1, "lag 2": 0}
    # one name has no claim to both
    assert modes.matched(["lag 2"]) == {"lag 2": 0}


def test_noise_near_the_root_is_no_node():
    shape = np.where(R < 0.1, -0.01 * np.sin(10 * np.pi * R), TWO_NODES)
    one = made_of([[0.9, 0.05, 0.05]], flap=[shape], lead=[R], twist=[R])
    assert one.labels == ["flap 3"]


def test_published_modes_are_compared_with_ours_of_the_same_kind(uh60a):
    # the sixth mode of the UH-60A is flap 3, near the published torsion in frequency alone
    modes = wf.blade_modes(uh60a, n_modes=7)
    assert modes.labels[3:6] == ["lag 2/flap 3", "torsion 1", "flap 3"]
    table = reference_table(uh60a, modes)
    published = table[table.index("BD_fanplot") :].splitlines()
    torsion, flap = (next(row for row in published if name in row) for name in ("torsion 1 ", "flap 3 "))
    assert "5.2030  ours   4.7977  -7.79% (torsion 1); nearest ours   5.2078  +0.09% (flap 3)" in torsion
    assert "4.8810  ours   5.2078  +6.70% (flap 3)" in flap
    # five modes kept: the third flap mode is not among them, and none stands in for it
    few = reference_table(uh60a, wf.blade_modes(uh60a))
    assert few.count("none of ours") == 4


def test_results_name_the_modes_that_their_coordinates_belong_to(uh60a):
    assert mode_labels(uh60a) == ["lag 1", "flap 1", "flap 2", "lag 2/flap 3", "torsion 1"]
    assert mode_labels(uh60a.with_rigid_blades()) == ["lag 1", "flap 1"]
    stand = wf.tunnel("uh60a", ct=0.006, inflow="dynamic")
    assert stand.data.attrs["blade_modes"] == '["lag 1", "flap 1", "flap 2", "lag 2/flap 3", "torsion 1"]'


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"n_modes": 0}, "n_modes"),
        ({"n_modes": 2.5}, "n_modes"),
        ({"n_elements": 0}, "n_elements"),
        ({"rotor_speed": -1.0}, "rotor_speed"),
        ({"rotor_speed": float("nan")}, "rotor_speed"),
        ({"n_modes": 99, "n_elements": 1}, "modes"),
        ({"reference_pitch": float("inf")}, "reference_pitch"),
    ],
)
def test_what_makes_no_sense_is_refused(tmp_path, given, named):
    with pytest.raises(InputError, match=named):
        wf.blade_modes(beam(tmp_path), **given)


def test_a_rigid_blade_has_no_modes(tmp_path):
    with pytest.raises(InputError, match="rigid"):
        wf.blade_modes(beam(tmp_path, flexible="false"))
