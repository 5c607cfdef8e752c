# SPDX-License-Identifier: MIT OR Apache-2.0
"""Maps over the rotor disk: binning of one revolution, and the drawing with the nose to the left.

x_h (aft) is drawn to the right and y_h (right) upward: nose left, azimuth counter-clockwise from the
right-hand side, advancing side at the top.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..results.disk import area_weights, element_widths, first_harmonics
from ..results.turns import revolutions
from . import style
from .histories import one_revolution_mean

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.colorbar import Colorbar
    from matplotlib.contour import QuadContourSet

TURN = 2 * np.pi
# azimuth refinement of the drawing only, so that the disk is round
REFINE = 4


def revolutions_flown(run: xr.Dataset) -> float:
    """Rotor revolutions from the start to the last recorded time."""
    return float(revolutions(run)[-1])


def revolution_map(run: xr.Dataset, name: str, revolution: float) -> xr.DataArray:
    """A (time, blade, station) variable over the disk (psi, station), of the turn ending at `revolution`.

    Every blade passes every azimuth once in it: the passages through one azimuth are fitted by a line in time
    and taken at the middle of the revolution, so the map belongs to one instant and has no seam, even while
    the flight changes. The azimuth step is that of the record.
    """
    import xarray as xr

    flown = revolutions(run)
    if not 1 - 1e-3 <= revolution <= flown[-1] + 1e-3:
        raise ValueError(f"revolution {revolution:g}: a map needs 1 to {flown[-1]:.2f}")
    step = float(np.median(np.diff(flown)))
    inside = (flown > revolution - 1 + step / 2) & (flown < revolution + step / 2)
    psi = run.azimuth.values[inside].ravel() % TURN
    values = run[name].values[inside].reshape(psi.size, -1)
    n_bins = max(round(1 / step), 1)
    first = float(psi[0] % (TURN / n_bins))
    bins = np.round((psi - first) / TURN * n_bins).astype(int) % n_bins
    when = np.repeat(flown[inside] - (revolution - 0.5), run.sizes["blade"])
    mean = _bin_fits(bins, n_bins, when, values)
    filled = np.flatnonzero(np.bincount(bins, minlength=n_bins))
    grid = first + TURN / n_bins * np.arange(n_bins)
    mean = _periodic(grid, grid[filled], mean[filled])
    attributes = {**run[name].attrs, "revolution": float(revolution)}
    return xr.DataArray(mean, {"psi": grid, "station": run.station.values}, ("psi", "station"), name, attributes)


def difference(field: xr.DataArray, reference: xr.DataArray) -> xr.DataArray:
    """Disk map `field` less `reference`, on the azimuths and stations of the reference (linear)."""
    psi, station = field[field.dims[0]].values, field[field.dims[1]].values
    at_psi, at_station = reference[reference.dims[0]].values, reference[reference.dims[1]].values
    values = _periodic(at_psi, psi, field.values)
    if station.shape != at_station.shape or not np.allclose(station, at_station):
        values = np.stack([np.interp(at_station, station, row) for row in values])
    return reference.copy(data=values - reference.values)


def harmonics(field: xr.DataArray) -> tuple[float, float, float]:
    """Mean and first harmonics of a disk map (psi, station): see `results.disk.first_harmonics`."""
    psi, station = field[field.dims[0]].values, field[field.dims[1]].values
    return first_harmonics(field.values, psi, station, area_weights(station, element_widths(station)))


def draw(
    axes: Axes,
    field: xr.DataArray,
    limits: tuple[float, float],
    cmap: str,
    n_levels: int = 26,
    extend: str = "neither",
) -> QuadContourSet:
    """One map (azimuth, station) as filled contours on the disk, nose to the left; `extend`: values beyond are filled too."""
    psi, station = field[field.dims[0]].values, field[field.dims[1]].values
    fine = np.linspace(0, TURN, REFINE * psi.size + 1)
    values = _periodic(fine, psi, field.values)
    x, y = station * np.cos(fine)[:, None], station * np.sin(fine)[:, None]
    # an even number of levels: no change is the white of the middle band, not the edge of two colours
    filled = axes.contourf(x, y, values, np.linspace(*limits, n_levels), cmap=cmap, extend=extend)
    around = np.linspace(0, TURN, 181)
    axes.plot(np.cos(around), np.sin(around), color=style.GREY, linewidth=0.7)
    axes.plot(station[0] * np.cos(around), station[0] * np.sin(around), color=style.GREY, linewidth=0.4)
    axes.set_aspect("equal")
    axes.set(xlim=(-1.2, 1.2), ylim=(-1.2, 1.2))
    axes.set_axis_off()
    return filled


def tidy(bar: Colorbar, label: str, limits: tuple[float, float]) -> None:
    """Colour bar with its label and few round ticks."""
    bar.set_label(label)
    bar.outline.set_linewidth(0.5)
    bar.set_ticks([tick for tick in MaxNLocator(4).tick_values(*limits) if limits[0] <= tick <= limits[1]])


def mark_directions(axes: Axes) -> None:
    """Say where the nose is and how the azimuth counts."""
    place: dict[str, Any] = {"fontsize": 6.5, "color": style.GREY}
    axes.text(-1.07, 0, "nose 180°", rotation=90, ha="right", va="center", **place)
    axes.text(1.07, 0, "tail ψ = 0", rotation=90, ha="left", va="center", **place)
    axes.text(0, 1.05, "advancing 90°", ha="center", va="bottom", **place)
    axes.text(0, -1.05, "retreating 270°", ha="center", va="top", **place)


def rows_of_maps(
    rows: Sequence[Sequence[xr.DataArray]],
    row_titles: Sequence[str],
    column_titles: Sequence[str],
    labels: Sequence[str],
    symmetric: Sequence[bool],
    title: str,
) -> Figure:
    """Maps in rows, one colour scale per row, of all values but for one per cent at either end, which are drawn as the ends.

    A `symmetric` row, and one whose values change sign for good, is drawn about zero in diverging colours. Rows that share a
    label share their colour scale too.
    """
    columns = max(len(row) for row in rows)
    figure = style.blank(2.15 * len(rows) + 0.5, width=max(2.15 * columns + 0.9, 5.2))
    grid = figure.subplots(len(rows), columns, squeeze=False)
    for i, row in enumerate(rows):
        together = [field.values for k, other in enumerate(rows) if labels[k] == labels[i] for field in other]
        about_zero = symmetric[i] or style.signed(*together)
        limits = style.levels(np.array(style.robust(*together)), symmetric=about_zero)
        cmap = style.DIVERGING if about_zero else style.SEQUENTIAL
        for j in range(columns):
            if j >= len(row):
                grid[i, j].set_visible(False)
                continue
            filled = draw(grid[i, j], row[j], limits, cmap, extend="both")
            mark_directions(grid[i, j])
            if i == 0:
                grid[i, j].set_title(column_titles[j])
        if row_titles[i]:
            grid[i, 0].text(-1.3, 0, row_titles[i], rotation=90, ha="right", va="center", fontsize=9)
        bar = figure.colorbar(filled, ax=grid[i, : len(row)].tolist(), shrink=0.85, pad=0.01)
        tidy(bar, labels[i], limits)
    figure.suptitle(title, fontsize=10, x=0.01, ha="left")
    return figure


def chosen_revolutions(run: xr.Dataset, revolutions: Sequence[float] | None, most: int = 3) -> list[float]:
    """Revolutions to draw: the given ones, else the eventful ones."""
    flown = revolutions_flown(run)
    last = int(np.floor(flown + 1e-3))
    if last < 1:
        raise ValueError(f"{flown:.2f} revolutions flown: a disk map needs one at least")
    if revolutions is not None:
        return list(revolutions)
    return eventful(run, last, most)


def eventful(run: xr.Dataset, last: int, most: int = 3) -> list[float]:
    """Up to `most` revolutions after the first, ascending: where the load stands farthest above and below its first, the last."""
    load = -run["force_z"].values
    mean = one_revolution_mean(run, load)
    if last < 2 or mean is None:
        return []
    whole = np.arange(2, last + 1)
    # a revolution that ends at n is centred half a turn before
    about = np.interp(whole - 0.5, revolutions(run), mean) - mean[0]
    peak, other = (int(whole[find(np.abs(about))]) for find in (np.argmax, np.argmin))
    ends = [int(whole[find(about)]) for find in (np.argmax, np.argmin)]
    # the smaller extreme only where it is one
    order = [peak, last, *(n for n in ends if abs(about[n - 2]) > 0.2 * np.abs(about).max()), (peak + last) // 2, other]
    order += [int(n) for n in np.round(np.linspace(2, last, most))]
    return sorted(float(n) for n in list(dict.fromkeys(order))[:most])


def _periodic(at: np.ndarray, psi: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Linear interpolation in azimuth, periodic, of values (psi, station)."""
    return np.stack([np.interp(at, psi, column, period=TURN) for column in values.T], axis=1)


def _bin_fits(bins: np.ndarray, n_bins: int, when: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Least-squares lines in time through the samples of each bin, taken at `when` = 0; (n_bins, station)."""
    count = np.maximum(np.bincount(bins, minlength=n_bins), 1)
    mean_when = np.bincount(bins, when, minlength=n_bins) / count
    late = when - mean_when[bins]
    spread = np.bincount(bins, late**2, minlength=n_bins)
    # one blade passes each azimuth once: no line through one point
    line = spread > 1e-9
    fits = []
    for column in values.T:
        mean = np.bincount(bins, column, minlength=n_bins) / count
        slope = np.bincount(bins, late * column, minlength=n_bins) / np.where(line, spread, 1.0)
        fits.append(mean - np.where(line, slope * mean_when, 0.0))
    return np.stack(fits, axis=1)
