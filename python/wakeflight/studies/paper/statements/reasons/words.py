# SPDX-License-Identifier: MIT OR Apache-2.0
"""Words that follow from numbers: which is larger, what may be concluded. Nothing is said that other data would belie."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ... import quantities as q
from ..verdict import RESOLUTION

if TYPE_CHECKING:
    import xarray as xr

    Runs = Mapping[str, xr.Dataset]

D, R = "arrested-descent", "roll-reversal"
NAMES = {"dynamic": "dynamic inflow", "relaxation": "relaxation", "time-marching": "time marching"}


def against(x: float, y: float, more: str, less: str, equal: str) -> str:
    """The word for `x` beside `y`; a difference below the resolution of the statements is none."""
    if abs(x - y) <= RESOLUTION * max(abs(x), abs(y)):
        return equal
    return more if x > y else less


def exceeds(x: float, y: float) -> bool:
    """Whether `x` is the larger by more than the resolution."""
    return against(x, y, "more", "less", "equal") == "more"


def where(premise: bool, conclusion: str, otherwise: str = "") -> str:
    """A conclusion, where the data bear its premise."""
    return conclusion if premise else otherwise


def most(values: Mapping[str, float]) -> str:
    """Name of the model with the largest value."""
    return NAMES[max(values, key=lambda name: values[name])]


def least(values: Mapping[str, float]) -> str:
    """Name of the model with the smallest value."""
    return NAMES[min(values, key=lambda name: values[name])]


def listed(values: Mapping[str, float], form: str = ".4f") -> str:
    """Values by model: `0.0060 with relaxation, 0.0084 with time marching`."""
    return ", ".join(f"{value:{form}} with {NAMES[name]}" for name, value in values.items())


def at(run: xr.Dataset, name: str, seconds: float) -> float:
    """A history, averaged over a blade passage, at a time."""
    return float(np.interp(seconds, run.time.values, q.smoothed(run, name)))
