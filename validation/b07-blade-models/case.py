"""Trim and manoeuvres of the UH-60A with its blade resolved in four ways."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

BLADES = {
    "hinge motion alone": {"n_modes": 2},
    "5 modes, 4 elements": {},
    "10 modes, 4 elements": {"n_modes": 10},
    "5 modes, 12 elements": {"n_elements": 12},
}
DEFAULT = "5 modes, 4 elements"
HISTORIES = {"p": "roll rate", "q": "pitch rate", "r": "yaw rate", "roll": "roll", "pitch": "pitch"}


def run(case):
    trims, flights = {}, {}
    for name, resolution in BLADES.items():
        aircraft = wf.load_aircraft("uh60a").discretised(**resolution)
        start = wf.trim(aircraft, inflow="relaxation")
        trims[name] = trimmed(start)
        for maneuver in (wf.arrested_descent(), wf.roll_reversal()):
            flights[maneuver.name, name] = wf.fly(start, maneuver, inflow="time-marching").data
    checks = []
    for name in BLADES:
        if name == DEFAULT:
            continue
        for (what, unit), ours in trims[DEFAULT].items():
            reference, stick = trims[name][what, unit], unit == "in"
            gate = stick and name == "10 modes, 4 elements"
            checks.append(
                Check(f"trim, {what}: default beside {name}", ours, reference, 0.2 if gate else np.nan, unit, gate=gate)
            )
    for maneuver in ("arrested-descent", "roll-reversal"):
        default = flights[maneuver, DEFAULT]
        for name in BLADES:
            if name == DEFAULT:
                continue
            other = flights[maneuver, name]
            for key, what in HISTORIES.items():
                mine, theirs = np.degrees(default[key].values), np.degrees(other[key].values)
                unit = "deg/s" if key in "pqr" else "deg"
                at = int(np.argmax(np.abs(mine - theirs)))
                label = f"{maneuver}, {what} where it differs most: default beside {name}"
                checks.append(
                    Check(
                        label, mine[at], theirs[at], unit=unit, gate=False, note=f"at {default.time[at].item():.2f} s"
                    )
                )
    return Outcome(checks, draw(flights))


def trimmed(start):
    """What the trim says, by name and unit."""
    mean = start.mean_outputs()
    values = {(f"{name} stick", "in"): value for name, value in start.stick.items()}
    values |= {
        (name, "deg"): np.degrees(value)
        for name, value in {
            "pitch": start.pitch,
            "heading against track": start.yaw,
            "collective": start.theta_0,
            "coning": mean["beta_0"],
            "beta_1c": mean["beta_1c"],
            "beta_1s": mean["beta_1s"],
        }.items()
    }
    return values | {("power", "kW"): mean["power"] / 1e3}


@style.styled
def draw(flights):
    figure = style.blank(5.2)
    grid = figure.subplots(3, 2, sharex="col")
    for column, maneuver in enumerate(("arrested-descent", "roll-reversal")):
        for axes, (key, label) in zip(
            grid[:, column], (("p", "roll rate [deg/s]"), ("q", "pitch rate [deg/s]"), ("roll", "roll [deg]"))
        ):
            for name, color, line in zip(BLADES, style.COLORS, style.LINES):
                data = flights[maneuver, name]
                axes.plot(
                    data.time, np.degrees(data[key]), color=color, ls=line, lw=1.1, label=name if column == 0 else None
                )
            axes.set_ylabel(label)
        grid[0, column].set_title(maneuver.replace("-", " "), loc="left")
        grid[-1, column].set_xlabel("time [s]")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4)
    return figure
