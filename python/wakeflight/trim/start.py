# SPDX-License-Identifier: MIT OR Apache-2.0
"""Closed-form start of a trim: momentum inflow, linear blade-element thrust and flapping, sticks through the rigging."""

from __future__ import annotations

import numpy as np

from .. import _core
from ..model import PITCH, ROLL, YAW, Model
from ..units import STANDARD_GRAVITY
from .equations import INCH

LIFT_SLOPE = 5.7  # 1/rad, of a section
FORWARD_FLAPPING = np.radians(2.0)


def first_guess(model: Model, problem: _core.TrimProblem) -> np.ndarray:
    """Unknowns of the trim in closed form.

    C_T = sigma a/2 [theta_75 (1/3 + mu^2/2) - lambda/2]; the cyclic holds two degrees of forward flapping against
    (8/3 theta_75 - 2 lambda) mu, whatever side the wind comes from; drag of four per cent of the weight at 80 kt, growing with
    the square of the speed; a turn banks by its lateral acceleration.
    """
    layout = model.core.trim_layout(problem)
    modes, inflow, tail = layout.modes, layout.inflow, layout.tail_inflow
    x = np.zeros(modes[-1])
    c, rotor, data = model.condition, model.rotor, model.data
    flat = c.speed * np.cos(c.flight_path)
    sideslip = (1.0 - c.bank_share) * (c.sideslip or 0.0)
    lateral = c.turn_rate * flat / STANDARD_GRAVITY
    thrust = c.gross_mass * STANDARD_GRAVITY * np.hypot(1.0, lateral)
    ct = thrust / (model.density * np.pi * rotor["radius"] ** 2 * model.tip_speed**2)
    mu, climb = flat / model.tip_speed, c.speed * np.sin(c.flight_path) / model.tip_speed
    lambda_0 = _core.descent_inflow(ct, mu**2, -climb)
    drag = 0.04 * (c.speed / 41.0) ** 2
    through = lambda_0 + climb + c.speed / model.tip_speed * drag
    pitch_75 = (2 * ct / (LIFT_SLOPE * model.aircraft.solidity) + 0.5 * through) / (1 / 3 + mu**2 / 2)
    twist = data["rotor"]["blade"]["twist"]
    theta_0 = pitch_75 - np.interp(0.75 * rotor["radius"], twist["x"], twist["y"])
    blowback = mu * (8 / 3 * pitch_75 - 2 * through) / (1 - mu**2 / 2)
    theta_1s = -(FORWARD_FLAPPING + blowback * np.cos(sideslip))
    # the advancing side is the right one of a counter-clockwise rotor
    theta_1c = np.radians(1.0) - model.hand * blowback * np.sin(sideslip)

    # sticks that give this pitch, the pedal at mid travel
    matrix, offset = np.asarray(data["rigging"]["matrix"]), np.asarray(data["rigging"]["offset"])
    pedal = 0.5 * INCH * model.aircraft.stick_travel_in[3]
    wanted = np.array([theta_1c, theta_1s, theta_0]) - offset[:3] - matrix[:3, 3] * pedal
    x[:3], x[3] = np.linalg.solve(matrix[:3, :3], wanted), pedal
    turning = np.arctan(lateral)
    x[ROLL] = c.bank_share * (c.bank or 0.0) + (1.0 - c.bank_share) * (turning + drag * np.sin(sideslip))
    x[PITCH] = FORWARD_FLAPPING + data["rotor"]["shaft_tilt_forward"] - drag * np.cos(sideslip)
    x[YAW] = -sideslip
    path = {"speed": c.speed, "flight_path": c.flight_path, "turn_rate": c.turn_rate}
    x[layout.path : inflow] = [path[part] for part in model.question.free]
    if inflow < tail:
        x[inflow] = lambda_0
    if tail < modes[0]:
        x[tail] = tail_inflow(
            model, thrust * (lambda_0 + climb) * model.tip_speed, model.side * flat * np.sin(sideslip)
        )
    flap = modes[rotor["flap_mode"]]
    x[flap] = np.radians(3.0) / rotor["flap_per_coordinate"]
    x[flap + 1] = FORWARD_FLAPPING / rotor["flap_per_coordinate"]
    lag_mode = int(np.argmin(rotor["frequencies"]))
    lead = rotor["root_lead_slope"][lag_mode]
    if abs(lead) > 0:
        x[modes[lag_mode]] = -np.radians(3.0) / lead
    return x


def tail_inflow(model: Model, power: float, to_the_right: float) -> float:
    """Induced inflow of the tail rotor that holds the torque of `power` [W], flying `to_the_right` [m/s].

    Where the tail moves into its own wake, by the curve of tests; beyond it is a windmill.
    """
    tail = model.data["tail_rotor"]
    tip_speed = tail["omega"] * tail["radius"]
    force = max(power, 0.0) / model.omega / abs(tail["position"][0])
    ct = force / (model.density * np.pi * tail["radius"] ** 2 * tip_speed**2)
    forward = model.condition.speed * np.cos(model.condition.flight_path) / tip_speed
    return _core.descent_inflow(max(ct, 1e-4), min(forward, 0.3) ** 2, -to_the_right / tip_speed)
