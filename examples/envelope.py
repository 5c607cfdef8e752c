# SPDX-License-Identifier: MIT OR Apache-2.0
"""Where level flight ends: trims over speed and altitude, the power they need and why some have no answer.

A case without a trim is a value of the table: its numbers are nan, `failure` says what limits.
"""

from collections import Counter
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), n_speeds: int = 9, n_altitudes: int = 6) -> Path:
    """Sweep, draw the map of power; returns the figure's path."""
    cases = wf.grid(
        speed=[f"{each:g} kt" for each in np.linspace(20.0, 180.0, n_speeds)],
        altitude=[f"{each:g} ft" for each in np.linspace(0.0, 20000.0, n_altitudes)],
        flight_path="0 deg",
        inflow="dynamic",
        blades="rigid",
    )
    table = wf.sweep(wf.trim, cases)
    reasons = Counter(str(each).split(":")[0] for each in table.failure.values.ravel() if each)
    print(f"{table.attrs['failed']} of {table.attrs['cases']} cases have no trim: {dict(reasons)}")

    figure, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    drawn = axes.pcolormesh(table.speed_value, table.altitude_value, table.power.T / 1e3, shading="nearest")
    figure.colorbar(drawn, label="power [kW]")
    axes.set(xlabel="true airspeed [kt]", ylabel="altitude [ft]", title="level flight, white: no trim")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "envelope.png", dpi=130)
    plt.close(figure)
    return out / "envelope.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
