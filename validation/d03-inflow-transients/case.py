"""Steps and ramps in hover."""

import json

import numpy as np
from scipy.integrate import solve_ivp

from wakeflight import _core
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

OMEGA, SIGMA_A, LOCK = 22.0, 0.0636 * 5.73, 8.0


def inflow_rate(state, ct, omega, apparent):
    choices = json.dumps({"apparent_mass": apparent, "mass_flow": "state"})
    return _core.pitt_peters_rate(state, [ct, 0.0, 0.0, 0.0, 0.0, 0.0], omega, choices)


def thrust(theta, lam, beta_dot):
    return 0.5 * SIGMA_A * (theta / 3 - lam / 2 - beta_dot / (3 * OMEGA))


def ramp(rate_deg, apparent="uncorrected", end=1.5):
    """Dense solution of inflow and flapping for a collective ramp to 12 deg, in two pieces: the corner is a kink."""
    corner = 12.0 / rate_deg

    def theta(t):
        return np.radians(np.minimum(rate_deg * t, 12.0))

    def equations(t, x):
        lam, beta, beta_dot = x
        rate = inflow_rate([lam, 0.0, 0.0], thrust(theta(t), lam, beta_dot), OMEGA, apparent)[0]
        moment = LOCK / 8 * (theta(t) - 4 / 3 * lam - beta_dot / OMEGA)
        return [rate, beta_dot, OMEGA**2 * (moment - beta)]

    options = {"rtol": 1e-9, "atol": 1e-12, "dense_output": True}
    first = solve_ivp(equations, (0.0, corner), [0.0, 0.0, 0.0], **options)
    second = solve_ivp(equations, (corner, end), first.y[:, -1], **options)

    def at(t):
        t = np.atleast_1d(t)
        x = np.where(t < corner, first.sol(np.minimum(t, corner)), second.sol(np.maximum(t, corner)))
        return np.array([thrust(theta(t), x[0], x[2]), x[0], np.degrees(x[1])])

    return at


def run(case):
    data = case.toml("inflow_steps.toml")
    step, checks = data["step_CT"], []
    ends = np.pi * np.array(step["psi_over_pi"])
    for apparent, key in (("corrected", "lambda_M11_128_75pi"), ("uncorrected", "lambda_M11_8_3pi")):
        start = [np.sqrt(step["CT_before"] / 2), 0.0, 0.0]
        solution = solve_ivp(
            lambda psi, x, a=apparent: inflow_rate(x, step["CT_after"], 1.0, a),
            (0.0, ends[-1]),
            start,
            t_eval=ends,
            rtol=1e-11,
            atol=1e-14,
        )
        checks.append(Check.largest(f"inflow after a step of thrust, {apparent} mass", solution.y[0], step[key], 1e-8))
    drawn = []
    for row in data["ramp"]:
        at = ramp(row["rate_deg_s"])
        samples = np.array(row["samples_t_CT_lambda_betadeg"])
        ours = at(samples[:, 0])
        name = f"{row['rate_deg_s']:g} deg/s"
        for i, (what, unit) in enumerate((("C_T", "-"), ("inflow", "-"), ("flapping", "deg"))):
            checks.append(Check.largest(f"{name}: {what}", ours[i], samples[:, i + 1], 1e-3, unit, "relative"))
        t = np.linspace(0.0, 1.5, 30001)
        ct, _, beta = at(t)
        checks.append(Check(f"{name}: peak of C_T", ct.max(), row["CT_peak"], 1e-3, "-", "relative"))
        checks.append(Check(f"{name}: time of the peak", t[ct.argmax()], row["t_peak_s"], 2e-4, "s"))
        ratio = ct.max() / row["CT_final"]
        checks.append(Check(f"{name}: overshoot", ratio, row["overshoot_ratio"], 1e-3, "-", "relative"))
        checks.append(Check(f"{name}: peak of flapping", beta.max(), row["beta_peak_deg"], 1e-3, "deg", "relative"))
        drawn.append((name, t, ct, samples))
    return Outcome(checks, draw(drawn))


@style.styled
def draw(drawn):
    figure = style.blank(2.8)
    axes = figure.subplots()
    for (name, t, ct, samples), color in zip(drawn, style.COLORS):
        shown = t <= 1.1
        axes.plot(t[shown], 1e3 * ct[shown], color=color, label=f"collective at {name}")
        axes.plot(samples[:, 0], 1e3 * samples[:, 1], "o", mfc="none", color=color)
    axes.plot([], [], "o", mfc="none", color=style.GREY, label="reference")
    axes.set_xlabel("time [s]")
    axes.set_ylabel(r"$10^3\,C_T$")
    axes.legend()
    return figure
