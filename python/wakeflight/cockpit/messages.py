# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a page may say to the cockpit: text, one small JSON object each; whatever else comes is refused.

{"sticks": [0.5, 0.4, 0.3, 0.5], "run": 1}    lateral, longitudinal, collective, pedal: shares of travel from the stop
{"do": "pause"}                               pause, fly, step, restart, end
{"inflow": "dynamic"}                         go on with this inflow model
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass

from ..errors import InputError

LARGEST = 1024
"""Bytes of the longest message."""
ORDERS = ("pause", "fly", "step", "restart", "end")


@dataclass(frozen=True)
class Message:
    """One of the three; the others are None. run: number of the run that the sticks are for."""

    run: int = 0
    sticks: tuple[float, ...] | None = None
    do: str | None = None
    inflow: str | None = None


def read(text: str | bytes, models: tuple[str, ...]) -> Message:
    """The message in `text`; InputError for whatever is none. models: inflow models that can be asked for."""
    if isinstance(text, bytes):
        raise InputError.of("message", f"{len(text)} bytes", "must be text")
    if len(text) > LARGEST:
        raise InputError.of("message", f"{len(text)} characters", f"must have at most {LARGEST}")
    try:
        said = json.loads(text)
    except (ValueError, RecursionError) as reason:
        raise InputError.of("message", text, f"must be JSON ({type(reason).__name__})") from reason
    match said:
        case {"sticks": [_, _, _, _] as shares, "run": int(run)} if len(said) == 2:
            return Message(run, tuple(_share(each) for each in shares))
        case {"do": str(order)} if len(said) == 1 and order in ORDERS:
            return Message(do=order)
        case {"inflow": str(name)} if len(said) == 1 and name in models:
            return Message(inflow=name)
    allowed = f"sticks (four shares of travel) with run, do ({', '.join(ORDERS)}), inflow ({', '.join(models)})"
    raise InputError.of("message", text, f"allowed: one of {allowed}")


def _share(value: object) -> float:
    """A share of a stick's travel, held between its stops."""
    match value:
        case bool():
            pass
        case int() | float() if -1e6 < value < 1e6 and math.isfinite(value):
            return min(1.0, max(0.0, float(value)))
    raise InputError.of("sticks", value, "must be four finite numbers, shares of travel")
