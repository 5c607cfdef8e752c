# SPDX-License-Identifier: MIT OR Apache-2.0
"""Vortices by themselves: the velocity on the axis of a ring, against its closed form.

`wf.induced_velocity` sums straight segments by Biot and Savart, with a core or without. A ring of many segments has
Gamma R^2 / (2 (R^2 + z^2)^(3/2)) on its axis.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import wakeflight as wf


def main(out: Path = Path("runs/examples"), n_segments: int = 360) -> Path:
    """Sum a ring, compare with the closed form, draw both; returns the figure's path."""
    radius, gamma = 1.0, 2.0
    psi = np.linspace(0.0, 2.0 * np.pi, n_segments + 1)
    ring = radius * np.stack([np.cos(psi), np.sin(psi), np.zeros_like(psi)], axis=1)
    height = np.linspace(-2.0, 2.0, 41)
    points = np.stack([np.zeros_like(height), np.zeros_like(height), height], axis=1)

    velocity = wf.induced_velocity(points, [ring], np.full(n_segments, gamma), np.full(n_segments, 0.02))
    exact = gamma * radius**2 / (2.0 * (radius**2 + height**2) ** 1.5)
    print(f"largest error {np.abs(velocity[:, 2] - exact).max():.2e} m/s of {exact.max():.2f} m/s")

    figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
    axes.plot(height, exact, label="closed form")
    axes.plot(height, velocity[:, 2], "o", markersize=4, label=f"{n_segments} segments")
    axes.set(xlabel="height over the ring [m]", ylabel="velocity on the axis [m/s]")
    axes.legend()
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "vortex_ring.png", dpi=130)
    plt.close(figure)
    return out / "vortex_ring.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
