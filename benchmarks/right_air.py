# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a wake answers: inflow by hub moments, motion and inflow after stick steps, section loads, power; and what it costs.

    python benchmarks/right_air.py OUT.json [NAME ...]
    python benchmarks/right_air.py OUT.json --judge NAME

NAME: wakes of `WAKES` (all but `reference`, which takes most of an hour). A clamped rotor of four blades at 0, 20, 80 kt carries
72 kN and a hub moment of either sign (|C_M| = 0.00097): differences of the harmonics of the inflow over those of the moment. In
flight, marched from each wake's own trim of the baseline: the right step of the roll reversal, a longitudinal and a collective
step. Level flight: trims, and flights of two seconds with the sticks held. `--judge` prints how far every wake is from one.
"""

import json
import sys
import time
from pathlib import Path

import numpy as np

import wakeflight as wf
from wakeflight.results import disk

ROTOR = Path(__file__).parent / "clamped-rotor.toml"
MOMENT = 1e5  # N m
INSTANTS = (1.2, 2.0)  # s, within the steps
FLOWN = 9.0  # revolutions, somewhat beyond the last instant
LEVEL = (0, 10, 20, 30, 40, 80, 120, 140)  # kt
STAND = (0, 20, 80)  # kt
SLOW = ("reference",)
"""Wakes asked at few speeds only; hover is none of them, where relaxation does not settle such a wake."""
SLOW_LEVEL, SLOW_STAND = (40, 80, 120), (80,)  # kt
REFERENCE = {
    "trailers": "full-span",
    "n_trailers": 9,
    "trailer_core": 0.02,
    "azimuth_step": "15 deg",
    "turns": 3,
    "far_wake_turns": 0,
}
HELD = wf.Maneuver("held", {"lateral": [(0.0, 0.0), (0.1, 0.0)]}, seconds=2.0)
STEPS = {
    "roll": wf.roll_reversal(),
    "pitch": wf.Maneuver("pitch", {"longitudinal": [(0.0, 0.0), (0.2, 0.0), (0.4, 1.0), (2.2, 1.0)]}, seconds=2.2),
    "collective": wf.Maneuver(
        "collective", {"collective": [(0.0, 0.0), (0.2, 0.0), (0.4, 1.0), (2.2, 1.0)]}, seconds=2.2
    ),
}
"""What is flown: the step to the right of the roll reversal, an inch aft, an inch up."""
RATE = {"roll": "p", "pitch": "q", "collective": "w"}
WAKES = {
    "standard": {},
    "paper": {"preset": "paper"},
    "nine trailers": REFERENCE,
    "nine trailers, no shed vorticity": {**REFERENCE, "shed_wake": "none"},
    "reference": {"preset": "reference"},
}


def wake(kind, name, **given):
    """The wake of that name as relaxation or marching model."""
    options = dict(WAKES[name]) | given
    return kind.preset(options.pop("preset", "standard"), **options)


def harmonics(data):
    """Mean, cosine and sine of the inflow over the disk, as momentum theory has them."""
    inflow, station = np.asarray(data["inflow"]), np.asarray(data["station"])
    inflow = inflow.mean(0) if inflow.ndim == 3 else inflow
    weights = disk.area_weights(station, disk.element_widths(station))
    psi = 2.0 * np.pi * np.arange(len(inflow)) / len(inflow)
    return np.array(disk.first_harmonics(inflow, psi, station, weights))


def by_moments(name, speed):
    """Derivatives of lambda_0 by C_M and of lambda_1s by C_L at a speed [kt]; the reason where the stand does not settle."""
    rotor = wf.load_rotor(ROTOR)
    radius, omega, density = rotor.rotor.radius, rotor.rotor.omega, 1.225
    scale = density * np.pi * radius**2 * (omega * radius) ** 2 * radius
    found = {}
    for axis, i in (("hub_pitch", 0), ("hub_roll", 2)):
        ends = []
        for sign in (-1.0, 1.0):
            moments = {"hub_pitch": "0 N*m", "hub_roll": "0 N*m", axis: f"{sign * MOMENT} N*m"}
            stand = {"thrust": "72 kN", "speed": f"{speed} kt", "shaft_angle": "0 deg", **moments}
            try:
                ends.append(harmonics(wf.tunnel(ROTOR, inflow=wake(wf.RelaxationWake, name), **stand).data))
            except wf.WakeflightError as reason:
                return str(reason)
        found[axis] = float((ends[1] - ends[0])[i] * scale / (2.0 * MOMENT))
    return found


def in_flight(name, aircraft):
    """Power and section loads of the trim; mean inflow, -Z/W (the blades' weight and inertia in it) and rate after each step."""
    start = wf.trim(aircraft, inflow=wake(wf.RelaxationWake, name))
    trimmed = start.to_dataset()
    found = {
        "power": float(trimmed["power_main"]) / 745.7,
        "lambda_1s": float(harmonics(trimmed)[2]),
        "cl_m2": np.asarray(trimmed["cl_m2"]).tolist(),
    }
    for step, maneuver in STEPS.items():
        began = time.perf_counter()
        marched = wake(wf.TimeMarchingWake, name)
        data = wf.fly(start, maneuver, inflow=marched, integrator="fixed", revolutions=FLOWN).data
        took = time.perf_counter() - began
        at = lambda values, data=data: [float(v) for v in np.interp(INSTANTS, data["time"], values)]  # noqa: E731
        rate, first = np.asarray(data[RATE[step]]), float(data[RATE[step]][0])
        found[step] = {
            "lambda_0": at(data["inflow_mean"]),
            "thrust_over_weight": at(-data["force_z"] / start.condition.weight),
            "rate": at((rate - first) if step == "collective" else np.degrees(rate - first)),
            "seconds": took,
            "real_time": float(data["time"][-1]) / (data.attrs["seconds_wake"] + data.attrs["seconds_dynamics"]),
        }
    return found


def in_level_flight(name, aircraft):
    """Power [hp], mean inflow and what is left of the inflow's loop, by speed [kt]; the reason where there is no trim."""
    found = {}
    for speed in SLOW_LEVEL if name in SLOW else LEVEL:
        condition = wf.FlightCondition(speed=f"{speed} kt", flight_path="0 deg")
        try:
            start = wf.trim(aircraft, condition, inflow=wake(wf.RelaxationWake, name))
            held = wf.fly(start, HELD, inflow=wake(wf.TimeMarchingWake, name), integrator="fixed").data
        except wf.WakeflightError as reason:
            found[speed] = str(reason)
            continue
        trimmed, thrust = start.to_dataset(), -held["force_z"] / start.condition.weight
        steps = round(2.0 * np.pi / (aircraft.rotor.omega * float(held["time"][1] - held["time"][0])))
        turns = len(held["time"]) // steps
        means = np.asarray(held["inflow_mean"])[: turns * steps].reshape(turns, steps).mean(1)
        found[speed] = {
            "held_thrust_over_weight": [float(thrust.min()), float(thrust.max())],
            "held_lambda_0": [float(means.min()), float(means.max())],
            "power": float(trimmed["power_main"]) / 745.7,
            "lambda_0": float(trimmed["inflow_mean"]),
            "left": float(trimmed["residual_inflow"]),
        }
    return found


def resampled(values, n=72):
    """A map (n_azimuths, n_stations) at n azimuths, by its harmonics."""
    values = np.asarray(values)
    return np.fft.irfft(np.fft.rfft(values, axis=0), n, axis=0) * (n / values.shape[0])


def distances(found, judge):
    """How far a wake is from the judge: relative, of -Z/W the difference, of section loads the RMS over that of the judge."""
    rows = {}
    for speed in found["stand"]:
        mine, true = found["stand"][speed], judge["stand"].get(speed)
        if isinstance(mine, dict) and isinstance(true, dict):
            for axis, label in (("hub_pitch", "dlambda_0/dC_M"), ("hub_roll", "dlambda_1s/dC_L")):
                if abs(true[axis]) > 0.5:
                    rows[f"{label}, {speed} kt"] = mine[axis] / true[axis] - 1.0
    loads, true = resampled(found["flight"]["cl_m2"]), resampled(judge["flight"]["cl_m2"])
    rows["section loads, RMS"] = float(np.sqrt(np.mean((loads - true) ** 2) / np.mean(true**2)))
    rows["section loads, RMS over that about their mean"] = float(
        np.sqrt(np.mean((loads - true) ** 2) / np.mean((true - true.mean(0)) ** 2))
    )
    rows["power"] = found["flight"]["power"] / judge["flight"]["power"] - 1.0
    for step in STEPS:
        mine, true = found["flight"][step], judge["flight"][step]
        for i, instant in enumerate(INSTANTS):
            for quantity in ("lambda_0", "rate"):
                rows[f"{step}: {quantity} at {instant} s"] = mine[quantity][i] / true[quantity][i] - 1.0
            rows[f"{step}: -Z/W at {instant} s"] = mine["thrust_over_weight"][i] - true["thrust_over_weight"][i]
    # a run that was ended before its last part has none
    for speed, mine in found.get("level", {}).items():
        true = judge.get("level", {}).get(speed)
        if isinstance(mine, dict) and isinstance(true, dict):
            for quantity in ("power", "lambda_0"):
                rows[f"level, {speed} kt: {quantity}"] = mine[quantity] / true[quantity] - 1.0
    return rows


def judged(path, judge):
    """Prints the distances of every wake in the file from one of them."""
    kept = json.loads(path.read_text())
    others = {name: distances(each, kept[judge]) for name, each in kept.items() if name != judge}
    print(f"| from `{judge}` | " + " | ".join(others) + " |")
    print("| --- |" + " --- |" * len(others))
    for row in next(iter(others.values())):
        print(f"| {row} | " + " | ".join(f"{each[row]:+.3f}" if row in each else "" for each in others.values()) + " |")


def main(out, *names):
    """All of it for the wakes named, into a file that keeps what it has of others."""
    path, aircraft = Path(out), wf.load_aircraft("uh60a")
    if names[:1] == ("--judge",):
        return judged(path, names[1])
    kept = json.loads(path.read_text()) if path.exists() else {}
    for name in names or [each for each in WAKES if each not in SLOW]:
        at = SLOW_STAND if name in SLOW else STAND
        found = kept[name] = {"stand": {speed: by_moments(name, speed) for speed in at}}
        path.write_text(json.dumps(kept) + "\n")
        found["flight"] = in_flight(name, aircraft)
        path.write_text(json.dumps(kept) + "\n")
        found["level"] = in_level_flight(name, aircraft)
        path.write_text(json.dumps(kept) + "\n")
        shown = {**kept[name], "flight": {k: v for k, v in kept[name]["flight"].items() if k != "cl_m2"}}
        print(name, json.dumps(shown), flush=True)
    return None


if __name__ == "__main__":
    main(*sys.argv[1:])
