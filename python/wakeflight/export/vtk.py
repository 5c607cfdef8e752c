# SPDX-License-Identifier: MIT OR Apache-2.0
"""Wakes, blades and path for ParaView: PolyData files (.vtp) per moment, and a time series (.pvd) to open."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..atomic import write_text
from ..results import frames

if TYPE_CHECKING:
    import xarray as xr


def write(run: xr.Dataset, out_dir: str | Path, name: str = "wake") -> Path:
    """Write every wake snapshot of a run, a polyline per blade in hub axes [m]: x aft, y right, z up.

    A run with the sheets of a full-span wake gives a polyline per trailer, numbered from root to tip.
    Point data: `age` [rad], `blade`, `trailer` and, where the run has them, `circulation` [m2/s] and `core_radius` [m]. Times in
    the series are seconds from the start of the flight. Returns the path of the .pvd file, the one to open.
    """
    if "wake" not in run:
        raise ValueError("the run has no wake to export")
    out_dir = Path(out_dir)
    entries = []
    for k, time in enumerate(snapshot_times(run)):
        file = f"{name}-{k:03d}.vtp"
        write_text(out_dir / file, poly_data(*_vortices(run, k)), encoding="ascii")
        entries.append((time, 0, file))
    return _series(out_dir / f"{name}.pvd", entries)


def write_all(run: xr.Dataset, out_dir: str | Path) -> Path:
    """Wake and blades of every moment, in hub axes (`hub.pvd`) and, of a flight, in earth axes (`earth.pvd`) with its path.

    Earth axes: x east, y north, z up, from the start of the flight [m]. Moments are those of the wake's snapshots, four a
    revolution where there is no wake. Blades are flat, of the chord at 0.75 R, at their flap and lead angles, with point data
    `blade` and `radius` [m]. `earth.pvd` has the path flown as a line. Returns the series to open first.
    """
    if "wake" in run and "snapshot" not in run.dims:
        # a rotor on a stand: one moment
        run = run.expand_dims("snapshot").assign(snapshot_revolution=("snapshot", [0.0]))
    flown = "azimuth" in run and "time" in run.dims
    if not flown:
        return write(run, out_dir)
    out_dir = Path(out_dir)
    times = snapshot_times(run) if "wake" in run else _quarter_turns(run)
    rows = [int(np.argmin(np.abs(run["time"].values - time))) for time in times]
    turned, hub = frames.hub_in_earth(run)
    path = np.stack([run["east"].values, run["north"].values, -run["down"].values], axis=1)
    seconds = {"time": run["time"].values[None]}
    write_text(out_dir / "path.vtp", poly_data(path[None], seconds), encoding="ascii")
    kept: dict[str, list[tuple[float, int, str]]] = {"hub": [], "earth": []}
    for k, (time, row) in enumerate(zip(times, rows, strict=True)):
        corners, faces = _blades(run, row)
        for frame, entries in kept.items():
            placed = _same if frame == "hub" else _Placed(turned[row], hub[row])
            if "wake" in run:
                nodes, data = _vortices(run, k)
                file = f"{frame}-wake-{k:03d}.vtp"
                write_text(out_dir / file, poly_data(placed(nodes), data), encoding="ascii")
                entries.append((time, 0, file))
            file = f"{frame}-blades-{k:03d}.vtp"
            write_text(out_dir / file, poly_data(placed(corners), faces, kind="Polys"), encoding="ascii")
            entries.append((time, 1, file))
            if frame == "earth":
                entries.append((time, 2, "path.vtp"))
    _series(out_dir / "earth.pvd", kept["earth"])
    return _series(out_dir / "hub.pvd", kept["hub"])


def snapshot_times(run: xr.Dataset) -> np.ndarray:
    """Times of the wake's snapshots from the start of the flight [s]."""
    times: np.ndarray = run["snapshot_revolution"].values * 2 * np.pi / float(run.attrs["omega"])
    return times


def _quarter_turns(run: xr.Dataset) -> np.ndarray:
    return np.arange(0.0, float(run["time"][-1]) + 1e-9, 0.5 * np.pi / float(run.attrs["omega"]))


