# SPDX-License-Identifier: MIT OR Apache-2.0
"""Derivatives and modes of a UH-60A in ten lines: trim, linearize, print, draw."""

from pathlib import Path

import wakeflight as wf
from wakeflight.plotting import linear, style


def main(out: Path = Path("runs/examples")) -> Path:
    """Print modes and derivatives at 80 kt; returns the figure's path."""
    aircraft = wf.load_aircraft("uh60a")
    start = wf.trim(aircraft, wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft"), inflow="dynamic")
    model = wf.linearize(start)
    print(model.modes_table())
    print(model.derivatives_table())
    return style.save(linear.modes(model.modes()), out / "uh60a_modes.png")


if __name__ == "__main__":
    print(f"wrote {main()}")
