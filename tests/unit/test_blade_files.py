# SPDX-License-Identifier: MIT OR Apache-2.0
"""Hinge springs, lag held, rigid blades by their moments: options of aircraft and rotor files, against closed forms."""

import math
import shutil
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf

UH60A = Path(str(resources.files("wakeflight.aircraft"))) / "uh60a"
OMEGA, RADIUS, HINGE = 30.0, 8.0, 0.4
MASS, FIRST, INERTIA = 100.0, 380.0, 1900.0
MOMENTS = f'blade_mass = "{MASS} kg"\nfirst_moment = "{FIRST} kg m"\nflap_inertia = "{INERTIA} kg m2"\n'

ROTOR = """schema = 2
name = "rotor"
[rotor]
model = "rigid"
n_blades = 4
radius = "{radius} m"
omega = "{omega} rad/s"
[rotor.blade]
root = "{root}"
root_station = "{hinge} m"
root_cutout = "1 m"
geometry = {{ columns = {{ r_R = [0, 1], chord_m = [0.5, 0.5], twist_deg = [0, 0] }} }}
{blade}
[rotor.airfoil]
name = "section"
polar = {{ lift_curve_slope = "5.7 1/rad", cd = [0.01, 0, 1.0] }}
"""


def rotor(tmp_path, blade=MOMENTS, root="hinged"):
    path = tmp_path / "rotor.toml"
    path.write_text(ROTOR.format(radius=RADIUS, omega=OMEGA, hinge=HINGE, root=root, blade=blade))
    return path


def frequencies(of):
    return np.asarray(wf.blade_modes(of).frequencies)


@pytest.mark.parametrize(("flap", "lag"), [(0.0, 0.0), (2e4, 0.0), (3e4, 8e4)])
def test_a_blade_of_given_moments_has_the_frequencies_of_its_offset_and_springs(tmp_path, flap, lag):
    springs = f'flap_spring = "{flap} N m/rad"\nlag_spring = "{lag} N m/rad"\n'
    offset, over = HINGE * FIRST / INERTIA, INERTIA * OMEGA**2
    expected = sorted(math.sqrt(each) for each in (1.0 + offset + flap / over, offset + lag / over))
    assert frequencies(rotor(tmp_path, MOMENTS + springs)) == pytest.approx(expected, rel=1e-9)


def test_lag_held_leaves_the_flap_hinge_alone(tmp_path):
    (found,) = frequencies(rotor(tmp_path, MOMENTS, root="flapping"))
    assert found == pytest.approx(math.sqrt(1.0 + HINGE * FIRST / INERTIA), rel=1e-9)


def test_a_uniform_blade_by_its_moments_is_the_one_by_its_mass(tmp_path):
    length = RADIUS - HINGE
    by_moments = MOMENTS.replace(f"{MASS}", f"{12 * length}").replace(f"{FIRST}", f"{6 * length**2}")
    by_moments = by_moments.replace(f"{INERTIA}", f"{4 * length**3}")
    stands = []
    for blade in (by_moments, 'mass = "12 kg/m"\n'):
        path = rotor(tmp_path, blade)
        stands.append(wf.tunnel(path, collective="9 deg", speed="30 m/s", shaft_angle="-3 deg", inflow="dynamic"))
    first, second = (np.r_[each.ct, each.cq, each.beta_0, each.beta_1c, each.beta_1s] for each in stands)
    assert first == pytest.approx(second, rel=1e-6)


def test_coning_on_a_flap_spring_is_the_closed_form(tmp_path):
    # mean flap moment of the air over I Omega^2 nu^2; in hover without cyclic the blade does not move
    coning = {}
    for flap in (0.0, 4e5):
        spring = f'flap_spring = "{flap} N m/rad"\n'
        stand = wf.tunnel(
            rotor(tmp_path, MOMENTS + spring, "flapping"), collective="9 deg", speed="0 kt", inflow="dynamic"
        )
        nu_squared = 1.0 + HINGE * FIRST / INERTIA + flap / (INERTIA * OMEGA**2)
        lift = stand.thrust / 4
        coning[flap] = (stand.beta_0 * INERTIA * OMEGA**2 * nu_squared + 9.80665 * FIRST) / lift
    # the arm of the lift about the hinge, the same for both but for the little that coning changes
    assert coning[0.0] == pytest.approx(coning[4e5], rel=5e-3)
    assert 0.7 * RADIUS < coning[0.0] < 0.8 * RADIUS


def test_a_blade_lies_on_its_flap_stop_as_on_a_spring_that_begins_there(tmp_path):
    # the coning of hover goes beyond a stop: the balance of the free blade, and K (beta - stop) besides
    stop, stiffness, arm = math.radians(1.0), 4e5, {}
    for name, stops in {
        "free": "",
        "stopped": f'flap_stops = {{ high = "1 deg", stiffness = "{stiffness} N m/rad" }}\n',
    }.items():
        stand = wf.tunnel(
            rotor(tmp_path, MOMENTS + stops, "flapping"), collective="9 deg", speed="0 kt", inflow="dynamic"
        )
        assert stand.beta_0 > stop
        moment = stand.beta_0 * INERTIA * OMEGA**2 * (1.0 + HINGE * FIRST / INERTIA) + 9.80665 * FIRST
        arm[name] = (moment + (stiffness * (stand.beta_0 - stop) if stops else 0.0)) / (stand.thrust / 4)
    assert arm["stopped"] == pytest.approx(arm["free"], rel=5e-3)


@pytest.mark.parametrize(
    ("blade", "root", "named"),
    [
        (
            'flap_stops = { low = "-6 deg", stiffness = "1e6 N m/rad" }\n' + MOMENTS,
            "clamped",
            ("flap_stops", "no flap"),
        ),
        ('lag_stops = { low = "-6 deg", stiffness = "1e6 N m/rad" }\n' + MOMENTS, "flapping", ("lag_stops", "no lag")),
        ('flap_stops = { stiffness = "1e6 N m/rad" }\n' + MOMENTS, "hinged", ("needs low, high, or both",)),
        (
            'flap_stops = { low = "2 deg", high = "1 deg", stiffness = "1 N m/rad" }\n' + MOMENTS,
            "hinged",
            ("not below",),
        ),
        ('flap_stops = { low = "-2 deg" }\n' + MOMENTS, "hinged", ("flap_stops.stiffness",)),
        ('flap_spring = "1 N m/rad"\n' + MOMENTS, "clamped", ("flap_spring", "no flap hinge")),
        ('lag_spring = "1 N m/rad"\n' + MOMENTS, "flapping", ("lag_spring", "no lag hinge")),
        ('flap_spring = "-1 N m/rad"\n' + MOMENTS, "hinged", ("rotor.blade.flap_spring",)),
        ('blade_mass = "100 kg"\n', "hinged", ("blade_mass", "first_moment", "together")),
        ('mass = "12 kg/m"\n' + MOMENTS, "hinged", ("mass and flap_inertia",)),
        (MOMENTS.replace("1900", "1400"), "hinged", ("blade_mass, first_moment, flap_inertia", "S^2/m <= I <= S L")),
        (MOMENTS.replace("1900", "2900"), "hinged", ("S^2/m <= I <= S L",)),
        (MOMENTS + "flexible = true", "hinged", ("in version 2 it is model",)),
        ("", "hinged", ("needs structure, mass or flap_inertia",)),
        (MOMENTS.replace("flap_inertia", "flap_inertai"), "hinged", ("is flap_inertia meant?",)),
    ],
)
def test_a_blade_that_cannot_be_is_refused(tmp_path, blade, root, named):
    with pytest.raises(wf.InputError) as caught:
        wf.load_rotor(rotor(tmp_path, blade, root))
    for each in ("rotor.toml", *named):
        assert each in str(caught.value), str(caught.value)


def uh60a(tmp_path, *changes):
    shutil.copytree(UH60A, tmp_path / "uh60a")
    path = tmp_path / "uh60a" / "uh60a.toml"
    text = path.read_text()
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    path.write_text(text)
    return wf.load_aircraft(path)


def number(value, unit):
    return f'{{ value = {value}, unit = "{unit}", source = "genhel", confidence = "C" }}'


def test_an_aircraft_with_rigid_blades_needs_no_elastic_numbers(tmp_path):
    lines = (UH60A / "uh60a.toml").read_text().splitlines()
    elastic = (
        "structure =",
        "control_stiffness =",
        "km1_over_ktheta =",
        "ka_over_ktheta =",
        "structural_damping_ratio =",
    )
    published = f"blade_mass = {number(256.9, 'lb')}\nfirst_moment = {number(86.7, 'slug ft')}\n"
    published += f"flap_inertia = {number(1512.6, 'slug ft2')}"
    dropped = [line for line in lines if line.startswith(elastic)]
    assert len(dropped) == 5
    changes = [(line + "\n", "") for line in dropped[1:]] + [(dropped[0], published)]
    aircraft = uh60a(tmp_path, ('model = "elastic"', 'model = "rigid"'), *changes)
    assert aircraft.blade_mass == pytest.approx(256.9 * 0.45359237, rel=1e-9)
    hinge, slug = 1.25 * 0.3048, 14.593903
    first, inertia = 86.7 * slug * 0.3048, 1512.6 * slug * 0.3048**2
    # the flap frequency of the published moments; the damper's spring is off
    assert frequencies(aircraft)[-1] == pytest.approx(math.sqrt(1.0 + hinge * first / inertia), rel=1e-6)
    found = list(wf.trim(aircraft, inflow="dynamic").stick.values())
    table = list(wf.trim(wf.load_aircraft("uh60a").with_rigid_blades(), inflow="dynamic").stick.values())
    # the structure table's blade has the same moments within 2 %, and twists its plane of rotation by its mass off the axis
    assert found == pytest.approx(table, abs=0.25)


