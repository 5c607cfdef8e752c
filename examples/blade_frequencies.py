# SPDX-License-Identifier: MIT OR Apache-2.0
"""Blade frequencies over rotor speed: where a mode meets a harmonic of the rotor, it is shaken.

Elastic blades are beams of finite elements in a centrifugal field; `wf.blade_modes` gives frequencies and shapes of an
aircraft's or a rotor's blade at any rotor speed.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), n_speeds: int = 11) -> Path:
    """Modes of the UH-60A's blade, draw the fan; returns the figure's path."""
    aircraft = wf.load_aircraft("uh60a")
    nominal = wf.blade_modes(aircraft, n_modes=6)
    print(nominal.table())

    shares = np.linspace(0.1, 1.1, n_speeds)
    omega = float(aircraft.rotor.omega)
    fan = np.array(
        [wf.blade_modes(aircraft, n_modes=6, rotor_speed=each * omega).natural_frequencies for each in shares]
    )

    figure, axes = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    for k, label in enumerate(nominal.labels):
        axes.plot(shares, fan[:, k] / omega, label=label)
    for harmonic in range(1, 9):
        axes.plot(shares, harmonic * shares, color="0.8", linewidth=0.8, zorder=0)
    axes.set(xlabel="rotor speed over nominal [1]", ylabel="frequency over nominal rotor speed [1]", ylim=(0.0, 8.0))
    axes.set_xlim(0.1, 1.1)
    axes.legend(ncols=3, loc="upper left", fontsize=8)
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "blade_frequencies.png", dpi=130)
    plt.close(figure)
    return out / "blade_frequencies.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
