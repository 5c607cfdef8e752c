# SPDX-License-Identifier: MIT OR Apache-2.0
"""What sums in single precision change, beside what the last bit of one number changes in double precision; and what they save.

    python benchmarks/precision.py [PRESET ...]

Trim (baseline), the answers to hub moments on the stand, and the whole roll reversal with `standard` and `paper`. A change is the
largest difference from double precision, over the largest value. The bit: the core radius of the tip vortex, one unit of its
last place larger. Seconds are those of six revolutions, one thread, the least of five flights of each precision in turn.
"""

import sys

import numpy as np
from measure import table
from right_air import MOMENT, ROTOR, harmonics

import wakeflight as wf
from wakeflight import _core

SUMS = {
    "double": {"precision": "double"},
    "one bit": {"precision": "double", "core_radius": float(np.nextafter(0.02, 1.0))},
    "single": {"precision": "single"},
}
HISTORIES = ("inflow_mean", "inflow", "circulation", "p", "q", "roll", "beta_1c", "beta_1s", "ct", "force_z")


def by_moments(preset, options):
    """Inflow's harmonics at hub moments of either sign about both axes, one after the other."""
    found = []
    for axis in ("hub_pitch", "hub_roll"):
        for sign in (-1.0, 1.0):
            moments = {"hub_pitch": "0 N*m", "hub_roll": "0 N*m", axis: f"{sign * MOMENT} N*m"}
            stand = {"thrust": "72 kN", "speed": "80 kt", "shaft_angle": "0 deg", **moments}
            wake = wf.RelaxationWake.preset(preset, **options)
            found.append(harmonics(wf.tunnel(ROTOR, inflow=wake, **stand).data))
    found = np.array(found)
    return {"stand: harmonics at hub moments": found, "stand: answers to hub moments": found[1::2] - found[::2]}


def flown(preset, options):
    """Trim and roll reversal."""
    start = wf.trim(wf.load_aircraft("uh60a"), inflow=wf.RelaxationWake.preset(preset, **options))
    wake = wf.TimeMarchingWake.preset(preset, **options)
    data = wf.fly(start, wf.roll_reversal(), inflow=wake, integrator="fixed").data
    trimmed = start.to_dataset()
    return {
        "trim: power": np.array(float(trimmed["power_main"])),
        "trim: inflow": np.asarray(trimmed["inflow"]),
        **{f"roll: {name}": np.asarray(data[name]) for name in HISTORIES},
    }


def cost(preset):
    """Seconds of wake and dynamics in double and in single precision, and their ratios."""
    aircraft, least, starts = wf.load_aircraft("uh60a"), {}, {}
    for name in ("double", "single"):
        starts[name] = wf.trim(aircraft, inflow=wf.RelaxationWake.preset(preset, **SUMS[name]))
        least[name] = np.full(2, np.inf)
    for _ in range(5):
        for name, best in least.items():
            wake = wf.TimeMarchingWake.preset(preset, **SUMS[name], convergence_revolutions=1)
            run = wf.fly(starts[name], wf.roll_reversal(), inflow=wake, integrator="fixed", revolutions=6).data.attrs
            best[:] = np.minimum(best, [float(run["seconds_wake"]), float(run["seconds_dynamics"])])
    names = ("wake", "dynamics")
    rows = [[n, *(f"{least[k][i]:.3f}" for k in least)] for i, n in enumerate(names)]
    ratios = least["double"] / least["single"]
    return table(
        ["seconds", "double", "single", "ratio"], [[*r, f"{x:.2f}"] for r, x in zip(rows, ratios, strict=True)]
    )


def main(*presets):
    """Two tables for each preset."""
    _core.set_threads(1)
    for preset in presets or ("standard", "paper"):
        found = {name: by_moments(preset, options) | flown(preset, options) for name, options in SUMS.items()}
        exact = found["double"]
        rows = []
        for quantity, value in exact.items():
            off = [np.abs(found[name][quantity] - value).max() / np.abs(value).max() for name in ("one bit", "single")]
            rows.append([quantity, *(f"{each:.1e}" for each in off)])
        print(
            f"`{preset}`\n\n" + table(["change of", "by one bit", "by single precision"], rows) + "\n" + cost(preset),
            flush=True,
        )


if __name__ == "__main__":
    main(*sys.argv[1:])
