"""The HART II rotor in its tunnel conditions, and where its tip vortices cross the planes that were measured."""

import numpy as np
from scipy.interpolate import CubicSpline
from wind import DEFAULT, MARCHED, SHEET, WAKES, wind

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

BASELINE = {"omega": "109.12 rad/s", "density": "1.2055 kg/m^3", "speed_of_sound": "341.7 m/s", "thrust": "3300 N",
            "hub_roll": "20 N m", "hub_pitch": "-20 N m"}  # fmt: skip
MINIMUM_NOISE = {"omega": "109.01 rad/s", "density": "1.1931 kg/m^3", "speed_of_sound": "342.2 m/s", "thrust": "3300 N",
                 "hub_roll": "30 N m", "hub_pitch": "-30 N m",
                 "higher_harmonics": [{"order": 3, "amplitude": "0.8 deg", "phase": "300 deg"}]}  # fmt: skip


def rotor_in(case, condition, wake=DEFAULT, **options):
    """The rotor at 32.9 m/s, tilted back by 4.3 deg, trimmed to the measured thrust and hub moments."""
    return wind(case.path("rotors/hart2.toml"), wake, speed="32.9 m/s", shaft_angle="4.3 deg", **condition, **options)


def filaments(stand, azimuth):
    """Tip vortices (n_blades, n_ages, 3) over R at the moment when the reference blade is at `azimuth` [deg]."""
    psi = stand.data.azimuth.values
    path = stand.data.wake_path.values / stand.radius
    spline = CubicSpline(np.append(psi, 2 * np.pi), np.concatenate([path, path[:1]]), bc_type="periodic")
    blades = stand.model.n_blades
    return np.array([spline((np.radians(azimuth) + 2 * np.pi * k / blades) % (2 * np.pi)) for k in range(blades)])


def crossings(stand, azimuth, y):
    """Points (n, 2), x and z over R, where tip vortices cross the plane at `y` over R."""
    found = []
    for filament in filaments(stand, azimuth):
        # four points between nodes: a straight piece of 10 deg cuts its corner by 0.004 R
        at = np.arange(len(filament))
        fine = CubicSpline(at, filament)(np.linspace(0, at[-1], 4 * at[-1] + 1))
        side = fine[:, 1] - y
        for i in np.flatnonzero(side[:-1] * side[1:] < 0):
            share = side[i] / (side[i] - side[i + 1])
            found.append((fine[i] + share * (fine[i + 1] - fine[i]))[[0, 2]])
    return np.array(found)


def nearest(points, x):
    """The crossing whose x is nearest: vortices lie a quarter of the radius apart."""
    return points[np.argmin(np.abs(points[:, 0] - x))]


def drift(x):
    """Mean distance along the wind between vortices that follow each other: gaps that are no multiple of a passage."""
    gaps = np.diff(np.sort(x))
    return gaps[(gaps > 0.18) & (gaps < 0.34)]


def drifts(stand, table, side):
    """Ours and measured drift in a quarter turn, planes and moments of one side with two centres or more, over R."""
    ours, measured = [], []
    for label in np.unique(table["label"][table["side"] == side]):
        rows = (table["label"] == label) & (table["side"] == side)
        x, y = table["x_R"][rows], float(np.mean(table["y_R"][rows]))
        if len(x) < 2:
            continue
        at = crossings(stand, float(table["psi_blade_deg"][rows][0]), y)[:, 0]
        measured += list(drift(x))
        ours += list(drift(at[(at > x.min() - 0.15) & (at < min(x.max(), 0.5))]))
    return float(np.mean(ours)), float(np.mean(measured))


def vortices(case, condition):
    """Compare tip-vortex centres with those measured."""
    table = case.table("vortices.csv")
    found, checks = {}, []
    for name in [*WAKES, MARCHED]:
        stand = rotor_in(case, condition, name)
        for side in ("advancing", "retreating"):
            text = f"drift along the wind in a quarter turn, {side} side"
            note = "" if name == DEFAULT else name
            checks.append(Check(text, *drifts(stand, table, side), unit="R", gate=False, note=note))
        rows = zip(table["psi_blade_deg"], table["x_R"], table["y_R"])
        ours = np.array([nearest(crossings(stand, psi, y), x) for psi, x, y in rows])
        found[name] = (stand, ours)
        error = ours - np.column_stack([table["x_R"], table["z_R"]])
        close = (np.abs(error[:, 0]) <= 0.04) & (np.abs(error[:, 1]) <= 0.05)
        note, gate = ("", True) if name == DEFAULT else (name, False)
        checks.append(Check(f"share of {len(table)} centres within 0.04 R along and 0.05 R up", close.mean(), 1.0, 0.2,
                            gate=gate, note=note))  # fmt: skip
        for side in ("advancing", "retreating"):
            z = error[table["side"] == side, 1]
            checks.append(
                Check(f"mean height less measured, {side} side", z.mean(), 0.0, unit="R", gate=False, note=note)
            )
        checks.append(
            Check("rms of the height", np.sqrt(np.mean(error[:, 1] ** 2)), 0.0, unit="R", gate=False, note=note)
        )
        checks.append(
            Check("rms along the wind", np.sqrt(np.mean(error[:, 0] ** 2)), 0.0, unit="R", gate=False, note=note)
        )
    return Outcome(checks, draw(table, found))


@style.styled
def draw(table, found):
    """Side views of the wake in the planes measured, moments of about 20 and about 70 deg."""
    planes = (0.4, 0.55, 0.7, 0.85, 0.97, -0.4, -0.55, -0.7, -0.85, -0.97)
    planes = [p for p in planes if np.any(np.abs(table["y_R"] - p) < 0.06)]
    figure = style.blank(1.3 * len(planes) / 2 + 1.2)
    panels = figure.subplots((len(planes) + 1) // 2, 2, sharex=True, sharey=True)
    for axes, plane in zip(panels.T.flat, planes):
        rows = np.abs(table["y_R"] - plane) < 0.06
        for early, fill in ((True, None), (False, "none")):
            moment = rows & ((table["psi_blade_deg"] < 45) == early)
            if not moment.any():
                continue
            label = "blade at about 20°" if early else "at about 70°"
            axes.plot(table["x_R"][moment], table["z_R"][moment], "ko", mfc=fill, ms=4, label=f"measured, {label}")
            psi = np.median(table["psi_blade_deg"][moment])
            for name, color, marker in ((DEFAULT, style.COLORS[0], "s"), (SHEET, style.COLORS[1], "^")):
                points = crossings(found[name][0], psi, plane)
                points = points[np.argsort(points[:, 0])]
                word = "default" if name == DEFAULT else "largest circulation, sheet"
                axes.plot(*points.T, marker, color=color, mfc=fill, ms=3.5, label=f"{word}, {label}")
        axes.set_title(f"y/R = {plane:g} ({'advancing' if plane > 0 else 'retreating'})")
        axes.set_xlim(-1.1, 1.2)
        axes.set_ylim(-0.1, 0.2)
        axes.axhline(0, color="k", lw=0.4)
    for axes in panels[:, 0]:
        axes.set_ylabel("z/R")
    for axes in panels[-1]:
        axes.set_xlabel("x/R, aft of the hub")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
