# SPDX-License-Identifier: MIT OR Apache-2.0
"""Velocity induced by vortex filaments."""

import json
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .arguments import checked
from .errors import InputError

CORES = ("singular", "scully", "vatistas2", "rankine", "lamb_oseen", "rosenhead_moore")
CORE_DISTANCES = ("line", "segment")
METHODS = ("direct", "tree", "auto")

# the law multiplies up to sixteen lengths: beyond this they overflow
FARTHEST = 1e15


@checked
def induced_velocity(
    points: ArrayLike,
    filaments: Sequence[ArrayLike],
    circulation: ArrayLike,
    core_radius: ArrayLike,
    core: str = "vatistas2",
    core_distance: str = "line",
    method: str = "direct",
    tolerance: float = 1e-3,
    curvature_correction: bool = False,
) -> NDArray[np.float64]:
    """Velocity induced at points by filaments of straight segments (n, 3) [m/s].

    Of each segment, r1 and r2 the vectors from its ends to the point, c = r1 x r2, F the factor of its core,

        v = circulation / (4 pi) (|r1| + |r2|) / (|r1| |r2| (|r1| |r2| + r1 . r2)) F c

    A node gets no velocity from the segments it ends, wherever their cores are.

    Parameters
    ----------
    points (n, 3) [m]: where the velocity is wanted.
    filaments: sequence of (m, 3) arrays [m], nodes in order, at least two each; lengths may differ.
    circulation (n_segments,) [m2/s]: of each segment, filament after filament; positive in the nodes' order.
    core_radius (n_segments,) [m]: radius of peak swirl of each segment's core.
    core: singular (which takes no notice of the core radius), scully, vatistas2, rankine, lamb_oseen or
        rosenhead_moore.
    core_distance: what F is taken at, the distance to the infinite "line" through the segment or that to the
        "segment" itself.
        Without effect for singular and rosenhead_moore.
    method: "direct", every segment at every point, exact to rounding; "tree", far segments by multipoles and near ones
        exactly, for thousands of segments and more; "auto", the faster of the two (the tree from about 2000 points and
        2000 segments on, docs/numerics/performance.md).
        By the tree, a point's velocity depends within the tolerance on which other points are asked for.
    curvature_correction: whether points that are inner nodes of a filament, to the last bit, also get what the arc through
        them and their neighbours induces beyond its two chords a and b, along its binormal,
        kappa circulation / (4 pi) max(0, ln(2 sqrt(a b) / core) - 0.5772). The constant is that of vatistas2 cores; with
        core_distance = "segment" a vortex ring then moves at its speed within 0.1 %, for chords of three cores and more and steps
        up to 20 degrees.
    tolerance [-]: error that the tree is allowed, over the largest induced velocity at the points.
    """
    points = _vectors("points", points)
    if isinstance(filaments, np.ndarray) and filaments.ndim != 3:
        raise InputError(
            f"filaments: an array of shape {filaments.shape}; allowed is a sequence of (m, 3) arrays of nodes"
        )
    nodes = [_vectors(f"filaments[{i}]", filament) for i, filament in enumerate(filaments)]
    for i, filament in enumerate(nodes):
        if len(filament) < 2:
            raise InputError(f"filaments[{i}]: {len(filament)} nodes; allowed are 2 or more")
    n_segments = sum(len(filament) - 1 for filament in nodes)
    circulation = _values("circulation", circulation, n_segments)
    core_radius = _values("core_radius", core_radius, n_segments)
    if np.any(core_radius < 0.0):
        i_segment = int(np.argmax(core_radius < 0.0))
        raise InputError(f"core_radius[{i_segment}] = {core_radius[i_segment]:g}: allowed are 0 and more")
    _one_of("core", core, CORES)
    _one_of("core_distance", core_distance, CORE_DISTANCES)
    _one_of("method", method, METHODS)
    if curvature_correction and core != "vatistas2":
        raise InputError(f"core = {core!r}: allowed is vatistas2 with curvature_correction")
    if not 0.0 < tolerance < 1.0:
        raise InputError.of("tolerance", tolerance, "allowed are numbers above 0 and below 1")

    n_nodes = np.array([len(filament) for filament in nodes], dtype=np.int64)
    all_nodes = np.concatenate(nodes) if nodes else np.empty((0, 3))
    summed = method if method == "direct" else {method: {"tolerance": float(tolerance)}}
    chosen = {"core": core, "core_distance": core_distance, "method": summed}
    law = json.dumps(chosen | {"curvature_correction": curvature_correction})
    return _core.induced_velocity(points, all_nodes, n_nodes, (circulation, core_radius), law)


def _numbers(name: str, value: ArrayLike) -> NDArray[np.float64]:
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "iuf":
            raise TypeError
    except (TypeError, ValueError):
        raise InputError.of(name, value, "allowed is an array of real numbers") from None
    return np.ascontiguousarray(array, dtype=np.float64)


def _check_size(name: str, array: NDArray[np.float64]) -> None:
    bad = ~(np.abs(array) <= FARTHEST)
    if bad.any():
        index = tuple(int(i) for i in np.argwhere(bad)[0])
        limit = f"allowed are finite numbers up to {FARTHEST:g} in magnitude"
        raise InputError(f"{name}{list(index)} = {array[index]:g}: {limit}")


def _vectors(name: str, value: ArrayLike) -> NDArray[np.float64]:
    array = _numbers(name, value)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{name}: shape {array.shape}; allowed is (n, 3)")
    _check_size(name, array)
    return array


def _values(name: str, value: ArrayLike, n_segments: int) -> NDArray[np.float64]:
    array = _numbers(name, value)
    if array.shape != (n_segments,):
        raise InputError(f"{name}: shape {array.shape}; allowed is ({n_segments},), one value a segment")
    _check_size(name, array)
    return array


def _one_of(name: str, value: str, allowed: tuple[str, ...]) -> None:
    if value not in allowed:
        raise InputError.of(name, value, f"allowed are {', '.join(allowed)}")
