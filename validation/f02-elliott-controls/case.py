"""Controls and qualities of the inflow of the Elliott-Althoff rotor at advance ratios 0.15 and 0.23."""

import numpy as np
from elliott import induced
from wind import DEFAULT, MARCHED, wind

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

KEPT = (0, 1)
"""Conditions compared: the third column mixes the advance ratio 0.30 with the controls of 0.35."""


def run(case):
    data = case.toml("rotor.toml")["conditions"]
    checks, found = [], {}
    for i in KEPT:
        mu, angle = data["mu"][i], data["shaft_angle_deg"][i]
        for name in (MARCHED, DEFAULT):  # the default last: its field is drawn
            stand = wind(
                case.path("rotors/elliott-althoff.toml"),
                name,
                speed=f"{mu / np.cos(np.radians(angle)) * 190.42} m/s",
                shaft_angle=f"{angle} deg",
                ct=data["CT"][i],
                flapping="zero",
            )
            note, gate = ("", True) if name == DEFAULT else (name, False)
            # signs of the report: theta = A0 - A1 cos psi - B1 sin psi
            for text, ours, theirs in (
                ("collective at 0.75 R", float(stand.data.theta_75), data["theta0_deg"][i]),
                ("theta_1c", stand.theta_1c, -data["theta1c_deg"][i]),
                ("theta_1s", stand.theta_1s, -data["theta1s_deg"][i]),
            ):
                label = f"{text} at mu = {mu:g}"
                checks.append(Check(label, np.degrees(ours), theirs, 1.0, "deg", gate=gate, note=note))
        psi, r = np.radians(np.arange(0.0, 361.0, 10.0)), np.linspace(0.25, 1.1, 35)
        field = np.array([induced(stand, np.full_like(r, at), r) for at in psi])
        found[mu] = (psi, r, field)
        front = field[18][r > 0.8].min()
        checks.append(Check(f"least inflow ahead of the disk at mu = {mu:g}", front, -0.0125, 0.0125, "inflow ratio"))
        at, station = np.unravel_index(np.argmax(field[:, r <= 0.98]), field[:, r <= 0.98].shape)
        largest = field[at, station]
        note = f"at azimuth {np.degrees(psi[at]):.0f} deg, r/R = {r[station]:.2f}"
        checks.append(
            Check(f"largest inflow at mu = {mu:g}", largest, 0.045, gate=False, unit="inflow ratio", note=note)
        )
    return Outcome(checks, draw(found))


@style.styled
def draw(found):
    figure = style.blank(3.4)
    panels = figure.subplots(1, len(found), subplot_kw={"projection": "polar"})
    low, high = style.levels(*(field for _, _, field in found.values()), symmetric=True)
    for axes, (mu, (psi, r, field)) in zip(panels, found.items()):
        axes.set_theta_zero_location("S")
        drawn = axes.contourf(psi, r, field.T, levels=np.linspace(low, high, 25), cmap=style.DIVERGING)
        axes.grid(False)
        axes.set_yticks([])
        axes.set_xticks(np.radians([0, 90, 180, 270]), ["0° aft", "90°", "180°", "270°"])
        axes.set_title(f"µ = {mu:g}")
    figure.colorbar(drawn, ax=panels, label="induced inflow one chord above the tips, down [ΩR]", shrink=0.8)
    return figure
