"""The tree beside a public fast multipole library, `fmm3dpy` (pip install fmm3dpy), which the program does not use itself.

    OMP_NUM_THREADS=1 python benchmarks/public_fmm.py

The library sums point sources: each segment is one vortex particle at its middle there (a curl of three potentials at the
same points), without a core and without the quadrature that near segments would need, so that it does less than the tree. Its
precision is the coarsest of those tried whose error against its own plain sum is no larger than the tree's against the direct
sum of segments.
"""

import time

import numpy as np
from measure import machine, table
from vortex import helices

import wakeflight as wf
from wakeflight import _core

SIZES = ((20, 4, 10.0), (20, 8, 2.5))
PRECISIONS = (3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5)
SAMPLED = 2000  # points at which errors are taken


def by_library(points: np.ndarray, middles: np.ndarray, strengths: np.ndarray, precision: float) -> np.ndarray:
    """Velocity of vortex particles (n, 3) at points: curl of the potentials of the three parts of their strengths."""
    import fmm3dpy

    found = fmm3dpy.lfmm3d(eps=precision, sources=middles.T, charges=strengths.T, targets=points.T, pgt=2, nd=3)
    slope = np.asarray(found.gradtarg)  # (part, derivative along, point)
    x, y, z = slope[:, 0], slope[:, 1], slope[:, 2]
    return np.column_stack([y[2] - z[1], z[0] - x[2], x[1] - y[0]])


def plainly(points: np.ndarray, middles: np.ndarray, strengths: np.ndarray) -> np.ndarray:
    """The same sum, pair by pair."""
    velocity = np.empty_like(points)
    for k, point in enumerate(points):
        way = point - middles
        velocity[k] = (np.cross(strengths, way) / (np.linalg.norm(way, axis=1) ** 3)[:, None]).sum(0) / (4.0 * np.pi)
    return velocity


def error_of(found: np.ndarray, exact: np.ndarray) -> float:
    """Largest difference over the largest velocity."""
    return float(np.linalg.norm(found - exact, axis=1).max() / np.linalg.norm(exact, axis=1).max())


def main() -> None:
    """Print the table."""
    _core.set_threads(1)
    rows = []
    for size in SIZES:
        points, nodes, circulation = helices(*size)
        radius = np.full(circulation.size, 0.02)
        starts, ends = (np.concatenate([f[s] for f in nodes]) for s in (slice(None, -1), slice(1, None)))
        middles, strengths = 0.5 * (starts + ends), circulation[:, None] * (ends - starts)
        some = np.random.default_rng(1).choice(len(points), min(SAMPLED, len(points)), replace=False)
        begun = time.process_time()
        tree = wf.induced_velocity(points, nodes, circulation, radius, method="tree")
        by_tree = time.process_time() - begun
        error = error_of(tree[some], wf.induced_velocity(points[some], nodes, circulation, radius))
        exact = plainly(points[some], middles, strengths)
        for precision in PRECISIONS:
            begun = time.process_time()
            found = by_library(points, middles, strengths, precision)
            taken = time.process_time() - begun
            its_error = error_of(found[some], exact)
            if its_error <= error:
                break
        cells = [f"{by_tree:.3g}", f"{error:.1e}", f"{precision:g}", f"{taken:.3g}", f"{its_error:.1e}"]
        rows.append([str(circulation.size), *cells, f"{taken / by_tree:.1f}"])
    head = ["segments", "tree [processor s]", "its error", "precision asked of the library", "library [processor s]"]
    print(f"Measured on: {machine()}.\n")
    print(table([*head, "its error", "library / tree"], rows))


if __name__ == "__main__":
    main()
