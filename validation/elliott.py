"""Induced inflow one chord above the disk of the Elliott-Althoff rotor: ours at the measured points, and the scores."""

import numpy as np
from wind import DEFAULT, MARCHED, WAKES, wind

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

HEIGHT = 0.0767
"""One chord over the radius: the laser's plane above the tip-path plane."""


def induced(stand, psi, r):
    """Inflow ratio, positive down, at azimuths [rad] and radii over R in the plane one chord above the tips."""
    radius = stand.radius
    height = stand.beta_0 * (1.0 - 0.0508 / 0.860552) + HEIGHT
    # psi = 0 aft, the hub's x axis aft and y to the right, the advancing side
    points = radius * np.column_stack([r * np.cos(psi), r * np.sin(psi), np.full_like(r, height)])
    return -stand.wake_velocity(points)[:, 2] / stand.model.tip_speed


def momentum(ct, mu, angle):
    """Glauert's mean induced inflow, shaft angle [rad] nose down positive, by Newton."""
    inflow = ct / (2 * mu)
    for _ in range(50):
        through = mu * np.tan(angle) + inflow
        f = inflow - ct / (2 * np.hypot(mu, through))
        inflow -= f / (1 + ct * through / (2 * np.hypot(mu, through) ** 3))
    return inflow


def blade_element(ct, mu, inflow):
    """Pitch at 0.75 R [deg] of C_T = sigma a/2 [theta_75/3 (1 + 3/2 mu^2) - lambda/2], linear twist, a = 5.73, no flapping.

    Longitudinal cyclic is left out: at first order in mu it adds mu/2 theta_1s to the bracket.
    """
    load = 2 * ct / (4 * 0.06604 / (np.pi * 0.860552) * 5.73)
    return float(np.degrees(3 * (load + inflow / 2) / (1 + 1.5 * mu**2)))


def compare(case, speed, shaft_angle, controls, tolerance):
    """Trim to the measured thrust and no flapping, and compare inflow and controls.

    controls: measured collective at 0.75 R, theta_1c, theta_1s [deg].
    """
    table = case.table("inflow.csv")
    psi, r, measured = np.radians(table["psi_deg"]), table["r_R"], table["lambda_i_down"]
    found = {}
    for name in [*WAKES, MARCHED]:
        stand = wind(
            case.path("rotors/elliott-althoff.toml"),
            name,
            speed=f"{speed} m/s",
            shaft_angle=f"{shaft_angle} deg",
            ct=0.0064,
            flapping="zero",
        )
        found[name] = (stand, induced(stand, psi, r))
    checks = []
    ahead = (table["psi_deg"] >= 150) & (table["psi_deg"] <= 210) & (r > 0.8)
    inside = r <= 0.98
    rear = (np.cos(psi) > 0.5) & inside & (r > 0.7)
    for name, (stand, ours) in found.items():
        note, gate = ("", True) if name == DEFAULT else (name, False)
        rms = float(np.sqrt(np.mean((ours - measured) ** 2)))
        checks += [
            Check(f"rms of the difference, {len(r)} points", rms, 0.0, tolerance, "inflow ratio", gate=gate, note=note),
            Check("share of points ahead of the disk with upwash where it is measured", agreement(ours, measured, ahead),
                  1.0, 0.25, gate=gate, note=note),
            Check("mean of the points ahead of the disk", ours[ahead].mean(), measured[ahead].mean(), gate=False, note=note),
            Check("mean of the points over the rear", ours[rear].mean(), measured[rear].mean(), gate=False, note=note),
            Check("mean of all points on the disk", ours[inside].mean(), measured[inside].mean(), gate=False, note=note),
        ]  # fmt: skip
        theta = np.degrees([float(stand.data.theta_75), stand.theta_1c, stand.theta_1s])
        for text, mine, theirs in zip(("collective at 0.75 R", "theta_1c", "theta_1s"), theta, controls):
            checks.append(Check(text, mine, theirs, 1.0, "deg", gate=gate, note=note))
    mu, angle = stand.data.attrs, np.radians(-shaft_angle)
    mu = speed * np.cos(angle) / (float(mu["omega"]) * float(mu["radius"]))
    uniform = momentum(0.0064, mu, angle)
    simple = blade_element(0.0064, mu, mu * np.tan(angle) + uniform)
    text = "collective of uniform inflow and a linear section, for scale"
    checks.append(Check(text, simple, controls[0], unit="deg", gate=False))
    rms = float(np.sqrt(np.mean((uniform - measured) ** 2)))
    checks.append(Check("rms of uniform momentum inflow, for scale", rms, 0.0, tolerance, "inflow ratio", gate=False))
    return Outcome(checks, draw(table, found, uniform))


def agreement(ours, measured, where):
    """Share of points whose sign is that of the measurement."""
    return float(np.mean(np.sign(ours[where]) == np.sign(measured[where])))


@style.styled
def draw(table, found, uniform):
    """Radial distributions at every azimuth of the test."""
    azimuths = np.unique(table["psi_deg"])
    figure = style.blank(7.0)
    panels = figure.subplots(4, 3, sharex=True, sharey=True)
    for axes, psi in zip(panels.flat, azimuths):
        rows = table["psi_deg"] == psi
        axes.plot(table["r_R"][rows], table["lambda_i_down"][rows], "ko", ms=2.5, label="measured")
        for (name, (_, ours)), color, line in zip(found.items(), style.COLORS, style.LINES):
            axes.plot(table["r_R"][rows], ours[rows], line, color=color, lw=1.1, label=name)
        axes.axhline(uniform, color=style.GREY, lw=0.8, ls=":", label="uniform, momentum theory")
        axes.axhline(0, color="k", lw=0.4)
        axes.set_title(f"ψ = {psi:g}°")
    for axes in panels.flat[len(azimuths) :]:
        axes.set_visible(False)
    for axes in panels[-1]:
        axes.set_xlabel("r/R")
    for axes in panels[:, 0]:
        axes.set_ylabel("inflow, down [ΩR]")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