def test_an_aircraft_flies_with_lag_held_and_springs(tmp_path):
    changes = [('root = "hinged"', f'root = "flapping"\nflap_spring = {number(5e4, "N m/rad")}')]
    text = (UH60A / "uh60a.toml").read_text()
    damper = text[text.index("[rotor.lag_damper]") : text.index("# --- sticks to blade pitch")]
    aircraft = uh60a(tmp_path, *changes, (damper, ""), ('model = "elastic"', 'model = "rigid"'))
    assert aircraft.discretisation.n_modes == 1
    free = wf.load_aircraft("uh60a").with_rigid_blades()
    (held,) = frequencies(aircraft)
    inertia = 5e4 / ((held**2 - frequencies(free)[-1] ** 2) * 27.0**2)
    # 1512.6 slug ft2 about the hinge
    assert inertia == pytest.approx(2050.8, rel=5e-3)
    start = wf.trim(aircraft, inflow="dynamic")
    flight = wf.fly(start, wf.arrested_descent(), inflow="dynamic", revolutions=2, integrator="fixed")
    assert flight.data.sizes["mode"] == 1
    assert np.all(np.isfinite(flight.data.modal))


def test_numbers_of_a_rotor_file_are_replaced_by_name_and_kept_in_the_run(tmp_path):
    spring = 'flap_spring = "2e4 N m/rad"\n'
    path = rotor(tmp_path, MOMENTS + spring)
    stiffer = wf.load_rotor(path).with_({"rotor.blade.flap_spring": "x 2"}).with_({"rotor.omega": "25 rad/s"})
    assert stiffer.data["blade"]["flap_spring"] == pytest.approx(4e4) and stiffer.omega == 25.0
    assert dict(stiffer.changes) == {"rotor.blade.flap_spring": "x 2", "rotor.omega": "25 rad/s"}
    written = tmp_path / "written.toml"
    written.write_text(path.read_text().replace("2e4", "4e4").replace(f"{OMEGA}", "25"))
    asked = {"collective": "9 deg", "speed": "20 m/s", "inflow": "dynamic"}
    first, second = (wf.tunnel(each, **asked) for each in (stiffer, wf.load_rotor(written)))
    assert first.ct == second.ct and first.beta_0 == second.beta_0
    assert "rotor.omega" in str(first.data.attrs["configuration"])
    # of an aircraft the same, by the names of its file
    faster = wf.load_rotor("bo105").with_({"rotor.omega": "45 rad/s"})
    assert faster.omega == 45.0 and faster.with_({"rotor.omega": "44 rad/s"}).omega == 44.0
    with pytest.raises(wf.InputError, match="must be given first"):
        stiffer.with_rigid_blades().with_({"rotor.omega": "26 rad/s"})
    with pytest.raises(wf.InputError, match=r"rotor\.omega"):
        wf.load_rotor(path).with_({"rotor.omega": "20 m"})


def test_a_flight_says_which_blade_lies_on_its_stop_and_since_when():
    free = wf.load_aircraft("uh60a").with_rigid_blades()
    stop = {"rotor.blade.flap_stops": {"high": "4 deg", "stiffness": "1e6 N m/rad"}}
    runs = {}
    for name, aircraft in {"free": free, "stopped": free.with_(stop)}.items():
        start = wf.trim(aircraft, wf.FlightCondition(speed="120 kt"), inflow="dynamic")
        hands = wf.Maneuver("hands off", {}, seconds=1.0)
        runs[name] = wf.fly(start, hands, revolutions=2, integrator="fixed").data
    assert np.degrees(runs["free"].flap.max()) > 4.5
    assert runs["stopped"].flap.max() < runs["free"].flap.max() - np.radians(0.2)
    assert "flap stop" not in runs["free"].attrs["warnings"]
    assert "pushes its flap stop in by" in runs["stopped"].attrs["warnings"]


def test_nodes_below_the_ground_are_told():
    from wakeflight.monitors import hinges

    told = hinges.below_ground(np.array([0.0, 0.1, 0.2]))
    assert told.text == "10.0 % on average, 20.0 % at most" and told.warning is None
