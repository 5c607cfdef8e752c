"""Thin vortex rings: limits of the sum over segments, and the trap of the perpendicular core."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def speed(n, core, core_radius, core_distance="line"):
    """4 pi R V / Gamma at a vertex of a polygon of n sides."""
    angle = 2 * np.pi * np.arange(n + 1) / n
    nodes = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    nodes[-1] = nodes[0]
    v = wf.induced_velocity(nodes[:1], [nodes], np.ones(n), np.full(n, core_radius), core, core_distance)
    return 4 * np.pi * v[0, 2]


def limit(core, core_radius, n=4000):
    """Richardson's limit of the polygon for many sides, the error being of second order."""
    coarse, fine = speed(n, core, core_radius), speed(2 * n, core, core_radius)
    return (4 * fine - coarse) / 3


def run(case):
    exact = case.toml("ring.toml")
    soft, trap = exact["rosenhead_moore_exact"], exact["perpendicular_core_continuum"]
    unit = "Gamma/(4 pi R)"
    checks = [
        Check(f"softened ring, core {mu:g} R", limit("rosenhead_moore", mu), v, 1e-6, unit)
        for mu, v in zip(soft["mu"], soft["fourpiV"])
    ]
    for name, core in (("vatistas_n1", "scully"), ("vatistas_n2", "vatistas2"), ("lamb_oseen", "lamb_oseen")):
        checks.append(Check(f"perpendicular core, {core}", limit(core, trap["rc"]), trap[name], 1e-6, unit))
    n = 20000
    checks.append(
        Check(
            "constant of the bare polygon",
            speed(n, "singular", 0.0) - np.log(n),
            exact["polygon_singular_vertex"]["c"],
            1e-6,
            unit,
        )
    )
    for mu in (0.02, 0.01, 0.005):
        thin = np.log(8 / mu) - exact["constants"]["rosenhead_moore"]
        checks.append(
            Check(
                f"thin-ring formula, core {mu:g} R",
                limit("rosenhead_moore", mu, 20000),
                thin,
                3 * mu**2 * np.log(8 / mu),
                unit,
            )
        )
    return Outcome(checks, draw(trap))


@style.styled
def draw(trap):
    figure = style.blank(3.0)
    axes = figure.subplots()
    n = np.unique(np.geomspace(12, 5000, 40).astype(int))
    for core, color in (("vatistas2", style.COLORS[0]), ("rosenhead_moore", style.COLORS[1])):
        axes.semilogx(n, [speed(int(k), core, 0.05) for k in n], color=color, label=core)
    axes.axhline(trap["saffman_vatistas_n2"], color=style.COLORS[0], ls="--")
    axes.text(12, trap["saffman_vatistas_n2"] + 0.05, "thin ring, Vatistas n = 2", fontsize=8, color=style.COLORS[0])
    axes.axhline(np.log(8 / 0.05) - 1, color=style.COLORS[1], ls="--")
    axes.text(12, np.log(8 / 0.05) - 0.95, "thin ring, Rosenhead-Moore", fontsize=8, color=style.COLORS[1])
    axes.set_xlabel("segments of the ring, core 0.05 R")
    axes.set_ylabel("speed of a vertex [circulation / (4 pi R)]")
    axes.legend(loc="lower right")
    return figure
