"""Definitions of the metrics against closed forms; the bare airframes of the shipped aircraft beside the limits."""

import numpy as np

import wakeflight as wf
from wakeflight.handling import attitude_metrics, limits, quickness
from wakeflight.plotting import handling as drawing
from wakeflight.validate import Check, Outcome

WIDTHS = (0.2, 0.5, 1.0)
LAG = 3.0


def run(case):
    data = case.toml("ads33_metrics.toml")
    exact = data["exact_check"]
    a, tau = exact["a_rad_s"], exact["tau_s"]
    found = attitude_metrics(lambda w: a / (1j * w * (1j * w + a)) * np.exp(-1j * w * tau)).values
    pairs = {
        "w_180": "w180_rad_s",
        "bandwidth_phase": "bandwidth_phase_rad_s",
        "bandwidth_gain": "bandwidth_gain_rad_s",
        "phase_delay": "phase_delay_s",
    }
    checks = [Check(name, found[name], exact[key], 1e-8) for name, key in pairs.items()]
    t = np.linspace(0.0, 20.0, 20001)
    for width in WIDTHS:
        on = np.minimum(t, width)
        p = (np.exp(-LAG * (t - on)) - np.exp(-LAG * t)) / LAG
        roll = (on - p) / LAG
        checks.append(
            Check(
                f"quickness, pulse of {width:g} s", quickness(t, p, roll)[0], (1 - np.exp(-LAG * width)) / width, 1e-8
            )
        )
    ours, notes, bounds = {}, [], data["limits_level_1"]
    for name in ("uh60a", "bo105"):
        condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 m")
        start = wf.trim(wf.load_aircraft(name), condition, inflow="dynamic")
        metrics = wf.handling_qualities(wf.linearize(start))
        ours[start.aircraft.name] = metrics.data
        for coupling in ("pitch_due_to_roll", "roll_due_to_pitch"):
            note = "limit of level 1, bare airframe"
            checks.append(
                Check(
                    f"{coupling}, {name}", abs(metrics[coupling]), bounds["interaxis_coupling"], gate=False, note=note
                )
            )
        notes += [f"{name}: {key}: {text}." for key, text in metrics.reasons.items() if key.endswith(".bandwidth")]
    return Outcome(checks, drawing.bandwidth(ours, limits()), notes)
