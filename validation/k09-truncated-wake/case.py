"""Inflow of a rigid helical wake of eight turns."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def velocity(n, pitch, turns, step, r):
    s = np.arange(round(turns * 360 / step) + 1) * np.radians(step)
    wake = [
        np.column_stack([np.cos(2 * np.pi * k / n - s), np.sin(2 * np.pi * k / n - s), -pitch * s]) for k in range(n)
    ]
    n_segments = n * (s.size - 1)
    points = np.column_stack([r, 0 * r, 0 * r])
    return wf.induced_velocity(points, wake, np.ones(n_segments), np.zeros(n_segments), core="singular")


def run(case):
    table = case.table("wake.csv")
    checks = []
    for step in (10, 5):
        rows = table.where(discretisation=f"segments_{step}deg")
        ours = velocity(2, 0.05, 8, step, rows["r"])
        exact = np.column_stack([rows["ur"], rows["uphi"], rows["uz"]])
        checks.append(Check.largest(f"velocity on the blade, {step}-degree segments", ours, exact, 1e-9, "Gamma/R"))
    curve, infinite = table.where(discretisation="exact_curve"), table.where(discretisation="semi_infinite_exact")
    ours = velocity(2, 0.05, 8, 10, curve["r"])[:, 2]
    checks += [
        Check(f"cost of 10-degree chords at {r:g} R", v, e, unit="Gamma/R", kind="relative", gate=False)
        for r, v, e in zip(curve["r"], ours, curve["uz"])
    ]
    checks += [
        Check(f"cost of ending after 8 turns at {r:g} R", v, e, unit="Gamma/R", kind="relative", gate=False)
        for r, v, e in zip(curve["r"], curve["uz"], infinite["uz"])
    ]
    return Outcome(checks, draw(curve, infinite))


@style.styled
def draw(curve, infinite):
    figure = style.blank(2.8)
    axes = figure.subplots()
    r = np.linspace(0, 0.97, 60)
    for turns, color in ((4, style.COLORS[1]), (8, style.COLORS[0]), (40, style.COLORS[2])):
        axes.plot(r, velocity(2, 0.05, turns, 5, r)[:, 2], color=color, label=f"{turns} turns, 5-degree segments")
    axes.plot(curve["r"], curve["uz"], "o", color=style.COLORS[0], ms=4, label="8 turns of the curve, exact")
    axes.plot(infinite["r"], infinite["uz"], "s", color=style.COLORS[6], ms=4, label="infinite, exact")
    axes.set_xlabel("radius [R]")
    axes.set_ylabel("axial velocity, up positive [circulation / R]")
    axes.legend()
    return figure
