# SPDX-License-Identifier: MIT OR Apache-2.0
"""Wake snapshots for ParaView: one PolyData file (.vtp) per snapshot, and a time series (.pvd)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..atomic import write_text

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
    seconds = run["snapshot_revolution"].values * 2 * np.pi / float(run.attrs["omega"])
    entries = []
    for k, time in enumerate(seconds):
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
        file = f"{name}-{k:03d}.vtp"
        write_text(out_dir / file, poly_data(nodes.reshape(-1, *nodes.shape[-2:]), flat), encoding="ascii")
        entries.append(f'    <DataSet timestep="{time:.9g}" file="{file}"/>')
    series = _document("Collection", "  <Collection>\n" + "\n".join(entries) + "\n  </Collection>")
    return write_text(out_dir / f"{name}.pvd", series)


def poly_data(nodes: np.ndarray, point_data: dict[str, np.ndarray]) -> str:
    """VTK XML text of polylines: nodes (lines, points, 3), point data each (lines, points)."""
    n_lines, n_points = nodes.shape[:2]
    n_all = n_lines * n_points
    scalars = "\n".join(_array(name, values) for name, values in point_data.items())
    lines = (
        _array("connectivity", np.arange(n_all), "Int64")
        + "\n"
        + _array("offsets", n_points * np.arange(1, n_lines + 1), "Int64")
    )
    piece = f"""  <PolyData>
    <Piece NumberOfPoints="{n_all}" NumberOfLines="{n_lines}">
      <PointData>
{scalars}
      </PointData>
      <Points>
{_array("position", nodes.reshape(-1, 3))}
      </Points>
      <Lines>
{lines}
      </Lines>
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
