# SPDX-License-Identifier: MIT OR Apache-2.0
"""Moments of the shipped fuselages: within slender-body theory, unstable, and what the BO-105's modes become with them."""

from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf

FOLDER = Path(__file__).resolve().parents[2] / "validation"

# width, depth of the fuselage at its thickest, plan and side area [m, m2]. BO-105: areas of its source, width recalled, depth in
# proportion to the areas. UH-60A: width and length recalled, no deeper than wide; areas no larger than length times width.
SIZES = {"bo105": (1.58, 1.75, 7.5, 8.3), "uh60a": (2.36, 2.36, 15.3 * 2.36, 15.3 * 2.36)}


def slopes(name):
    """Of pitching moment by angle of attack, yawing moment by sideslip, within ten degrees, over dynamic pressure [m3/rad]."""
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 m")
    fuselage = wf.load_aircraft(name).core_data(condition)["fuselage"]
    pitching, yawing = fuselage["pitching"], fuselage["yawing"]
    alpha, beta = np.array(pitching["x"]), np.array(yawing["y"])
    near_alpha, near_beta = np.abs(alpha) < np.radians(10.1), np.abs(beta) < np.radians(10.1)
    m = np.array(pitching["values"])[near_alpha][:, np.argmin(np.abs(beta))]
    n = np.array(yawing["values"])[np.argmin(np.abs(alpha))][near_beta]
    return np.polyfit(alpha[near_alpha], m, 1)[0], np.polyfit(beta[near_beta], n, 1)[0]


@pytest.mark.parametrize("name", SIZES)
def test_moment_slopes_lie_within_slender_body_theory(name):
    # In crossflow a section of width b moves rho pi b^2/4 of air a metre, so the moment's slope is q pi/2 times the integral
    # of b^2, itself at most the greatest width times the plan area. Short bodies, separation and a tail boom in the crossflow
    # take from it.
    width, depth, plan, side = SIZES[name]
    pitch, yaw = slopes(name)
    assert 0.0 < pitch < 0.5 * np.pi * width * plan
    assert 0.0 < -yaw < 0.5 * np.pi * depth * side


def test_the_polynomial_of_the_bo105s_source_exceeds_slender_body_theory():
    # why it is not used: 12 752 N m/rad at 30.48 m/s
    width, _, plan, _ = SIZES["bo105"]
    assert 0.5 * np.pi * width * plan < 12752.0 / (0.5 * 1.225 * 30.48**2)


@pytest.fixture
def derivatives(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    import derivatives

    return derivatives


def test_modes_of_the_averaged_balances_are_those_of_the_whole_aircraft(derivatives):
    start = wf.trim(
        wf.load_aircraft("bo105"), wf.FlightCondition(speed="120 kt", flight_path="0 deg"), inflow="dynamic"
    )
    averaged = derivatives.linear_model(start).eigenvalues
    whole = derivatives.periodic_roots(start)
    slow = averaged[np.abs(averaged) < 5.0]
    # blades and inflow follow at once in the one, in their own time in the other: that moves the Dutch roll most
    for root in slow:
        assert np.min(np.abs(whole - root)) < 0.03
    dutch = slow[np.argmax(slow.imag)]
    assert 2.5 < dutch.imag < 4.5 and dutch.real < -0.3
    assert whole[0].real < 0.3


def test_a_derivative_by_attitude_is_gravity(derivatives):
    start = wf.trim(wf.load_aircraft("bo105"), wf.FlightCondition(speed="80 kt", flight_path="0 deg"), inflow="dynamic")
    model = derivatives.linear_model(start)
    assert model["X_theta"] == pytest.approx(-9.80665 * np.cos(start.pitch), rel=2e-3)
    assert model["Y_phi"] == pytest.approx(9.80665 * np.cos(start.pitch) * np.cos(start.roll), rel=2e-3)
