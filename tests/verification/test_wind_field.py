# SPDX-License-Identifier: MIT OR Apache-2.0
"""Fields of velocity: linear ones reproduced exactly, in a ship's axes, with time, up or down; what cannot be read is refused."""

import numpy as np
import pytest
import xarray as xr

import wakeflight as wf


def linear(x, y, z, t=0.0):
    """u, v, w of a field that is linear in everything."""
    return np.stack([2.0 + 0.1 * x - 0.2 * z, 0.3 * y + 0.05 * t, -1.0 + 0.1 * x + 0.02 * y - 0.07 * t], axis=-1)


def dataset(times=(0.0, 4.0), positive="down", units="m/s"):
    x, y, z = np.linspace(-40, 60, 6), np.linspace(-20, 30, 5), np.linspace(-10, 20, 4)
    t = np.array(times)
    grid = np.meshgrid(t, x, y, z, indexing="ij")
    sign = -1.0 if positive == "up" else 1.0
    values = linear(grid[1], grid[2], sign * grid[3], grid[0])
    values[..., 2] *= sign
    data = {name: (("time", "x", "y", "z"), values[..., i], {"units": units}) for i, name in enumerate("uvw")}
    edges = {name: (name, each, {"units": "m"}) for name, each in (("x", x), ("y", y), ("z", z))}
    edges["time"] = ("time", t, {"units": "s"})
    found = xr.Dataset(data, edges)
    found.z.attrs["positive"] = positive
    return found


POINTS = np.random.default_rng(1).uniform([-15, -10, -8], [15, 15, 9], (40, 3))


@pytest.mark.parametrize("positive", ["down", "up"])
def test_a_linear_field_is_reproduced_exactly(positive):
    field = wf.WindField(dataset(positive=positive))
    assert np.abs(field(POINTS, 1.3) - linear(*POINTS.T, 1.3)).max() < 1e-12
    assert field.beyond == 0
    steady = wf.WindField(dataset(positive=positive).isel(time=0, drop=True))
    assert np.abs(steady(POINTS, 9.0) - linear(*POINTS.T)).max() < 1e-12


def test_a_ship_carries_its_airwake():
    still = wf.WindField(dataset())
    ship = wf.WindField(dataset(), heading="90 deg", speed="5 m/s", origin=("10 m", "2 m", "-1 m"))
    t = 0.7
    # north, east, down of a point that is forward, right, down of the field's zero on a ship that heads east
    forward, right, down = POINTS.T
    place = np.stack([-(right - 2.0), forward - 10.0 + 5.0 * t, down + 1.0], axis=1)
    u, v, w = still(POINTS, t).T
    assert np.abs(ship(place, t) - np.stack([-v, u, w], axis=1)).max() < 1e-12


def test_beyond_its_edges_a_field_is_held_or_nothing_and_counts():
    far = np.array([[100.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    held, nothing = wf.WindField(dataset()), wf.WindField(dataset(), outside="zero")
    assert held(far, 0.0)[0] == pytest.approx(linear(60.0, 0.0, 0.0))
    assert np.array_equal(nothing(far, 0.0)[0], np.zeros(3)) and nothing(far, 0.0)[1, 0] == pytest.approx(2.0)
    assert (held.beyond, nothing.beyond) == (1, 2)


def test_a_file_is_told_and_made_again(tmp_path):
    from wakeflight.wind import wind_of_table

    path = tmp_path / "airwake.nc"
    dataset(units="kt").to_netcdf(path, engine="h5netcdf")
    field = wf.WindField(str(path), heading="30 deg")
    again = wind_of_table(field.described())
    assert np.array_equal(again(POINTS, 1.0), field(POINTS, 1.0))
    assert np.linalg.norm(field(POINTS, 1.0), axis=1) == pytest.approx(
        np.linalg.norm(linear(*(POINTS @ again._turn.T).T, 1.0), axis=1) * 1852 / 3600
    )


def test_what_is_no_field_is_refused_by_name(tmp_path):
    whole = dataset()
    bare = whole.copy()
    bare.u.attrs.clear()
    broken = whole.copy(deep=True)
    broken.v.values[0, 0, 0, 0] = np.nan
    turned = whole.isel(x=slice(None, None, -1))
    for source, named in (
        (whole.drop_vars("w"), "u, v, w"),
        (whole.isel(z=0), "coordinates"),
        (bare, "attribute units"),
        (broken, "must be finite"),
        (turned, r"wind field x = '[-0-9.]+ before [-0-9.]+': .* ascend: sort the field by x"),
        (str(tmp_path / "none.nc"), "cannot be read"),
        (7, "u, v, w"),
    ):
        with pytest.raises(wf.InputError, match=named):
            wf.WindField(source)
    with pytest.raises(wf.InputError, match="outside"):
        wf.WindField(whole, outside="wrap")
