"""Hover performance of the rotors of Knight and Hefner."""

from functools import partial

import numpy as np
from settings import BASELINE, HOVER_WAKES, baseline, hover

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    table = case.table("performance.csv")
    keep = (table["theta_deg"] >= 2) & (table["theta_deg"] % 2 == 0)
    checks, curves = [], []
    for blades in (2, 4):
        rows = keep & (table["blades"] == blades)
        rotor = case.path(f"rotors/knight-hefner-{blades}.toml")
        for name in [*list(HOVER_WAKES)[:2], BASELINE]:
            default = name.startswith("default")
            solved = partial(baseline, rotor) if name == BASELINE else partial(hover, rotor, name)
            found = [solved(collective=f"{t:g} deg") for t in table["theta_deg"][rows]]
            curves.append((blades, name, table["theta_deg"][rows], [(s.ct, s.cq) for s in found]))
            for theta, stand, ct, cq in zip(table["theta_deg"][rows], found, table["CT"][rows], table["CQ"][rows]):
                note = "; ".join([*([] if default else [name]), *stand.notes])
                common = {"kind": "relative", "gate": default and theta >= 6, "note": note}
                checks.append(Check(f"C_T, {blades} blades, {theta:g} deg", stand.ct, ct, 0.07, **common))
                checks.append(Check(f"C_Q, {blades} blades, {theta:g} deg", stand.cq, cq, 0.10, **common))
    return Outcome(checks, draw(table, curves))


@style.styled
def draw(table, curves):
    figure = style.blank(3.4)
    left, right = figure.subplots(1, 2)
    for blades, marker in ((2, "o"), (4, "s")):
        rows = table["blades"] == blades
        left.plot(table["theta_deg"][rows], table["CT"][rows], "k" + marker, ms=4, label=f"measured, {blades} blades")
        right.plot(table["CT"][rows], table["CQ"][rows], "k" + marker, ms=4)
    for blades, name, theta, found in curves:
        ct, cq = np.transpose(found)
        i = [*list(HOVER_WAKES)[:2], BASELINE].index(name)
        left.plot(theta, ct, style.LINES[i], color=style.COLORS[i], label=name if blades == 2 else None)
        right.plot(ct, cq, style.LINES[i], color=style.COLORS[i])
    left.set_xlabel("collective [deg]")
    left.set_ylabel("thrust coefficient C_T")
    right.set_xlabel("thrust coefficient C_T")
    right.set_ylabel("torque coefficient C_Q")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
