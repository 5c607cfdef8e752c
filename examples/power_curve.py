# SPDX-License-Identifier: MIT OR Apache-2.0
"""Power over speed in level flight: the bucket, and the sticks that go with it.

Induced power falls with speed, parasite power rises with its cube; between them lies the speed of least power, which is
that of longest endurance.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), speeds: tuple[int, ...] = (0, 20, 40, 60, 80, 100, 120, 140)) -> Path:
    """Trim at every speed, draw power and sticks; returns the figure's path."""
    aircraft = wf.load_aircraft("uh60a")
    power, sticks = [], []
    for speed in speeds:
        condition = wf.FlightCondition(speed=f"{speed} kt", flight_path="0 deg", altitude="5250 ft")
        start = wf.trim(aircraft, condition, inflow="dynamic")
        power.append(float(start.to_dataset().power) / 1e3)
        sticks.append(start.stick)
        print(f"{speed:4d} kt  {power[-1]:7.0f} kW  pitch {np.degrees(start.pitch):6.2f} deg")
    print(f"least power at {speeds[int(np.argmin(power))]} kt")

    figure, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(6.4, 4.8), layout="constrained")
    above.plot(speeds, power, "o-")
    above.set_ylabel("power [kW]")
    for name in ("collective", "longitudinal", "lateral", "pedal"):
        below.plot(speeds, [stick[name] for stick in sticks], "o-", label=name)
    below.set(xlabel="true airspeed [kt]", ylabel="stick from its stop [in]")
    below.legend(ncols=4, loc="upper center", fontsize=8)
    below.set_ylim(0.0, 10.0)
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "power_curve.png", dpi=130)
    plt.close(figure)
    return out / "power_curve.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
