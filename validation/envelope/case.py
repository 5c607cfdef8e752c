"""Trims and hands-off flights over the envelope, and random stick motions."""

import re

import numpy as np
from envelope_runs import SPEEDS, WEIGHTS, level, one, others, random_flight

from wakeflight.plotting import style
from wakeflight.studies import several
from wakeflight.validate import Check, Outcome

LARGEST_INFLOW = 0.3
"""Induced velocity over the tip speed that no flight of these comes near."""
RATE, ATTITUDE, LOAD = 8.0, 8.0, 0.3
"""Hands off for two seconds: largest body rate [deg/s], change of attitude [deg] and of load factor."""
RANDOM_SPEEDS = (60, 100, 140)
N_RANDOM = 40


def run(case):
    given = conditions()
    found = several(one, given)
    random = several(random_flight, [(RANDOM_SPEEDS[i % 3], i) for i in range(N_RANDOM)])
    flights = [f for f in found if f.get("fly")]
    trims = [f for f in found if not f.get("fly")]
    checks = [
        *counted("trim", trims),
        *counted("flight", flights),
        *bounded("hands off", [f for f in flights if "end" in f]),
        *held([f for f in flights if "end" in f]),
        *bounded("random sticks", [f for f in random if "end" in f]),
        *costs(found, random),
    ]
    return Outcome(checks, draw(found), notes(found))


def conditions():
    """All of them, with the marching wake also flown hands off."""
    every = []
    for aircraft in WEIGHTS:
        for weight in range(3):
            every += [level(aircraft, v, weight, "dynamic") for v in SPEEDS]
            every += [level(aircraft, v, weight, "relaxation") for v in SPEEDS[:: 1 if weight == 1 else 2]]
            every += [level(aircraft, v, weight, "time-marching", fly=True) for v in SPEEDS[:: 1 if weight == 1 else 4]]
        every += [level(aircraft, v, 1, "time-marching") for v in SPEEDS[::2]]
        every += others(aircraft, "dynamic")
        every += others(aircraft, "relaxation", coarse=True)
    return every


def count(quantity, cases, gate=True, note=""):
    """How many cases; none is allowed."""
    return Check(quantity, len(cases), 0.0, 0.0, gate=gate, note=note)


def told(cases, most=3):
    """What the first few failures say."""
    texts = [f"{name_of(f)}: {f['failure']}" for f in cases if f["failure"]]
    return "; ".join(texts[:most]) + (f"; and {len(texts) - most} more" if len(texts) > most else "")


def name_of(f):
    """Condition of a result in a few words."""
    if "seed" in f:
        return f"{f['speed']} kt, seed {f['seed']}"
    words = [f["aircraft"], f["inflow"], f["kind"], f["speed"], f["weight"]]
    words += [f"{name} {f[name]}" for name in ("flight_path", "turn_rate") if f.get(name, "0 deg") != "0 deg"]
    return " ".join(words)


NO_LIMIT = re.compile("(no|without a) stick, stall or inflow limit")


def counted(kind, cases):
    """Failures by what they name; those that name no limit count, and flights that stop. What rests only in the mean is shown."""
    failed = [f for f in cases if f["failure"]]
    without = [f for f in failed if not f["named"] or NO_LIMIT.search(f["failure"])]
    unrest = [f for f in failed if f not in without and "did not settle" in f["failure"]]
    named = [f for f in failed if f not in without and f not in unrest]
    mean = [f for f in cases if any("circles about" in text or "varies from turn" in text for text in f["warnings"])]
    return [
        count(f"{kind}: failures without a named limit, of {len(cases)}", without, note=told(without)),
        count(f"{kind}: stopped by a limit that is named", named, gate=kind == "flight", note=told(named)),
        count(f"{kind}: wake that does not settle, with what moves", unrest, gate=kind == "flight", note=told(unrest)),
        count(f"{kind}: on a wake that rests in the mean alone", mean, gate=False),
        count(f"{kind}: with any warning", [f for f in cases if f["warnings"]], gate=False),
    ]


