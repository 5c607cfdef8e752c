"""The first guess of the wake against the skewed helix."""

import json

import numpy as np

from wakeflight import _core
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

RADIUS, OMEGA, STEPS = 2.0, 100.0, 36


def guess(mu, inflow, turns=2):
    """Markers (azimuths, ages, 3) over the radius."""
    rotor = {
        "n_blades": 2,
        "radius": RADIUS,
        "root_cutout": 0.2 * RADIUS,
        "hinge_offset": 0.0,
        "chord": 0.1,
        "omega": OMEGA,
    }
    wake = {"turns": float(turns), "azimuth_step": 2 * np.pi / STEPS}
    options = {"rotor": rotor, "wake": wake, "relaxation": {}}
    # the hub moves against x, which points aft
    wake = _core.RelaxationWake(json.dumps(options), ([-mu * OMEGA * RADIUS, 0, 0], [0, 0, 0]), inflow)
    return wake.lattice()[:, -1] / RADIUS


def run(case):
    table = case.table("wake.csv")
    ours, exact = [], np.column_stack([table["x"], table["y"], table["z"]])
    for mu, inflow, psi, age in zip(*(table[k] for k in ("mu", "lambda", "psi_deg", "zeta_deg"))):
        ours.append(guess(mu, inflow)[round(psi / 10) % STEPS, round(age / 10)])
    # the table has twelve decimals
    checks = [
        Check.largest(f"{axis} of the markers", np.array(ours)[:, i], exact[:, i], 1e-12, "R")
        for i, axis in enumerate("xyz")
    ]
    return Outcome(checks, draw(table, exact))


@style.styled
def draw(table, exact):
    figure = style.blank(3.0)
    axes = figure.subplots()
    for mu, inflow, color in (
        (0.1, 0.03, style.COLORS[0]),
        (0.185, 0.025, style.COLORS[1]),
        (0.3, 0.038, style.COLORS[2]),
    ):
        path = guess(mu, inflow)[18]
        axes.plot(path[:, 0], path[:, 1], color=color, label=f"advance ratio {mu:g}, blade forward")
        rows = (table["mu"] == mu) & (table["psi_deg"] == 180)
        axes.plot(exact[rows, 0], exact[rows, 1], "o", color=color, ms=4)
    axes.set_aspect("equal")
    axes.set_xlabel("x, aft [R]")
    axes.set_ylabel("y, right [R]")
    axes.legend(title="points: exact", loc="upper left", bbox_to_anchor=(1.02, 1.0))
    return figure
