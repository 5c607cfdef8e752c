# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a linear model takes the inflow for."""

from __future__ import annotations

from ..errors import InputError
from ..inflow import InflowModel

OF_DYNAMIC = ("dynamic", "frozen")
OF_WAKE = ("states", "identified", "quasi-static", "frozen")


def check_wake(asked: str | None, inflow: InflowModel) -> str:
    """The way in which inflow is linear, refused by name where there is none."""
    allowed = OF_DYNAMIC if inflow.is_dynamic else OF_WAKE
    if asked is None and inflow.is_dynamic:
        return OF_DYNAMIC[0]
    if asked is None or asked not in allowed:
        raise InputError.of(
            "wake", str(asked), f"must be said of a trim with inflow='{inflow.name}'; allowed: {', '.join(allowed)}"
        )
    return asked
