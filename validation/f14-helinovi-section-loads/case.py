"""Section normal force at 0.87 R of the HeliNOVI model in climb and descent."""

import numpy as np
from wind import DEFAULT, IN_TIME, MARCHED, SHEET, wind

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

FLIGHTS = {"ID1": ("climb, 12°", "-14.6 deg", 0.00529), "ID5": ("descent, 6°", "4.6 deg", 0.00504)}
WAKES = {DEFAULT: DEFAULT, SHEET: SHEET, MARCHED: MARCHED, "uniform and first-harmonic dynamic inflow": None,
         **dict(zip(IN_TIME, IN_TIME))}  # fmt: skip


def run(case):
    table = case.table("loads.csv")
    checks, found = [], {}
    for flight, (text, angle, ct) in FLIGHTS.items():
        rows = table.where(case=flight)
        order = np.argsort(rows["psi_deg"])
        psi, measured = rows["psi_deg"][order], rows["CN"][order]
        # points are irregular: averages are over azimuth, by interpolation to every degree
        even = np.arange(0.0, 360.0)
        level = np.interp(even, psi, measured, period=360.0)
        for name, wake in WAKES.items():
            stand = wind(
                case.path("rotors/hart2.toml"),
                wake,
                speed="32.9 m/s",
                shaft_angle=angle,
                omega="109.12 rad/s",
                density="1.2055 kg/m^3",
                speed_of_sound="341.7 m/s",
                ct=ct,
                flapping="zero",
            )
            data = stand.data
            ours = np.array([np.interp(0.87, data.station.values, line) for line in data.cn.values])
            mine = np.interp(even, np.degrees(data.azimuth.values), ours, period=360.0)
            found[flight, name] = (np.degrees(data.azimuth.values), ours)
            note, gate = ("", True) if name == DEFAULT else (name, False)
            shape = np.sqrt(np.mean((mine - mine.mean() - level + level.mean()) ** 2))
            checks += [
                Check(f"{text}: mean C_N", mine.mean(), level.mean(), 0.08, gate=gate, note=note),
                Check(f"{text}: rms of C_N, means removed", shape, 0.0, 0.10, gate=gate, note=note),
                Check(f"{text}: C_N varies by, rms", np.std(mine), np.std(level), gate=False, note=note),
            ]
    return Outcome(checks, draw(table, found))


@style.styled
def draw(table, found):
    figure = style.blank(3.4)
    panels = figure.subplots(1, 2, sharey=True)
    for axes, (flight, (text, _, _)) in zip(panels, FLIGHTS.items()):
        rows = table.where(case=flight)
        axes.plot(rows["psi_deg"], rows["CN"], "k.", ms=3, label="measured")
        for name, color, line in zip(WAKES, style.COLORS, style.LINES):
            axes.plot(*found[flight, name], line, color=color, label=name)
        axes.set_title(f"{flight}: {text}")
        axes.set_xlabel("azimuth [deg], 0 aft")
        axes.set_xticks(range(0, 361, 90))
    panels[0].set_ylabel("C_N at 0.87 R")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
