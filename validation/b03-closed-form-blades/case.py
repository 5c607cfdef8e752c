"""Closed forms of rotating blades."""

import beams
import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def stiff(e):
    """Flap and lag frequency of a nearly rigid blade hinged at `e`."""
    found = beams.modes(beams.uniform("hinged", e, 1.0, 1e3, 1e3), 1.0, 2, 1)
    return beams.mostly(found, beams.FLAP)[0], beams.mostly(found, beams.LAG)[0]


def run(case):
    data = case.toml("closed_form_blade.toml")
    rigid = data["articulated_uniform_rigid"]
    ours = np.array([stiff(e) for e in rigid["e"]])
    checks = [
        Check.largest("rigid flap, hinge at e", ours[:, 0], rigid["nu_flap"], 1e-6, "1/rev", "relative"),
        Check.largest("rigid lag, hinge at e", ours[:, 1], rigid["nu_lag"], 1e-6, "1/rev", "relative"),
    ]
    elastic = data["articulated_elastic"]
    for n_elements, tolerance in ((4, None), (24, 1e-3)):
        for kind, name, count in ((beams.FLAP, "flap", 3), (beams.LAG, "lag", 2)):
            found = []
            for ei in elastic["EI"]:
                # the other direction is kept out of the way
                other = {"ei_lag": 1e3} if kind == beams.FLAP else {"ei_flap": 1e3}
                blade = beams.uniform("hinged", 0.0466, 1.0, **{f"ei_{name}": ei, **other})
                found.append(beams.mostly(beams.modes(blade, 1.0, count + 2, n_elements), kind)[:count])
            for i in range(count):
                reference = elastic[f"{name}_{i + 1}"]
                allowed = (1e-3, 5e-3, 2e-2)[i] if tolerance is None else tolerance
                label = f"elastic {name} {i + 1}, {n_elements} elements"
                checks.append(Check.largest(label, [f[i] for f in found], reference, allowed, "1/rev", "relative"))
    torsion = data["torsion_uniform_clamped"]
    k2 = torsion["km_over_R"] ** 2
    for omega, key in ((1e-6, "omega_nonrotating_per_rev"), (1.0, "omega_rotating_per_rev")):
        blade = beams.uniform(
            ei_flap=1e3, ei_lag=1e3, gj=[torsion["GJ_over_mO2R4"]], i_theta=[k2], control_stiffness=1e9
        )
        found = beams.mostly(beams.modes(blade, omega, 4, 12), beams.TORSION)[0]
        checks.append(Check(f"torsion 1, {key.split('_')[1]}", found, torsion[key], 1e-5, "1/rev", "relative"))
    southwell = data["southwell"]
    at = [beams.mostly(beams.modes(beams.uniform(), eta, 3, 12), beams.FLAP)[:2] for eta in (1e-9, 0.1)]
    for i, key in enumerate(("K1_clamped", "K2_clamped")):
        slope = (at[1][i] ** 2 - at[0][i] ** 2) / 0.1**2
        checks.append(Check(f"Southwell slope {i + 1}", slope, southwell[key], 1e-3, kind="relative"))
    uh60a = wf.blade_modes(wf.load_aircraft("uh60a"), reference_pitch=0.0)
    for kind, key in (("flap 1", "nu_flap"), ("lag 1", "nu_lag_no_spring")):
        mine = uh60a.frequencies[uh60a.labels.index(kind)]
        reference = data["uh60_rigid_blade"][key]
        checks.append(Check(f"UH-60A, {kind}", mine, reference, 5e-3, "1/rev", "relative", note="its own blade table"))
    return Outcome(checks, draw(rigid, ours))


@style.styled
def draw(rigid, ours):
    figure = style.blank(2.8)
    axes = figure.subplots()
    e = np.linspace(0.001, 0.16, 100)
    axes.plot(e, np.sqrt(1 + 1.5 * e / (1 - e)), color=style.COLORS[0], label="flap, closed form")
    axes.plot(e, np.sqrt(1.5 * e / (1 - e)), color=style.COLORS[1], label="lag, closed form")
    axes.plot(rigid["e"], ours[:, 0], "o", color=style.COLORS[0], label="one stiff element")
    axes.plot(rigid["e"], ours[:, 1], "o", color=style.COLORS[1])
    axes.set_xlabel("hinge offset e/R")
    axes.set_ylabel("frequency [1/rev]")
    axes.legend()
    return figure
