"""The flight envelope as a list of conditions, each trimmed and, with the time-marching wake, flown hands off.

One condition is one call of `one`, a plain dictionary in and out, so that several can be run at once.
"""

import time

import numpy as np

import wakeflight as wf
from wakeflight.studies import attempt

KNOT = 0.514444
HOLD_SECONDS = 2.0
WEIGHTS = {"uh60a": ("13000 lbf", "16000 lbf", "20000 lbf"), "bo105": ("1900 kg", "2200 kg", "2500 kg")}
"""Light, middle, heavy."""
SPEEDS = tuple(range(0, 170, 10))
"""Level flight [kt]."""
TURNING = (60, 80, 100)
"""Speed [kt] of turns of 30, 45 and 60 degrees of bank, to either side."""


def level(aircraft, speed, weight=1, inflow="dynamic", **more):
    """Straight and level at `speed` [kt]."""
    return {
        "aircraft": aircraft,
        "inflow": inflow,
        "kind": "level",
        "speed": f"{speed} kt",
        "flight_path": "0 deg",
        "altitude": "0 ft",
        "weight": WEIGHTS[aircraft][weight],
        **more,
    }


def others(aircraft, inflow, coarse=False):
    """Climbs, descents, vertical, rearward and sideward flight, turns, at the middle weight."""
    conditions = []

    def add(kind, speed, **more):
        conditions.append({**level(aircraft, 0, inflow=inflow), "kind": kind, "speed": speed, **more})

    for speed in (60, 80, 100)[:: 2 if coarse else 1]:
        for path in (-12, -6, 6, 10):
            add("climb" if path > 0 else "descent", f"{speed} kt", flight_path=f"{path} deg")
    for rate in (1, 5) if coarse else (1, 2, 5, 10):
        add("vertical climb", f"{rate} m/s", flight_path="90 deg")
    for rate in (1, 2):
        add("vertical descent", f"{rate} m/s", flight_path="-90 deg")
    for speed in (20,) if coarse else (5, 10, 20, 30, 40):
        add("rearward", f"{speed} kt", sideslip="180 deg")
        add("to the right", f"{speed} kt", sideslip="90 deg")
        add("to the left", f"{speed} kt", sideslip="-90 deg")
    for speed in TURNING[1:2] if coarse else TURNING:
        for bank in (-60, -30, 30, 60) if coarse else (-60, -45, -30, 30, 45, 60):
            rate = np.degrees(9.80665 * np.tan(np.radians(bank)) / (speed * KNOT))
            # bank and heading are found: with no sideslip a bank of its own would ask for too much
            add("turn", f"{speed} kt", turn_rate=f"{rate:.9g} deg/s")
    return conditions


def one(given):
    """Trim `given`; with `fly` also fly it hands off. Figures by name; `failure` is empty where all went well."""
    c = dict(given)
    aircraft = wf.load_aircraft(c.pop("aircraft"))
    inflow, fly, _ = c.pop("inflow"), c.pop("fly", False), c.pop("kind")
    made_with = wf.inflow_model("relaxation" if fly else inflow)
    trimmed = attempt(lambda: wf.trim(aircraft, wf.FlightCondition(**c), inflow=made_with), Exception)
    found = {**given, "failure": trimmed.failure, "named": trimmed.foreseen, "warnings": (), "seconds": trimmed.seconds}
    if trimmed.failure:
        return found
    start = trimmed.answer
    mean = start.mean_outputs()
    found |= {
        "warnings": start.warnings,
        "residual": max(start.residuals["linear"], start.residuals["angular"]),
        "power": mean["power"],
        "inflow_mean": mean["inflow_mean"],
        "roll": start.roll,
        "pitch": start.pitch,
        **start.stick,
    }
    if fly:
        result = flown(start, inflow)
        found |= result | {"seconds": trimmed.seconds + result["seconds"]}
    return found


def flown(start, inflow, maneuver=None):
    """Extremes of a flight with sticks held (or of `maneuver`)."""
    hold = maneuver or wf.Maneuver("hold", (("lateral", ((0.0, 0.0), (0.1, 0.0))),), seconds=HOLD_SECONDS)
    done = attempt(lambda: wf.fly(start, hold, inflow=inflow, integrator="fixed"))
    flight, told = done.answer, {"failure": done.failure, "named": done.foreseen, "seconds": done.seconds}
    if flight is None:
        return told
    data, weight = flight.data, start.condition.weight
    load_factor = -data.force_z.values / weight
    rates = np.degrees(np.array([data[name].values for name in "pqr"]))
    mean, tip = data.inflow_mean.values, start.model.tip_speed
    return {
        **told,
        "flight_warnings": flight.warnings,
        "end": float(data.time[-1]),
        "finite": bool(np.isfinite(data.inflow).all() and np.isfinite(data.force_z).all()),
        "unsolved": int(data.attrs.get("circulation_not_converged", 0)),
        "followed": int(data.attrs.get("circulation_followed", 0)),
        "inflow_most": float(abs(data.inflow).max()),
        "mach": float(data.mach.max()),
        "mach_of_motion": (tip + start.condition.speed) / start.model.speed_of_sound,
        "rate": float(abs(rates - rates[:, :1]).max()),
        "attitude": float(np.degrees(max(np.ptp(data["roll"].values), np.ptp(data["pitch"].values)))),
        "load_factor": (float(load_factor.min()), float(load_factor.max())),
        "inflow_change": float(abs(mean[-1] - mean[0])),
    }


STICKS = ("lateral", "longitudinal", "collective", "pedal")


def random_maneuver(seed, stick, travel, seconds=3.0, amplitude=1.0):
    """Random stick motion about trim within `amplitude` [in] and the travel, corners 0.25 to 0.75 s apart."""
    random = np.random.default_rng(seed)
    controls = []
    for name, full in zip(STICKS, travel):
        low, high = max(-amplitude, -stick[name]), min(amplitude, full - stick[name])
        times, corners = 0.1, [(0.0, 0.0), (0.1, 0.0)]
        while (times := times + random.uniform(0.25, 0.75)) < seconds:
            corners.append((round(times, 3), float(random.uniform(low, high))))
        controls.append((name, tuple(corners)))
    return wf.Maneuver(f"random-{seed}", tuple(controls), seconds=seconds)


def random_flight(given):
    """One random manoeuvre of `seed` at `speed` [kt] with the time-marching wake."""
    speed, seed = given
    begun = time.perf_counter()
    start = wf.trim(wf.load_aircraft("uh60a"), wf.FlightCondition(speed=f"{speed} kt", flight_path="0 deg"))
    found = flown(start, "time-marching", random_maneuver(seed, start.stick, start.aircraft.stick_travel_in))
    return {"speed": speed, "seed": seed, **found, "seconds": time.perf_counter() - begun}
