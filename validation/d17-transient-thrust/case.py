"""Overshoot of thrust in collective ramps, and the report's factor."""

import importlib.util

import numpy as np

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    factor = case.toml("carpenter_fridovich_statement.toml")["overshoot"]["calculated_over_measured"]
    path = case.folder.parent / "d03-inflow-transients" / "case.py"
    spec = importlib.util.spec_from_file_location("wakeflight_case_d03_ramps", path)
    ramps = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(ramps)
    t, checks, drawn = np.linspace(0.0, 1.5, 15001), [], {}
    for apparent in ("uncorrected", "corrected"):
        drawn[apparent] = []
        for rate in (6.0, 20.0, 50.0, 200.0):
            ct = ramps.ramp(rate, apparent, end=4.0)(np.concatenate([t, t + 1.5]))[0]
            overshoot = ct.max() / ct[-1]
            drawn[apparent].append((rate, overshoot))
            label = f"peak over steady thrust at {rate:g} deg/s, {apparent} mass"
            note = "beside it what the report's factor makes of it"
            checks.append(Check(label, overshoot, 1.0 + (overshoot - 1.0) / factor, gate=False, note=note))
    return Outcome(checks, draw(drawn, factor))


@style.styled
def draw(drawn, factor):
    figure = style.blank(2.6)
    axes = figure.subplots()
    for (apparent, points), color in zip(drawn.items(), style.COLORS):
        rate, overshoot = np.array(points).T
        axes.semilogx(rate, overshoot, marker="o", color=color, label=f"{apparent} apparent mass")
        axes.semilogx(rate, 1.0 + (overshoot - 1.0) / factor, ls="--", color=color)
    axes.plot([], [], "--", color=style.GREY, label="overshoot over the report's 1.1")
    axes.set_xlabel("rate of collective [deg/s]")
    axes.set_ylabel("peak over steady thrust")
    axes.legend()
    return figure
