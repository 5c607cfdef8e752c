# SPDX-License-Identifier: MIT OR Apache-2.0
"""The tree beside the direct sum, for sets of segments and points that nobody would think of."""

import numpy as np
import pytest

import wakeflight as wf

SETS = 200


def filaments(rng, size):
    """Tangled, wandering, wound, straight or coinciding ones of a size."""
    kind = rng.integers(0, 5)
    for i in range(rng.integers(1, 40)):
        n = rng.integers(2, 120)
        if kind == 0:
            nodes = rng.normal(size=(n, 3))
        elif kind == 1:
            nodes = np.cumsum(rng.normal(size=(n, 3)) * 10 ** rng.uniform(-4, 0), axis=0)
        elif kind == 2:
            age, radius = np.linspace(0, rng.uniform(1, 40), n), rng.uniform(0.1, 1)
            nodes = np.column_stack([radius * np.cos(age), radius * np.sin(age), -0.02 * age])
        elif kind == 3:
            nodes = np.column_stack([np.linspace(0, 1, n), np.full(n, i * 10 ** rng.uniform(-3, 0)), np.zeros(n)])
        else:
            nodes = np.repeat(rng.normal(size=(n // 3 + 1, 3)), 3, axis=0)[:n]
        yield size * nodes


@pytest.mark.parametrize("core_distance", ["line", "segment"])
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_the_tree_is_within_half_of_its_tolerance_for_random_sets(core_distance, tolerance):
    rng = np.random.default_rng([int(-np.log10(tolerance)), len(core_distance)])
    for number in range(SETS):
        size = 10 ** rng.uniform(-6, 6)
        lines = list(filaments(rng, size))
        nodes, n = np.vstack(lines), sum(len(line) - 1 for line in lines)
        circulation = rng.normal(size=n) * 10 ** rng.uniform(-8, 8)
        core_radius = size * 10 ** rng.uniform(-4, 0.5, size=n if rng.random() < 0.5 else 1) * np.ones(n)
        count = rng.integers(1, 600)
        points = nodes[rng.integers(0, len(nodes), count)]
        beside = points + rng.normal(size=(count, 3)) * size * 10 ** rng.uniform(-8, 0)
        away = rng.normal(size=(count, 3)) * size * 10 ** rng.uniform(0, 5)
        points = np.vstack([points, beside, away][: rng.integers(1, 4)])
        given = (points, lines, circulation, core_radius)
        tree = wf.induced_velocity(*given, core_distance=core_distance, method="tree", tolerance=tolerance)
        direct = wf.induced_velocity(*given, core_distance=core_distance)
        largest = np.linalg.norm(direct, axis=1).max()
        assert np.linalg.norm(tree - direct, axis=1).max() <= 0.5 * tolerance * largest, (number, size)
