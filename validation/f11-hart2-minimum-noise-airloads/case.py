"""Section loads and elastic tip motion of HART II with 3-per-rev pitch."""

import numpy as np
from hart2 import MINIMUM_NOISE, rotor_in
from wind import DEFAULT, IN_TIME, MARCHED, SHEET

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

RUNS = {
    DEFAULT: (DEFAULT, {}),
    SHEET: (SHEET, {}),
    MARCHED: (MARCHED, {}),
    **{name: (name, {}) for name in IN_TIME},
    "default, without the higher harmonic": (DEFAULT, {"higher_harmonics": []}),
    "default, higher harmonic of opposite sign": (
        DEFAULT,
        {"higher_harmonics": [{"order": 3, "amplitude": "0.8 deg", "phase": "120 deg"}]},
    ),
}


def at_station(stand, name, station=0.87):
    """A quantity of the sections at a radius over R, by azimuth."""
    data = stand.data
    return np.array([np.interp(station, data.station.values, row) for row in data[name].values])


def ten_degrees(psi, value):
    """Means over ten degrees about each multiple of ten."""
    bins = np.round(psi / 10).astype(int) % 36
    return np.array([np.mean(value[bins == k]) for k in range(36)])


def harmonic(psi, value, order=1):
    """Complex amplitude of a harmonic by least squares, psi in degrees."""
    angle = np.radians(psi)
    columns = [np.ones_like(angle)]
    for k in range(1, 6):
        columns += [np.cos(k * angle), np.sin(k * angle)]
    fit = np.linalg.lstsq(np.column_stack(columns), value, rcond=None)[0]
    return complex(fit[2 * order - 1], -fit[2 * order])


def periodic(psi, stand, values):
    """Ours at measured azimuths [deg]."""
    at = np.degrees(stand.data.azimuth.values)
    return np.interp(psi, at, values, period=360.0)


def run(case):
    table = case.table("airloads.csv")
    of = {name: table.where(quantity=name) for name in ("M2Cn_087", "M2Cm_087", "tip_flap_pctR", "tip_twist_deg")}
    measured = {name: (rows["psi_deg"], rows["value"]) for name, rows in of.items()}
    cn = ten_degrees(*measured["M2Cn_087"])
    checks, found = [], {}
    for name, (wake, change) in RUNS.items():
        stand = rotor_in(case, {**MINIMUM_NOISE, **change}, wake)
        ours = {
            "M2Cn_087": at_station(stand, "cn_m2"),
            "M2Cm_087": at_station(stand, "cm_m2"),
            "tip_flap_pctR": 100 * stand.data.tip_flap.values / stand.radius,
            "tip_twist_deg": np.degrees(stand.data.tip_twist.values),
        }
        found[name] = (np.degrees(stand.data.azimuth.values), ours)
        note, gate = ("", True) if name == DEFAULT else (name, False)
        mine = ours["M2Cn_087"]
        shape = np.sqrt(np.mean((mine - mine.mean() - cn + cn.mean()) ** 2))
        checks += [
            Check("mean M2Cn at 0.87 R", mine.mean(), cn.mean(), 0.012, gate=gate, note=note),
            Check("rms of M2Cn, means removed", shape, 0.0, 0.015, gate=gate, note=note),
            Check("rms of measured M2Cn itself, mean removed, for scale", np.std(cn), 0.0, gate=False, note=note),
        ]
        psi, value = measured["tip_flap_pctR"]
        flap = abs(harmonic(psi, periodic(psi, stand, ours["tip_flap_pctR"])) - harmonic(psi, value))
        checks.append(
            Check("difference of the first harmonic of tip flap", flap, 0.0, 0.5, "% R", gate=gate, note=note)
        )
        psi, value = measured["tip_twist_deg"]
        twist = periodic(psi, stand, ours["tip_twist_deg"])
        checks.append(Check("rms of elastic tip twist", np.sqrt(np.mean((twist - value) ** 2)), 0.0, 0.6, "deg",
                            gate=gate, note=note))  # fmt: skip
        mine, theirs = harmonic(psi, twist, 3), harmonic(psi, value, 3)
        checks.append(Check("amplitude of 3-per-rev twist", abs(mine), abs(theirs), unit="deg", gate=False, note=note))
        turned = np.degrees(np.angle(mine / theirs))
        checks.append(Check("phase of 3-per-rev twist less measured", turned, 0.0, unit="deg", gate=False, note=note))
    return Outcome(checks, draw(measured, found))


@style.styled
def draw(measured, found):
    figure = style.blank(6.0)
    panels = figure.subplots(2, 2, sharex=True)
    labels = ("M²Cn at 0.87 R", "M²Cm at 0.87 R", "tip flap [% R]", "elastic tip twist [deg], nose up")
    for axes, name, label in zip(panels.flat, measured, labels):
        axes.plot(*measured[name], "k.", ms=3, label="measured")
        shown = [each for each in found.items() if "attached" not in each[0]]
        for (run_name, (psi, ours)), color, line in zip(shown, style.COLORS, style.LINES):
            axes.plot(psi, ours[name], line, color=color, lw=1.0, label=run_name)
        axes.set_ylabel(label)
        axes.set_xticks(range(0, 361, 90))
    for axes in panels[-1]:
        axes.set_xlabel("azimuth [deg], 0 aft")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=1)
    return figure
