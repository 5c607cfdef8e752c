"""A fixed rectangular wing: `wf.wing` with its two tips, and the near wake of a blade so far out that it flies straight."""

import json

import numpy as np
from scipy.interpolate import CubicSpline

import wakeflight as wf
from wakeflight import _core
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

FAR = 1e5
"""Distance of the wing from the hub, in chords."""
COUNTS = (20, 40, 80, 160)
AT = (0.0, 0.5, 0.8, 0.95)
"""Stations over the half span at which circulation is compared."""


def fixed_wing(table, i):
    """Checks of `wf.wing` by lifting line with 40 stations in cosine spacing, as the case asks for."""
    ratio, alpha = float(table["AR"][i]), 1e-3
    found = wf.wing(ratio, 1.0, f"{alpha} rad", blade_model="lifting-line", n=40)
    widths = np.diff(found.edges)
    # sections of slope 2 pi: Gamma = pi c (sin alpha - w)
    downwash = np.sin(alpha) - found.circulation / np.pi
    drag = 2 * np.sum(found.circulation * downwash * widths) / ratio
    text = f"aspect ratio {ratio:g}, wf.wing with 40 stations"
    local = CubicSpline(found.stations / (ratio / 2), found.circulation / (ratio * alpha))(AT)
    theirs = [table[name][i] for name in ("G0", "G05", "G08", "G095")]
    return [
        Check(f"lift-curve slope, {text}", found.cl / alpha, table["CL_alpha"][i], 0.005, "1/rad", "relative"),
        Check(
            f"induced drag, {text}", drag * np.pi * ratio / found.cl**2, 1 + table["delta"][i], 0.005, "-", "relative"
        ),
        *(
            Check(f"circulation at {at:g} of the half span, {text}", ours, exact, 0.005, "b U alpha", "relative")
            for at, ours, exact in zip(AT, local, theirs)
        ),
    ]


def wing(ratio, n):
    """Edges and stations along the span, circulation over U alpha, downwash angle over alpha, of a wing of unit chord."""
    options = wf.RelaxationWake(near_wake_angle="10 deg").resolved("forward").core_options(wf.load_aircraft("uh60a"))
    rotor = {"n_blades": 1, "radius": FAR + ratio / 2, "root_cutout": FAR - ratio / 2, "hinge_offset": 0.0,
             "chord": 1.0, "omega": 1.0 / FAR}  # fmt: skip
    options["rotor"] = rotor
    options["wake"] |= {"n_stations": n, "near_wake_segments": 60}
    at_rest = ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    text = json.dumps(options)
    tip_speed = rotor["omega"] * rotor["radius"]
    matrix, edges, stations = _core.near_wake_matrix(text, at_rest, (0.0, 0.0, 0.0))
    matrix *= tip_speed
    # Gamma = c/2 2 pi (U alpha - w): the section's lift-curve slope is 2 pi
    circulation = np.linalg.solve(np.eye(n) + np.pi * matrix, np.full(n, np.pi))
    return edges - FAR, stations - FAR, circulation, matrix @ circulation


def run(case):
    table = case.table("wing.csv")
    checks, found = [], {}
    for i, ratio in enumerate(table["AR"]):
        checks += fixed_wing(table, i)
        slopes, local = [], []
        for n in COUNTS:
            edges, stations, circulation, downwash = wing(ratio, n)
            width = np.diff(edges)
            slopes.append(2 * np.sum(circulation * width) / ratio)
            local.append(np.interp(AT, stations / (ratio / 2), circulation / ratio))
        exact = table["CL_alpha"][i]
        text = f"aspect ratio {ratio:g}"
        checks.append(Check(f"lift-curve slope, {text}, 160 stations", slopes[-1], exact, 0.005, "1/rad", "relative"))
        limit = 2 * slopes[-1] - slopes[-2]
        checks.append(
            Check(f"slope without the error of first order, {text}", limit, exact, 0.001, "1/rad", "relative")
        )
        drag = 2 * np.sum(circulation * downwash * width) / ratio
        delta = drag * np.pi * ratio / slopes[-1] ** 2 - 1
        checks.append(Check(f"induced-drag factor delta, {text}", delta, table["delta"][i], 0.01))
        theirs = [table[name][i] for name in ("G0", "G05", "G08", "G095")]
        ours = 2 * local[-1] - local[-2]
        label = f"circulation without the error of first order, {text}"
        checks.append(Check.largest(label, ours, theirs, 0.005, "b U alpha", "relative"))
        for at, raw, reference in zip(AT, local[-1], theirs):
            label = f"circulation at {at:g} of the half span, {text}, 160 stations"
            checks.append(Check(label, raw, reference, unit="b U alpha", gate=False))
        found[ratio] = (np.abs(np.array(slopes) / exact - 1), stations / (ratio / 2), circulation / ratio, theirs)
    return Outcome(checks, draw(found))


@style.styled
def draw(found):
    figure = style.blank(2.9)
    left, right = figure.subplots(1, 2)
    for (ratio, (error, y, circulation, exact)), color in zip(found.items(), style.COLORS):
        left.plot(y, circulation, color=color, label=f"aspect ratio {ratio:g}")
        left.plot(AT, exact, "ko", ms=4)
        right.loglog(COUNTS, error, "o-", color=color)
    right.loglog(COUNTS, 0.5 / np.array(COUNTS), "--", color=style.GREY, label="first order")
    left.set_xlabel("2y/b, the refined end on the right")
    left.set_ylabel("circulation over b U α; dots exact")
    right.set_xlabel("stations")
    right.set_ylabel("relative error of the lift-curve slope")
    left.legend()
    right.legend()
    return figure
