# SPDX-License-Identifier: MIT OR Apache-2.0
"""Stability and control derivatives over speed: a linear model of eight states at every speed, one table."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt

import wakeflight as wf

SHOWN = {"A": (("p", "p"), ("q", "q"), ("p", "q"), ("q", "p")), "B": (("p", "lateral"), ("q", "longitudinal"))}


def main(
    out: Path = Path("runs/examples"), speeds: Sequence[str] = tuple(wf.arange("20 kt", "140 kt", "20 kt"))
) -> Path:
    """Linearize at every speed, draw damping and control; returns the figure's path."""
    cases = wf.grid(speed=list(speeds), flight_path="0 deg", altitude="0 ft", inflow="dynamic")
    table = wf.sweep(wf.linearize, cases, order=8, keep=["A", "B"])

    figure, (left, right) = plt.subplots(1, 2, sharex=True, figsize=(7.2, 3.2), layout="constrained")
    for axes, (matrix, entries) in zip((left, right), SHOWN.items(), strict=True):
        rows, columns = table[matrix].dims[-2:]
        for row, column in entries:
            values = table[matrix].sel({rows: row, columns: column})
            axes.plot(table.speed_value, values, "o-", label=f"{row} by {column}")
            print(f"{row} by {column}: {', '.join(f'{each:+.3f}' for each in values.values)}")
        axes.set_xlabel("true airspeed [kt]")
        axes.legend(fontsize=8)
    left.set_ylabel("1/s")
    right.set_ylabel("rad/s² per inch")
    out.mkdir(parents=True, exist_ok=True)
    figure.savefig(out / "derivatives.png", dpi=130)
    plt.close(figure)
    return out / "derivatives.png"


if __name__ == "__main__":
    print(f"wrote {main()}")