def _vortices(run: xr.Dataset, k: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Nodes (lines, ages, 3) [m, hub axes] of one snapshot, and what is known at them."""
    snapshot = run.isel(snapshot=k)
    sheet = "wake_sheet" if "wake_sheet" in run else "wake"
    nodes = snapshot[sheet].values
    lines = nodes.shape[:-2]
    data = {
        "age": np.broadcast_to(run["age"].values, nodes.shape[:-1]),
        "blade": np.broadcast_to(run["blade"].values.reshape(-1, *[1] * len(lines)), nodes.shape[:-1]),
    }
    if len(lines) == 2:
        data["trailer"] = np.broadcast_to(run["trailer"].values[None, :, None], nodes.shape[:-1])
    for label, variable in (("circulation", f"{sheet}_circulation"), ("core_radius", f"{sheet}_core")):
        if variable in run:
            data[label] = snapshot[variable].values
    flat = {label: values.reshape(-1, nodes.shape[-2]) for label, values in data.items()}
    return nodes.reshape(-1, *nodes.shape[-2:]), flat


def _blades(run: xr.Dataset, row: int) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Corners (blades, 4, 3) [m, hub axes] of flat blades at one record, and their numbers and radii."""
    shape = frames.geometry(run)
    radius = float(run.attrs["radius"])
    r = np.array([shape["root_cutout"], radius, radius, shape["root_cutout"]])
    behind = shape["chord"] * np.array([-0.25, -0.25, 0.75, 0.75])
    azimuth, flap, lead = (run[name].values[row] for name in ("azimuth", "flap", "lead"))
    corners = frames.blade_points(shape, azimuth, flap, lead, r, behind)
    blade = np.broadcast_to(run["blade"].values[:, None], corners.shape[:-1])
    return corners, {"blade": blade, "radius": np.broadcast_to(r, corners.shape[:-1])}


class _Placed:
    """Hub axes to earth axes: east, north, up."""

    def __init__(self, turned: np.ndarray, hub: np.ndarray):
        self.turned, self.hub = turned, hub

    def __call__(self, nodes: np.ndarray) -> np.ndarray:
        north, east, down = np.moveaxis(nodes @ self.turned.T + self.hub, -1, 0)
        return np.stack([east, north, -down], axis=-1)


def _same(nodes: np.ndarray) -> np.ndarray:
    return nodes


def _series(path: Path, entries: list[tuple[float, int, str]]) -> Path:
    """Write the collection of files over time; parts of one moment are numbered."""
    rows = "\n".join(
        f'    <DataSet timestep="{time:.9g}" part="{part}" file="{file}"/>' for time, part, file in entries
    )
    write_text(path, _document("Collection", f"  <Collection>\n{rows}\n  </Collection>"))
    return path


def poly_data(nodes: np.ndarray, point_data: dict[str, np.ndarray], kind: str = "Lines") -> str:
    """VTK XML text of polylines, or of polygons (`Polys`): nodes (lines, points, 3), point data each (lines, points)."""
    n_lines, n_points = nodes.shape[:2]
    n_all = n_lines * n_points
    scalars = "\n".join(_array(name, values) for name, values in point_data.items())
    lines = (
        _array("connectivity", np.arange(n_all), "Int64")
        + "\n"
        + _array("offsets", n_points * np.arange(1, n_lines + 1), "Int64")
    )
    piece = f"""  <PolyData>
    <Piece NumberOfPoints="{n_all}" NumberOf{kind}="{n_lines}">
      <PointData>
{scalars}
      </PointData>
      <Points>
{_array("position", nodes.reshape(-1, 3))}
      </Points>
      <{kind}>
{lines}
      </{kind}>
    </Piece>
  </PolyData>"""
    return _document("PolyData", piece)


def _document(kind: str, content: str) -> str:
    head = f'<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt64">'
    return f'<?xml version="1.0"?>\n{head}\n{content}\n</VTKFile>\n'


def _array(name: str, values: np.ndarray, kind: str = "Float64") -> str:
    """One DataArray in plain text; nine digits are a hundredth of a micrometre on a rotor."""
    components = 3 if name == "position" else 1
    text = " ".join(f"{value:d}" if kind == "Int64" else f"{value:.9g}" for value in np.ravel(values).tolist())
    head = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
    return f"        {head}\n          {text}\n        </DataArray>"
