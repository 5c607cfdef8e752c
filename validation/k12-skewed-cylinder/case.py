"""Skewed vortex cylinder as a stack of polygonal rings."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

SIDES = 120


def stack(skew):
    """Rings of a cylinder with unit vorticity per length along the axis: nodes and circulation."""
    edges = np.concatenate([np.arange(0, 1, 0.002), np.arange(1, 4, 0.01), 4 * 1.01 ** np.arange(0, 560)])
    middle, width = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    angle = 2 * np.pi * np.arange(SIDES + 1) / SIDES
    # polygon with the circle's area: its far field is that of the ring
    radius = np.sqrt(2 * np.pi / SIDES / np.sin(2 * np.pi / SIDES))
    ring = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle])
    ring[-1] = ring[0]
    shift = np.column_stack([middle * np.tan(skew), 0 * middle, middle])
    return [ring + each for each in shift], np.repeat(width, SIDES)


def inflow(skew, points):
    """Velocity normal to the disk over half the vorticity."""
    rings, circulation = stack(skew)
    return 2 * wf.induced_velocity(points, rings, circulation, 0 * circulation, core="singular")[:, 2]


def run(case):
    table = case.table("inflow.csv")
    slope_row = table["psi_deg"] == "slope_at_centre_over_w0"
    checks, curves = [], []
    for skew in np.unique(table["chi_deg"]):
        rows = (table["chi_deg"] == skew) & ~slope_row
        r, psi = table["r"][rows], np.radians(table["psi_deg"][rows].astype(float))
        exact = table["w_over_half_gamma"][rows]
        h = 0.02
        probes = np.array([(h, 0, 0), (-h, 0, 0), (0, 0, 0)])
        points = np.vstack([np.column_stack([r * np.cos(psi), r * np.sin(psi), 0 * r]), probes])
        ours = inflow(np.radians(skew), points)
        checks.append(Check.largest(f"inflow, skew {skew:g} deg", ours[:-3], exact, 5e-4, "gamma/2"))
        slope = (ours[-3] - ours[-2]) / (2 * h) / ours[-1]
        given = table["w_over_half_gamma"][(table["chi_deg"] == skew) & slope_row][0]
        checks.append(Check(f"fore-and-aft slope over the mean, skew {skew:g} deg", slope, given, 1e-3))
        curves.append((skew, r, psi, exact, ours[:-3]))
    return Outcome(checks, draw(curves))


@style.styled
def draw(curves):
    figure = style.blank(3.0)
    axes = figure.subplots()
    for (skew, r, psi, exact, ours), color in zip(curves, style.COLORS):
        along = np.abs(np.sin(psi)) < 1e-9
        x = r[along] * np.cos(psi[along])
        order = np.argsort(x)
        axes.plot(x[order], ours[along][order], color=color, label=f"skew {skew:g}°")
        axes.plot(x, exact[along], "o", color=color, ms=4)
    axes.set_xlabel("fore-and-aft diameter, aft positive [R]")
    axes.set_ylabel("inflow over half the vorticity")
    axes.legend(title="points: exact")
    return figure
