# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a helicopter could have but hardly has is told by key; a factor of ten mostly is one or the other."""

import math
import shutil
from importlib import resources
from pathlib import Path

import pytest

import wakeflight as wf
from wakeflight.aircraft import load_aircraft
from wakeflight.aircraft.rotor_doubts import damper_stroke

PACKAGE = Path(str(resources.files("wakeflight.aircraft")))


def copied(tmp_path, name):
    shutil.copytree(PACKAGE / name, tmp_path / name)
    return tmp_path / name / f"{name}.toml"


def column_changed(path, column, change):
    """The CSV file at `path` with `change` done to the numbers of `column` (`M...`: of every Mach number)."""
    lines = path.read_text().splitlines()
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    names = lines[head].split(",")
    chosen = [i for i, name in enumerate(names) if name == column or (column == "M..." and name.startswith("M"))]
    assert chosen
    for i in range(head + 1, len(lines)):
        cells = lines[i].split(",")
        for k in chosen:
            cells[k] = repr(change(float(cells[k])))
        lines[i] = ",".join(cells)
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize(
    ("table", "column", "factor", "told"),
    [
        # air forces over inertia: a tenth of the mass leaves a blade of balsa
        ("blade_structure.csv", "mass_kg_m", 0.1, "Lock number"),
        ("blade_structure.csv", "EI_flap_Nm2", 1000.0, "steel"),
        ("blade_structure.csv", "EI_lag_Nm2", 1000.0, "steel"),
        ("blade_structure.csv", "GJ_Nm2", 1000.0, "steel"),
        ("blade_structure.csv", "I_theta_cg_kgm", 0.0, "inertia in torsion"),
        ("blade_geometry.csv", "twist_deg", -1.0, "wash out"),
        ("blade_geometry.csv", "twist_deg", 8.0, "beyond 45 deg"),
        ("naca23012_cl.csv", "M...", 0.1, "lift slope"),
        ("naca23012_cd.csv", "M...", 0.1, "smooth plate"),
        ("naca23012_cd.csv", "M...", 0.5, "across the stream"),
        ("stabilator.csv", "cl", 0.1, "stubby"),
        ("fin.csv", "cl", 0.1, "stubby"),
        ("fin.csv", "cd", 0.1, "at 90 deg"),
        ("stabilator.csv", "cd", 0.0, "at 90 deg"),
        ("fuselage.csv", "Dq_m2", 0.1, "straight ahead"),
        ("fuselage.csv", "Lq_m2", 10.0, "above the largest drag"),
        ("fuselage.csv", "Yq_m2", 10.0, "above the largest drag"),
        ("fuselage.csv", "Mq_m3", 10.0, "above the largest drag"),
    ],
)
def test_a_table_off_by_a_factor_is_told(tmp_path, table, column, factor, told):
    path = copied(tmp_path, "bo105")
    # an inertia per length that stays within its section
    if column == "mass_kg_m":
        column_changed(path.parent / table, "I_theta_cg_kgm", lambda x: factor * x)
    column_changed(path.parent / table, column, lambda x: factor * x)
    assert any(told in warning for warning in load_aircraft(path).warnings)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("ixx = { value = 4659,", "ixx = { value = 40000,", "longer than they are wide"),
        ("cg_station = { value = 358.0,", "cg_station = { value = 440.0,", "beside the hub"),
        ("cg_waterline = { value = 248.2,", "cg_waterline = { value = 320.0,", "not below the hub"),
        ("weight = { value = 16000,", "weight = { value = 80000,", "CT/sigma"),
        ("position = { value = [732.0, 14.0, 324.7]", "position = { value = [300.0, 14.0, 324.7]", "add to the torque"),
        ("position = { value = [700.0,", "position = { value = [1200.0,", "stabilator.position"),
        ("position = { value = [695.0,", "position = { value = [300.0,", "fin.position: not behind"),
        ("position = { value = [345.5, 0.0, 234.0]", "position = { value = [345.5, 0.0, 0.0]", "fuselage.position"),
        ("area = { value = 45.0,", "area = { value = 450.0,", "stabilator.area"),
        ("cd_polar = { value = [0.0087, -0.0216, 0.4]", "cd_polar = { value = [0.87, -0.0216, 0.4]", "cd_polar"),
        ("power = { value = 2828,", "power = { value = 282.8,", "ideal power of hover"),
        ("accessory_power = { value = 60.0,", "accessory_power = { value = 2000.0,", "half of limits.power"),
        ("swashplate_phase = { value = -9.7,", "swashplate_phase = { value = -97,", "swashplate_phase"),
        ("forward = { value = 3.0,", "forward = { value = 30.0,", "rotor.shaft.forward"),
        ("precone = { value = 0.0,", "precone = { value = -2.0,", "coned up"),
        ("cd_increment = { value = 0.002,", "cd_increment = { value = -0.002,", "takes drag away"),
        ("r = { value = 6.898,", "r = { value = 689.8,", "quarter of the radius"),
    ],
)
def test_a_number_hardly_any_helicopter_has_is_told(tmp_path, old, new, told):
    path = copied(tmp_path, "uh60a")
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    assert any(told in warning for warning in load_aircraft(path).warnings)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda x: 0.0, "does nothing"),
        # force that has risen to 1000 lbf falls with the rate from there on: what it damps there shrinks
        (lambda x: min(x, max(0.0, 2000.0 - x)), "damps less"),
    ],
)
def test_a_damper_that_hardly_damps_is_told(tmp_path, change, told):
    path = copied(tmp_path, "uh60a")
    column_changed(path.parent / "lag_damper.csv", "force_lbf", change)
    assert any(told in warning for warning in load_aircraft(path).warnings)


def test_the_stroke_of_a_damper_is_the_slope_of_its_length():
    damper = load_aircraft("uh60a").core_data()["rotor"]["lag_damper"]

    def length(lead):
        s = lead + damper["zeta_geo"]
        x = damper["c"] + damper["b"] * math.cos(s) + damper["d"] * math.sin(s)
        y = -damper["r"] - damper["b"] * math.sin(s) + damper["d"] * math.cos(s)
        return math.sqrt(x * x + y * y + damper["a"] ** 2)

    assert damper_stroke(damper) == pytest.approx((length(1e-5) - length(-1e-5)) / 2e-5, rel=1e-8)
    # a rod end on the hinge line turns about it: the length does not change, whatever the hinge does
    on_the_line = {**damper, "b": 0.0, "d": 0.0}
    assert damper_stroke(on_the_line) == 0.0


def test_a_fin_in_the_way_adds_no_thrust(tmp_path):
    path = copied(tmp_path, "uh60a")
    text = path.read_text()
    for factors in ("[1.1, 1.0, 30.0]", "[0.9, 0.0, 30.0]"):
        path.write_text(text.replace("[0.9, 1.0, 30.0]", factors, 1))
        with pytest.raises(wf.InputError, match=r"tail_rotor\.fin_blockage"):
            load_aircraft(path)


@pytest.mark.parametrize("column", ["x_cg_m", "x_cg_straight_m"])
def test_a_column_that_stands_for_another_is_bounded_too(tmp_path, column):
    # straight_tip chooses one of the two: a slip in the other waits for whoever changes it
    path = copied(tmp_path, "uh60a")
    column_changed(path.parent / "blade_structure.csv", column, lambda x: 1e30)
    with pytest.raises(wf.InputError, match=column):
        load_aircraft(path)
