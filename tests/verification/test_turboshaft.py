# SPDX-License-Identifier: MIT OR Apache-2.0
"""The example of engines of one's own: the poles of its closed loop with a rotor that only turns."""

import importlib.util
from pathlib import Path

import numpy as np

PATH = Path(__file__).resolve().parents[2] / "examples" / "turboshaft.py"
SPEC = importlib.util.spec_from_file_location("turboshaft", PATH)
example = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(example)

INERTIA, NOMINAL, TRIMMED = 10_921.0, 27.0, 50_000.0
"""What turns with the blades [kg m2], speed [rad/s], torque of the trim [N m]."""


def slowed(dt, seconds, load):
    """Speed of the rotor [rad/s] under a `load` of constant torque added at once [N m], step by step."""
    engines, speed, found = example.T700(), NOMINAL, []
    engines.begin(TRIMMED, NOMINAL)
    for k in range(round(seconds / dt)):
        speed += dt * (engines.torque(k * dt, dt, speed, 0.0) - TRIMMED - load) / INERTIA
        found.append(speed)
    return np.array(found)


def matrix():
    """Rates of rotor speed, gas generator's speed [rpm] and integral by themselves, of both engines and the governor."""
    (own, by_fuel), (by_gas, fuelled, damped) = example.GAS, example.TURBINE
    torque = 2 * example.GEAR * example.INERTIA / INERTIA
    proportional, integral = example.GOVERNOR
    rpm = np.pi / 30
    return np.array(
        [
            [
                torque * (damped * example.GEAR - rpm * fuelled * proportional),
                torque * rpm * by_gas,
                torque * rpm * fuelled * integral,
            ],
            [-by_fuel * proportional, own, by_fuel * integral],
            [-1.0, 0.0, 0.0],
        ]
    )


def test_power_turbine_and_load_together_have_the_published_damping():
    # about hover, with the damping of a load of 1.36 MW that goes with the speed squared
    speed = 20_900 * np.pi / 30
    load = 1.36e6 / speed**2 / example.INERTIA
    assert abs(example.TURBINE[2] - load + 0.565) < 1e-3


def test_the_rotor_answers_a_load_as_the_closed_loop_says():
    from scipy.linalg import expm

    loop, seconds, load = matrix(), 2.0, 5_000.0
    poles = np.linalg.eigvals(loop)
    assert poles.real.max() < -1.0
    # the state under a constant push, by the exponential of the augmented matrix
    pushed = np.zeros((4, 4))
    pushed[:3, :3], pushed[0, 3] = loop, -load / INERTIA
    exact = [(expm(pushed * t) @ [0.0, 0.0, 0.0, 1.0])[0] for t in (0.2, 0.5, 1.0, 2.0)]
    errors = []
    for dt in (2e-3, 1e-3):
        flown = slowed(dt, seconds, load) - NOMINAL
        errors.append(max(abs(flown[round(t / dt) - 1] - e) for t, e in zip((0.2, 0.5, 1.0, 2.0), exact, strict=True)))
    assert errors[1] < 0.01 * np.max(np.abs(exact))
    # what is left is the holding of fuel and torque over the step, of first order
    assert 1.7 < errors[0] / errors[1] < 2.3
