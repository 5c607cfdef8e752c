# SPDX-License-Identifier: MIT OR Apache-2.0
"""The border to the core: arrays of a wrong shape and numbers that are none are Python exceptions that say so, never a panic."""

import itertools

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import _core


@pytest.fixture(scope="module")
def start():
    return wf.trim(wf.load_aircraft("uh60a"), inflow="dynamic")


def calls(start):
    """Calls of the core by name, each with arguments that fit."""
    core, problem, x = start.model.core, start.problem, start.x
    y = start.state()
    n, rotor = y.size, start.model.rotor
    still, out, matrix = np.zeros(n), np.empty(n), np.empty((n, n))
    modes, stations = len(rotor["frequencies"]), len(rotor["stations"])
    inputs = _core.Inputs(start.stick_si, np.zeros(4), 0.0, None, 0.0, 0.0)
    hub, stick = core.hub(y), start.stick_si
    row, modal = np.zeros(stations), np.zeros(modes)
    linear = _core.Linearised(core)
    atol = np.full(n, 1e-6)
    return {
        "residual": (core.residual, (0.0, y, still, inputs, out)),
        "jacobian": (core.jacobian, (0.0, y, still, inputs, (1.0, 1.0), matrix)),
        "consistent_rate": (core.consistent_rate, (0.0, y, inputs)),
        "outputs": (core.outputs, (0.0, y, still, inputs)),
        "hub": (core.hub, (y,)),
        "equivalent_angles": (core.equivalent_angles, (np.zeros((2, modes)),)),
        "section_circulation": (core.section_circulation, (hub, stick, (0.0, modal, modal), row)),
        "passages": (core.passages, (problem, x, np.zeros(2), np.zeros((2, stations)))),
        "trim_residual": (core.trim_residual, (problem, x)),
        "trim_jacobian": (core.trim_jacobian, (problem, x)),
        "trim_state": (core.trim_state, (problem, x, 0.0)),
        "trim_motion": (core.trim_motion, (problem, x, 36)),
        "followed_incidence": (core.followed_incidence, (0.0, y, 0.1, 0.01)),
        "fixed": (_core.FixedStep, (core, 0.0, y, 1e-5, atol, 0.3)),
        "linearised": (linear.renew, (core, (0.0, y), still, inputs, True)),
        "masses": (linear.renew, (core, (0.0, y), still, inputs, False)),
        "consistent": (linear.consistent, (core, (0.0, y), still, inputs, True)),
        "matrix": (linear.matrix, (1.0, matrix)),
    }


NAMES = (
    *(
        "residual",
        "jacobian",
        "consistent_rate",
        "outputs",
        "hub",
        "equivalent_angles",
        "section_circulation",
        "passages",
    ),
    *("trim_residual", "trim_jacobian", "trim_state", "trim_motion", "followed_incidence"),
    *("fixed", "linearised", "masses", "consistent", "matrix"),
)


def changed(value):
    """The same with another shape, as far as it holds an array."""
    if isinstance(value, tuple):
        for i, part in enumerate(value):
            for other in changed(part):
                yield (*value[:i], other, *value[i + 1 :])
    elif isinstance(value, np.ndarray):
        last = value.shape[-1]
        yield np.zeros((*value.shape[:-1], last + 1))
        yield np.zeros((*value.shape[:-1], last - 1))
        yield np.zeros((*value.shape[:-1], 0))
        yield np.zeros((*value.shape, 2))


@pytest.mark.parametrize("name", NAMES)
def test_wrong_shapes_are_exceptions(start, name):
    call, given = calls(start)[name]
    call(*given)
    for i, value in enumerate(given):
        for other in changed(value):
            # a panic is no Exception: it would not be caught here
            with pytest.raises((ValueError, TypeError)):
                call(*given[:i], other, *given[i + 1 :])


def test_inflow_of_another_rotor_is_refused(start):
    core, y = start.model.core, start.state()
    for shape, kind in itertools.product(((3, 20), (4, 19), (5, 20), (0, 20)), (np.zeros, np.ones)):
        inputs = _core.Inputs(start.stick_si, np.zeros(4), 0.0, kind(shape), 0.0, 0.0)
        with pytest.raises(ValueError, match="inflow has"):
            core.residual(0.0, y, np.zeros(y.size), inputs, np.empty(y.size))
