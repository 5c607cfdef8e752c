# SPDX-License-Identifier: MIT OR Apache-2.0
"""Means and first harmonics over the disk: exact where they must be, and one number whoever asks."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.plotting.disk import harmonics
from wakeflight.results.disk import area_weights, disk_mean, element_widths, first_harmonics


def grid(n=20, cutout=0.13, n_azimuths=36):
    """Edges that narrow towards the tip, their middles and widths, azimuths."""
    edges = cutout + (1 - cutout) * np.sin(0.5 * np.pi * np.arange(n + 1) / n)
    return edges, 0.5 * (edges[1:] + edges[:-1]), np.diff(edges), 2 * np.pi * np.arange(n_azimuths) / n_azimuths


@pytest.mark.parametrize("n", [1, 5, 20, 200])
def test_a_station_weighs_the_share_of_the_annulus_that_its_element_sweeps(n):
    edges, station, width, _ = grid(n)
    exact = (edges[1:] ** 2 - edges[:-1] ** 2) / (1.0 - edges[0] ** 2)
    np.testing.assert_allclose(area_weights(station, width), exact, rtol=1e-12)
    # one length unit is as good as another
    np.testing.assert_allclose(area_weights(8.2 * station, 8.2 * width), exact, rtol=1e-12)
    np.testing.assert_allclose(element_widths(station), width, rtol=1e-9)


@pytest.mark.parametrize("n_azimuths", [3, 24, 36])
def test_uniform_and_linear_inflow_give_their_own_coefficients(n_azimuths):
    _, station, width, psi = grid(n_azimuths=n_azimuths)
    weights = area_weights(station, width)
    uniform = np.full((n_azimuths, station.size), 0.05)
    assert disk_mean(uniform, weights) == pytest.approx(0.05, rel=1e-14)
    assert first_harmonics(uniform, psi, station, weights) == pytest.approx((0.05, 0.0, 0.0), abs=1e-16)
    shape = 0.02 * np.cos(psi) - 0.007 * np.sin(psi)
    linear = 0.05 + np.outer(shape, station)
    # also where the record does not begin over the tail
    for first in (0.0, 0.1):
        turned = 0.05 + np.outer(0.02 * np.cos(psi + first) - 0.007 * np.sin(psi + first), station)
        found = first_harmonics(turned, psi + first, station, weights)
        assert found == pytest.approx((0.05, 0.02, -0.007), abs=1e-15)
    # the second harmonic, and what is even in azimuth, is no part of the first
    second = linear + np.outer(np.cos(2 * psi), station) if n_azimuths > 3 else linear
    assert first_harmonics(second, psi, station, weights) == pytest.approx((0.05, 0.02, -0.007), abs=1e-14)


def test_a_mean_of_what_varies_within_elements_errs_by_the_square_of_their_width():
    errors = []
    for n in (10, 20, 40):
        edges, station, width, _ = grid(n)
        exact = 2 / 3 * (1 - edges[0] ** 3) / (1 - edges[0] ** 2)
        errors.append(abs(disk_mean(station[None, :], area_weights(station, width)) / exact - 1))
    assert errors[1] < 1e-3
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([2.0, 2.0], abs=0.05)


def test_stations_that_are_no_middles_of_elements_are_refused():
    for station in (np.linspace(0.1, 1.0, 10), np.array([0.2, 0.9, 0.95]), np.array([0.5, 0.4])):
        with pytest.raises(ValueError, match="no middles"):
            element_widths(station)


@pytest.mark.parametrize("name", ["uh60a", "bo105"])
@pytest.mark.parametrize("n_stations", [12, 20])
def test_trim_stand_and_figures_state_the_same_harmonics(name, n_stations):
    inflow = wf.DynamicInflow(n_stations=n_stations)
    start = wf.trim(wf.load_aircraft(name), wf.FlightCondition(speed="60 kt", flight_path="0 deg"), inflow=inflow)
    data = start.to_dataset()
    # the map of dynamic inflow is linear by construction: its states are the harmonics
    i = start.model.core.trim_layout(start.problem).inflow
    mean, sine, cosine = start.x[i : i + 3]
    for found in (start.inflow_harmonics(), harmonics(data.inflow)):
        assert found == pytest.approx((mean, cosine, sine), abs=1e-14)
    assert float(data.inflow_mean) == pytest.approx(mean, rel=1e-13)
    stand = wf.tunnel(name, ct=0.006, speed="60 kt", inflow=inflow)
    ours = (float(stand.data[f"inflow_{part}"]) for part in ("mean", "1c", "1s"))
    assert tuple(ours) == pytest.approx(stand.inflow_harmonics(), rel=1e-14)
    assert harmonics(stand.data.inflow) == pytest.approx(stand.inflow_harmonics(), rel=1e-11, abs=1e-14)
    # stations of the core are middles of elements that end at the tip
    np.testing.assert_allclose(
        element_widths(stand.data.station.values), stand.data.width.values / stand.radius, rtol=1e-9
    )
