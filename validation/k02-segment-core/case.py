"""Segment with a finite core against the closed form of every core model."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

NAMES = {
    "singular": "singular",
    "vatistas_n1_scully": "scully",
    "vatistas_n2": "vatistas2",
    "vatistas_ninf_rankine": "rankine",
    "lamb_oseen": "lamb_oseen",
}


def axial(core, core_radius, h):
    """Velocity beside the middle of a unit segment, at distance h."""
    return wf.induced_velocity([[0.5, h, 0.0]], [[(0, 0, 0), (1, 0, 0)]], [1.0], [core_radius], core=core)[0, 2]


def run(case):
    table = case.table("cores.csv")
    checks = []
    for filed, core in NAMES.items():
        rows = table.where(core=filed)
        ours = [axial(core, rc, h) for rc, h in zip(rows["rc"], rows["h"])]
        checks.append(Check.largest(f"velocity, {core}", ours, rows["uz"], 1e-11, "Gamma/l", "relative"))
    return Outcome(checks, draw(table))


@style.styled
def draw(table):
    figure = style.blank(3.0)
    axes = figure.subplots()
    h = np.geomspace(0.005, 2.0, 200)
    for (filed, core), color in zip(NAMES.items(), style.COLORS):
        axes.loglog(h / 0.1, [axial(core, 0.1, x) for x in h], color=color, label=core)
        rows = table.where(core=filed)
        axes.loglog(rows["h"] / 0.1, rows["uz"], "o", color=color, ms=4)
    axes.set_xlabel("distance over core radius")
    axes.set_ylabel("velocity [circulation / length]")
    axes.legend(title="points: exact")
    return figure
