"""Momentum inflow in climb and descent."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

CT = 0.005


def induced(rotor, rate):
    """Induced velocity over v_h of the three-state model at a rate of climb over v_h; NaN where no steady answer is found."""
    v_h = np.sqrt(CT / 2)
    try:
        stand = wf.tunnel(rotor, inflow="dynamic", climb=f"{rate * v_h * rotor.omega * rotor.radius} m/s", ct=CT)
    except wf.NumericalFailure:
        return np.nan
    return float(stand.data.inflow_mean) / v_h


def run(case):
    data = case.toml("branches.toml")
    rotor = wf.load_rotor(case.path("rotors/knight-hefner-4.toml"))
    climb, exact = data["momentum"]["climb_x"], data["momentum"]["climb_y"]
    checks = [Check.largest("v_i/v_h in climb", [induced(rotor, x) for x in climb], exact, 1e-9)]
    fit = data["leishman_quartic"]
    rates = np.array(fit["x"])
    ours = np.array([induced(rotor, x) for x in rates])
    for x, y, reference in zip(rates, ours, fit["y"]):
        if -2.0 < x < 0.0:
            checks.append(Check(f"v_i/v_h in descent at {x:g} v_h, the fit of tests", y, reference, 0.01))
    windmill = np.array(data["momentum"]["windmill_x"])
    below = np.array([induced(rotor, x) for x in windmill])
    state, fold = np.array(data["momentum"]["windmill_y"]), windmill > -2.001
    checks.append(Check.largest("v_i/v_h in the windmill brake state", below[~fold], state[~fold], 1e-9))
    glauert = data["glauert_1926_curve"]
    return Outcome(checks, draw(data, rates, ours, windmill, below, glauert))


@style.styled
def draw(data, rates, ours, windmill, below, glauert):
    figure = style.blank(3.2)
    axes = figure.subplots()
    momentum, fit = data["momentum"], data["leishman_quartic"]
    axes.plot(momentum["climb_x"], momentum["climb_y"], "ko", mfc="none", label="momentum theory, climb")
    axes.plot(momentum["windmill_x"], momentum["windmill_y"], "ks", mfc="none", label="momentum theory, windmill brake")
    axes.plot(fit["x"], fit["y"], "--", color=style.GREY, label="fit of tests in descent")
    axes.plot(glauert["x"], glauert["y"], ":", color=style.GREY, label="Glauert's curve of 1926")
    axes.plot([*windmill[::-1], *rates[::-1]], [*below[::-1], *ours[::-1]], "+-", lw=0.8, color=style.COLORS[0],
              label="three-state inflow")  # fmt: skip
    axes.set_xlabel("rate of climb over v_h")
    axes.set_ylabel("induced velocity over v_h")
    axes.legend()
    return figure
