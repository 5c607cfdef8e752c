# SPDX-License-Identifier: MIT OR Apache-2.0
"""Inputs that engineers fly: steps, doublets, 3-2-1-1, frequency sweeps, recorded sticks; each a manoeuvre like any other.

Amplitudes are lengths of stick about trim, times text with units. A hand takes `rise` to move from one level to the next.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .arguments import checked
from .errors import InputError
from .maneuver_files import recorded
from .maneuvers import Maneuver
from .stick_histories import Corner
from .sticks import STICKS
from .units import quantity

SAMPLES = 24
"""Corners of a period of a frequency sweep: straight pieces between them are within 0.9 % of its amplitude of the sine."""

LONGEST = 10000.0
"""Longest time [s] that is taken."""


@checked
def step(
    stick: str, amplitude: Any, at: Any = "1 s", rise: Any = "0.1 s", seconds: Any = "5 s", back: Any = None
) -> Maneuver:
    """A step of `stick` by `amplitude` ("0.5 in") at time `at`, held; back: time at which it returns (a pulse)."""
    first, ramp = _time("at", at, 0.0), _time("rise", rise)
    levels = [(first, _amplitude(amplitude))]
    if back is not None:
        levels.append((_time("back", back), 0.0))
    return _stepped("step" if back is None else "pulse", stick, levels, ramp, _time("seconds", seconds))


@checked
def doublet(
    stick: str, amplitude: Any, at: Any = "1 s", width: Any = "1 s", rise: Any = "0.1 s", seconds: Any = "6 s"
) -> Maneuver:
    """A doublet: `stick` by `amplitude` for `width`, by as much to the other side for as long, and back to trim."""
    return _multistep("doublet", (1,) * 2, stick, amplitude, at, width, rise, seconds)


@checked
def three_two_one_one(
    stick: str, amplitude: Any, at: Any = "1 s", width: Any = "0.5 s", rise: Any = "0.1 s", seconds: Any = "8 s"
) -> Maneuver:
    """A 3-2-1-1: steps to alternating sides that last three, two, one and one times `width`."""
    return _multistep("3-2-1-1", (3, 2, 1, 1), stick, amplitude, at, width, rise, seconds)


@checked
def frequency_sweep(
    stick: str,
    amplitude: Any,
    low: Any = "0.3 rad/s",
    high: Any = "12 rad/s",
    seconds: Any = "60 s",
    at: Any = "1 s",
    fade: Any = "2 s",
) -> Maneuver:
    """A frequency sweep: a sine of `amplitude` whose frequency rises from `low` to `high` (rad/s or Hz), as many seconds per
    octave.

    Its phase is w T/ln(high/low) ((high/low)^(t/T) - 1), w = low. The amplitude grows from zero within `fade` and falls to it
    within the last `fade` of the `seconds`.
    """
    first, whole, soft = _time("at", at, 0.0), _time("seconds", seconds), _time("fade", fade, 0.0)
    span = whole - first
    w_low, w_high = _frequency("low", low), _frequency("high", high)
    if not w_low < w_high:
        raise InputError.of("high", high, f"must be above low = {low}")
    if not 2.0 * soft < span:
        raise InputError.of("fade", fade, f"must be less than half of the {span:g} s that are swept")
    inches = _amplitude(amplitude)
    octave = math.log(w_high / w_low) / span
    last = w_low / octave * math.expm1(octave * span)
    count = math.ceil(last / (2.0 * math.pi / SAMPLES))
    corners: list[Corner] = [(0.0, 0.0)] if first > 0.0 else []
    for k in range(count + 1):
        phase = min(k * 2.0 * math.pi / SAMPLES, last)
        t = math.log1p(phase * octave / w_low) / octave
        share = 1.0 if soft == 0.0 else max(0.0, min(1.0, t / soft, (span - t) / soft))
        corners.append((first + t, share * inches * math.sin(phase)))
    corners[-1] = (whole, 0.0)
    return Maneuver("frequency sweep", {_stick(stick): corners}, seconds=whole)


@checked
def recorded_sticks(
    path: str | Path, about: str = "first", join: Any = "0.5 s", seconds: Any = None, name: str | None = None
) -> Maneuver:
    """Sticks that were recorded, a CSV file of any rate: `time_s`, `lateral_in`, ... with the unit behind the name.

    about: `first`: inches count from the first sample, which is trim; `trim`: they are about trim already, 0 at first;
    `stop`: they are where the stick was, and from trim it goes there within `join`. seconds: how long is flown, by default as
    long as the record.
    """
    length = None if seconds is None else _time("seconds", seconds)
    return recorded(Path(path), about, _time("join", join), length, name)


def _stick(stick: str) -> str:
    if stick not in STICKS:
        raise InputError.choice("stick", stick, STICKS)
    return stick


def _amplitude(amplitude: Any) -> float:
    inches = quantity(amplitude, "in", "amplitude")
    if not 0.0 < abs(inches) <= 100.0:
        raise InputError.of("amplitude", amplitude, "must not be 0 in, and at most 100 in")
    return inches


def _time(name: str, value: Any, low: float = 1e-3) -> float:
    """A time [s]."""
    seconds = quantity(value, "s", name)
    if not low <= seconds <= LONGEST:
        raise InputError.of(name, value, f"must lie between {low:g} s and {LONGEST:g} s")
    return seconds


def _frequency(name: str, value: Any) -> float:
    """A frequency [rad/s], given so or in Hz."""
    try:
        found = quantity(value, "rad/s", name)
    except InputError:
        found = 2.0 * math.pi * quantity(value, "Hz", name)
    if not 1e-3 <= found <= 1e3:
        raise InputError.of(name, value, "must lie between 0.001 and 1000 rad/s")
    return found


def _multistep(
    name: str, lasting: Sequence[int], stick: str, amplitude: Any, at: Any, width: Any, rise: Any, seconds: Any
) -> Maneuver:
    """Steps to alternating sides that last multiples of `width`, and back."""
    t, unit, inches = _time("at", at, 0.0), _time("width", width), _amplitude(amplitude)
    levels = []
    for k, times in enumerate(lasting):
        levels.append((t, inches if k % 2 == 0 else -inches))
        t += times * unit
    return _stepped(name, stick, [*levels, (t, 0.0)], _time("rise", rise), _time("seconds", seconds))


def _stepped(name: str, stick: str, levels: Sequence[tuple[float, float]], rise: float, seconds: float) -> Maneuver:
    """A stick that goes to each level from its time on, within `rise`."""
    corners: list[Corner] = [(0.0, 0.0)] if levels[0][0] > 0.0 else []
    before = 0.0
    for k, (t, level) in enumerate(levels):
        if k and not t - levels[k - 1][0] >= rise:
            raise InputError.of(
                "rise", f"{rise:g} s", f"must be at most the {t - levels[k - 1][0]:g} s that a level lasts"
            )
        if not corners or t > corners[-1][0]:
            corners.append((t, before))
        corners.append((t + rise, level))
        before = level
    if corners[-1][0] > seconds:
        raise InputError.of(
            "seconds", f"{seconds:g} s", f"must be at least {corners[-1][0]:g} s, where the stick comes to rest"
        )
    return Maneuver(name, {_stick(stick): corners}, seconds=seconds)
