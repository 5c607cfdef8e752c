"""Strength of the tip vortex over the largest bound circulation."""

import numpy as np
from settings import HOVER_WAKES, hover

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    data = case.toml("strength.toml")
    rotor = case.path("rotors/caradonna-tung.toml")
    checks, found = [], {}
    for name in HOVER_WAKES:
        found[name] = []
        for theta, measured in zip(data["theta_deg"], data["A_age_200deg"]):
            stand = hover(rotor, name, collective=f"{theta} deg", rpm=1250)
            strength = np.interp(np.radians(200), stand.data.age, stand.data.tip_vortex_circulation)
            ratio = float(strength / stand.data.circulation.mean("azimuth").max())
            found[name].append(ratio)
            default = name.startswith("default")
            checks.append(
                Check(f"ratio at {theta} deg", ratio, measured, 0.1, gate=default, note="" if default else name)
            )
    return Outcome(checks, draw(data, found))


@style.styled
def draw(data, found):
    figure = style.blank(2.8)
    axes = figure.subplots()
    for (name, ratio), color in zip(found.items(), style.COLORS):
        axes.plot(data["theta_deg"], ratio, "o-", mfc="none", color=color, label=name)
    axes.errorbar(data["theta_deg"], data["A_age_200deg"], 0.1, fmt="ko", label="measured, age 200°")
    axes.set_ylim(0, 1.2)
    axes.set_xlabel("collective [deg]")
    axes.set_ylabel("tip vortex over largest bound circulation")
    axes.legend(loc="lower right")
    return figure
