# SPDX-License-Identifier: MIT OR Apache-2.0
"""Results for other programs: what is written is what the dataset holds, and stands where it should in space."""

import csv
import json
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
import synthetic

import wakeflight as wf
from wakeflight.export import FORMATS, export
from wakeflight.results import frames

SHAPE = {
    "hub": [0.36, 0.0, -1.71],
    "shaft_tilt": [np.radians(3.0), np.radians(1.0)],
    "rotation": 1,
    "hinge_offset": 0.381,
    "root_cutout": 1.0,
    "chord": 0.527,
    "stick_travel": [10.0, 10.0, 10.0, 5.38],
}


@pytest.fixture(scope="module")
def run():
    arrays = synthetic.run_arrays()
    arrays |= {"flap": np.full_like(arrays["azimuth"], 0.05), "lead": np.full_like(arrays["azimuth"], -0.02)}
    from wakeflight.results import assemble

    return assemble(arrays, synthetic.attributes(geometry=json.dumps(SHAPE)))


def test_matlab_gets_every_variable_with_unit_and_meaning(run, tmp_path):
    from scipy.io import loadmat

    read = loadmat(export(run, tmp_path, "mat"), simplify_cells=True)
    for name in run.data_vars:
        assert np.array_equal(read[name], run[name].values)
        assert read["units"][name] == run[name].attrs["units"]
        assert read["dimensions"][name] == ", ".join(run[name].dims)
    assert read["attributes"]["aircraft"] == "uh60a"


def test_netcdf3_holds_the_same(run, tmp_path):
    import xarray as xr

    with xr.open_dataset(export(run, tmp_path, "netcdf3"), engine="scipy") as read:
        for name in run.data_vars:
            assert np.array_equal(read[name].values, run[name].values)
            assert read[name].attrs["units"] == run[name].attrs["units"]
    with (tmp_path / "run-netcdf3.nc").open("rb") as file:
        assert file.read(3) == b"CDF"


def test_tables_have_a_row_for_each_place_and_units_in_their_heads(run, tmp_path):
    export(run, tmp_path, "csv")
    with (tmp_path / "time.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == run.sizes["time"]
    assert [float(row["force_z [N]"]) for row in rows] == run.force_z.values.tolist()
    assert [float(row["hub_force_y [N]"]) for row in rows] == run.hub_force.sel(xyz="y").values.tolist()
    with (tmp_path / "time-blade-station.csv").open(encoding="utf-8") as file:
        row = list(csv.DictReader(file))[1 * 4 * 20 + 2 * 20 + 5]
    assert float(row["inflow [1]"]) == float(run.inflow[1, 2, 5])
    assert (float(row["time [s]"]), row["blade [1]"]) == (float(run.time[1]), "3")


def test_blades_stand_in_hub_axes_at_their_angles():
    azimuth, flap, lead = (np.array([each]) for each in (0.0, 0.1, 0.0))
    (tip,) = frames.blade_points(SHAPE, azimuth, flap, lead, np.array([8.0]), np.zeros(1))[0]
    out = 8.0 - SHAPE["hinge_offset"]
    # over the tail, flapped up
    assert tip == pytest.approx([SHAPE["hinge_offset"] + out * np.cos(0.1), 0.0, out * np.sin(0.1)])
    (edge,) = frames.blade_points(SHAPE, np.array([np.pi / 2]), 0 * flap, lead, np.array([8.0]), np.array([0.4]))[0]
    # on the right, turning towards the nose: the trailing edge is aft
    assert edge == pytest.approx([0.4, 8.0, 0.0])
    mirrored = {**SHAPE, "rotation": -1}
    (edge,) = frames.blade_points(mirrored, np.array([np.pi / 2]), 0 * flap, lead, np.array([8.0]), np.array([0.4]))[0]
    assert edge == pytest.approx([0.4, -8.0, 0.0])


def test_hub_axes_are_those_of_the_physics_core():
    aircraft = wf.load_aircraft("bo105")
    start = wf.trim(aircraft, wf.FlightCondition(speed="40 kt", flight_path="0 deg"), inflow="dynamic")
    sim = wf.Simulation(start)
    velocity, _ = sim.model.core.hub(sim.y)
    turned = frames.body_of_hub(*aircraft.geometry["shaft_tilt"])
    assert turned @ velocity == pytest.approx(sim.y[:3], abs=1e-9)


def test_the_hub_stands_above_the_body_in_earth_axes(run):
    turned, hub = frames.hub_in_earth(run)
    place = np.stack([run.north, run.east, run.down], axis=1)
    assert (hub[:, 2] < place[:, 2]).all()
    assert np.linalg.norm(hub - place, axis=1) == pytest.approx(np.linalg.norm(SHAPE["hub"]))
    # z of the hub points up, x aft
    assert turned[0, 2, 2] < -0.9
    assert turned[0, 0, 0] < -0.9


def _points(path):
    piece = ElementTree.parse(path).getroot().find("./PolyData/Piece")
    return piece, np.array(piece.find("./Points/DataArray").text.split(), dtype=float).reshape(-1, 3)


def test_paraview_gets_wake_and_blades_in_both_axes(run, tmp_path):
    series = export(run, tmp_path, "vtk")
    files = [each.get("file") for each in ElementTree.parse(series).getroot().findall("./Collection/DataSet")]
    assert len(files) == 2 * run.sizes["snapshot"]
    piece, blades = _points(tmp_path / "hub-blades-001.vtp")
    assert int(piece.get("NumberOfPolys")) == run.sizes["blade"]
    assert np.linalg.norm(blades, axis=1).max() < 1.01 * run.attrs["radius"]
    _, wake = _points(tmp_path / "hub-wake-001.vtp")
    _, flown = _points(tmp_path / "earth-wake-001.vtp")
    # a rotation and a shift: distances stay
    lengths = [np.linalg.norm(np.diff(points, axis=0), axis=1) for points in (wake, flown)]
    assert lengths[1] == pytest.approx(lengths[0], rel=1e-6)
    _, path = _points(tmp_path / "path.vtp")
    assert path == pytest.approx(np.stack([run.east, run.north, -run.down], axis=1), rel=1e-8)


def test_what_a_result_has_not_is_refused(run, tmp_path):
    with pytest.raises(wf.InputError, match="did you mean mat"):
        export(run, tmp_path, "matlab")
    old = run.drop_attrs()
    old.attrs = {name: value for name, value in run.attrs.items() if name != "geometry"}
    with pytest.raises(wf.InputError, match="earlier version"):
        export(old, tmp_path, "vtk")


def test_every_format_of_the_command_line_is_one():
    from wakeflight.cli.export import FORMATS as OFFERED

    assert set(OFFERED) <= set(FORMATS)
