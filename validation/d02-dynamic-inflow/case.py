"""Static gains and eigenvalues of the dynamic inflow model."""

import json

import numpy as np

from wakeflight import _core
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

MASS = np.diag([128 / (75 * np.pi), 16 / (45 * np.pi), 16 / (45 * np.pi)])


def rate(state, ct, mu, mu_z, **choices):
    """Rates per radian of rotor azimuth."""
    return np.array(_core.pitt_peters_rate(state, [ct, 0.0, 0.0, mu, 0.0, mu_z], 1.0, json.dumps(choices)))


def matrix(state, ct, mu, mu_z, step=1e-3, **choices):
    """Derivative of the rates by central differences, exact for what is linear."""
    columns = []
    for i in range(3):
        d = np.zeros(3)
        d[i] = step
        columns.append(
            (rate(state + d, ct, mu, mu_z, **choices) - rate(state - d, ct, mu, mu_z, **choices)) / (2 * step)
        )
    return np.array(columns).T


def ordered(values):
    return np.array(sorted(values, key=lambda v: (round(v.real, 6), v.imag)))


def run(case):
    checks, drawn = [], []
    for row in case.toml("pitt_peters.toml")["case"]:
        ct, mu = row["CT"], row["mu"]
        mu_z = -mu * np.tan(np.radians(row["alpha_deg"]))
        name = f"µ = {mu:g}, C_T = {ct:g}"
        mean = _core.momentum_inflow(ct, mu**2, mu_z)
        checks.append(Check(f"{name}: momentum inflow", mean, row["lambda_i"], 1e-7))
        checks.append(Check(f"{name}: total inflow", mean - mu_z, row["lambda_total"], 1e-7))
        steady = np.array(row["static_states_for_CT_only"])
        a = matrix(steady, ct, mu, mu_z)
        flow = np.diag([row["V_T"], row["V_m"], row["V_m"]])
        gains = np.linalg.inv(-MASS @ a) @ flow
        checks.append(Check.largest(f"{name}: static gains", gains, row["L_tilde"], 1e-6))
        ours = ordered(np.linalg.eigvals(a))
        reference = ordered(np.array(row["eig_frozen_re"]) + 1j * np.array(row["eig_frozen_im"]))
        checks.append(Check.largest(f"{name}: eigenvalues, real", ours.real, reference.real, 1e-7, "1/rad"))
        checks.append(Check.largest(f"{name}: eigenvalues, imaginary", ours.imag, reference.imag, 1e-7, "1/rad"))
        left = rate(steady, ct, mu, mu_z)
        checks.append(Check(f"{name}: rate left in the steady state", np.max(np.abs(left)), 0.0, 2e-7, "1/rad"))
        drawn.append((name, ours, reference))
    hover = np.array([0.05, 0.0, 0.0])
    # the mass flow now depends on the state: a short step
    for apparent, value, tolerance in (("corrected", -0.36815539, 1e-7), ("uncorrected", -0.23562, 5e-6)):
        a = matrix(hover, 0.005, 0.0, 0.0, 1e-5, apparent_mass=apparent, mass_flow="state")
        checks.append(
            Check(f"hover, small perturbations, {apparent} mass: uniform", a[0, 0], value, tolerance, "1/rad")
        )
        checks.append(
            Check(f"hover, small perturbations, {apparent} mass: cyclic", a[1, 1], -0.44178647, 1e-7, "1/rad")
        )
    return Outcome(checks, draw(drawn))


@style.styled
def draw(drawn):
    figure = style.blank(2.8)
    axes = figure.subplots()
    for (name, ours, reference), color in zip(drawn, style.COLORS):
        axes.plot(reference.real, reference.imag, "o", ms=8, mfc="none", color=color, label=name)
        axes.plot(ours.real, ours.imag, "+", color=color)
    axes.plot([], [], "+", color=style.GREY, label="ours")
    axes.axvline(0.0, color=style.GREY, lw=0.7)
    axes.set_xlabel("real part of the eigenvalues [1/rad]")
    axes.set_ylabel("imaginary part [1/rad]")
    axes.legend()
    return figure
