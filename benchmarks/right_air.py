# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a wake answers: inflow by hub moments on the stand, inflow and load factor in a roll, power; and what it costs.

    python benchmarks/right_air.py OUT.json [NAME ...]

NAME: wakes of `WAKES` (all). A clamped rotor of four blades at 0, 20, 80 kt carries 72 kN and a hub moment of either sign
(|C_M| = 0.00097): differences of the harmonics of the inflow over those of the moment. The roll is the right step of the
roll reversal, marched from its own trim. Level flight: trims, and flights of two seconds with the sticks held.
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
INSTANTS = (1.2, 2.0)  # s, within the roll to the right
LEVEL = (0, 10, 20, 30, 40, 80, 120, 140)  # kt
STAND = (0, 20, 80)  # kt
REFERENCE = {
    "trailers": "full-span",
    "n_trailers": 9,
    "trailer_core": 0.02,
    "azimuth_step": "15 deg",
    "turns": 3,
    "far_wake_turns": 0,
}
HELD = wf.Maneuver("held", {"lateral": [(0.0, 0.0), (0.1, 0.0)]}, seconds=2.0)
WAKES = {
    "standard": {},
    "paper": {"preset": "paper"},
    "reference": REFERENCE,
    "reference, no shed vorticity": {**REFERENCE, "shed_wake": "none"},
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


def in_roll(name, aircraft):
    """Mean inflow and -Z/W in the roll (the blades' weight and inertia are in Z), power of the trim, seconds of the flight."""
    start = wf.trim(aircraft, inflow=wake(wf.RelaxationWake, name))
    maneuver = wf.roll_reversal()
    began = time.perf_counter()
    data = wf.fly(start, maneuver, inflow=wake(wf.TimeMarchingWake, name), integrator="fixed").data
    took = time.perf_counter() - began
    weight = start.condition.weight
    at = lambda values: [float(v) for v in np.interp(INSTANTS, data["time"], values)]  # noqa: E731
    trimmed = start.to_dataset()
    return {
        "lambda_0": at(data["inflow_mean"]),
        "thrust_over_weight": at(-data["force_z"] / weight),
        "roll_rate": at(np.degrees(data["p"])),
        "power": float(trimmed["power_main"]) / 745.7,
        "lambda_1s": float(harmonics(trimmed)[2]),
        "seconds": took,
        "real_time": float(data["time"][-1]) / (data.attrs["seconds_wake"] + data.attrs["seconds_dynamics"]),
    }


def in_level_flight(name, aircraft):
    """Power [hp], mean inflow and what is left of the inflow's loop, by speed [kt]; the reason where there is no trim."""
    found = {}
    for speed in LEVEL:
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


def main(out, *names):
    """All of it for the wakes named, into a file that keeps what it has of others."""
    path, aircraft = Path(out), wf.load_aircraft("uh60a")
    kept = json.loads(path.read_text()) if path.exists() else {}
    for name in names or WAKES:
        kept[name] = {
            "stand": {speed: by_moments(name, speed) for speed in STAND},
            "roll": in_roll(name, aircraft),
            "level": in_level_flight(name, aircraft),
        }
        path.write_text(json.dumps(kept, indent=1) + "\n")
        print(name, json.dumps(kept[name]), flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
