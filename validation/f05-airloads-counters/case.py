"""Blade frequencies of the UH-60A beside the range of published calculations."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    ranges = case.toml("counters.toml")["rotor_frequencies_per_rev_at_27_02_rad_s"]
    found = wf.blade_modes(wf.load_aircraft("uh60a"), n_modes=7)
    # counters.toml writes flap1
    modes = found.matched([f"{name[:-1]} {name[-1]}" for name in ranges])
    ours = {name: found.frequencies[i] for name, i in zip(ranges, modes.values())}
    checks, points = [], []
    for name, (low, high) in ranges.items():
        middle, half = (low + high) / 2, (high - low) / 2
        points.append(float(ours[name]))
        checks.append(Check(f"frequency of {name}", points[-1], middle, half, "per rev"))
    return Outcome(checks, draw(ranges, points))


@style.styled
def draw(ranges, points):
    figure = style.blank(2.6)
    axes = figure.subplots()
    at = np.arange(len(ranges))
    for k, (low, high) in enumerate(ranges.values()):
        axes.plot([k, k], [low, high], color="k", lw=5, alpha=0.35, label="published calculations" if k == 0 else None)
    axes.plot(at, points, "+", ms=10, color=style.COLORS[0], label="ours")
    axes.set_xticks(at, ranges)
    axes.set_ylabel("frequency per revolution")
    axes.legend()
    return figure
