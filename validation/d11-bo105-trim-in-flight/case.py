"""BO-105 trimmed at the speeds of the flight test."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

MODELS = ("dynamic", "relaxation", "time-marching")
SPEEDS = np.array([0.0, 10.0, 20.0, 30.0, 40.0, 60.0, 80.0, 105.0])
QUANTITIES = {
    "theta_deg": ("pitch attitude", "deg", 1.5),
    "theta0_deg": ("collective", "deg", 1.2),
    "theta1s_deg": ("longitudinal cyclic", "deg", 1.0),
    "power_kW": ("power", "kW", None),
}


def trims(aircraft, model):
    """The four quantities at `SPEEDS` (4, n), nan where there is no trim, and why there is none, by speed."""
    rows, reasons = [], {}
    for speed in SPEEDS:
        condition = wf.FlightCondition(speed=f"{speed} kt", flight_path="0 deg", altitude="0 m")
        try:
            start = wf.trim(aircraft, condition, inflow=model)
        except wf.NumericalFailure as reason:
            reasons[speed] = str(reason)
            rows.append([np.nan] * 4)
            continue
        power = start.mean_outputs()["power"] / 1e3
        rows.append([*np.degrees([start.pitch, start.theta_0, start.theta_1s]), power])
    return np.array(rows).T, reasons


def run(case):
    table = case.table("bo105_trim_flight.csv")
    aircraft = wf.load_aircraft("bo105")
    ours, checks, notes = {}, [], []
    for model in MODELS:
        ours[model], reasons = trims(aircraft, model)
        checks.append(Check(f"speeds with a trim, {model}", len(SPEEDS) - len(reasons), len(SPEEDS), 0.0))
        notes.extend(f"{model}, {speed:g} kt: {reason}" for speed, reason in reasons.items())
    for i, (key, (name, unit, tolerance)) in enumerate(QUANTITIES.items()):
        flown = table.where(quantity=key)
        for model in MODELS:
            speed, value = flown["V_kt"], flown["value"]
            mine = np.interp(speed, SPEEDS, ours[model][i])
            # beside a speed without a trim there is nothing to compare
            there = np.isfinite(mine)
            speed, value, mine = speed[there], value[there], mine[there]
            error = mine - value
            if tolerance is None:
                hover = speed < 20.0
                for part, label, allowed in ((hover, "below 20 kt", 0.10), (~hover, "from 20 kt", 0.12)):
                    if not part.any():
                        notes.append(f"{name} {label}, {model}: no trim beside what was flown.")
                        continue
                    checks.append(
                        Check.largest(f"{name} {label}, {model}", mine[part], value[part], allowed, unit, "relative")
                    )
                    bias = np.mean(error[part] / value[part])
                    rms = np.sqrt(np.mean((error[part] / value[part]) ** 2))
                    notes.append(
                        f"{name} {label}, {model}: mean difference {100 * bias:+.1f} %, rms {100 * rms:.1f} %."
                    )
            else:
                checks.append(Check.largest(f"{name}, {model}", mine, value, tolerance, unit))
                shape = np.sqrt(np.mean((error - error.mean()) ** 2))
                notes.append(
                    f"{name}, {model}: mean difference {error.mean():+.2f} {unit}, about that mean rms {shape:.2f} {unit}."
                )
    return Outcome(checks, draw(table, ours), notes)


@style.styled
def draw(table, ours):
    figure = style.blank(4.6)
    grid = figure.subplots(2, 2, sharex=True)
    for i, (axes, (key, (name, unit, _))) in enumerate(zip(grid.flat, QUANTITIES.items(), strict=True)):
        flown = table.where(quantity=key)
        for (model, values), color, line in zip(ours.items(), style.COLORS, style.LINES):
            axes.plot(SPEEDS, values[i], color=color, ls=line, label=model if i == 0 else None)
        axes.plot(flown["V_kt"], flown["value"], "o", mfc="none", color="black", label="flight" if i == 0 else None)
        axes.set_ylabel(f"{name} [{unit}]")
    grid[1, 1].set_ylim(bottom=0.0)
    for axes in grid[1]:
        axes.set_xlabel("true airspeed [kt]")
    figure.legend(loc="outside lower center", ncols=4)
    return figure
