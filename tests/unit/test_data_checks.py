# SPDX-License-Identifier: MIT OR Apache-2.0
"""Data are checked for physics on loading: what cannot be is refused by file and key, what is doubtful is told."""

import shutil
from importlib import resources
from pathlib import Path

import pytest

import wakeflight as wf
from wakeflight.aircraft import load_aircraft

PACKAGE = Path(str(resources.files("wakeflight.aircraft")))
ROTORS = sorted(Path("validation/rotors").resolve().glob("*.toml"))

AXES = {"alpha_deg", "beta_deg", "angle_deg", "psi_deg", "chi_deg", "a1f_deg", "r_R", "r_in_m", "r_out_m", "rate_in_s"}
"""Columns that are arguments: the tables' values are the others."""

NO_SIGN = {"fuselage_wash.csv"}
"""Tables whose values physics lets have either sign: the wash of a fuselage depends on its shape."""

TABLES = [(name, path.name) for name in ("uh60a", "bo105") for path in sorted((PACKAGE / name).glob("*.csv"))]


def copied(tmp_path, name):
    shutil.copytree(PACKAGE / name, tmp_path / name)
    return tmp_path / name / f"{name}.toml"


def refused(path, *named):
    with pytest.raises(wf.InputError) as caught:
        load_aircraft(path)
    message = str(caught.value)
    for each in named:
        assert each in message, message
    assert "\n" not in message
    assert len(message) < 500
    return message


def rewritten(path, change):
    """The CSV file at `path` with `change` done to the value of every cell that is a number and no argument."""
    header, lines = None, []
    for line in path.read_text().splitlines():
        if line.startswith("#") or not line.strip():
            lines.append(line)
        elif header is None:
            header = line.split(",")
            lines.append(line)
        else:
            cells = line.split(",")
            for i, (name, cell) in enumerate(zip(header, cells, strict=True)):
                try:
                    cells[i] = cell if name in AXES else repr(change(float(cell)))
                except ValueError:
                    continue
            lines.append(",".join(cells))
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize("name", ["uh60a", "bo105"])
def test_shipped_aircraft_are_without_doubt(name):
    assert load_aircraft(name).warnings == ()


@pytest.mark.parametrize("path", ROTORS, ids=lambda path: path.stem)
def test_shipped_rotors_are_without_doubt(path):
    assert wf.load_rotor(path).warnings == ()


@pytest.mark.parametrize(("name", "table"), TABLES)
def test_a_negated_table_is_refused(tmp_path, name, table):
    # drag would drive, lift fall with the angle, masses be negative, the wake go up, the damper feed the lag motion
    path = copied(tmp_path, name)
    rewritten(path.parent / table, lambda x: -x)
    if table in NO_SIGN:
        load_aircraft(path)
    else:
        refused(path, table)


@pytest.mark.parametrize("factor", [100.0, 1e30, 1e300])
@pytest.mark.parametrize(("name", "table"), TABLES)
def test_a_table_blown_up_is_refused(tmp_path, name, table, factor):
    path = copied(tmp_path, name)
    rewritten(path.parent / table, lambda x: factor * x)
    if table == "blade_structure.csv" and factor == 100.0:
        # the blades would outweigh the aircraft, or their mass lie outside of them
        refused(path, name)
    else:
        refused(path, table)


