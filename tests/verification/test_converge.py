# SPDX-License-Identifier: MIT OR Apache-2.0
"""The study of convergence: what it reports is what separate runs give."""

import csv

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.plotting import convergence, style


@pytest.fixture(scope="module")
def elements(uh60a):
    return wf.converge(uh60a, "trim", vary="elements", values=[4, 8, 2], inflow="dynamic")


def test_values_are_those_of_separate_trims_coarse_to_fine(elements, uh60a):
    assert elements.labels == ["2", "4", "8"]
    alone = wf.trim(uh60a.discretised(n_elements=8), inflow="dynamic")
    data = elements.data
    assert float(data["value"].sel(setting="8", quantity="collective")) == alone.stick["collective"]
    ours = float(data["value"].sel(setting="8", quantity="power"))
    assert ours == pytest.approx(alone.mean_outputs()["power"] / 745.6998715822702, rel=1e-12)


def test_errors_fall_with_refinement_and_zero_bank_has_none(elements):
    error = elements.data["error"].sel(quantity="power").values
    assert error[0] > 3 * error[1] > 0
    assert "does not depend" in str(elements.data["order_note"].sel(quantity="roll").values)


def test_files_and_figure_hold_every_setting(elements, tmp_path):
    paths = elements.save(tmp_path)
    assert [path.name for path in paths] == ["converge.nc", "converge.csv", "converge.md"]
    with paths[1].open() as stream:
        rows = list(csv.DictReader(stream))
    assert {row["setting"] for row in rows} == {"2", "4", "8"}
    assert len(rows) == 3 * elements.data.sizes["quantity"]
    assert "nan" not in paths[1].read_text() + paths[2].read_text()
    style.save(convergence.figure(elements.data), tmp_path / "converge.png")


@pytest.mark.parametrize(("vary", "values"), [("modes", "4, 5, 6"), ("stations", "10, 20, 40")])
def test_the_table_has_a_line_for_every_quantity(uh60a, vary, values):
    study = wf.converge(uh60a, vary=vary, values=values, inflow="dynamic")
    for quantity in study.quantities:
        lines = [line for line in study.table().splitlines() if line.startswith(f"{quantity.name} ")]
        # among the values and among the errors
        assert len(lines) == 2
        assert f"| {quantity.name} |" in study.markdown()


def test_more_elements_only_lower_the_frequencies_of_the_blade(uh60a):
    # Ritz: each set of elements contains the coarser one. The order is one, not four, for steps of stiffness lie within
    # elements: curvature and twist rate jump there and a polynomial cannot
    study = wf.converge(uh60a, "modes", vary="elements", values=[4, 8, 16, 32, 64])
    frequencies = study.data["value"].values
    assert np.all(np.diff(frequencies, axis=0) < 1e-9)
    torsion = study.estimates[4]
    assert torsion.order == pytest.approx(1.0, abs=0.3)
    assert torsion.error[0] < 0.006 * frequencies[-1, 4]


def test_a_rotor_on_a_stand_is_swept_as_the_verb_runs_it(uh60a):
    stand = {"collective": "16 deg", "speed": "80 kt"}
    study = wf.converge(uh60a, "tunnel", vary="stations", values=[10, 20], inflow="dynamic", stand=stand)
    alone = wf.tunnel(uh60a, inflow=wf.DynamicInflow(n_stations=20), **stand)
    assert float(study.data["value"].sel(setting="20", quantity="ct")) == alone.ct
    assert float(study.data["value"].sel(setting="10", quantity="ct")) != alone.ct


def test_histories_are_compared_at_the_instants_all_settings_have(uh60a):
    study = wf.converge(
        uh60a, wf.arrested_descent(), vary="azimuth-step", values="15 deg, 10 deg", inflow="dynamic", revolutions=1
    )
    # every 30 degrees of a revolution, both ends
    assert study.times.size == 13
    assert study.data["error_known"].sel(setting="10 deg").sum() == 0


def test_a_tighter_solver_costs_more_and_errs_less(uh60a):
    study = wf.converge(
        uh60a, "arrested-descent", vary="tolerance", values=[1e-4, 1e-5, 1e-7], inflow="dynamic", revolutions=3
    )
    error, work = study.data["error"].sel(quantity="q").values, study.data["residual_evaluations"].values
    assert error[0] > 3 * error[1] > 0
    assert work[2] > work[1] > work[0]
