# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rotor on a stand as a table to print."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..trim.table import HORSEPOWER
from ..views import text_table
from .dataset import scatter
from .solved import Solved

HOVERING = 1e-3
"""Advance ratio up to which the power of hover is what power is held against."""


def table(stand: Solved, assumed: Sequence[str], said: Sequence[tuple[str, str]]) -> str:
    """The result as a table to print; `said`: what monitors, notes and warnings say."""
    m, deg = stand.model, np.degrees
    c, lam = m.condition, stand.inflow_harmonics()
    scattered = f" (+- {scatter(stand)[0]:.6f} over {stand.averaged} revolutions)" if stand.averaged > 1 else ""
    sigma = m.aircraft.solidity
    velocity = c.velocity
    rows = [
        ("rotor", f"{m.aircraft.name}, {m.n_blades} blades, R = {stand.radius:.4g} m, solidity {sigma:.4f}"),
        (
            "condition",
            f"{c.regime(m.tip_speed)}, mu = {c.mu(m.tip_speed):.4f}, mu_z = {c.mu_z(m.tip_speed):+.4f} (descent +), "
            f"{np.linalg.norm(velocity):.2f} m/s, {m.omega * 30 / np.pi:.1f} rpm, {c.density:.4f} kg/m3",
        ),
        ("inflow, blade model", f"{m.inflow.name}, {m.blade_model}"),
        *(("assumed", text) for text in assumed),
        ("theta_0, 1c, 1s", f"{deg(stand.theta_0):.3f}, {deg(stand.theta_1c):.3f}, {deg(stand.theta_1s):.3f} deg"),
        ("C_T, C_T/sigma", f"{stand.ct:.6f}, {stand.ct / sigma:.4f}{scattered}"),
        # ideal power is that of hover: across a wind the ratio means nothing
        *(
            [("C_Q, figure of merit", f"{stand.cq:.7f}, {stand.figure_of_merit:.4f}")]
            if c.mu(m.tip_speed) < HOVERING
            else [("C_Q", f"{stand.cq:.7f}")]
        ),
        ("thrust, torque", f"{stand.thrust:.5g} N, {stand.torque:.5g} N m"),
        ("power", f"{stand.power / 1e3:.4g} kW ({stand.power / HORSEPOWER:.1f} hp)"),
        ("H force, side force", f"{stand.aero_force[0]:.4g} N aft, {stand.aero_force[1]:.4g} N right"),
        (
            "hub moments",
            f"{-stand.hub_moment[0]:.4g} N m right side down, {stand.hub_moment[1]:.4g} N m nose up",
        ),
        ("coning, beta_1c, 1s", f"{deg(stand.beta_0):.3f}, {deg(stand.beta_1c):.3f}, {deg(stand.beta_1s):.3f} deg"),
        ("lambda_0, 1c, 1s", ", ".join(f"{v:.5f}" for v in lam)),
        ("residual", f"{stand.residual:.1e}"),
        *said,
    ]
    return text_table(rows)
