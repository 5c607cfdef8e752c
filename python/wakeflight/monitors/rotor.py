# SPDX-License-Identifier: MIT OR Apache-2.0
"""Monitors of the rotor: induced velocity, Mach number, angle of attack, stall, pitch, axial flow, vortices, inner solves."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..limits import StallAlongSpan, StallAngles, in_vortex_ring, reversed_flow, stalled
from .monitor import Monitor, Places, since

STALLED_SHARE = 0.05
"""Share of the disk beyond stall from which a result says so: the tables are of steady flow, dynamic stall is not modelled."""
SLOW = 0.3
"""Section speed over the tip speed below which stall is not counted: a dynamic pressure of 9 % of the tip's, and the surroundings
of the reversed flow, where angles of attack are large in any forward flight."""
LARGEST_PITCH = np.radians(60.0)
"""Largest blade pitch found [rad]: beyond 45 deg from its flow a section lifts less the more it is pitched (sin 2 alpha)."""
LARGE_DISPLACEMENT = 0.25
"""Motion of a wake node in a step over R from which a result says so: half of what the wake refuses."""


def induced_velocity(inflow: np.ndarray, usual: Any, bound: Any, places: Places) -> Monitor:
    """Largest induced velocity over the tip speed against what one cause can give (`usual`) and all together (`bound`).

    inflow: field as `places` says; usual, bound: numbers, or (n_times,).
    """
    size = np.abs(inflow)
    largest = places.over_disk(size)
    value, limit, where = places.worst(size, bound)
    text = f"{value:.3f} of the tip speed at {where} (motion can give {limit:.3f})"
    warning = failure = None
    if value > limit:
        failure = beyond_motion(value, limit, where)
    elif np.any(largest > usual):
        value, limit, where = places.worst(size, usual)
        warning = (
            f"induced velocity of {value:.3f} of the tip speed at {where}: more than momentum, one vortex or the section's own "
            f"near wake alone can give ({limit:.3f})"
        )
    values = {"inflow_max": largest, "inflow_bound": np.broadcast_to(bound, np.shape(largest))}
    return Monitor("largest inflow", text, values, warning, failure)


def beyond_motion(value: float, bound: float, where: str) -> str:
    """What is said of an induced velocity that nothing gives."""
    return (
        f"induced velocity of {value:.3g} of the tip speed at {where}: momentum and vortices of the largest lift give at most "
        f"{bound:.3g}"
    )


def mach_number(mach: np.ndarray, bound: Any, table_end: float, places: Places) -> Monitor:
    """Largest section Mach number against that of the tip in the wind (`bound`), and against the end of the section tables."""
    largest = places.over_disk(mach)
    value, limit, where = places.worst(mach, bound)
    peak, at = float(mach.max()), places.of(mach)
    warning = failure = None
    if value > limit:
        failure = faster_than_motion(value, limit, where)
    elif peak > table_end:
        first = since(places.time, largest > table_end)
        warning = (
            f"Mach number up to {peak:.2f}, beyond the {table_end:g} of the section tables (held there), at {at}{first}"
        )
    text = f"{peak:.3f} at {at} (tables to {table_end:g}, motion gives {float(np.max(bound)):.3f})"
    values = {"mach_max": largest, "mach_bound": np.broadcast_to(bound, np.shape(largest))}
    return Monitor("largest Mach number", text, values, warning, failure)


def faster_than_motion(value: float, bound: float, where: str) -> str:
    """What is said of a Mach number that nothing gives."""
    return f"section Mach number {value:.3g} at {where}: the blades' motion and the wind give at most {bound:.3g}"


def angle_of_attack(alpha: np.ndarray, places: Places) -> Monitor:
    """Smallest and largest angle of attack [rad]; the section tables cover the whole circle, so that none is beyond them."""
    low, high = places.over_disk(alpha, np.min), places.over_disk(alpha, np.max)
    text = f"{np.degrees(np.min(low)):.1f} to {np.degrees(np.max(high)):.1f} deg (tables: +-180 deg)"
    return Monitor("angle of attack", text, {"alpha_min": low, "alpha_max": high})


def stall(
    angles: StallAngles | StallAlongSpan,
    alpha: np.ndarray,
    mach: np.ndarray,
    weights: np.ndarray,
    tip_mach: float,
    places: Places,
    passage: int = 1,
) -> Monitor:
    """Share of the disk beyond the stall angle of its Mach number, either way, and share in reversed flow (beyond 90 deg).

    Stall is not counted in reversed flow, nor where a section is slower than `SLOW` of the tip, `tip_mach`. weights
    (n_stations,): shares of the disk area. passage: steps of a history in which the blades pass every azimuth once.
    """
    beyond = stalled(angles, alpha, mach, slow=SLOW * tip_mach)
    fields = beyond, beyond & (alpha < 0.0), reversed_flow(alpha)
    share, below, backward = (over_passage(places.mean_over_disk(each, weights), passage) for each in fields)
    most = float(np.max(share))
    warning = None
    if most > STALLED_SHARE:
        negative = float(np.ravel(below)[int(np.argmax(share))])
        how = f", {100 * negative:.1f} % at negative angles" if negative > 0.0 else ""
        warning = (
            f"{100 * most:.1f} % of the disk beyond stall{how}{since(places.time, np.asarray(share) > STALLED_SHARE)}: "
            f"steady section tables there, no dynamic stall"
        )
    text = f"{100 * most:.1f} % of the disk, {100 * float(np.max(backward)):.1f} % in reversed flow"
    return Monitor("beyond stall", text, {"stalled_share": share, "reversed_share": backward}, warning)


def over_passage(values: Any, steps: int) -> Any:
    """Mean of a history over its last `steps` values, fewer at its begin; a number as it is."""
    if np.ndim(values) == 0:
        return values
    total = np.concatenate([[0.0], np.cumsum(values)])
    end = np.arange(1, total.size)
    begin = np.maximum(end - steps, 0)
    return (total[end] - total[begin]) / (end - begin)


def pitch(found: dict[str, float], axial_angle: float, why: str) -> Monitor:
    """Pitch that was found against what a blade can do with: collective at 3/4 R from its flow, amplitude of the cyclic.

    found: `collective` (at 3/4 R) and `cyclic` [rad], those found and not given; axial_angle: of the flow at 3/4 R, climb +; why:
    what else is known of the solution.
    """
    angles = {name: angle - (axial_angle if name == "collective" else 0.0) for name, angle in found.items()}
    beyond = [
        f"{name} pitch of {np.degrees(found[name]):.0f} deg" for name in found if abs(angles[name]) > LARGEST_PITCH
    ]
    failure = None
    if beyond:
        failure = (
            f"{' and '.join(beyond)}, beyond {np.degrees(LARGEST_PITCH):.0f} deg from the flow, where more pitch gives less "
            f"lift: what was asked for is out of reach ({why})"
        )
    text = ", ".join(f"{name} {np.degrees(angle):.1f} deg" for name, angle in found.items()) or "given"
    return Monitor("pitch found", text, failure=failure)


def axial_flow(mu: Any, mu_z: Any, ct: Any, momentum: bool, time: np.ndarray | None = None) -> Monitor:
    """Descent of the disk along its axis against the vortex-ring range, half to twice the hover induced velocity of its thrust.

    mu, mu_z: speed of the hub in the disk plane and down the shaft over the tip speed; ct: thrust coefficient; numbers, or
    (n_times,). momentum: whether the inflow is dynamic, which follows a curve through tests there.
    """
    hover = np.sqrt(0.5 * np.abs(ct))
    # with thrust downward the air that comes from above is what a descent is otherwise
    descent = np.asarray(mu_z) * np.sign(ct)
    inside = np.array([in_vortex_ring(*each) for each in np.column_stack(np.broadcast_arrays(descent, mu, hover))])
    warning = None
    if inside.any():
        k = int(np.argmax(inside))
        ratio = float(np.ravel(descent)[k] / np.ravel(hover)[k])
        what = (
            "dynamic inflow follows a curve through scattered tests there, and knows nothing of its unsteadiness"
            if momentum
            else "what a free wake gives there depends on the turns kept"
        )
        warning = (
            f"the disk descends along its axis at {ratio:.2f} times the hover induced velocity{since(time, inside)}, in the "
            f"vortex-ring range of 0.5 to 2: {what}"
        )
    text = f"descent along the shaft {_span(mu_z)}, hover induced velocity {_span(hover)} of the tip speed"
    return Monitor("axial flow", text, {"mu_z": mu_z, "hover_inflow": hover}, warning)


def _span(value: Any) -> str:
    """A number, or the two ends of a history; what rounds to zero has no sign."""
    ends = [f"{round(float(each), 4) + 0.0:.4f}" for each in (np.min(value), np.max(value))]
    return ends[0] if np.ndim(value) == 0 else " to ".join(ends)


def vortex_distance(distance: Any) -> Monitor:
    """Smallest distance of a tip vortex from a blade, in its core radii: how much the loads rest on the core.

    Told, not warned of: in any forward flight an old filament crosses a blade within its core.
    """
    return Monitor(
        "vortex from blade", f"{float(np.min(distance)):.3g} core radii at least", {"vortex_blade_distance": distance}
    )


def node_motion(step: Any, radius: float, time: np.ndarray | None = None) -> Monitor:
    """Largest motion of a wake node in a step, `step` [m] (a number, or (n_times,))."""
    share = np.asarray(step) / radius
    most = float(share.max())
    warning = None
    if most > LARGE_DISPLACEMENT:
        warning = (
            f"wake nodes moved up to {most:.2f} R in a step, more than {LARGE_DISPLACEMENT:g} R: the azimuth step is too "
            f"coarse for this wake{since(time, share > LARGE_DISPLACEMENT)}"
        )
    return Monitor("wake node motion", f"{most:.3f} R in a step at most", {"max_displacement": step}, warning)


def unrenewed(count: int, renewals: int) -> Monitor:
    """Renewals of a relaxed wake in flight in which inflow and circulation did not agree."""
    text = f"inflow and circulation do not agree in {count} of {renewals} renewals of the wake"
    return Monitor("unsettled renewals", f"{count} of {renewals}", warning=text if count else None)
