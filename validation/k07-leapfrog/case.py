"""Leapfrogging rings as free polygons."""

import numpy as np
from scipy.integrate import solve_ivp

import wakeflight as wf
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

SIDES = 216


def fly(sides, exact, until):
    """Motion of the two rings: times of passing, and nodes (2, sides, 3) at any time."""
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    start = np.concatenate([ring, ring + np.array([0, 0, exact["separation"]])])
    strength, core = np.ones(2 * sides), np.full(2 * sides, exact["mu"])

    def rate(_, flat):
        nodes = flat.reshape(2, sides, 3)
        closed = [np.vstack([r, r[:1]]) for r in nodes]
        return wf.induced_velocity(flat.reshape(-1, 3), closed, strength, core, core="rosenhead_moore").ravel()

    def passing(_, flat):
        z = flat.reshape(2, sides, 3)[:, :, 2].mean(axis=1)
        return z[0] - z[1]

    flown = solve_ivp(
        rate, (0, until), start.ravel(), "DOP853", events=passing, rtol=1e-8, atol=1e-9, dense_output=True
    )
    return flown.t_events[0], lambda t: flown.sol(t).reshape(2, sides, 3)


def run(case):
    exact = case.toml("leapfrog.toml")["case"]
    times = np.linspace(0, 1.02 * exact["t_full_cycle"], 160)
    passes, nodes = fly(SIDES, exact, times[-1])
    coarse, _ = fly(SIDES // 2, exact, 1.1 * exact["t_first_pass"])
    coarsest, _ = fly(SIDES // 3, exact, 1.1 * exact["t_first_pass"])

    def state(t):
        return np.ravel([(np.hypot(r[:, 0], r[:, 1]).mean(), r[:, 2].mean()) for r in nodes(t)])

    late, later = (abs(t / exact["t_first_pass"] - 1) for t in (coarse[0], passes[0]))
    checks = [
        Check("time of the first pass", passes[0], exact["t_first_pass"], 0.005, "R^2/Gamma", "relative"),
        # after two passes the rings stand as they began when the radii are equal again: half a cycle after equal passes
        Check("time of the full cycle", passes[0] + passes[1], exact["t_full_cycle"], 0.005, "R^2/Gamma", "relative"),
    ]
    checks += [
        Check("order in the number of sides, time of the first pass", np.log2(late / later), 2.0, 0.15),
        Check(
            "time of the first pass, 72 sides",
            coarsest[0],
            exact["t_first_pass"],
            unit="R^2/Gamma",
            kind="relative",
            gate=False,
        ),
    ]
    for t, key in ((passes[0], "R_Z_at_first_pass"), (1.0, "state_t1"), (2.0, "state_t2"), (5.0, "state_t5")):
        checks.append(
            Check.largest(f"radii and positions at t = {t:.3f}", state(t), exact[key], 0.005, "R", "relative")
        )
    r1, _, r2, _ = np.array([state(t) for t in times]).T
    checks.append(
        Check.largest(
            "sum of the squares of the radii", r1**2 + r2**2, np.full(times.size, 2.0), 0.005, "R^2", "relative"
        )
    )
    out_of_round = max(np.ptp(np.hypot(r[:, 0], r[:, 1])) for r in nodes(times[-1]))
    checks.append(Check("out of round at the end", out_of_round, 0.0, 1e-3, "R"))
    return Outcome(checks, draw(times, np.array([state(t) for t in times]), exact))


@style.styled
def draw(times, states, exact):
    figure = style.blank(3.0)
    left, right = figure.subplots(1, 2)
    for k, color in enumerate(style.COLORS[:2]):
        left.plot(times, states[:, 2 * k], color=color, label=f"ring {k + 1}")
        right.plot(states[:, 2 * k + 1], states[:, 2 * k], color=color)
        points = np.array(
            [exact[key][2 * k : 2 * k + 2] for key in ("state_t1", "state_t2", "R_Z_at_first_pass", "state_t5")]
        )
        left.plot([1, 2, exact["t_first_pass"], 5], points[:, 0], "o", color=color, ms=4)
        right.plot(points[:, 1], points[:, 0], "o", color=color, ms=4)
    left.set_xlabel("time [R^2 / circulation]")
    left.set_ylabel("radius [R]")
    left.legend(title="points: exact")
    right.set_xlabel("axial position [R]")
    right.set_ylabel("radius [R]")
    return figure
