# SPDX-License-Identifier: MIT OR Apache-2.0
"""Modes of any blade: of an aircraft or of a rotor file, turning or at rest; what is refused."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.errors import InputError

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
