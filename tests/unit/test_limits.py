# SPDX-License-Identifier: MIT OR Apache-2.0
"""Limits of steady flight: stall from the section tables, sticks against stops, where momentum theory has answers."""

import numpy as np
import pytest

from wakeflight.limits import in_vortex_ring, stall_angles, stalled, stalled_share, sticks_beyond


def table(peak, reversed_peak, slope=0.1):
    # a lift curve in degrees: linear between its peaks, falling by half beyond them
    alpha = np.arange(-180.0, 181.0)
    lift = slope * np.clip(alpha, reversed_peak, peak)
    beyond = (alpha > peak) | (alpha < reversed_peak)
    lift[beyond] *= 0.5
    return {"cl": {"x": np.radians(alpha), "y": [0.0, 1.0], "values": np.column_stack([lift, lift])}}


def test_stall_is_where_lift_stops_growing_either_way():
    angles = stall_angles(table(12.0, -8.0))
    # on a grid of a quarter of a degree
    assert np.degrees(angles.positive) == pytest.approx(12.0, abs=0.3)
    assert np.degrees(angles.negative) == pytest.approx(-8.0, abs=0.3)


def test_a_break_of_a_degree_is_no_stall_and_a_shelf_is():
    alpha = np.arange(-180.0, 181.0)
    bent = 0.1 * alpha
    bent[alpha > 3.0] -= 0.1  # one degree without growth, as where a shock appears
    shelf = np.where(alpha > 5.0, 0.5 + 0.01 * (alpha - 5.0), 0.1 * alpha)
    tables = {"cl": {"x": np.radians(alpha), "y": [0.7, 0.8], "values": np.column_stack([bent, shelf])}}
    no_stall, at_shelf = np.degrees(stall_angles(tables).positive)
    assert no_stall > 25.0
    assert at_shelf == pytest.approx(5.0, abs=0.5)


def test_reversed_flow_is_not_counted_and_shares_are_of_the_area():
    tables = table(12.0, -8.0)
    alpha = np.radians([[0.0, 20.0], [175.0, 5.0]])
    mach = np.full((2, 2), 0.4)
    assert stalled(stall_angles(tables), alpha, mach).tolist() == [[False, True], [False, False]]
    assert stalled_share(tables, alpha, mach, np.array([0.25, 0.75])) == pytest.approx(0.375)


def test_sticks_beyond_their_stops_are_told_in_inches():
    stick = {"lateral": 5.0, "collective": 18.42, "pedal": -0.571}
    high, low = sticks_beyond(stick, (10.0, 10.0, 5.38))
    assert high == "collective needs 18.4 of 10 in"
    assert low.startswith("pedal needs -0.57 in")


def test_the_vortex_ring_range_is_half_to_twice_the_hover_inflow_of_an_axial_descent():
    assert [in_vortex_ring(descent, 0.0, 10.0) for descent in (2.0, 6.0, 19.0, 21.0)] == [False, True, True, False]
    assert not in_vortex_ring(10.0, 30.0, 10.0)