def bounded(kind, flights):
    """Every sample of every flight within physical bounds."""
    beyond = [f for f in flights if f["inflow_most"] >= LARGEST_INFLOW]
    fast = [f for f in flights if f["mach"] >= 1.1 * f["mach_of_motion"]]
    worst = max(flights, key=lambda f: f["inflow_most"])
    return [
        count(
            f"{kind}: flights with a number that is not finite, of {len(flights)}",
            [f for f in flights if not f["finite"]],
        ),
        count(f"{kind}: flights with an unsolved circulation", [f for f in flights if f["unsolved"]]),
        count(f"{kind}: flights that end early", [f for f in flights if f["failure"]], gate=kind == "hands off"),
        count(
            f"{kind}: flights with inflow of {LARGEST_INFLOW} or more",
            beyond,
            note=f"largest {worst['inflow_most']:.3f}, {name_of(worst)}",
        ),
        count(f"{kind}: flights beyond 1.1 times the Mach number of motion", fast),
    ]


def held(flights):
    """Rates, attitude and load factor in two seconds hands off."""
    rate, attitude = (max(flights, key=lambda f, key=key: f[key]) for key in ("rate", "attitude"))
    load = max(flights, key=lambda f: f["load_factor"][1] - f["load_factor"][0])
    return [
        Check("hands off: largest change of a body rate", rate["rate"], 0.0, RATE, "deg/s", note=name_of(rate)),
        Check(
            "hands off: largest change of attitude", attitude["attitude"], 0.0, ATTITUDE, "deg", note=name_of(attitude)
        ),
        Check("hands off: widest range of load factor", np.ptp(load["load_factor"]), 0.0, 2 * LOAD, note=name_of(load)),
    ]


def costs(found, random):
    """Seconds that trims and flights took, median and most."""
    rows = []
    for kind in ("dynamic", "relaxation", "time-marching", "hands off", "random sticks"):
        if kind == "random sticks":
            those = random
        elif kind == "hands off":
            those = [f for f in found if f.get("fly")]
        else:
            those = [f for f in found if f["inflow"] == kind and not f.get("fly")]
        seconds = [f["seconds"] for f in those]
        slowest = max(those, key=lambda f: f["seconds"])
        rows += [
            Check(f"{kind}: median time", np.median(seconds), np.nan, unit="s", gate=False),
            Check(f"{kind}: longest time", max(seconds), np.nan, unit="s", gate=False, note=name_of(slowest)),
        ]
    return rows


def notes(found):
    """Every trim that failed, in its own words."""
    return [f"{name_of(f)}: {f['failure']}" for f in found if f["failure"]]


COLORS = {name: color for name, (color, _) in style.MODELS.items()}
ROWS = (
    ("power", 1e-3, "power [kW]"),
    ("collective", 1.0, "collective [in]"),
    ("longitudinal", 1.0, "longitudinal [in]"),
    ("lateral", 1.0, "lateral [in]"),
    ("pedal", 1.0, "pedal [in]"),
    ("pitch", 180 / np.pi, "pitch [deg]"),
    ("roll", 180 / np.pi, "roll [deg]"),
)


@style.styled
def draw(found):
    """Power, sticks and attitude in level flight against speed: models by colour, weights by line."""
    figure = style.blank(9.5)
    grid = figure.subplots(len(ROWS), 2, sharex=True)
    for column, aircraft in enumerate(WEIGHTS):
        for inflow, color in COLORS.items():
            for weight, line in zip(WEIGHTS[aircraft], (":", "-", "--")):
                those = [
                    f
                    for f in found
                    if (f["aircraft"], f["inflow"], f["weight"], f["kind"]) == (aircraft, inflow, weight, "level")
                    and "power" in f
                    and not f.get("fly")
                ]
                speed = [float(f["speed"].split()[0]) for f in those]
                for axes, (name, factor, label) in zip(grid[:, column], ROWS):
                    values = [factor * f[name] for f in those]
                    axes.plot(speed, values, line, color=color, lw=1.0, marker=".", ms=2.5)
                    axes.set_ylabel(label)
        grid[0, column].set_title(f"{aircraft}: {', '.join(WEIGHTS[aircraft])}", loc="left")
        grid[-1, column].set_xlabel("speed [kt]")
    handles = [grid[0, 0].plot([], [], color=color)[0] for color in COLORS.values()]
    handles += [grid[0, 0].plot([], [], line, color="0.3")[0] for line in (":", "-", "--")]
    labels = [*COLORS, "light", "middle", "heavy"]
    figure.legend(handles, labels, loc="outside lower center", ncols=6)
    return figure
