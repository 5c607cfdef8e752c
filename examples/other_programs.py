# SPDX-License-Identifier: MIT OR Apache-2.0
"""Results for other programs: ParaView, MATLAB, spreadsheets, and the NetCDF file itself.

`run.nc` is NetCDF-4: Python reads it with xarray, MATLAB with `ncread("run.nc", "force_z")`, Julia with NCDatasets. For the rest
there is `wf.export`.
"""

from pathlib import Path

import matplotlib.pyplot as plt

import wakeflight as wf


def main(out: Path = Path("runs/examples"), revolutions: float = 2) -> Path:
    """Fly briefly, write every format, draw the tip vortices from above; returns the figure's path."""
    start = wf.trim(wf.load_aircraft("bo105"), inflow="relaxation")
    flight = wf.fly(start, wf.arrested_descent(), inflow="time-marching", revolutions=revolutions)
    out.mkdir(parents=True, exist_ok=True)
    print(f"wrote {flight.save(out / 'other_programs.nc').name}")
    for form in ("vtk", "mat", "csv", "netcdf3"):
        print(f"wrote {form}: {wf.export(flight.data, out / 'other_programs' / form, to=form).name}")

    wake = flight.data.wake.isel(snapshot=-1) / flight.data.attrs["radius"]
    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for blade in wake.blade:
        line = wake.sel(blade=blade)
        axes.plot(line.sel(xyz="x"), line.sel(xyz="y"), linewidth=0.9, label=f"blade {int(blade)}")
    axes.set(xlabel="x/R, aft", ylabel="y/R, right", aspect="equal")
    figure.legend(ncols=4, fontsize=8, loc="outside upper center")
    figure.savefig(out / "other_programs.png", dpi=130)
    plt.close(figure)
    return out / "other_programs.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
