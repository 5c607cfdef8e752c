# SPDX-License-Identifier: MIT OR Apache-2.0
"""A first flight: the arrested descent of a UH-60A with a free wake that marches in time with it.

The helicopter descends at 6 deg and 80 kt; the pilot pulls the collective up and puts it back. What a passenger feels is the
load factor, the force of everything but gravity over the weight; over it lie the vibrations of four blades passing.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), revolutions: float = 12) -> Path:
    """Trim, fly, draw load factor and pitch attitude; returns the figure's path."""
    aircraft = wf.load_aircraft("uh60a")
    condition = wf.FlightCondition(speed="80 kt", flight_path="-6 deg", altitude="5250 ft", weight="16000 lbf")

    start = wf.trim(aircraft, condition, inflow="relaxation")
    print(start.table())

    flight = wf.fly(start, wf.arrested_descent(), inflow="time-marching", revolutions=revolutions)
    data = flight.data
    weight = condition.weight or 1.0
    load_factor = -data.force_z / weight
    # the mean over one revolution takes the passage of the blades out
    period = round(2.0 * np.pi / data.attrs["omega"] / float(data.time[1] - data.time[0]))
    smooth = load_factor.rolling(time=period, center=True, min_periods=1).mean()
    print(f"largest load factor {float(smooth.max()):.2f}, warnings: {', '.join(flight.warnings) or 'none'}")

    figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 4.8), layout="constrained")
    above.plot(data.time, load_factor, color="0.75", linewidth=0.8, label="as flown")
    above.plot(data.time, smooth, label="mean over a revolution")
    above.set_ylabel("load factor [1]")
    above.legend(loc="lower right")
    below.plot(data.time, np.degrees(data.pitch))
    below.set(xlabel="time [s]", ylabel="pitch [deg]")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "first_flight.png", dpi=130)
    plt.close(figure)
    return out / "first_flight.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
