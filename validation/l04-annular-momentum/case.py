"""Hover of an untwisted blade by blade elements and annular momentum, beside the closed form."""

import tempfile
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

SCALE = 1e-4
"""Pitch and solidity over those of the case: the closed form is homogeneous, the sections' angles become small."""
COUNTS = (100, 200)
AT = (0.25, 0.5, 0.75, 1.0)

ROTOR = """
format = 1
name = "Untwisted rectangular blades"
[rotor]
n_blades = 2
radius = "5 m"
omega = "40 rad/s"
[rotor.blade]
root = "clamped"
flexible = false
root_station = "0 m"
root_cutout = "1e-9 m"
geometry = {{ columns = {{ r_R = [0, 1], chord_m = [{chord!r}, {chord!r}], twist_deg = [0, 0] }} }}
[rotor.airfoil]
name = "linear lift, no drag"
polar = {{ lift_curve_slope = "{slope!r} 1/rad", cd = [0.0, 0.0, 0.0], prandtl_glauert = false }}
"""


def hover(folder, sigma, slope, theta, scale, n, tip_loss="none"):
    """Rotor of solidity `scale` sigma at `scale` theta [deg]."""
    path = Path(folder) / "rotor.toml"
    path.write_text(ROTOR.format(chord=float(scale * sigma * np.pi * 5 / 2), slope=float(slope)))
    model = wf.AnnularInflow(n_stations=n, azimuth_step="45 deg", tip_loss=tip_loss)
    return wf.tunnel(path, f"{scale * theta!r} deg", inflow=model)


def run(case):
    table = case.table("hover.csv")
    checks, curves = [], []
    with tempfile.TemporaryDirectory() as folder:
        for i in range(len(table)):
            sigma, slope, theta = (float(table[name][i]) for name in ("sigma", "a", "theta_deg"))
            stands = [hover(folder, sigma, slope, theta, SCALE, n) for n in COUNTS]
            r, lam = stands[-1].data.station.values, stands[-1].data.inflow.values[0] / SCALE
            text = f"sigma {sigma:g}, {theta:g} deg"
            for at, ours in zip(AT, CubicSpline(r, lam)(AT)):
                exact = table[f"lam_{round(100 * at):03d}"][i]
                checks.append(Check(f"inflow at {at:g} R, {text}", ours, exact, 1e-8))
            for name, power, label in (("CT", 2, "thrust coefficient"), ("CPi", 3, "induced power coefficient")):
                coarse, fine = (getattr(s, {"CT": "ct", "CPi": "cq"}[name]) / SCALE**power for s in stands)
                # the middles of the elements integrate to second order
                limit = (4 * fine - coarse) / 3
                checks.append(Check(f"{label}, {text}", limit, table[name][i], 1e-8, kind="relative"))
            own = hover(folder, sigma, slope, theta, 1.0, 40)
            lossy = hover(folder, sigma, slope, theta, 1.0, 40, "prandtl")
            for stand, note in ((own, "at its own angles"), (lossy, "with Prandtl's tip loss")):
                checks.append(
                    Check(f"thrust coefficient {note}, {text}", stand.ct, table["CT"][i], kind="relative", gate=False)
                )
            curves.append((text, r, lam, [table[f"lam_{round(100 * at):03d}"][i] for at in AT], lossy))
    return Outcome(checks, draw(curves))


@style.styled
def draw(curves):
    figure = style.blank(2.9)
    axes = figure.subplots()
    for (text, r, lam, exact, lossy), color in zip(curves, style.COLORS):
        axes.plot(r, lam, color=color, label=text)
        axes.plot(lossy.data.station, lossy.data.inflow[0], "--", color=color, label="with Prandtl's tip loss")
        axes.plot(AT, exact, "ko", ms=4)
    axes.set_ylim(0, 0.15)
    axes.set_xlabel("r/R")
    axes.set_ylabel("inflow, down [ΩR]; dots exact")
    axes.legend()
    return figure
