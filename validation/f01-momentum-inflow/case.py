"""Mean inflow and fore-aft gradient of the three-state inflow model in trim."""

import numpy as np

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome


def run(case):
    table = case.table("inflow.csv")
    # any rotor will do: clamped, rigid, its aerodynamic moments trimmed out so that thrust alone drives the inflow
    rotor = wf.load_rotor(case.path("rotors/knight-hefner-4.toml"))
    ours, gradient = [], []
    for ct, mu, angle in zip(table["CT"], table["mu"], table["alpha_deg"]):
        speed = mu / np.cos(np.radians(angle)) * rotor.omega * rotor.radius
        stand = wf.tunnel(
            rotor,
            inflow="dynamic",
            speed=f"{speed} m/s",
            shaft_angle=f"{-angle} deg",
            ct=float(ct),
            hub_roll="0 N m",
            hub_pitch="0 N m",
        )
        ours.append(float(stand.data.inflow_mean))
        gradient.append(float(stand.data.inflow_1c) / ours[-1])
    checks = [
        Check.largest("mean inflow", ours, table["lambda_i"], 1e-8, "tip speed"),
        Check.largest("fore-aft gradient over the mean", gradient, table["kx_pitt_peters"], 1e-7, "-"),
    ]
    return Outcome(checks, draw(table, ours, gradient))


@style.styled
def draw(table, ours, gradient):
    figure = style.blank(2.8)
    left, right = figure.subplots(1, 2)
    left.plot(table["mu"], table["lambda_i"], "ko", mfc="none", label="Glauert; static gradient of Pitt and Peters")
    left.plot(table["mu"], ours, "+", color=style.COLORS[0], label="dynamic inflow, trimmed")
    left.set_ylabel("mean induced inflow [ΩR]")
    right.plot(table["chi_deg"], table["kx_pitt_peters"], "ko", mfc="none")
    right.plot(table["chi_deg"], gradient, "+", color=style.COLORS[0])
    right.plot(table["chi_deg"], table["kx_coleman"], "x", color=style.GREY, label="Coleman")
    right.set_ylabel("fore-aft gradient over the mean")
    left.set_xlabel("advance ratio")
    right.set_xlabel("wake skew [deg]")
    right.legend()
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
