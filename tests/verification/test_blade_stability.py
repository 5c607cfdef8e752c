"""Floquet multipliers of one trimmed blade, hub fixed, inflow frozen."""

import numpy as np
import pytest

N_STEPS = 360


def multipliers(start):
    """Eigenvalues of the transition over a revolution of blade 1's perturbation (q, q_dot)."""
    model = start.model
    core, omega = model.core, model.omega
    n = model.layout["size"]
    (a, b), (_, d) = model.layout["modal"][0], model.layout["modal_rate"][0]
    own = np.arange(a, d)
    zero = np.zeros((n, n))

    def matrix(t):
        y, y_dot = core.trim_state(start.problem, start.x, t)
        inputs = start.inputs(0.0)
        stiffness, mass = zero.copy(), zero.copy()
        core.jacobian(t, y, y_dot, inputs, (1.0, 0.0), stiffness)
        core.jacobian(t, y, y_dot, inputs, (0.0, 1.0), mass)
        block = np.ix_(own, own)
        return -np.linalg.solve(mass[block], stiffness[block])

    period = 2 * np.pi / omega
    h = period / N_STEPS
    transition = np.eye(own.size)
    ahead = matrix(0.0)
    for k in range(N_STEPS):
        here, middle, ahead = ahead, matrix((k + 0.5) * h), matrix((k + 1) * h)
        k1 = here @ transition
        k2 = middle @ (transition + 0.5 * h * k1)
        k3 = middle @ (transition + 0.5 * h * k2)
        k4 = ahead @ (transition + h * k3)
        transition = transition + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    assert b - a == model.layout["n_modes"]
    return np.linalg.eigvals(transition)


def test_every_multiplier_of_the_trimmed_blade_lies_inside_the_unit_circle(baseline_dynamic):
    values = multipliers(baseline_dynamic)
    assert np.abs(values).max() < 1.0
    # flap is damped by about gamma/16 per radian: its multiplier is far inside
    assert np.sort(np.abs(values))[0] < 0.2


@pytest.mark.slow
def test_the_multipliers_are_converged_in_the_step(baseline_dynamic):
    global N_STEPS
    coarse = np.sort(np.abs(multipliers(baseline_dynamic)))
    N_STEPS *= 2
    fine = np.sort(np.abs(multipliers(baseline_dynamic)))
    N_STEPS //= 2
    assert coarse == pytest.approx(fine, abs=1e-3)
