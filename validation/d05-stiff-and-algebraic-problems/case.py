"""IDA, as the flights use it, on test problems F(t, y, y') = 0."""

import numpy as np

from wakeflight.errors import NumericalFailure
from wakeflight.integrators import IdaIntegrator
from wakeflight.plotting import style
from wakeflight.validate import Check, Outcome

RTOL = 1e-6


class Derivatives:
    """dF/dy and dF/dy' of a test problem where they were last asked for."""

    def renew(self, core, at, y_dot, inputs, whole):
        self.by_y, self.by_rate = (np.asarray(part, float) for part in core.j(*at, y_dot))

    def matrix(self, c_j, out):
        out[:] = self.by_y + c_j * self.by_rate


class Problem:
    """What the solver asks of an aircraft: residual and derivatives, here of a test problem.

    It turns by so much that derivatives serve no longer than the instant they were found at.
    """

    def __init__(self, n, residual, jacobian):
        self.n, self.f, self.j = n, residual, jacobian
        self.core = self
        self.omega, self.has_free_speed = np.inf, False
        self.layout = {"size": n, "modal": [], "modal_rate": [], "inflow": (0, 0), "tail_inflow": (0, 0)}
        self.rotor = {"angle_per_coordinate": [1.0], "frequencies": [1.0]}

    def residual(self, t, y, y_dot, inputs, out):
        out[:] = self.f(t, y, y_dot)

    def turned(self, t):
        return 1e12 * t

    def linearised(self):
        return Derivatives()

    def state_names(self):
        return [(f"y{i}", "1") for i in range(self.n)]

    def integrate(self, y, rate, times, atol):
        solver = IdaIntegrator(self, RTOL)
        solver.atol = np.asarray(atol, float)
        solver.start(0.0, np.array(y, float), np.array(rate, float))
        states = []
        for t in times:
            solver.advance_to(t, None)
            states.append(solver.state)
        return np.array(states)


def robertson():
    def f(t, y, d):
        slow, fast, quench = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
        return [d[0] + slow - fast, d[1] - slow + fast + quench, y.sum() - 1.0]

    def j(t, y, d):
        rows = [[0.04, -1e4 * y[2], -1e4 * y[1]], [-0.04, 1e4 * y[2] + 6e7 * y[1], 1e4 * y[1]], [1.0, 1.0, 1.0]]
        return rows, np.diag([1.0, 1.0, 0.0])

    return Problem(3, f, j)


def pendulum(g):
    def f(t, s, d):
        x, y, u, v, lam = s
        return [d[0] - u, d[1] - v, d[2] + lam * x, d[3] + lam * y + g, u * u + v * v - lam * (x * x + y * y) - g * y]

    def j(t, s, d):
        x, y, u, v, lam = s
        rows = np.zeros((5, 5))
        rows[0, 2] = rows[1, 3] = -1.0
        rows[2, 0], rows[2, 4] = lam, x
        rows[3, 1], rows[3, 4] = lam, y
        rows[4] = -2 * lam * x, -2 * lam * y - g, 2 * u, 2 * v, -(x * x + y * y)
        return rows, np.diag([1.0, 1.0, 1.0, 1.0, 0.0])

    return Problem(5, f, j)


def linear():
    return Problem(
        2,
        lambda t, s, d: [d[0] + s[0] - s[1], s[1] - s[0] - np.cos(t)],
        lambda t, s, d: ([[1.0, -1.0], [-1.0, 1.0]], np.diag([1.0, 0.0])),
    )


def run(case):
    data = case.toml("dae_tests.toml")
    allowed, checks, drawn = 20 * RTOL, [], {}

    rows = data["robertson"]
    found = robertson().integrate([1.0, 0.0, 0.0], [-0.04, 0.04, 0.0], rows["t"], [1e-10, 1e-14, 1e-10])
    for i, key in enumerate(("y1", "y2")):
        checks.append(Check.largest(f"Robertson: {key}", found[:, i], rows[key], allowed, "-", "relative"))
    drawn["Robertson, y1"] = rows["t"], np.abs(found[:, 0] / rows["y1"] - 1)

    rows = data["pendulum_index1"]
    found = pendulum(9.81).integrate([1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, -9.81, 0.0], rows["t"], [1e-9] * 5)
    for i, key in ((0, "x"), (1, "y"), (4, "lam")):
        range_of = 1.0 if key != "lam" else 3 * 9.81
        error = np.abs(found[:, i] - rows[key]) / range_of
        checks.append(Check(f"pendulum: {key} to 2 s, error over its range", error[:3].max(), 0.0, allowed))
        checks.append(Check(f"pendulum: {key} at 5 s, error over its range", error[3], 0.0, allowed, gate=False))
    drawn["pendulum, x"] = rows["t"], np.abs(found[:, 0] - rows["x"])

    rows = data["linear_index1"]
    found = linear().integrate([2.0, 3.0], [1.0, 1.0], rows["t"], [1e-9] * 2)
    for i, key in enumerate("yz"):
        checks.append(Check.largest(f"linear: {key}", found[:, i], rows[key], allowed, "-", "relative"))
    drawn["linear, y"] = rows["t"], np.abs(found[:, 0] / rows["y"] - 1)

    refused = 0.0
    try:
        linear().integrate([2.0, 0.0], [-2.0, 0.0], [1.0], [1e-9] * 2)
    except NumericalFailure:
        refused = 1.0
    checks.append(Check("inconsistent start refused (1: yes)", refused, 1.0, 0.0))
    return Outcome(checks, draw(drawn))


@style.styled
def draw(drawn):
    figure = style.blank(2.6)
    axes = figure.subplots()
    for (name, (t, error)), color in zip(drawn.items(), style.COLORS):
        axes.loglog(t, np.maximum(error, 1e-12), marker="o", color=color, label=name)
    axes.axhline(20 * RTOL, color=style.GREY, ls="--", label="allowed")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("error")
    axes.legend()
    return figure
