# SPDX-License-Identifier: MIT OR Apache-2.0
"""Bandwidth and phase delay of a UH-60A and a BO-105 beside the limits of ADS-33E, and where they come from.

The bare airframe from the stick: no actuators, no control system. What does not exist is nan, with its reason.
"""

from collections.abc import Sequence
from pathlib import Path

import wakeflight as wf
from wakeflight.handling import limits
from wakeflight.plotting import handling, style


def main(out: Path = Path("runs/examples"), names: Sequence[str] = ("uh60a", "bo105")) -> Path:
    """Handling qualities of every aircraft at 80 kt; returns the figure's path."""
    metrics = {}
    for name in names:
        condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft")
        start = wf.trim(wf.load_aircraft(name), condition, inflow="dynamic")
        found = wf.handling_qualities(wf.linearize(start))
        metrics[name] = found.data
        print(f"{name}: roll {found['roll.bandwidth']:.2f} rad/s, phase delay {found['roll.phase_delay']:.3f} s")
        for quantity, reason in found.reasons.items():
            print(f"  {quantity}: {reason}")
    return style.save(handling.bandwidth(metrics, limits()), out / "bandwidth.png")


if __name__ == "__main__":
    print(f"wrote {main()}")
