# SPDX-License-Identifier: MIT OR Apache-2.0
"""The start of the arrested descent with the tip-vortex wakes and with the full-span wake: histories to compare.

`python benchmarks/wake_defaults_maneuver.py FOLDER [NAME ...]` trims and flies each wake that FOLDER has no file of, at the
discretisation of `wake_defaults.py`; without names all.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np
from wake_defaults import CANDIDATES, COMMON, FULL_SPAN, file_of

import wakeflight as wf

REVOLUTIONS = 4.0
CONVERGENCE = 3
HISTORIES = ("inflow_mean", "ct", "beta_1c", "beta_1s", "force_z", "moment_x", "moment_y", "power", "w", "p", "q")
WAKES = {
    "full-span": FULL_SPAN,
    **{name: CANDIDATES[name] for name in ("equivalent", "mean", "max", "equivalent, sheet", "max, sheet")},
}


def run(aircraft: wf.Aircraft, options: dict) -> dict:
    """One flight as plain numbers and lists."""
    started = time.process_time()
    trim_options = {**COMMON, **options}
    marching = {name: value for name, value in trim_options.items() if name != "max_loops"}
    start = wf.trim(aircraft, inflow=wf.RelaxationWake(**trim_options))
    inflow = wf.TimeMarchingWake(convergence_revolutions=CONVERGENCE, evaluation="pece", **marching)
    data = wf.fly(start, wf.arrested_descent(start="0.05 s"), inflow=inflow, revolutions=REVOLUTIONS).data
    return {
        "time": data["time"].values.tolist(),
        **{name: data[name].values.tolist() for name in HISTORIES},
        "inflow": data["inflow"].values[-24:].tolist(),
        "cl_m2": data["cl_m2"].values[-24:].tolist(),
        "area_weights": start.model.area_weights.tolist(),
        "convergence_change": np.atleast_1d(json.loads(str(data.attrs["convergence_change"]))).tolist(),
        "cpu_seconds": time.process_time() - started,
    }


def main(folder: Path, names: list[str]) -> None:
    """Fly what is missing."""
    folder.mkdir(parents=True, exist_ok=True)
    aircraft = wf.load_aircraft("uh60a")
    for name in names or list(WAKES):
        path = file_of(folder, "maneuver", name)
        if not path.exists():
            numbers = run(aircraft, WAKES[name])
            path.write_text(json.dumps(numbers))
            print(f"maneuver  {name:<32}{numbers['cpu_seconds']:7.1f} s", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
