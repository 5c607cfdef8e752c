"""Core radii along the filaments of a wake against the growth law."""

import json

import numpy as np

from wakeflight import _core
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

ALPHA, STEPS, TURNS = 1.25643, 36, 5


def cores(rotor):
    """Core radius [m] at the nodes 1 .. n-1 of a filament, from its segments."""
    radius, omega = rotor["R"], rotor["Omega"]
    growth = 4 * ALPHA * rotor["delta"] * rotor["nu"] / (omega * radius**2)
    known = {
        "n_blades": 2,
        "radius": radius,
        "root_cutout": 0.2 * radius,
        "hinge_offset": 0.0,
        "chord": 0.1 * radius,
        "omega": omega,
    }
    wake = {
        "turns": float(TURNS),
        "azimuth_step": 2 * np.pi / STEPS,
        "core_radius": rotor["r0"] / radius,
        "core_growth": growth,
    }
    options = {"rotor": known, "wake": wake, "relaxation": {}}
    wake = _core.RelaxationWake(json.dumps(options), ([-0.1 * omega * radius, 0, 0], [0, 0, 0]), 0.03)
    squared = wake.core_radius()[0, -1] ** 2
    return np.sqrt(0.5 * (squared[1:] + squared[:-1]))


def run(case):
    data = case.toml("growth.toml")
    checks, curves = [], []
    for name, text in (("case_uh60", "UH-60 rotor"), ("case_model", "model rotor")):
        rotor = data[name]
        along = cores(rotor)
        for age, exact in zip(rotor["zeta_deg"], rotor["rc"]):
            if age == 0:
                # the release itself lies half a step before the first segment's middle
                first = 4 * ALPHA * rotor["delta"] * rotor["nu"] / rotor["Omega"] * np.radians(10)
                ours = np.sqrt(along[0] ** 2 - first)
            else:
                ours = along[round(age / 10) - 1]
            checks.append(Check(f"core radius at {age} deg, {text}", ours, exact, 1e-7, "m"))
        curves.append((text, rotor, along))
    return Outcome(checks, draw(curves))


@style.styled
def draw(curves):
    figure = style.blank(2.6)
    axes = figure.subplots()
    for (text, rotor, along), color in zip(curves, style.COLORS):
        age = 10.0 * (1 + np.arange(along.size))
        axes.plot(age, 1000 * along, color=color, label=text)
        axes.plot(rotor["zeta_deg"], 1000 * np.array(rotor["rc"]), "o", color=color, ms=4)
    axes.set_xlabel("age [deg]")
    axes.set_ylabel("core radius [mm]")
    axes.legend(title="points: exact")
    return figure
