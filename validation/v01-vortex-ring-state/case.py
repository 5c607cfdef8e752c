"""Induced velocity in vertical descent by the method of the report."""

import numpy as np
from descent import inferred_inflow

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

RATES = (0.0, 0.4, 0.8, 1.2, 1.6)
VARIED = 1.2
VARIATIONS = {"12 turns instead of 8": {"turns": 12}, "largest circulation": {"turns": 8, "tip_strength": "max"}}


def run(case):
    table = case.table("inflow.csv")
    x, y = table["Vd_over_vh"], table["vi_over_vh"]
    rotor = case.path("rotors/castles-gray-6ft-1200.toml")
    found = [inferred_inflow(rotor, rate) for rate in RATES]
    ours = [each.ratio for each in found]
    checks = [
        Check(f"v_i/v_h at V_d/v_h = {rate:g}", value, np.interp(rate, x, y), 0.25, gate=rate <= 1.2)
        for rate, value in zip(RATES, ours)
    ]
    for name, options in VARIATIONS.items():
        value = inferred_inflow(rotor, VARIED, wf.TimeMarchingWake(**options)).ratio
        text = f"v_i/v_h at V_d/v_h = {VARIED:g}"
        checks.append(Check(text, value, np.interp(VARIED, x, y), gate=False, note=name))
    return Outcome(checks, draw(x, y, found))


@style.styled
def draw(x, y, found):
    figure = style.blank(3.2)
    axes = figure.subplots()
    axes.plot(x, y, "k-", label="measured, faired")
    axes.fill_between(x, y - 0.15, y + 0.15, color=style.GREY, alpha=0.2, lw=0)
    rates = [each.rate for each in found]
    ours, scatter = [each.ratio for each in found], [each.scatter for each in found]
    label = "time-marching wake, mean and scatter of revolutions"
    axes.errorbar(rates, ours, scatter, fmt="o", color=style.COLORS[0], label=label)
    d = np.linspace(0, 2.4, 100)
    axes.plot(d, d, ":", color=style.GREY, label="no flow through the disk")
    axes.set_xlabel("rate of descent over v_h")
    axes.set_ylabel("induced velocity over v_h")
    axes.legend()
    return figure
