# SPDX-License-Identifier: MIT OR Apache-2.0
"""A Monte Carlo of the arrested descent: the same stick, with weight, centre of gravity and speed as uncertain as they are.

The table has a dimension `member`; what was drawn stands beside the histories as coordinates, so that a correlation is a line.
"""

from pathlib import Path

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style, sweeps


def main(out: Path = Path("runs/examples"), members: int = 24, revolutions: float = 12.0) -> Path:
    """Fly every member, print what the spread comes from, draw histories; returns the figure's path."""
    cases = wf.sample(
        members,
        seed=1,
        weight=wf.Normal("16000 lbf", "400 lbf"),
        speed=wf.Uniform("76 kt", "84 kt"),
        **{"aircraft.loading.cg_station": wf.Normal("358 in", "2 in")},
    )
    table = wf.sweep(
        wf.fly, cases, maneuver=wf.arrested_descent(), inflow="dynamic", revolutions=revolutions, integrator="fixed",
        keep=["w", "q", "pitch", "down"],
    )  # fmt: skip
    end = table.pitch.isel(time=-1)
    print(f"pitch at the end: {np.degrees(float(end.mean())):.2f} deg, spread {np.degrees(float(end.std())):.2f} deg")
    for name in ("weight", "speed", "aircraft.loading.cg_station"):
        along = table[f"{name}_value"]
        print(f"  correlation with {name}: {np.corrcoef(along, end)[0, 1]:+.2f}")
    return style.save(sweeps.figure(table, ["w", "q", "pitch"]), out / "monte_carlo.png")


if __name__ == "__main__":
    print(f"wrote {main()}")
