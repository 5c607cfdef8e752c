# SPDX-License-Identifier: MIT OR Apache-2.0
"""A measured or computed field of velocity: an airwake, the lee of a hill, a survey."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from ..arguments import checked
from ..errors import InputError
from ..units import convert, quantity
from .kinds import Wind

if TYPE_CHECKING:
    import xarray as xr

OUTSIDE = ("nearest", "zero")
AXES = {"time": "s", "x": "m", "y": "m", "z": "m"}
"""Coordinates of a field in the order they are kept, and their units."""
COMPONENTS = ("u", "v", "w")


class WindField(Wind):
    """Velocities u, v, w on x, y, z, and on time where they change: linear in each between the values.

    source: an xarray.Dataset, or a NetCDF file of one; every coordinate and variable with its `units`. x, u: along `heading`
    (clockwise from north); y, v: to the right of it; z, w: down, or up where z has `positive = "up"`. origin: where in the field,
    in its own x, y, z, the flight begins; speed: at which the field moves along its heading, a ship's. outside: beyond its edges
    the `nearest` value or `zero`; `beyond` counts the points asked there. The rotor does not change the field.
    """

    kind: ClassVar[str] = "field"

    @checked
    def __init__(
        self,
        source: Any,
        heading: str = "0 deg",
        origin: tuple[str, str, str] = ("0 m", "0 m", "0 m"),
        speed: str = "0 m/s",
        outside: str = "nearest",
    ):
        if outside not in OUTSIDE:
            raise InputError.choice("wind field outside", outside, OUTSIDE)
        self.heading, self.origin, self.speed, self.outside = heading, tuple(origin), speed, outside
        angle = quantity(heading, "rad", "wind field heading")
        along, across = math.cos(angle), math.sin(angle)
        # from north, east, down to the axes of the field
        self._turn = np.array([[along, across, 0.0], [-across, along, 0.0], [0.0, 0.0, 1.0]])
        self._start = np.array([quantity(each, "m", "wind field origin") for each in self.origin])
        self._pace = np.array([quantity(speed, "m/s", "wind field speed"), 0.0, 0.0])
        self.beyond = 0
        """Points asked beyond the edges so far."""
        match source:
            case str() | Path():
                self.file: str | None = str(source)
                self._read(_opened(Path(source)))
            case _:
                self.file = None
                self._read(source)

    def _read(self, field: xr.Dataset) -> None:
        """Coordinates and velocities in SI, x forward, y right, z down."""
        try:
            names = [name for name in AXES if name in field["u"].dims]
            missing = [name for name in ("x", "y", "z") if name not in names]
            arrays = [field[name].transpose(*names) for name in COMPONENTS]
            edges = [field[name] for name in names]
        except (KeyError, ValueError, TypeError, AttributeError) as reason:
            said = "must have u, v, w, each on x, y, z, or on time besides"
            raise InputError.of("wind field", f"{type(reason).__name__}: {reason}", said, self.file) from reason
        if missing:
            raise InputError.of("wind field", ", ".join(missing), "must be coordinates of u, v, w", self.file)
        self._edges = [self._in_si(edge, AXES[name]) for name, edge in zip(names, edges, strict=True)]
        for name, values in zip(names, self._edges, strict=True):
            said = "must be two values or more that ascend"
            if values.size < 2:
                raise InputError.of(f"wind field {name}", f"{values.size} values", said, self.file)
            falls = np.flatnonzero(~(np.diff(values) > 0.0))
            if falls.size:
                pair = f"{values[falls[0]]:g} before {values[falls[0] + 1]:g}"
                raise InputError.of(f"wind field {name}", pair, f"{said}: sort the field by {name}", self.file)
        velocity = np.stack([self._in_si(array, "m/s") for array in arrays], axis=-1)
        if edges[-1].attrs.get("positive") == "up":
            self._edges[-1] = -self._edges[-1][::-1]
            velocity = velocity[..., ::-1, :] * np.array([1.0, 1.0, -1.0])
        self._changes = "time" in names
        self._velocity = velocity

    def _in_si(self, array: xr.DataArray, unit: str) -> np.ndarray:
        name = f"wind field {array.name}"
        if "units" not in array.attrs:
            raise InputError.of(name, "no units", "must have the attribute units", self.file)
        values = np.asarray(array.values, dtype=float) * convert(1.0, str(array.attrs["units"]), unit)
        if not np.isfinite(values).all():
            raise InputError.of(name, "not finite", "must be finite numbers", self.file)
        return values

    def __call__(self, points: np.ndarray, t: float) -> np.ndarray:
        """At points (n, 3), linear between the values of the field."""
        asked = self._start + np.asarray(points) @ self._turn.T - self._pace * t
        places = [np.full(len(asked), t)] if self._changes else []
        places += list(asked.T)
        outside = np.zeros(len(asked), dtype=bool)
        cells, shares = [], []
        for values, place in zip(self._edges, places, strict=True):
            outside |= (place < values[0]) | (place > values[-1])
            within = np.clip(place, values[0], values[-1])
            cell = np.clip(np.searchsorted(values, within, side="right") - 1, 0, values.size - 2)
            cells.append(cell)
            shares.append((within - values[cell]) / (values[cell + 1] - values[cell]))
        found = np.zeros((len(asked), 3))
        for corner in itertools.product((0, 1), repeat=len(cells)):
            weight = np.ones(len(asked))
            for upper, share in zip(corner, shares, strict=True):
                weight = weight * (share if upper else 1.0 - share)
            at = tuple(cell + upper for cell, upper in zip(cells, corner, strict=True))
            found += weight[:, None] * self._velocity[at]
        self.beyond += int(outside.sum())
        if self.outside == "zero":
            found[outside] = 0.0
        turned: np.ndarray = found @ self._turn
        return turned

    def described(self) -> dict[str, Any]:
        """By its file; a field without one is told by its kind alone."""
        placed = {"heading": self.heading, "origin": list(self.origin), "speed": self.speed, "outside": self.outside}
        if self.file is None:
            return {"kind": Wind.kind, "name": "a field without a file", **placed}
        return {"kind": self.kind, "source": self.file, **placed}


def _opened(path: Path) -> xr.Dataset:
    """All of a NetCDF file."""
    import xarray as xr

    try:
        with xr.open_dataset(path) as file:
            return file.load()
    except (OSError, ValueError) as reason:
        raise InputError.of("wind field", str(path), f"cannot be read: {reason}") from reason
