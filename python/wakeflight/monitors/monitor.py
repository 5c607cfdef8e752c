# SPDX-License-Identifier: MIT OR Apache-2.0
"""What one monitor says of a result, and where on the disk or in time it says it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Monitor:
    """One quantity watched: its values for the Dataset, its line in tables, and what must be said about it.

    values: by the name of the variable, numbers of a steady result, arrays over time of a flight. warning: beyond a limit of
    the aircraft or of the model, the number stands. failure: beyond what physics allows, the number is no answer.
    """

    label: str
    text: str
    values: Mapping[str, Any] = field(default_factory=dict)
    warning: str | None = None
    failure: str | None = None


@dataclass(frozen=True)
class Places:
    """Where the values of a field lie: a map (azimuth, station) of a steady result, or a history (time, blade, station).

    station (n_stations,) r/R; azimuth (n_azimuths,) or (n_times, n_blades) [rad]; time (n_times,) [s], None for a map.
    """

    station: np.ndarray
    azimuth: np.ndarray
    time: np.ndarray | None = None

    def over_disk(self, values: np.ndarray, reduce: Any = np.max) -> np.ndarray:
        """`values` reduced over the disk: a number of a map, (n_times,) of a history."""
        found: np.ndarray = reduce(values, axis=(0, 1) if self.time is None else (1, 2))
        return found

    def mean_over_disk(self, values: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """Mean over azimuth or blades of `values` weighted along the stations: a number, or (n_times,)."""
        along = np.asarray(values @ weights)
        found: np.ndarray = along.mean() if self.time is None else along.mean(axis=1)
        return found

    def worst(self, values: np.ndarray, bound: Any) -> tuple[float, float, str]:
        """Of the disk whose largest of `values` is largest against `bound` (a number, or (n_times,)): value, bound, place."""
        if self.time is None:
            return float(values.max()), float(bound), self.of(values)
        k = int(np.argmax(self.over_disk(values) / bound))
        there = Places(self.station, self.azimuth[k : k + 1], self.time[k : k + 1])
        return float(values[k].max()), float(np.broadcast_to(bound, self.time.shape)[k]), there.of(values[k : k + 1])

    def of(self, values: np.ndarray) -> str:
        """Place of the largest of `values`, in words."""
        index = np.unravel_index(int(np.argmax(values)), values.shape)
        psi = np.degrees(self.azimuth[index[:-1]]) % 360.0
        where = f"psi = {psi:.0f} deg, r/R = {self.station[index[-1]]:.3f}"
        if self.time is None:
            return where
        return f"t = {self.time[index[0]]:.3f} s, blade {index[1] + 1} at {where}"


def warnings(monitors: Iterable[Monitor]) -> tuple[str, ...]:
    """What is to be warned of."""
    return tuple(each.warning for each in monitors if each.warning is not None)


def failures(monitors: Iterable[Monitor]) -> tuple[str, ...]:
    """What makes the result no answer."""
    return tuple(each.failure for each in monitors if each.failure is not None)


def variables(monitors: Iterable[Monitor]) -> dict[str, Any]:
    """Variables of the Dataset by name."""
    return {name: value for each in monitors for name, value in each.values.items()}


def lines(monitors: Iterable[Monitor]) -> list[tuple[str, str]]:
    """Lines of a table: each monitor once."""
    return list(dict.fromkeys((each.label, each.text) for each in monitors))


def since(time: np.ndarray | None, beyond: np.ndarray) -> str:
    """When a history is first `beyond` (n_times,), as `, from t = 0.48 s`; nothing for a steady result."""
    return "" if time is None else f", from t = {time[int(np.argmax(beyond))]:.2f} s"
