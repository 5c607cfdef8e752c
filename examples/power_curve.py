# SPDX-License-Identifier: MIT OR Apache-2.0
"""Power over speed in level flight, with several inflow models: the bucket, and the sticks that go with it.

Induced power falls with speed, parasite power rises with its cube; between them lies the speed of least power, which is
that of longest endurance. One sweep trims every speed with every model, on all cores.
"""

from collections.abc import Sequence
from pathlib import Path

import wakeflight as wf
from wakeflight.plotting import style, sweeps


def main(
    out: Path = Path("runs/examples"),
    speeds: Sequence[str] = tuple(wf.arange("0 kt", "140 kt", "20 kt")),
    models: Sequence[str] = ("dynamic",),
) -> Path:
    """Trim at every speed, draw power and sticks; returns the figure's path."""
    cases = wf.grid(speed=list(speeds), inflow=list(models), flight_path="0 deg", altitude="5250 ft")
    table = wf.sweep(wf.trim, cases)
    for model in models:
        power = table.power.sel(inflow=model) / 1e3
        print(f"{model}: {', '.join(f'{each:.0f}' for each in power.values)} kW")
        print(f"least power at {table.speed.values[int(power.values.argmin())]}")
    figure = sweeps.figure(table, y=["power", "collective", "longitudinal", "pedal"], x="speed")
    return style.save(figure, out / "power_curve.png")


if __name__ == "__main__":
    print(f"wrote {main()}")
