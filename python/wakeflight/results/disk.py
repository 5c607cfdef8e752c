# SPDX-License-Identifier: MIT OR Apache-2.0
"""Means and first harmonics over the rotor disk, with the one area weight that belongs to blade stations.

A station is the middle r of a blade element of width w. In a revolution the element sweeps
pi ((r + w/2)^2 - (r - w/2)^2) = 2 pi r w: r w over its sum is the element's share of the area between root cutout and tip
exactly, not by quadrature. What is constant over an element is averaged exactly; of what varies within one, an error of the
order of w^2 is left. The disk inboard of the root cutout has no stations and is no part of any mean (1 to 4 per cent of the
area of most rotors).
"""

from __future__ import annotations

import numpy as np


def element_widths(station: np.ndarray) -> np.ndarray:
    """Widths (n,) over R of the elements whose middles are the stations r/R (n,), the last of them ending at the tip.

    Edges follow from the tip inward: each station lies half-way between two.
    """
    widths = np.empty(len(station))
    edge = 1.0
    for k in range(len(station) - 1, -1, -1):
        widths[k] = 2.0 * (edge - station[k])
        edge = 2.0 * station[k] - edge
    if not np.all(widths > 0.0):
        raise ValueError(f"stations {np.asarray(station).tolist()} are no middles of elements that end at the tip")
    return widths


def area_weights(station: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Shares of the area between root cutout and tip that elements stand for (n,), summing to one; both lengths in one unit."""
    area = station * width
    found: np.ndarray = area / area.sum()
    return found


def disk_mean(field: np.ndarray, weights: np.ndarray) -> float:
    """Area mean of a field (..., n_stations) given at equal steps of azimuth."""
    return float(np.mean(field @ weights))


def first_harmonics(
    field: np.ndarray, psi: np.ndarray, station: np.ndarray, weights: np.ndarray
) -> tuple[float, float, float]:
    """f_0, f_1c, f_1s of a disk map (n_azimuths, n_stations): f ~ f_0 + (f_1c cos psi + f_1s sin psi) r/R, least squares by area.

    psi (n_azimuths,) [rad] at equal steps over a revolution, where the three shapes are orthogonal: f_0 is the area mean,
    f_1c = int(f r cos psi dA) / int(r^2 cos^2 psi dA), f_1s likewise with the sine. station (n_stations,) r/R.
    """
    values = [disk_mean(field, weights)]
    for shape in (np.cos(psi), np.sin(psi)):
        basis = np.outer(shape, station)
        values.append(float(np.sum(field * basis @ weights) / np.sum(basis**2 @ weights)))
    return values[0], values[1], values[2]
