"""Hover performance of the six-foot rotor of Castles and Gray."""

from functools import partial

import numpy as np
from settings import BASELINE, HOVER_WAKES, baseline, hover

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

ANGLES = np.arange(1.0, 12.1, 1.5)


def run(case):
    table = case.table("hover.csv")
    checks, curves = [], []
    for rpm in (1200, 1600):
        rotor = case.path(f"rotors/castles-gray-6ft-{rpm}.toml")
        rows = (table["rotor"] == "6ft_const") & (table["rpm"] == rpm)
        for name in [*list(HOVER_WAKES)[: 2 if rpm == 1200 else 1], BASELINE]:
            default = name.startswith("default")
            solved = partial(baseline, rotor) if name == BASELINE else partial(hover, rotor, name)
            found = [solved(collective=f"{a:g} deg") for a in (0.0, *ANGLES)]
            ct, cq = np.array([s.ct for s in found[1:]]), np.array([s.cq - found[0].cq for s in found[1:]])
            curves.append((rpm, name, ct, cq))
            for theta, thrust, torque in zip(*(table[k][rows] for k in ("theta075_deg", "CT", "dCQ"))):
                gate, note = default and thrust > 0.002, "" if default else name
                ours, text = np.interp(theta, ANGLES, ct), f"C_T at {theta:g} deg, {rpm} rpm"
                checks.append(Check(text, ours, thrust, 0.08, kind="relative", gate=gate, note=note))
                if gate and np.isfinite(torque):
                    same, text = np.interp(thrust, ct, cq), f"torque increment at C_T = {thrust:g}, {rpm} rpm"
                    checks.append(Check(text, same, torque, kind="relative", gate=False))
    return Outcome(checks, draw(table, curves))


@style.styled
def draw(table, curves):
    figure = style.blank(4.6)
    left, right = figure.subplots(1, 2)
    for rpm, marker in ((1200, "o"), (1600, "s")):
        rows = (table["rotor"] == "6ft_const") & (table["rpm"] == rpm)
        left.plot(table["theta075_deg"][rows], table["CT"][rows], "k" + marker, ms=4, label=f"measured, {rpm} rpm")
        right.plot(table["CT"][rows], table["dCQ"][rows], "k" + marker, ms=4)
    for rpm, name, ct, cq in curves:
        color = style.COLORS[[*list(HOVER_WAKES)[:2], BASELINE].index(name)]
        left.plot(ANGLES, ct, color=color, ls="-" if rpm == 1200 else "--", label=f"{name}, {rpm} rpm")
        right.plot(ct, cq, color=color, ls="-" if rpm == 1200 else "--")
    left.set_xlabel("collective at 0.75 R [deg]")
    left.set_ylabel("thrust coefficient C_T")
    right.set_xlabel("thrust coefficient C_T")
    right.set_ylabel("torque coefficient\nless that of no thrust")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=1)
    return figure
