# SPDX-License-Identifier: MIT OR Apache-2.0
"""Error estimates: an order where there is one, and none where the sequence does not show it."""

import numpy as np
import pytest

from wakeflight.studies.converge.estimate import estimate, geometric
from wakeflight.studies.converge.parameters import Setting, parameter
from wakeflight.studies.converge.runs import Outcome, Quantity
from wakeflight.studies.converge.study import Study

SIZES = np.array([4.0, 2.0, 1.0])
TIMES = np.linspace(0.0, 1.0, 7)


def power_law(order, sizes=SIZES, shape=TIMES):
    return np.array([np.sin(3.0 * TIMES) + 0.01 * h**order * shape for h in sizes])


@pytest.mark.parametrize("order", [1.0, 1.7, 2.0, 2.6])
def test_a_power_law_is_extrapolated_to_its_limit(order):
    found = estimate(SIZES, power_law(order), 2.0)
    assert found.order == pytest.approx(order, rel=1e-9)
    np.testing.assert_allclose(found.limit, np.sin(3.0 * TIMES), atol=1e-12)
    expected = [0.01 * h**order * np.sqrt(np.mean(TIMES**2)) for h in SIZES]
    np.testing.assert_allclose(found.error, expected, rtol=1e-9)
    np.testing.assert_allclose(found.largest, [0.01 * h**order for h in SIZES], rtol=1e-9)


@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ([1.0, 2.0, 4.0], "do not fall"),
        ([1.0, 2.0, 1.5], "change direction"),
        ([1.0, 1.9, 2.7], "fall too slowly"),
        ([1.0, 2.0, 2.01], "fall faster"),
        ([2.0, 2.0, 2.0], "does not depend"),
    ],
)
def test_a_sequence_outside_its_asymptotic_range_has_no_order(values, reason):
    found = estimate(SIZES, np.array(values)[:, None], 2.0)
    assert found.order is None
    assert reason in found.note
    # the finest is the reference then, and its own error is not known
    assert found.error[-1] is None
    assert found.error[0] == pytest.approx(abs(values[0] - values[-1]))


def test_two_terms_of_which_neither_leads_have_no_steady_order():
    # first and second order with opposite signs: three settings alone would show a false order
    sizes = np.array([8.0, 4.0, 2.0, 1.0])
    values = (sizes**2 - 3.5 * sizes)[:, None]
    found = estimate(sizes, values, 2.0)
    assert found.order is None


def test_four_settings_confirm_an_order():
    sizes = np.array([8.0, 4.0, 2.0, 1.0])
    found = estimate(sizes, power_law(2.0, sizes), 2.0)
    assert found.order == pytest.approx(2.0)
    assert "four" in found.note


def test_no_order_is_sought_where_no_power_is_expected_or_ratios_differ():
    assert estimate(SIZES, power_law(2.0), None).order is None
    uneven = np.array([3.0, 2.0, 1.0])
    assert estimate(uneven, power_law(2.0, uneven), 2.0).note == "no three settings in geometric ratio"


def test_the_finest_three_in_geometric_ratio_are_found_among_others():
    assert geometric(np.array([15.0, 10.0, 7.5, 5.0, 2.5])) == (1, 3, 4)
    assert geometric(np.array([15.0, 10.0, 7.0])) is None


def test_a_study_with_a_setting_that_did_not_settle_has_no_order():
    outcomes = tuple(
        Outcome(np.array([[1.0 + h**2]]), np.zeros(1), 1.0, 1.0, {}, notes)
        for h, notes in zip(SIZES, ((), ("still moves",), ()), strict=True)
    )
    given = tuple(Setting(f"{h:g}", h, h) for h in SIZES)
    study = Study("a run", parameter("azimuth-step"), given, outcomes, (Quantity("power", "hp"),))
    assert study.estimates[0].order is None
    assert "2: still moves" in study.table()
    settled = Study(
        "a run", parameter("azimuth-step"), given, (outcomes[0], outcomes[2], outcomes[2]), study.quantities
    )
    assert "still moves" not in settled.table()
