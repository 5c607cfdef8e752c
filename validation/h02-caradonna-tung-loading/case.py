"""Section lift of the rotor of Caradonna and Tung."""

import numpy as np
from settings import FULL_SPAN, HOVER_WAKES, full_span_hover, hover

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

STATIONS = {"cl_050": 0.50, "cl_068": 0.68, "cl_080": 0.80, "cl_089": 0.89, "cl_096": 0.96}


def run(case):
    table = case.table("loading.csv")
    rotor = case.path("rotors/caradonna-tung.toml")
    checks, curves = [], []
    for i in range(1, len(table)):  # the first row has interchanged columns
        theta, rpm = table["theta_deg"][i], table["rpm"][i]
        measured = {r: table[name][i] for name, r in STATIONS.items()}
        found = {}
        for name in HOVER_WAKES:
            stand = hover(rotor, name, collective=f"{theta} deg", rpm=rpm)
            lift = stand.data.cl.mean("azimuth")
            found[name] = (lift.station.values, lift.values)
        full = full_span_hover(rotor, collective=f"{theta:g} deg", rpm=float(rpm)).data.cl.mean("azimuth")
        found[FULL_SPAN] = (full.station.values, full.values)
        ours = found[next(iter(HOVER_WAKES))]
        for r, cl in measured.items():
            text, tolerance = f"c_l at {r:g} R, {theta:g} deg, {rpm:g} rpm", 0.04 if r > 0.9 else 0.02
            checks.append(Check(text, np.interp(r, *ours), cl, tolerance))
            judged = np.interp(r, *found[FULL_SPAN])
            checks.append(Check(text, judged, cl, tolerance, gate=False, note=FULL_SPAN))
        curves.append((theta, rpm, measured, found))
    return Outcome(checks, draw(curves[:2]))


@style.styled
def draw(curves):
    figure = style.blank(3.4)
    both = figure.subplots(1, 2, sharey=True)
    for axes, (theta, rpm, measured, found) in zip(both, curves):
        for (name, (r, cl)), color in zip(found.items(), style.COLORS):
            axes.plot(r, cl, color=color, label=name)
        axes.plot(list(measured), list(measured.values()), "ko", label="measured")
        axes.set_title(f"{theta:g}°, {rpm:g} rpm")
        axes.set_xlabel("radius [R]")
        axes.set_ylim(0, 0.45)
    both[0].set_ylabel("section lift coefficient")
    figure.legend(*both[0].get_legend_handles_labels(), loc="outside lower center")
    return figure
