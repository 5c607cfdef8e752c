"""Inflow gradient of a hovering rotor in a steady pitch rate, over the rate: K_R."""

import numpy as np
from settings import HOVER_WAKES, hover

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

RATES = (-0.006, 0.006)
"""Pitch rate over rotor speed."""


def gradient(rotor, wake, rate):
    """Fore-aft inflow gradient of a clamped rotor that takes no hub moment."""
    speed = np.degrees(rate * rotor.omega)
    return hover(
        rotor, wake, ct=0.005, pitch_rate=f"{speed} deg/s", hub_roll="0 N m", hub_pitch="0 N m"
    ).inflow_harmonics()[1:]


def run(case):
    rotor = wf.load_rotor(case.path("rotors/knight-hefner-4.toml"))
    checks, found = [], {}
    for k, wake in enumerate(HOVER_WAKES):
        pairs = np.array([gradient(rotor, wake, rate) for rate in RATES])
        curvature, cross = (pairs[1] - pairs[0]) / (RATES[1] - RATES[0])
        found[wake] = pairs
        note = "" if k == 0 else wake
        checks.append(Check("K_R of a nose-up rate", curvature, 1.1, 0.6, gate=k == 0, note=note))
        checks.append(Check("lateral gradient over the rate", cross, 0.0, gate=False, note=note))
    return Outcome(checks, draw(found))


@style.styled
def draw(found):
    figure = style.blank(2.8)
    axes = figure.subplots()
    rates = np.array(RATES)
    axes.fill_between(rates, 0.5 * rates, 1.7 * rates, color=style.GREY, alpha=0.2, lw=0, label="K_R from 0.5 to 1.7")
    for (name, pairs), color in zip(found.items(), style.COLORS):
        axes.plot(rates, pairs[:, 0], "o-", color=color, label=name)
    axes.set_xlabel("pitch rate over rotor speed")
    axes.set_ylabel("fore-aft inflow gradient [ΩR]")
    axes.legend()
    return figure
