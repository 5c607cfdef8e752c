# SPDX-License-Identifier: MIT OR Apache-2.0
"""The same stick, two inflow models: what a free wake changes in the response to a lateral step.

Dynamic inflow has three states for the whole disk; the relaxation wake has the vortices of a few turns. The roll they cause
is nearly the same, the pitch that comes with it is not: the off-axis response is where inflow models part.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), seconds: float = 1.5) -> Path:
    """Fly one manoeuvre with two models, draw roll and pitch rate; returns the figure's path."""
    aircraft = wf.load_aircraft("uh60a")
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg")
    step = wf.Maneuver("lateral step", {"lateral": [(0.2, 0.0), (0.4, 1.0)]}, seconds=seconds)

    figure, (on_axis, off_axis) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 4.8), layout="constrained")
    for inflow in ("dynamic", "relaxation"):
        start = wf.trim(aircraft, condition, inflow=inflow)
        flight = wf.fly(start, step, inflow=inflow)
        rates = {name: np.degrees(flight.data[name]) for name in ("p", "q")}
        on_axis.plot(flight.data.time, rates["p"], label=inflow)
        off_axis.plot(flight.data.time, rates["q"], label=inflow)
        print(
            f"{inflow:<12} roll rate at the end {float(rates['p'][-1]):6.2f} deg/s, pitch rate {float(rates['q'][-1]):6.2f} deg/s"
        )

    on_axis.set_ylabel("roll rate [deg/s]")
    on_axis.legend()
    off_axis.set(xlabel="time [s]", ylabel="pitch rate [deg/s]")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "inflow_models.png", dpi=130)
    plt.close(figure)
    return out / "inflow_models.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
