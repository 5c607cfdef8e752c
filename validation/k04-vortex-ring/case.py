"""Circular vortex ring by polygons of straight segments."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

SIDES = np.array([36, 72, 144, 288, 576])


def polygon_velocity(n, r, z):
    """Radial and axial velocity of an inscribed polygon, half way between two nodes off the axis."""
    angle = 2 * np.pi * np.arange(n + 1) / n
    nodes = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    nodes[-1] = nodes[0]
    direction = np.array([np.cos(np.pi / n), np.sin(np.pi / n)])
    v = wf.induced_velocity([[*(r * direction), z]], [nodes], np.ones(n), np.zeros(n), core="singular")[0]
    return np.array([v[:2] @ direction, v[2]])


def run(case):
    table = case.table("field.csv")
    polygon = table.where(kind="ngon")
    axial = [polygon_velocity(int(n), 0.0, z)[1] for n, z in zip(polygon["N"], polygon["z"])]
    checks = [Check.largest("axis velocity of polygons", axial, polygon["uz"], 1e-11, "Gamma/R", "relative")]
    ring = table.where(kind="ring")
    errors = []
    for r, z, *exact in zip(ring["r"], ring["z"], ring["ur"], ring["uz"]):
        error = [np.linalg.norm(polygon_velocity(n, r, z) - exact) / np.linalg.norm(exact) for n in SIDES]
        errors.append(error)
        order = np.log2(error[-2] / error[-1])
        checks.append(Check(f"order of convergence at r = {r:g}, z = {z:g}", order, 2.0, 0.05))
    return Outcome(checks, draw(ring, errors))


@style.styled
def draw(ring, errors):
    figure = style.blank(3.0)
    axes = figure.subplots()
    for r, z, error in zip(ring["r"], ring["z"], errors):
        axes.loglog(SIDES, error, "-", color=style.COLORS[0], lw=0.8, marker=".")
        if (r, z) in ((0.0, 0.0), (0.9, 0.1)):
            axes.annotate(f"r = {r:g}, z = {z:g}", (SIDES[0], error[0]), fontsize=8, va="bottom")
    axes.loglog(SIDES, 2.0 * (SIDES / SIDES[0]) ** -2.0 * errors[0][0], "--", color=style.GREY, label="second order")
    axes.set_xlabel("segments of the ring")
    axes.set_ylabel("relative error of the velocity")
    axes.legend()
    return figure
