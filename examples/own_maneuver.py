# SPDX-License-Identifier: MIT OR Apache-2.0
"""A manoeuvre of one's own: a longitudinal doublet, drawn by the corners of the stick.

A manoeuvre is a stick history about trim: corners (time in s, inches about trim) joined by straight lines. The same stands in
a TOML file for `wakeflight fly FILE.toml`; recorded sticks are a manoeuvre with many corners.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), seconds: float = 4.0) -> Path:
    """Fly a doublet with the BO-105, draw stick, rate and attitude; returns the figure's path."""
    doublet = wf.Maneuver(
        "doublet",
        {"longitudinal": [(0.5, 0.0), (0.6, 0.5), (1.1, 0.5), (1.3, -0.5), (1.8, -0.5), (1.9, 0.0)]},
        seconds=seconds,
    )
    aircraft = wf.load_aircraft("bo105")
    start = wf.trim(aircraft, wf.FlightCondition(speed="80 kt"), inflow="dynamic")
    flight = wf.fly(start, doublet, integrator="fixed")
    data = flight.data

    figure, panels = plt.subplots(3, 1, sharex=True, figsize=(6.4, 5.6), layout="constrained")
    panels[0].plot(data.time, data.longitudinal)
    panels[0].set_ylabel("stick, aft + [in]")
    panels[1].plot(data.time, np.degrees(data.q))
    panels[1].set_ylabel("pitch rate [deg/s]")
    panels[2].plot(data.time, np.degrees(data.pitch))
    panels[2].set(xlabel="time [s]", ylabel="pitch [deg]")
    print(f"largest pitch rate {float(np.degrees(abs(data.q)).max()):.1f} deg/s for half an inch of stick")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "own_maneuver.png", dpi=130)
    plt.close(figure)
    return out / "own_maneuver.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
