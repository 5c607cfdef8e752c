# SPDX-License-Identifier: MIT OR Apache-2.0
"""Units at the edge: text or pint in, SI out, bare numbers refused."""

import math

import pytest

from wakeflight.errors import InputError
from wakeflight.units import STANDARD_GRAVITY, convert, mass_of_weight, quantity


@pytest.mark.parametrize(
    ("text", "si_unit", "expected"),
    [
        ("80 kt", "m/s", 80 * 1852 / 3600),
        ("80 knots", "m/s", 80 * 1852 / 3600),
        ("5250 ft", "m", 1600.2),
        ("-6 deg", "rad", math.radians(-6)),
        ("10deg", "rad", math.radians(10)),
        ("1e3 m", "m", 1000.0),
        ("3 deg/s", "rad/s", math.radians(3)),
        ("258 rpm", "rad/s", 258 * 2 * math.pi / 60),
        ("36 km/h", "m/s", 10.0),
        ("0.5 s", "s", 0.5),
        # as word processors and spreadsheets write them
        ("\u22126 deg", "rad", math.radians(-6)),
        ("\u22126\u00b0", "rad", math.radians(-6)),
        ("5,250 ft", "m", 1600.2),
        ("5\u202f250 ft", "m", 1600.2),
        ("16\u2019000.5 lbf", "N", 16000.5 * 0.45359237 * STANDARD_GRAVITY),
        ("1 000 000 N", "N", 1e6),
    ],
)
def test_text_with_a_unit_becomes_si(text, si_unit, expected):
    assert quantity(text, si_unit, "field") == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("value", "unit", "si_unit", "expected"),
    [
        # published pairs of CR-166309 quantities and their SI values, independent of this code's factors
        (4659, "slug ft2", "kg m2", 6316.7558),
        (1090, "ft lbf/deg", "N m/rad", 84674.084),
        (15060, "ft lbf/rad", "N m/rad", 20418.618),
        (60, "hp", "W", 44741.992),
        (1.563612, "deg/in", "rad/m", 1.0744165),
        (1500, "lbf s/in", "N s/m", 262690.25),
        (45, "ft2", "m2", 4.1806368),
    ],
)
def test_compound_units_follow_published_conversions(value, unit, si_unit, expected):
    assert convert(value, unit, si_unit) == pytest.approx(expected, rel=1e-7)


def test_units_unknown_here_are_read_by_pint():
    assert quantity("50 mph", "m/s", "speed") == pytest.approx(22.352, rel=1e-12)


def test_a_pint_quantity_is_accepted():
    pint = pytest.importorskip("pint")
    ureg = pint.UnitRegistry()
    assert quantity(ureg.Quantity(80, "knot"), "m/s", "speed") == pytest.approx(80 * 1852 / 3600)
    with pytest.raises(InputError, match="speed"):
        quantity(ureg.Quantity(80, "kg"), "m/s", "speed")


@pytest.mark.parametrize(
    "value", ["80", 80, 80.0, None, True, "kt", "eighty kt", "nan kt", "1e999 kt", "80 kg", "80 foo", ""]
)
def test_anything_else_is_refused_in_one_line(value):
    with pytest.raises(InputError) as caught:
        quantity(value, "m/s", "speed")
    assert "speed" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_weight_is_a_mass_times_standard_gravity():
    pound = 0.45359237
    assert mass_of_weight("16000 lbf") == pytest.approx(16000 * pound, rel=1e-14)
    assert mass_of_weight("16000 lb") == pytest.approx(16000 * pound, rel=1e-14)
    assert mass_of_weight("7257 kg") == 7257.0
    assert mass_of_weight(f"{7257 * STANDARD_GRAVITY} N") == pytest.approx(7257.0, rel=1e-14)
    with pytest.raises(InputError, match="weight"):
        mass_of_weight("16000 ft")


def test_an_angle_is_not_a_plain_number():
    # a stiffness per radian is not a moment
    with pytest.raises(ValueError, match="N m"):
        convert(1.0, "N m", "N m/rad")


@pytest.mark.parametrize("text", ["5,25 ft", "5,2500 ft", "1234,567 ft", "1,234 567 ft", "12,34,567 ft", "5250, ft"])
def test_a_comma_that_separates_no_thousands_is_refused(text):
    with pytest.raises(InputError, match="altitude"):
        quantity(text, "m", "altitude")
