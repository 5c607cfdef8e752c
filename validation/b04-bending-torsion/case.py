"""Goland's wing."""

import beams
import numpy as np

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

ELEMENTS = (4, 6, 8, 12, 16)


def run(case):
    reference = case.table("goland_bending_torsion.csv")["omega_rad_s"]
    length, mass, offset, inertia = 6.096, 35.75, 0.183, 8.65
    wing = beams.uniform(
        radius=length,
        ei_flap=9.77e6,
        ei_lag=1e12,
        gj=[0.987e6],
        mass=[mass],
        # about the centre of gravity; the definition counts from the elastic axis
        i_theta=[inertia - mass * offset**2],
        x_cg=[-offset],
        control_stiffness=1e12,
    )
    found = {n: np.asarray(beams.modes(wing, 1e-6, 5, n).frequencies) for n in ELEMENTS}
    checks = [
        Check(f"mode {i + 1}, {n} elements", found[n][i], reference[i], 2e-3, "rad/s", "relative")
        for n, count in ((4, 2), (12, 5))
        for i in range(count)
    ]
    return Outcome(checks, draw(found, reference))


@style.styled
def draw(found, reference):
    figure = style.blank(2.8)
    axes = figure.subplots()
    for i in range(5):
        error = [abs(found[n][i] / reference[i] - 1) for n in ELEMENTS]
        axes.loglog(ELEMENTS, error, marker=".", color=style.COLORS[i], label=f"mode {i + 1}")
    axes.axhline(2e-3, color=style.GREY, ls="--", label="tolerance")
    axes.set_xticks(ELEMENTS, [str(n) for n in ELEMENTS])
    axes.minorticks_off()
    axes.set_xlabel("elements")
    axes.set_ylabel("relative error")
    axes.legend(ncols=2)
    return figure
