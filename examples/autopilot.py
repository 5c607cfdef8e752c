# SPDX-License-Identifier: MIT OR Apache-2.0
"""A flight in your hands: a controller that looks at the state and gives sticks, step by step.

`wf.Simulation` flies one azimuth step at a time. Here a pitch hold of two gains meets an upset of the longitudinal stick; the
same helicopter without it wanders off.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def fly(start: wf.Trim, gains: tuple[float, float], seconds: float) -> tuple[list[float], list[float]]:
    """Times [s] and pitch about trim [deg] of a flight with stick = gains . (pitch, pitch rate), inches a rad and a rad/s."""
    sim = wf.Simulation(start, inflow="dynamic")
    times, pitch = [0.0], [0.0]
    while sim.t < seconds:
        state = sim.state
        error = state.attitude[1] - start.pitch
        stick = -gains[0] * error - gains[1] * state.rates[1]
        # half an inch aft for a quarter of a second upsets the aircraft
        upset = 0.5 if 0.25 < sim.t < 0.5 else 0.0
        sim.step({"longitudinal": float(np.clip(stick + upset, -2.0, 2.0))})
        times.append(sim.t)
        pitch.append(float(np.degrees(sim.state.attitude[1] - start.pitch)))
    return times, pitch


def main(out: Path = Path("runs/examples"), seconds: float = 6.0) -> Path:
    """Fly with the loop open and closed, draw the pitch; returns the figure's path."""
    aircraft = wf.load_aircraft("bo105")
    start = wf.trim(aircraft, wf.FlightCondition(speed="60 kt", flight_path="0 deg"), inflow="dynamic")
    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    for label, gains in (("hands on the stick", (0.0, 0.0)), ("pitch hold", (12.0, 6.0))):
        times, pitch = fly(start, gains, seconds)
        axes.plot(times, pitch, label=label)
        print(f"{label:<20} pitch after {times[-1]:.1f} s: {pitch[-1]:6.2f} deg about trim")
    axes.set(xlabel="time [s]", ylabel="pitch about trim [deg]")
    axes.legend()
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "autopilot.png", dpi=130)
    plt.close(figure)
    return out / "autopilot.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
