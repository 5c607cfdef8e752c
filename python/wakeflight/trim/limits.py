# SPDX-License-Identifier: MIT OR Apache-2.0
"""What limits a trim, in the engineer's words: sticks, stall of the rotors, the vortex-ring range."""

from __future__ import annotations

import numpy as np

from .. import _core
from ..limits import in_vortex_ring, stall_along_span, stalled, sticks_beyond
from ..model import Model
from ..monitors.rotor import SLOW, STALLED_SHARE
from .equations import INCH
from .revolution import instants

TAIL_LOADING = 0.15
"""C_T/sigma of a tail rotor, a mean lift coefficient of 0.9, beyond which its thrust formula knows no stall but blades do."""
STICKS = ("lateral", "longitudinal", "collective", "pedal")


def limiting(
    model: Model, problem: _core.TrimProblem, x: np.ndarray, inflow_map: np.ndarray | None = None
) -> list[str]:
    """What is at or beyond a limit at the unknowns `x`; inflow_map (n_azimuths, n_stations): the one held, if any."""
    if not np.all(np.isfinite(x)):
        return []
    texts = []
    rotor = over_the_disk(model, problem, x, inflow_map)
    share, loading = rotor["stalled"], rotor["ct"] / model.aircraft.solidity
    if share > STALLED_SHARE:
        texts.append(f"main rotor: {100 * share:.0f} % of the disk beyond stall at C_T/sigma {loading:.3f}")
    texts += sticks_beyond(dict(zip(STICKS, (x[:4] / INCH).tolist(), strict=True)), model.aircraft.stick_travel_in)
    tail = tail_loading(model, problem, x)
    if model.data["tail_rotor"] is None:
        texts.append("no tail rotor: fin and sideslip alone balance the torque of the main rotor")
    if tail is not None and abs(tail) > TAIL_LOADING:
        texts.append(f"tail rotor: beyond its thrust at C_T/sigma {tail:.3f}")
    ring = tail_in_vortex_ring(tail_flow(model, problem, x))
    if ring is not None:
        texts.append(ring)
    hub, _ = model.core.hub(model.core.trim_state(problem, x, 0.0)[0])
    hover = np.sqrt(0.5 * abs(rotor["ct"])) * model.tip_speed
    if in_vortex_ring(-hub[2], np.hypot(hub[0], hub[1]), hover):
        answer = (
            "dynamic inflow is a mean of scattered tests" if model.inflow.is_dynamic else "the wake stays in the disk"
        )
        texts.append(
            f"axial flow in the vortex-ring range (descent at {-hub[2] / hover:.2f} of the induced velocity of hover): {answer}"
        )
    return texts


def over_the_disk(
    model: Model, problem: _core.TrimProblem, x: np.ndarray, inflow_map: np.ndarray | None
) -> dict[str, float]:
    """Share of the disk beyond stall, reversed flow and slow sections not counted, C_T, power [W]; means over a revolution."""
    seen = [out for _, out in instants(model, problem, x, inflow_map)]
    angles = stall_along_span(model.data["rotor"]["airfoil"], model.stations)
    slow = SLOW * model.tip_speed / model.speed_of_sound
    beyond = np.array([stalled(angles, out["alpha"], out["mach"], slow) for out in seen])
    return {
        "stalled": float(np.mean(beyond @ model.area_weights)),
        "ct": float(np.mean([out["ct"] for out in seen])),
        "power": float(np.mean([sum(out["power"]) for out in seen])),
    }


def tail_loading(model: Model, problem: _core.TrimProblem, x: np.ndarray) -> float | None:
    """C_T/sigma of the tail rotor by the momentum of its inflow, C_T = 2 lambda_i sqrt(mu^2 + lambda^2); None without one."""
    flow = tail_flow(model, problem, x)
    return None if flow is None else flow[0] / model.data["tail_rotor"]["solidity"]


def tail_flow(model: Model, problem: _core.TrimProblem, x: np.ndarray) -> tuple[float, float, float] | None:
    """C_T of the tail rotor, its motion along the axis into its own wake, and in its plane, over its tip speed.

    None without a tail rotor.
    """
    tail = model.data["tail_rotor"]
    if tail is None:
        return None
    at = model.core.trim_layout(problem).tail_inflow
    y, _ = model.core.trim_state(problem, x, 0.0)
    sin, cos = np.sin(tail["cant"]), np.cos(tail["cant"])
    # seen in the mirror where the tail rotor is the mirror image of its data
    velocity, rates = y[:3] * [1.0, model.side, 1.0], y[3:6] * [model.side, 1.0, model.side]
    velocity = (velocity + np.cross(rates, tail["position"])) / (tail["omega"] * tail["radius"])
    axial, across = velocity[1] * cos - velocity[2] * sin, velocity[1] * sin + velocity[2] * cos
    mu = float(np.hypot(velocity[0], across))
    return float(2 * x[at] * np.hypot(mu, x[at] + axial)), float(-axial), mu


def tail_in_vortex_ring(flow: tuple[float, float, float] | None) -> str | None:
    """What is said of a tail rotor (`tail_flow`) that moves into its own wake as fast as it sends it away."""
    if flow is None:
        return None
    ct, into, mu = flow
    hover = np.sqrt(0.5 * abs(ct))
    if not in_vortex_ring(into * np.sign(ct), mu, hover):
        return None
    return (
        f"tail rotor: moves into its own wake at {abs(into) / hover:.2f} of its induced velocity at rest, in the vortex-ring "
        "range of 0.5 to 2, where its momentum inflow has no answer"
    )
