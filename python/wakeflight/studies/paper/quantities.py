# SPDX-License-Identifier: MIT OR Apache-2.0
"""Numbers the statements are judged by: extremes of histories, means over parts of the disk, shapes of filaments.

Azimuths in degrees here, as the paper speaks of them: 0 over the tail, 90 advancing; radii over R.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...plotting.disk import TURN, difference, revolution_map
from ...results.disk import area_weights, element_widths

if TYPE_CHECKING:
    import xarray as xr

DEG = float(np.rad2deg(1.0))


def period(run: xr.Dataset) -> float:
    """Duration of a revolution [s]."""
    return TURN / float(run.attrs["omega"])


def smoothed(run: xr.Dataset, name: str) -> np.ndarray:
    """A history (time,) averaged over one blade passage, centred: without the vibration at blade frequency."""
    step = float(run.time[1] - run.time[0])
    n = round(period(run) / run.sizes["blade"] / step)
    values = run[name].values
    weights = np.full(n + 1, 1.0 / n)
    weights[[0, -1]] /= 2
    padded = np.concatenate([np.full(n // 2, values[0]), values, np.full(n - n // 2, values[-1])])
    return np.convolve(padded, weights, "valid")[: values.size]


def window(run: xr.Dataset, start: float = 0.0, end: float = np.inf) -> np.ndarray:
    """Which records lie between two times [s]."""
    found: np.ndarray = (run.time.values >= start - 1e-9) & (run.time.values <= end + 1e-9)
    return found


def extreme(
    run: xr.Dataset, name: str, sign: float, start: float = 0.0, end: float = np.inf, smooth: bool = True
) -> tuple[float, float]:
    """Largest change from trim in the direction of `sign`, as a positive number, and its time [s]."""
    values = smoothed(run, name) if smooth else run[name].values
    change = sign * (values - run[name].values[0])
    inside = np.flatnonzero(window(run, start, end))
    k = inside[np.argmax(change[inside])]
    return float(change[k]), float(run.time[k])


def excursion(run: xr.Dataset, name: str, start: float = 0.0, end: float = np.inf, smooth: bool = True) -> float:
    """Largest magnitude of the change from trim."""
    return max(extreme(run, name, sign, start, end, smooth)[0] for sign in (1.0, -1.0))


def correlation(a: xr.Dataset, b: xr.Dataset, name: str, end: float = np.inf) -> float:
    """Correlation coefficient of two histories over the time both have."""
    n = min(a.sizes["time"], b.sizes["time"])
    inside = window(a, 0.0, end)[:n]
    return float(np.corrcoef(a[name].values[:n][inside], b[name].values[:n][inside])[0, 1])


def rms_difference(a: xr.Dataset, b: xr.Dataset, name: str, end: float = np.inf) -> float:
    """Root mean square of the difference of two histories' changes from trim."""
    n = min(a.sizes["time"], b.sizes["time"])
    inside = window(a, 0.0, end)[:n]
    change = [run[name].values[:n][inside] - run[name].values[0] for run in (a, b)]
    return float(np.sqrt(np.mean((change[0] - change[1]) ** 2)))


def change_from_trim(run: xr.Dataset, name: str, revolution: float) -> xr.DataArray:
    """Disk map of a revolution less that of the first, which is flown at trim."""
    return difference(revolution_map(run, name, revolution), revolution_map(run, name, 1))


def weights(field: xr.DataArray) -> np.ndarray:
    """Shares of area of the points of a disk map (psi, station); see `results.disk`."""
    station = field["station"].values
    return np.broadcast_to(area_weights(station, element_widths(station)), field.shape)


def in_sector(
    field: xr.DataArray, azimuth: tuple[float, float] = (0.0, 360.0), radius: tuple[float, float] = (0.0, 1.0)
) -> np.ndarray:
    """Which points lie between two azimuths [deg], counted upward and across 0 if need be, and two radii over R."""
    psi = np.rad2deg(field[field.dims[0]].values)[:, None]
    station = field["station"].values
    width = azimuth[1] - azimuth[0]
    turned = (psi - azimuth[0]) % 360.0
    around = np.ones_like(turned, bool) if width >= 360.0 else turned <= width + 1e-9
    return around & (station >= radius[0]) & (station <= radius[1])


def sector_mean(
    field: xr.DataArray, azimuth: tuple[float, float] = (0.0, 360.0), radius: tuple[float, float] = (0.0, 1.0)
) -> float:
    """Area mean of a disk map over a sector."""
    area = np.where(in_sector(field, azimuth, radius), weights(field), 0.0)
    return float((field.values * area).sum() / area.sum())


def area_above(field: xr.DataArray, level: float) -> float:
    """Share of the swept area where a disk map exceeds a level."""
    area = weights(field)
    return float(area[field.values > level].sum() / area.sum())


def place_of_largest(field: xr.DataArray, absolute: bool = True) -> tuple[float, float, float]:
    """Azimuth [deg], radius over R and value where a disk map is largest (in magnitude)."""
    size = np.abs(field.values) if absolute else field.values
    k, j = np.unravel_index(int(np.argmax(size)), size.shape)
    psi = np.rad2deg(float(field[field.dims[0]][k])) % 360.0
    return psi, float(field["station"][j]), float(field.values[k, j])


def disk_rms(field: xr.DataArray) -> float:
    """Area-weighted root mean square of a disk map."""
    area = weights(field)
    return float(np.sqrt((field.values**2 * area).sum() / area.sum()))


def snapshot_at(run: xr.Dataset, revolution: float) -> int:
    """Number of the wake snapshot at a revolution."""
    return int(np.argmin(np.abs(run["snapshot_revolution"].values - revolution)))


def filament(run: xr.Dataset, revolution: float, blade: int = 0) -> np.ndarray:
    """Tip vortex of one blade at a revolution (n_ages, 3), over R."""
    found: np.ndarray = run["wake"].values[snapshot_at(run, revolution), blade] / float(run.attrs["radius"])
    return found


def first_turn_rms(a: np.ndarray, b: np.ndarray, n: int = 37) -> float:
    """Root mean square distance of two filaments over their first turn."""
    return float(np.sqrt(np.mean(np.sum((a[:n] - b[:n]) ** 2, axis=1))))


def axis_of(nodes: np.ndarray, n: int = 36) -> np.ndarray:
    """Centre line of a filament: mean of its nodes over one turn of age, moving along it (n_ages - n, 3)."""
    total = np.cumsum(np.concatenate([np.zeros((1, 3)), nodes]), axis=0)
    found: np.ndarray = (total[n:] - total[:-n]) / n
    return found


def bend(nodes: np.ndarray) -> float:
    """How far the centre line of a filament leaves its chord in the side view, over the length of the chord."""
    line = axis_of(nodes)[:, (0, 2)]
    chord = line[-1] - line[0]
    length = float(np.hypot(*chord))
    normal = np.array([-chord[1], chord[0]]) / length
    away = (line - line[0]) @ normal
    return float(away[np.argmax(np.abs(away))]) / length
