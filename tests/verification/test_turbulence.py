# SPDX-License-Identifier: MIT OR Apache-2.0
"""Turbulence: variances, one-dimensional spectra in closed form, no divergence, the same air for the same seed."""

import numpy as np
import pytest

import wakeflight as wf

SIGMA, LENGTH = 1.5, 200.0
MAKE = {"dryden": wf.Dryden, "von-karman": wf.VonKarman}


def along_and_across(name, k):
    """Spectra over wave numbers k > 0 along a line, of the component along it and of one across: each integrates to sigma^2."""
    if name == "dryden":
        kl = (k * LENGTH) ** 2
        along = 2.0 / (1.0 + kl)
        across = (1.0 + 3.0 * kl) / (1.0 + kl) ** 2
    else:
        kl = (1.339 * k * LENGTH) ** 2
        along = 2.0 / (1.0 + kl) ** (5 / 6)
        across = (1.0 + 8.0 / 3.0 * kl) / (1.0 + kl) ** (11 / 6)
    return SIGMA**2 * LENGTH / np.pi * along, SIGMA**2 * LENGTH / np.pi * across


@pytest.mark.parametrize("name", MAKE)
def test_every_realisation_has_the_variance_of_its_spectrum_in_all_directions(name):
    # waves shorter than a metre are left out: what the tail of the spectrum has in them
    kl = 2.0 * np.pi * LENGTH
    missing = {
        "dryden": 16.0 / (3.0 * np.pi * kl),
        "von-karman": 55.0 / (9.0 * np.pi * 1.339 * (1.339 * kl) ** (2 / 3)),
    }
    for seed in range(5):
        waves, sizes, _ = MAKE[name]("1.5 m/s", "200 m", seed).modes
        covariance = 0.5 * sizes.T @ sizes
        assert np.abs(covariance - covariance[0, 0] * np.eye(3)).max() < 1e-12
        assert covariance[0, 0] / SIGMA**2 == pytest.approx(1.0 - missing[name], abs=2e-4)
        # a wave that moves along itself would be compressed
        assert np.abs((waves * sizes).sum(axis=1)).max() < 1e-12


@pytest.mark.parametrize("name", MAKE)
def test_spectra_along_a_line_are_the_closed_forms(name):
    edges = np.array([1e-5, 2e-3, 5e-3, 1e-2, 3e-2, 0.1, 0.5])
    found, seeds = np.zeros((2, edges.size - 1)), 400
    for seed in range(seeds):
        waves, sizes, _ = MAKE[name]("1.5 m/s", "200 m", seed).modes
        for axis in range(3):
            across = (axis + 1) % 3
            for row, component in enumerate((axis, across)):
                found[row] += np.histogram(np.abs(waves[:, axis]), edges, weights=0.5 * sizes[:, component] ** 2)[0]
    found /= 3 * seeds
    for row in range(2):
        for i in range(edges.size - 1):
            k = np.linspace(edges[i], edges[i + 1], 4001)
            expected = np.trapezoid(along_and_across(name, k)[row], k)
            assert found[row, i] == pytest.approx(expected, rel=0.03), (name, row, i)


def test_a_flown_line_has_that_variance_and_the_seed_decides():
    air = wf.VonKarman("1.5 m/s", "50 m", seed=3)
    line = np.zeros((40_000, 3))
    line[:, 0] = np.linspace(0.0, 80_000.0, line.shape[0])
    velocity = air(line, 0.0)
    assert np.abs(velocity.std(axis=0) / 1.5 - 1.0).max() < 0.05
    assert np.corrcoef(velocity.T)[0, 2] == pytest.approx(0.0, abs=0.05)
    same, other = wf.VonKarman("1.5 m/s", "50 m", seed=3), wf.VonKarman("1.5 m/s", "50 m", seed=4)
    assert np.array_equal(same(line, 7.0), velocity)
    assert np.abs(other(line[:50], 0.0) - velocity[:50]).max() > 0.5


def test_velocities_have_no_divergence():
    air, h = wf.Dryden("2 m/s", "30 m", seed=1), 1e-4
    points = np.random.default_rng(0).uniform(-100, 100, (50, 3))
    divergence = np.zeros(50)
    for axis in range(3):
        step = h * np.eye(3)[axis]
        divergence += (air(points + step, 0.0) - air(points - step, 0.0))[:, axis] / (2 * h)
    assert np.abs(divergence).max() < 1e-6


def test_a_steady_wind_carries_turbulence_with_it():
    from wakeflight.wind import wind_of

    steady, air = wf.SteadyWind("10 m/s", from_="180 deg"), wf.Dryden("1 m/s", "50 m")
    both = wind_of([steady, air])
    points = np.array([[3.0, -2.0, 1.0], [40.0, 5.0, -8.0]])
    moved = points + 4.0 * steady.velocity
    assert both(moved, 4.0) == pytest.approx(air(points, 0.0) + steady.velocity, abs=1e-12)


def test_what_is_no_turbulence_is_refused_by_name():
    for given, named in (
        (("1.5", "200 m"), "turbulence intensity"),
        (("-1 m/s", "200 m"), "between 0 and 20"),
        (("1 m/s", "0 m"), "turbulence scale"),
        (("1 m/s", "50 m", -1), "turbulence seed"),
        (("1 m/s", "50 m", 0, 2), "turbulence bands"),
    ):
        with pytest.raises(wf.InputError, match=named):
            wf.Dryden(*given)
