# SPDX-License-Identifier: MIT OR Apache-2.0
"""What wakes cost and how far their answers are from those of nine trailers at 15 deg (`right_air.REFERENCE`), in one figure.

    python benchmarks/accuracy_cost.py OUT.json FIGURE.png [NAME ...]

Errors: answers of a clamped rotor to hub moments at 80 kt, mean inflow and -Z/W at two instants of the right step of the roll
reversal, power of the trim (`right_air.py` has the conditions). Cost: evaluations of the sums in nine
revolutions of the roll, which no other work on the machine disturbs, and processor seconds on one thread, convergence included.
"""

import json
import sys
import time
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import right_air
from right_air import INSTANTS, REFERENCE, by_moments, wake

import wakeflight as wf
from wakeflight import _core
from wakeflight.plotting.style import COLORS

WAKES = {
    "paper": {"preset": "paper"},
    "tip vortex and sheet": {"preset": "paper", "inboard_wake": "sheet"},
    "lattice, 2 trailers": {"n_trailers": 2},
    "standard": {},
    "lattice, 5 trailers": {"n_trailers": 5},
    "lattice, 9 trailers": {"n_trailers": 9},
    "reference": REFERENCE,
}
SHOWN = {"reference": "nine trailers, 15°"}
"""Names in the figure: a preset of another kind is called `reference`."""
LEAST = 1e-3
"""Errors are drawn from here on."""
ANSWERS = {
    "hub_pitch": "∂λ0/∂C_M, 80 kt",
    "hub_roll": "∂λ1s/∂C_L, 80 kt",
    "lambda_0": "λ0 in the roll",
    "thrust": "-Z/W in the roll (difference)",
    "power": "power of the trim",
}


def measured(name: str, aircraft: wf.Aircraft) -> dict[str, object]:
    """Answers and cost of one wake."""
    start = wf.trim(aircraft, inflow=wake(wf.RelaxationWake, name))
    begun = time.process_time()
    marched = wake(wf.TimeMarchingWake, name)
    data = wf.fly(start, wf.roll_reversal(), inflow=marched, integrator="fixed", revolutions=9).data
    took = time.process_time() - begun
    at = lambda values: [float(v) for v in np.interp(INSTANTS, data["time"], values)]  # noqa: E731
    return {
        **by_moments(name, 80),
        "lambda_0": at(data["inflow_mean"]),
        "thrust": at(-data["force_z"] / start.condition.weight),
        "power": float(start.mean_outputs()["power"]),
        "processor": took,
        "evaluations": float(data.attrs["segment_evaluations"]),
    }


def error(of: dict, reference: dict, answer: str) -> float:
    """Largest error of an answer, relative; of -Z/W the difference."""
    mine, true = np.atleast_1d(of[answer]), np.atleast_1d(reference[answer])
    return float(np.max(np.abs(mine - true) / (1.0 if answer == "thrust" else np.abs(true))))


def draw(found: dict[str, dict], path: Path) -> None:
    """Each answer's error over the cost: lattices joined by full lines, wakes of a tip vortex by broken ones."""
    reference = found["reference"]
    tips = [name for name in found if "preset" in WAKES[name]]
    lattices = [name for name in found if name not in tips and name != "reference"]
    figure, axes = plt.subplots(figsize=(8.4, 4.8), layout="constrained")
    for (answer, label), marker, color in zip(ANSWERS.items(), "osD^v", COLORS, strict=False):
        for names, line, face in ((lattices, "-", color), (tips, "--", "white")):
            cost = [found[name]["evaluations"] for name in names]
            errors = [max(error(found[name], reference, answer), LEAST) for name in names]
            axes.loglog(cost, errors, marker + line, color=color, mfc=face, label=label if names is lattices else None)
    for k, name in enumerate(sorted(found, key=lambda name: found[name]["evaluations"])):
        cost = found[name]["evaluations"]
        axes.axvline(cost, color="0.85", lw=0.8, ls=":" if name == "reference" else "-", zorder=0)
        axes.annotate(
            SHOWN.get(name, name),
            (cost, (2.2, 3.4)[k % 2]),
            fontsize=8,
            ha="center",
            va="bottom",
            annotation_clip=False,
        )
    axes.set(
        xlabel="evaluations of the sums in nine revolutions", ylabel="error against nine trailers at 15°, three turns"
    )
    cost = [each["evaluations"] for each in found.values()]
    axes.set(xlim=(0.75 * min(cost), 1.35 * max(cost)), ylim=(LEAST, 5.5))
    axes.grid(visible=True, axis="y", alpha=0.3)
    figure.legend(fontsize=8, frameon=False, loc="outside lower center", ncols=3)
    figure.savefig(path, dpi=110)


def main(out: str, figure: str, *names: str) -> None:
    """Measure what is not in the file yet, print the table, draw."""
    _core.set_threads(1)
    right_air.WAKES.update(WAKES)
    path, aircraft = Path(out), wf.load_aircraft("uh60a")
    found = json.loads(path.read_text()) if path.exists() else {}
    for name in names or WAKES:
        if name not in found:
            found[name] = measured(name, aircraft)
            path.write_text(json.dumps(found, indent=1) + "\n")
        print(name, json.dumps(found[name]), flush=True)
    if "reference" in found:
        for name in found:
            errors = [f"{100 * error(found[name], found['reference'], each):.1f}" for each in ANSWERS]
            print(
                f"| {name} | {' | '.join(errors)} | {found[name]['evaluations']:.2e} | {found[name]['processor']:.2f} |"
            )
        draw(found, Path(figure))


if __name__ == "__main__":
    main(*sys.argv[1:])
