# SPDX-License-Identifier: MIT OR Apache-2.0
"""Monitors of the aircraft: sticks against stops, power against stated limits, attitude and sideslip found, the ground."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .monitor import Monitor, since

STICK_SLACK = 1e-3
"""Inches beyond a stop that are not beyond it."""
CONTROL_MARGIN = 0.05
"""Share of the travel left to a stop below which a result says so."""
LARGE_ATTITUDE = np.radians(30.0)
"""Roll or pitch found by a trim from which it says so: half of the weight then acts along the airframe, not through the rotor."""
LARGE_SIDESLIP = np.radians(20.0)
"""Sideslip found by a trim from which it says so: fuselage data are measurements to about there, estimates beyond."""
GROUND_SLACK = 1.0
"""Sinking [m] below the ground that is not told: less than what an altitude stands for."""


def sticks(stick: Mapping[str, Any], travel: Sequence[float], time: np.ndarray | None = None) -> list[Monitor]:
    """Each stick against its stops, and the smallest distance to any stop; all in inches from the lower stop.

    stick: position by name, numbers or (n_times,), in the order of `travel`.
    """
    margins, texts = [], []
    for (name, position), full in zip(stick.items(), travel, strict=True):
        margin = np.minimum(position, full - np.asarray(position))
        margins.append(margin)
        worst = int(np.argmin(margin))
        at, left = float(np.ravel(position)[worst]), float(np.min(margin))
        stop = 0.0 if at < 0.5 * full else full
        if left < -STICK_SLACK:
            first = since(time, np.asarray(margin) < -STICK_SLACK)
            texts.append(f"{name} at {at:.2f} in, beyond its stop at {stop:.4g} in{first}")
        elif left < CONTROL_MARGIN * full:
            first = since(time, np.asarray(margin) < CONTROL_MARGIN * full)
            texts.append(
                f"{name} at {at:.2f} in, {100 * max(left, 0.0) / full:.1f} % of its travel from its stop at {stop:.4g} in"
                f"{first}"
            )
    least = np.min(margins, axis=0)
    left = float(np.min(least))
    closest = f"{left:.2f} in from a stop at least" if left >= 0.0 else f"{-left:.2f} in beyond a stop"
    warnings: list[str | None] = [*texts] or [None]
    return [
        Monitor("stick margin", closest, {"stick_margin": least}, warnings[0]),
        *(Monitor("stick margin", closest, warning=text) for text in warnings[1:]),
    ]


def power(engine: Any, limit: float | None, time: np.ndarray | None = None) -> Monitor:
    """Engine power [W], a number or (n_times,), against the aircraft's stated limit; None where none is stated."""
    most = float(np.max(engine))
    stated = "no limit stated" if limit is None else f"limit {limit / 1e3:.0f} kW"
    warning = None
    if limit is not None and most > limit:
        first = since(time, np.asarray(engine) > limit)
        warning = f"power {most / 1e3:.0f} kW, beyond the aircraft's {limit / 1e3:.0f} kW{first}"
    return Monitor("power at most", f"{most / 1e3:.0f} kW ({stated})", warning=warning)


def torque(shaft: Any, limit: float | None, time: np.ndarray | None = None) -> list[Monitor]:
    """Torque of the main rotor's shaft [N m], a number or (n_times,), where a limit is stated; none where it is not."""
    if limit is None:
        return []
    most = float(np.max(shaft))
    warning = None
    if most > limit:
        first = since(time, np.asarray(shaft) > limit)
        warning = f"torque {most / 1e3:.2f} kN m, beyond the aircraft's {limit / 1e3:.2f} kN m{first}"
    return [Monitor("torque at most", f"{most / 1e3:.2f} kN m (limit {limit / 1e3:.2f} kN m)", warning=warning)]


def rotor_speed(omega: Any, limits: tuple[float, float] | None) -> list[Monitor]:
    """Rotor speed [rad/s], a number or (n_times,), where the aircraft states the lowest and the highest; else none."""
    if limits is None:
        return []
    low, high = float(np.min(omega)), float(np.max(omega))
    span = f"{low:.4g}" if low == high else f"{low:.4g} to {high:.4g}"
    stated = f"{span} rad/s (limits {limits[0]:.4g} to {limits[1]:.4g})"
    outside = not limits[0] <= low <= high <= limits[1]
    return [Monitor("rotor speed", stated, warning=f"rotor speed {stated}: outside" if outside else None)]


def tail_rotor(loading: float | None, limit: float, ring: str | None = None) -> Monitor:
    """C_T/sigma of the tail rotor, whose thrust formula knows no stall, against `limit`; None without a tail rotor.

    ring: what is said of its axial flow, if anything.
    """
    if loading is None:
        return Monitor("tail rotor", "none")
    warning = None
    if abs(loading) > limit:
        warning = f"tail rotor at C_T/sigma {loading:.3f}, beyond the {limit:g} that blades without stall can have"
    if ring is not None:
        warning = ring if warning is None else f"{warning}; {ring}"
    return Monitor("tail rotor", f"C_T/sigma {loading:.3f}", warning=warning)


def attitude(roll: float, pitch: float, asked_bank: bool) -> Monitor:
    """Roll and pitch [rad] that a trim found; `asked_bank`: the bank is that of a turn or was given."""
    named = {"pitch attitude": pitch} if asked_bank else {"roll": roll, "pitch attitude": pitch}
    large = [f"{name} {np.degrees(angle):.1f} deg" for name, angle in named.items() if abs(angle) > LARGE_ATTITUDE]
    warning = None
    if large:
        warning = f"{' and '.join(large)} in steady flight, beyond {np.degrees(LARGE_ATTITUDE):.0f} deg"
    return Monitor("attitude", f"roll {np.degrees(roll):.1f} deg, pitch {np.degrees(pitch):.1f} deg", warning=warning)


def sideslip(velocity: Sequence[float], asked: bool) -> Monitor:
    """Sideslip atan2(v, u) [rad] of a trim, wind from the right +; `asked`: it was given and not found."""
    angle = float(np.arctan2(velocity[1], velocity[0])) if np.hypot(velocity[0], velocity[1]) > 1e-6 else 0.0
    warning = None
    if not asked and abs(angle) > LARGE_SIDESLIP:
        warning = (
            f"sideslip of {np.degrees(angle):.1f} deg found, beyond {np.degrees(LARGE_SIDESLIP):.0f} deg: give a bank or a "
            f"sideslip instead"
        )
    return Monitor("sideslip", f"{np.degrees(angle):.2f} deg", {"sideslip": angle}, warning)


def ground(down: np.ndarray, start_altitude: float, time: np.ndarray) -> Monitor:
    """Height of the body origin above the ground [m] over a flight, and whether it sinks below it.

    down (n_times,) [m] below the start; start_altitude [m] above sea level. The ground is sea level; a flight that starts there
    or lower has it at its start. It is not felt: no contact, no ground effect.
    """
    level = min(0.0, start_altitude)
    height = start_altitude - level - np.asarray(down)
    lowest = float(height.min())
    warning = None
    if lowest < -GROUND_SLACK:
        what = "sea level" if start_altitude > 0.0 else "where it started, taken as the ground"
        warning = f"the aircraft sinks {-lowest:.1f} m below {what}{since(time, height < -GROUND_SLACK)}: the ground is not felt"
    return Monitor("height above ground", f"{lowest:.1f} m at least", {"height": height}, warning)
