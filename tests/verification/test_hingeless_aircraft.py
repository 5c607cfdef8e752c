# SPDX-License-Identifier: MIT OR Apache-2.0
"""The hingeless BO-105: modes, damping of clamped blades, trim and flight with every inflow model, no code of its own."""

import numpy as np
import pytest
from scipy.linalg import eig

import wakeflight as wf
from wakeflight import _core
from wakeflight.inflow import DynamicInflow
from wakeflight.model import Model

MODELS = ("dynamic", "relaxation", "time-marching")


@pytest.fixture(scope="module")
def bo105():
    return wf.load_aircraft("bo105")


@pytest.fixture(scope="module")
def starts(bo105):
    return {name: wf.trim(bo105, inflow="dynamic" if name == "dynamic" else "relaxation") for name in MODELS[:2]}


def test_the_fitted_modes_come_back(bo105):
    # fitted with uncoupled elements at zero pitch, without the tension-twist coupling that raises torsion by 3 %
    modes = wf.blade_modes(bo105, n_modes=6, n_elements=12, reference_pitch=0.0)
    assert modes.labels == ["lag 1", "flap 1", "flap 2", "torsion 1", "lag 2", "flap 3"]
    assert modes.frequencies[[0, 1, 2, 4, 5]] == pytest.approx([0.670, 1.117, 2.838, 4.392, 5.106], rel=6e-3)
    assert modes.frequencies[3] == pytest.approx(3.600, rel=0.03)


def test_every_mode_of_a_clamped_blade_has_its_structural_damping(bo105):
    # a blade at rest in vacuum on a hub that does not move: eigenvalues of its modal equations alone
    model = Model.build(bo105, wf.FlightCondition().completed(bo105), DynamicInflow())
    y = np.zeros(model.layout["size"])
    y[6] = 1.0
    inputs = _core.Inputs([0.0] * 4, [0.0] * 4, 0.0, None, 0.0, 0.0, vacuum=True)
    n, jacobian, mass = y.size, np.empty((y.size, y.size)), np.empty((y.size, y.size))
    model.core.jacobian(0.0, y, np.zeros(n), inputs, (1.0, 0.0), jacobian)
    model.core.jacobian(0.0, y, np.zeros(n), inputs, (0.0, 1.0), mass)
    kept = [i for part in ("modal", "modal_rate") for i in range(*model.layout[part][0])]
    block = np.ix_(kept, kept)
    roots = eig(jacobian[block], -mass[block], right=False)
    roots = roots[roots.imag > 0]
    for frequency in np.asarray(model.rotor["frequencies"]):
        root = roots[np.argmin(np.abs(np.abs(roots) - frequency))]
        assert -root.real / abs(root) == pytest.approx(0.02, rel=0.1), frequency / model.omega


@pytest.mark.parametrize("speed", [0, 20, 40, 80, 120])
def test_trim_from_hover_to_120_kt(bo105, speed):
    start = wf.trim(bo105, wf.FlightCondition(speed=f"{speed} kt"), inflow="dynamic")
    travel = bo105.stick_travel_in
    assert all(0.0 < each < full for each, full in zip(start.stick.values(), travel, strict=True))
    assert start.residuals["linear"] < 1e-4 and start.residuals["angular"] < 1e-4
    assert start.residuals["harmonics"] < 1e-6
    # chosen precone: hardly any flap bending in the mean
    assert abs(start.mean_outputs()["beta_0"]) < np.radians(0.5)
    assert "beyond 2.5 deg precone" in start.table()


QUICK = {
    "dynamic": "dynamic",
    "relaxation": "relaxation",
    "time-marching": wf.TimeMarchingWake(convergence_revolutions=1),
}


@pytest.mark.parametrize("name", MODELS)
def test_a_manoeuvre_begins_with_every_model(starts, name):
    start = starts["dynamic" if name == "dynamic" else "relaxation"]
    flight = wf.fly(start, wf.arrested_descent(), inflow=QUICK[name], revolutions=1)
    assert flight.finished
    # written for 10 in of travel, flown by the same share of this stick's
    assert "collective inches times 0.9" in flight.data.attrs["maneuver_adapted"]
    assert flight.maneuver.travel_in is None


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
@pytest.mark.parametrize("maneuver", [wf.arrested_descent(), wf.roll_reversal()], ids=lambda m: m.name)
def test_both_manoeuvres_are_flown_to_the_last_revolution(starts, name, maneuver):
    flight = wf.fly(starts["dynamic" if name == "dynamic" else "relaxation"], maneuver, inflow=name)
    assert flight.finished
    assert flight.data.attrs["revolutions"] == flight.maneuver.revolutions
    assert all(np.isfinite(values).all() for values in flight.data.data_vars.values() if values.dtype.kind == "f")