@pytest.mark.parametrize(("name", "table"), TABLES)
def test_a_table_cut_in_half_is_refused(tmp_path, name, table):
    path = copied(tmp_path, name)
    lines = (path.parent / table).read_text().splitlines()
    first = next(i for i, line in enumerate(lines) if not line.startswith("#")) + 1
    body = [line for line in lines[first:] if line.strip()]
    # a damper's force may be known to any rate, but from rest on
    kept = body[len(body) // 2 :] if table == "lag_damper.csv" else body[: len(body) // 2]
    (path.parent / table).write_text("\n".join(lines[:first] + kept) + "\n")
    refused(path, table)


@pytest.mark.parametrize(("name", "table"), TABLES)
def test_a_column_that_is_not_used_is_refused(tmp_path, name, table):
    path = copied(tmp_path, name)
    lines, header = [], True
    for line in (path.parent / table).read_text().splitlines():
        if line.startswith("#") or not line.strip():
            lines.append(line)
            continue
        lines.append(line + (",sweep_deg" if header else ",20"))
        header = False
    (path.parent / table).write_text("\n".join(lines) + "\n")
    assert "unknown column" in refused(path, table, "sweep_deg")


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("omega = { value = 27.0,", "omega = { value = 42.0,", "rotor.omega"),
        ("ixz = { value = 1882", "ixz = { value = 18820", "loading.inertia"),
        ("izz = { value = 36796", "izz = { value = 46796", "loading.inertia"),
        ("izz = { value = 37200", "izz = { value = 147200", "loadings.tm85890.inertia"),
        ("weight = { value = 16000, unit", "weight = { value = 900, unit", "condition.weight"),
        ("cd_polar = { value = [0.0087, -0.0216, 0.4]", "cd_polar = { value = [-0.0087, 0.0216, -0.4]", "cd_polar"),
        ("cd_polar = { value = [0.0087, -0.0216, 0.4]", "cd_polar = { value = [0.0087, -0.216, 0.4]", "cd_polar"),
        ("radius = { value = 5.5,", "radius = { value = 55,", "tail_rotor.radius"),
        ("omega = { value = 124.62,", "omega = { value = 246.2,", "tail_rotor.omega"),
        ("cd_increment = { value = 0.002,", "cd_increment = { value = -0.05,", "cd_increment -0.05"),
        ("[0.0, 0.0, 1.563612, 0.0]", "[0.0, 0.0, -1.563612, 0.0]", "collective up must raise"),
        ("[-1.590228, 0.0", "[1.590228, 0.0", "lateral right must lower"),
        ("[0.0, 2.960917,", "[0.0, -2.960917,", "longitudinal aft must raise"),
        ("1.583530, -5.543861]", "1.583530, 5.543861]", "pedal right must lower"),
        ("offset = { value = [7.973828,", "offset = { value = [97.973828,", "rigging"),
        ("[0.0, 0.0, 1.563612, 0.0]", "[0.0, 0.0, 15.63612, 0.0]", "theta_0"),
        ("value = [10.0, 10.0, 10.0, 5.38]", "value = [10.0, 10.0, 0.0, 5.38]", "rigging.stick_travel"),
        ("structural_damping_ratio = { value = 0.01", "structural_damping_ratio = { value = -0.01", "damping_ratio"),
        ("structural_damping_ratio = { value = 0.01", "structural_damping_ratio = { value = 1.0", "damping_ratio"),
        ("control_stiffness = { value = 1090", "control_stiffness = { value = -1090", "control_stiffness"),
        ("n_blades = { value = 4", "n_blades = { value = 1", "n_blades"),
        ("root_cutout = { value = 3.5", "root_cutout = { value = -3.5", "root_cutout"),
        ("power = { value = 2828", "power = { value = -2828", "limits.power"),
        ("altitude = { value = 5250", f"altitude = {{ value = 1{'0' * 400}", "condition.altitude"),
    ],
)
def test_an_impossible_number_is_refused(tmp_path, old, new, named):
    path = copied(tmp_path, "uh60a")
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    refused(path, "uh60a.toml" if "cd_increment" not in old else "sc1095_cd.csv", named)


def test_section_tables_that_end_below_the_advancing_tip_are_told(tmp_path):
    path = copied(tmp_path, "uh60a")
    table = path.parent / "sc1095_cl.csv"
    table.write_text(table.read_text().replace("M0.7,M0.8,M0.9,M1.0", "M0.62,M0.63,M0.64,M0.7", 1))
    (warning,) = load_aircraft(path).warnings
    # 220.8 m/s and 80 kt over 340.3 m/s
    assert "end at Mach 0.7" in warning
    assert "Mach 0.77" in warning


@pytest.mark.parametrize(("column", "told"), [("Lq_ft2", "lift falls"), ("Yq_ft2", "into the wind")])
def test_a_fuselage_whose_forces_are_the_wrong_way_round_is_told(tmp_path, column, told):
    path = copied(tmp_path, "uh60a")
    table = path.parent / "fuselage.csv"
    header, lines = None, []
    for line in table.read_text().splitlines():
        cells = line.split(",")
        if not line.startswith("#") and header is not None:
            at = header.index(column)
            cells[at] = repr(-float(cells[at]))
        elif not line.startswith("#"):
            header = cells
        lines.append(",".join(cells))
    table.write_text("\n".join(lines) + "\n")
    (warning,) = load_aircraft(path).warnings
    assert told in warning


def test_keys_that_speak_to_a_part_that_is_off_are_told(tmp_path):
    path = copied(tmp_path, "uh60a")
    text = path.read_text()
    coning = next(line for line in text.splitlines() if line.startswith("coning ="))
    path.write_text(text.replace(coning + "\n", ""))
    (warning,) = load_aircraft(path).warnings
    assert "tail_rotor.tan_delta3: not used" in warning


def test_the_limit_of_power_is_what_the_file_states():
    assert load_aircraft("uh60a").limits.power == pytest.approx(2828 * 745.6999, rel=1e-6)
    assert load_aircraft("bo105").limits.power == pytest.approx(515e3)
    rows = {row.key: row for row in load_aircraft("uh60a").sources()}
    assert (rows["limits.power"].value, rows["limits.power"].confidence) == (2828, "A/B")
