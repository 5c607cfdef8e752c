"""Autorotation of the PCA-2 rotor in forward flight."""

import numpy as np
from wind import DEFAULT, MARCHED, wind

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

WAKES = {DEFAULT: DEFAULT, "dynamic inflow of three states": None}
RADIUS = 22.5 * 0.3048
ROWS = 7
"""Points of the test compared, evenly spread over its 65."""


def at_speed(case, wake, speed, alpha, rpm):
    """The rotor at its fixed pitch of 2.7 deg, turning at `rpm`."""
    return wind(
        case.path("rotors/pca2.toml"),
        wake,
        speed=f"{speed} m/s",
        shaft_angle=f"{alpha} deg",
        collective="2.7 deg",
        lateral_cyclic="0 deg",
        longitudinal_cyclic="0 deg",
        rpm=float(rpm),
    )


def autorotating(case, wake, speed, alpha, rpm):
    """Rotor speed [rpm] without torque, by the secant method from the measured one, and the rotor there."""
    old, new = rpm, 1.04 * rpm
    before, stand = at_speed(case, wake, speed, alpha, old).cq, at_speed(case, wake, speed, alpha, new)
    for _ in range(6):
        step = np.clip(-stand.cq * (new - old) / (stand.cq - before), -0.15 * new, 0.15 * new)
        old, before, new = new, stand.cq, new + step
        stand = at_speed(case, wake, speed, alpha, new)
        if abs(stand.cq) < 2e-6:
            break
    return new, stand


def run(case):
    table = case.table("autorotation.csv")
    chosen = np.linspace(0, len(table) - 1, ROWS).astype(int)
    checks, found = [], {name: [] for name in WAKES}
    for i in chosen:
        mu, alpha, rpm, lift, drag, ct = (table[name][i] for name in ("mu", "alpha_deg", "rpm", "CL", "CD", "CT"))
        angle = np.radians(alpha)
        speed = mu * rpm * np.pi / 30 * RADIUS / np.cos(angle)
        for name, wake in WAKES.items():
            ours, stand = autorotating(case, wake, speed, alpha, rpm)
            x, _, z = stand.aero_force
            ratio = (z * np.cos(angle) - x * np.sin(angle)) / (z * np.sin(angle) + x * np.cos(angle))
            found[name].append((mu, ours / rpm, stand.ct / ct, ratio, lift / drag))
            note, gate = ("", True) if name == DEFAULT else (name, False)
            text = f"at mu = {mu:g}, disk {alpha:g} deg"
            checks += [
                Check(f"rotor speed {text}", ours, rpm, 0.06, "rpm", "relative", gate, note),
                Check(f"C_T {text}", stand.ct, ct, 0.10, "-", "relative", gate, note),
                Check(f"lift over drag {text}", ratio, lift / drag, 0.20, "-", "relative", gate, note),
            ]
            if name == DEFAULT:
                marched = at_speed(case, MARCHED, speed, alpha, ours)
                for what, mine, theirs in (("C_T", marched.ct, stand.ct), ("C_Q", marched.cq, stand.cq)):
                    label = f"{what} of the wake marched in time at the speed found, beside relaxed, {text}"
                    checks.append(Check(label, mine, theirs, gate=False, note="; ".join(marched.notes)))
    return Outcome(checks, draw(table, found))


@style.styled
def draw(table, found):
    figure = style.blank(2.9)
    panels = figure.subplots(1, 3)
    panels[2].plot(table["mu"], table["CL"] / table["CD"], "k.", ms=3, label="measured")
    for (name, rows), color, marker in zip(found.items(), style.COLORS, "sv"):
        mu, speed, thrust, ratio, _ = np.array(rows).T
        for axes, value in zip(panels, (speed, thrust, ratio)):
            axes.plot(mu, value, marker, mfc="none", color=color, label=name)
    for axes, text, width in zip(panels, ("rotor speed over measured", "C_T over measured"), (0.06, 0.1)):
        axes.axhspan(1 - width, 1 + width, color=style.GREY, alpha=0.15, lw=0)
        axes.axhline(1, color="k", lw=0.6)
        axes.set_ylabel(text)
    panels[2].set_ylabel("lift over drag")
    for axes in panels:
        axes.set_xlabel("advance ratio")
    figure.legend(*panels[2].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure
