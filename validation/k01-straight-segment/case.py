"""Straight vortex segment against the closed form."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    table = case.table("points.csv")
    start, end, point, exact = (np.column_stack([table[f"{p}{axis}"] for axis in "xyz"]) for p in "ABPu")
    ours = np.array(
        [wf.induced_velocity([p], [[a, b]], [1.0], [0.0], core="singular")[0] for a, b, p in zip(start, end, point)]
    )
    speed = np.linalg.norm(exact, axis=1)
    error = np.linalg.norm(ours - exact, axis=1) / speed
    checks = [
        Check(f"error of the velocity at ({', '.join(f'{x:g}' for x in p)})", float(e), 0.0, 1e-12)
        for p, e in zip(point, error)
    ]
    return Outcome(checks, draw(speed, error))


@style.styled
def draw(speed, error):
    figure = style.blank(2.6)
    axes = figure.subplots()
    axes.loglog(speed, np.maximum(error, 1e-17), "o")
    axes.axhline(1e-12, color=style.GREY, ls="--")
    axes.text(speed.min(), 1.3e-12, "tolerance", color=style.GREY, fontsize=8)
    axes.set_xlabel("exact speed for unit circulation")
    axes.set_ylabel("relative error of the velocity")
    return figure
