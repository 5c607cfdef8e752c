"""Swirl profiles of a very long straight vortex."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

NAMES = {
    "vatistas_n1_scully": "scully",
    "vatistas_n2": "vatistas2",
    "vatistas_ninf_rankine": "rankine",
    "lamb_oseen": "lamb_oseen",
}
CORE_RADIUS, HALF_LENGTH = 0.1, 1e6


def swirl(core, x):
    """Swirl velocity times 2 pi core radius over circulation, at x core radii."""
    line = [(0, 0, -HALF_LENGTH), (0, 0, HALF_LENGTH)]
    v = wf.induced_velocity([[x * CORE_RADIUS, 0, 0]], [line], [1.0], [CORE_RADIUS], core=core)[0]
    return v[1] * 2 * np.pi * CORE_RADIUS


def run(case):
    table = case.table("swirl.csv")
    checks = []
    for filed, core in NAMES.items():
        rows = table.where(core=filed)
        ours = [swirl(core, x) for x in rows["r_over_rc"]]
        # the table's last printed digit is 1e-12
        checks.append(Check.largest(f"swirl, {core}", ours, rows["v_nd"], 1e-10, kind="relative"))
    return Outcome(checks, draw(table))


@style.styled
def draw(table):
    figure = style.blank(3.0)
    axes = figure.subplots()
    x = np.linspace(0.02, 5, 200)
    for (filed, core), color in zip(NAMES.items(), style.COLORS):
        axes.plot(x, [swirl(core, each) for each in x], color=color, label=core)
        rows = table.where(core=filed)
        keep = rows["r_over_rc"] <= 5
        axes.plot(rows["r_over_rc"][keep], rows["v_nd"][keep], "o", color=color, ms=4)
    axes.set_xlabel("radius over core radius")
    axes.set_ylabel("swirl [circulation / (2 pi core radius)]")
    axes.legend(title="points: exact")
    return figure
