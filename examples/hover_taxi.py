# SPDX-License-Identifier: MIT OR Apache-2.0
"""Hover taxi: a UH-60A goes to 15 kt and back to rest with its hub one radius above the ground, and far above it.

`wf.follow` flies the speed by what is missing of it, `wf.AltitudeHold` keeps the height with the collective. The follower knows
the size of the airspeed and not its sense: the flight ends as rest is reached. With speed the ground is worth less power.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf

PATH = [("0 s", "0 kt"), ("1 s", "0 kt"), ("7 s", "15 kt"), ("11 s", "15 kt"), ("18 s", "1 kt")]
HEIGHTS = {"hub 8.2 m above ground": "8.2 m", "away from the ground": None}


def main(out: Path = Path("runs/examples"), seconds: float = 18.0) -> Path:
    """Fly both, draw speed, height, attitude and power over time; returns the figure's path."""
    aircraft = wf.load_aircraft("uh60a")
    pilot = [
        wf.follow(speed=PATH, hands=wf.Hands(accelerating=0.08, attitude=2.0)),
        wf.AltitudeHold(altitude="0.2 in/ft", climb_rate="0.2 in/(ft/s)"),
        wf.AttitudeHold(heading="10 in/rad", yaw_rate="4 in/(rad/s)"),
    ]
    figure, axes = plt.subplots(4, 1, figsize=(6.4, 7.2), layout="constrained", sharex=True)
    for label, height in HEIGHTS.items():
        start = wf.trim(aircraft, wf.FlightCondition(speed="0 kt", height=height), inflow="dynamic")
        hands_off = wf.Maneuver("hover taxi", {}, seconds=seconds)
        run = wf.fly(start, hands_off, integrator="fixed", control=pilot).data
        speed = np.hypot(np.gradient(run.north, run.time), np.gradient(run.east, run.time)) / 0.514444
        for axis, values in zip(axes, (speed, -run.down, np.degrees(run["pitch"]), run.power / 1e3), strict=True):
            axis.plot(run.time, values, label=label)
        print(f"{label:<24} power {float(run.power[0]) / 1e3:.0f} kW at rest, fastest {speed.max():.1f} kt")
    for axis, name in zip(axes, ("speed [kt]", "climbed [m]", "pitch [deg]", "power [kW]"), strict=True):
        axis.set_ylabel(name)
    axes[0].legend()
    axes[-1].set_xlabel("time [s]")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "hover_taxi.png", dpi=130)
    plt.close(figure)
    return out / "hover_taxi.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
