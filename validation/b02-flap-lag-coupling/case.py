"""Flap-lag coupling of a hingeless blade by pitch and twist."""

import beams
import numpy as np

from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def coupled(ei_flap, ei_lag, pitch, twist, n_elements, n_modes):
    blade = beams.uniform(ei_flap=ei_flap, ei_lag=ei_lag)
    blade["twist"] = {"x": [0.0, 1.0], "y": [-0.75 * twist, 0.25 * twist]}
    return beams.modes(blade, 1.0, n_modes, n_elements, pitch)


def run(case):
    table = case.table("flap_lag_coupled.csv")
    rows = list(
        zip(table["EIy"], table["EIz"], np.radians(table["theta75_deg"]), np.radians(table["twist_deg"]), strict=True)
    )
    coarse = np.array([np.asarray(coupled(*row, 4, 3).frequencies) for row in rows])
    fine = [coupled(*row, 12, 5) for row in rows]
    frequencies = np.array([np.asarray(found.frequencies) for found in fine])
    checks = [
        Check.largest(f"mode {i + 1}, 4 elements", coarse[:, i], table[f"w{i + 1}"], tolerance, "1/rev", "relative")
        for i, tolerance in enumerate((3e-3, 3e-3, 1e-2))
    ]
    checks += [
        Check.largest(f"mode {i + 1}, 12 elements", frequencies[:, i], table[f"w{i + 1}"], 2e-4, "1/rev", "relative")
        for i in range(5)
    ]
    for i in range(2):
        share = [found.energy_shares[i, beams.FLAP] for found in fine]
        checks.append(Check.largest(f"flap share of mode {i + 1}", share, table[f"flap_fraction_{i + 1}"], 1.5e-3))
    return Outcome(checks, draw(table, frequencies))


@style.styled
def draw(table, ours):
    figure = style.blank(3.0)
    axes = figure.subplots()
    stiff = table["case"] == "stiff_inplane"
    blade = coupled
    pitch = np.linspace(0.0, 20.0, 21)
    first = next(i for i in range(len(table)) if stiff[i])
    ei = table["EIy"][first], table["EIz"][first]
    curve = np.array([np.asarray(blade(*ei, np.radians(p), 0.0, 12, 2).frequencies) for p in pitch])
    for i in range(2):
        axes.plot(pitch, curve[:, i], color=style.COLORS[i], label=f"mode {i + 1}")
        axes.plot(table["theta75_deg"][stiff], table[f"w{i + 1}"][stiff], "o", mfc="none", color=style.COLORS[i])
    axes.plot([], [], "o", mfc="none", color=style.GREY, label="reference")
    axes.set_xlabel("pitch [deg]")
    axes.set_ylabel("frequency [1/rev]")
    axes.set_title("Stiff in the plane: coupling pushes flap and lag apart", loc="left")
    axes.legend()
    return figure
