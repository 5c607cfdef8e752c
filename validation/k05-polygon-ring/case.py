"""Self-induced speed at a vertex of a polygonal ring."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

NAMES = {"singular": "singular", "vatistas_n1": "scully", "vatistas_n2": "vatistas2"}


def speed(n, core, core_radius):
    """4 pi R V / Gamma at a vertex."""
    angle = 2 * np.pi * np.arange(n + 1) / n
    nodes = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    nodes[-1] = nodes[0]
    v = wf.induced_velocity(nodes[:1], [nodes], np.ones(n), np.full(n, core_radius), core=core)
    return 4 * np.pi * v[0, 2]


def run(case):
    table = case.table("self.csv")
    checks = []
    for filed, core in NAMES.items():
        rows = table.where(core=filed)
        ours = [speed(int(n), core, rc) for n, rc in zip(rows["N"], rows["rc"])]
        checks.append(Check.largest(f"vertex speed, {core}", ours, rows["fourpiV"], 1e-9, "Gamma/(4 pi R)"))
    return Outcome(checks, draw(table))


@style.styled
def draw(table):
    figure = style.blank(3.0)
    axes = figure.subplots()
    for (filed, core), color in zip(NAMES.items(), style.COLORS):
        rows = table.where(core=filed)
        n = np.unique(np.geomspace(8, 400, 40).astype(int))
        axes.semilogx(
            n, [speed(int(k), core, rows["rc"][0]) for k in n], color=color, label=f"{core}, core {rows['rc'][0]:g} R"
        )
        axes.plot(rows["N"], rows["fourpiV"], "o", color=color, ms=4)
    axes.axhline(np.log(8 / 0.05) - 0.5, color=style.GREY, ls="--")
    axes.text(8, np.log(8 / 0.05) - 0.42, "ring with the Vatistas n = 2 core of 0.05 R", color=style.GREY, fontsize=8)
    axes.set_xlabel("segments of the ring")
    axes.set_ylabel("speed of a vertex [circulation / (4 pi R)]")
    axes.legend(title="points: exact", loc="lower right")
    return figure
