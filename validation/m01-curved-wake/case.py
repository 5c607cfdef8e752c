"""Gradient of inflow under a vortex tube whose axis is bent."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

SIDES, CURVATURE = 120, 0.01


def inflow(curvature, x):
    """Velocity along the axis at (x, 0, 0) over half the vorticity; the axis leaves along z and bends toward +x."""
    edges = np.concatenate([np.arange(0, 4, 0.02), 4 * 1.02 ** np.arange(0, 82)])
    s, width = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    turned = curvature * s
    angle = 2 * np.pi * np.arange(SIDES + 1) / SIDES
    radius = np.sqrt(2 * np.pi / SIDES / np.sin(2 * np.pi / SIDES))
    rings = []
    for along, tilt in zip(s, turned):
        centre = (0.5 * curvature * along**2, 0.0, along)
        across = radius * np.cos(angle)
        # ring in the plane normal to the tangent (tilt, 0, 1)
        ring = np.column_stack([across * np.cos(tilt), radius * np.sin(angle), -across * np.sin(tilt)]) + centre
        ring[-1] = ring[0]
        rings.append(ring)
    circulation = np.repeat(width, SIDES)
    points = np.column_stack([x, 0 * x, 0 * x])
    return 2 * wf.induced_velocity(points, rings, circulation, 0 * circulation, core="singular")[:, 2]


def run(case):
    exact = case.toml("curved.toml")["result"]
    x = np.array(exact["x"])
    ours = (inflow(CURVATURE, x) - inflow(-CURVATURE, x)) / (2 * CURVATURE * x)
    checks = [Check(f"factor of the gradient at x = {each:g} R", k, e, 0.01) for each, k, e in zip(x, ours, exact["K"])]
    return Outcome(checks, draw(x, ours, exact["K"]))


@style.styled
def draw(x, ours, exact):
    figure = style.blank(2.6)
    axes = figure.subplots()
    axes.plot(x, ours, "o-", label="program")
    axes.plot(x, exact, "--", color=style.GREY, label="exact")
    axes.set_ylim(0.9, 1.1)
    axes.set_xlabel("position toward which the wake bends [R]")
    axes.set_ylabel("gradient over curvature x half the vorticity")
    axes.legend()
    return figure
