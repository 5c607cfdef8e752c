# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flight conditions: SI inside, ranges checked, the rest from the aircraft."""

import dataclasses
import math

import pytest

from wakeflight.aircraft import load_aircraft
from wakeflight.condition import FlightCondition, condition_for
from wakeflight.errors import InputError


def test_the_baseline_is_in_si():
    condition = FlightCondition(speed="80 kt", flight_path="-6 deg", altitude="5250 ft", weight="16000 lbf")
    assert condition.speed == pytest.approx(41.155556, rel=1e-7)
    assert condition.flight_path == pytest.approx(-0.10471976, rel=1e-7)
    assert condition.altitude == pytest.approx(1600.2)
    assert condition.gross_mass == pytest.approx(7257.4779, rel=1e-8)
    assert condition.weight == pytest.approx(71171.5, rel=1e-6)
    with pytest.raises(dataclasses.FrozenInstanceError):
        condition.speed = 0.0


def test_what_is_not_given_is_the_aircrafts():
    aircraft = load_aircraft("uh60a")
    assert not FlightCondition(speed="60 kt").is_complete
    condition = condition_for(aircraft, speed="60 kt")
    assert condition.is_complete
    assert condition.flight_path == pytest.approx(math.radians(-6))
    assert condition.gross_mass == pytest.approx(7257.4779, rel=1e-8)
    assert condition.speed == pytest.approx(60 * 1852 / 3600)
    assert condition == FlightCondition(speed="60 kt").completed(aircraft)


def test_the_second_reading_of_the_paper_differs_in_altitude_only():
    aircraft = load_aircraft("uh60a")
    second = condition_for(aircraft, named="ct-sigma-0071")
    assert second.altitude == pytest.approx(930 * 0.3048)
    assert (second.speed, second.gross_mass) == (aircraft.condition.speed, aircraft.condition.gross_mass)
    with pytest.raises(InputError, match="ct-sigma-0071"):
        condition_for(aircraft, named="nowhere")


def test_a_loading_brings_its_weight_and_a_given_weight_wins():
    aircraft = load_aircraft("uh60a", loading="tm85890")
    assert aircraft.condition.gross_mass == pytest.approx(7438.9149, rel=1e-8)
    assert condition_for(aircraft, weight="7000 kg").gross_mass == 7000.0


@pytest.mark.parametrize(
    ("given", "heading", "bank", "sideslip"),
    [
        ({"speed": "80 kt"}, "free", 0.0, None),
        ({"speed": "60 kt"}, "free", 0.0, None),
        ({"speed": "59.9 kt"}, "aligned", None, 0.0),
        ({"speed": "0 kt"}, "aligned", None, 0.0),
        ({"speed": "80 kt", "sideslip": "5 deg"}, "aligned", None, math.radians(5)),
        ({"speed": "20 kt", "bank": "2 deg"}, "free", math.radians(2), None),
        ({"speed": "20 kt", "sideslip": "180 deg"}, "aligned", None, math.pi),
        ({"speed": "80 kt", "heading": "aligned"}, "aligned", None, 0.0),
        ({"speed": "80 kt", "turn_rate": "6 deg/s"}, "aligned", None, 0.0),
    ],
)
def test_trim_convention_follows_speed_unless_given(given, heading, bank, sideslip):
    condition = condition_for(load_aircraft("uh60a"), **given)
    assert condition.heading == heading
    assert condition.bank == (None if bank is None else pytest.approx(bank))
    assert condition.sideslip == (None if sideslip is None else pytest.approx(sideslip))


@pytest.mark.parametrize(
    "given",
    [
        {"speed": "-5 kt"},
        {"speed": 80},
        {"speed": "501 kt"},
        {"flight_path": "95 deg"},
        {"altitude": "60000 ft"},
        {"weight": "0 lbf"},
        {"weight": "-1 kg"},
        {"bank": "90 deg"},
        {"sideslip": "5 deg", "bank": "5 deg"},
        {"sideslip": "5 deg", "heading": "free"},
        {"heading": "sideways"},
    ],
)
def test_a_condition_out_of_range_names_the_field_and_what_is_allowed(given):
    with pytest.raises(InputError) as caught:
        FlightCondition(**given)
    message = str(caught.value)
    assert next(iter(given)) in message
    assert "\n" not in message


def test_three_hundred_knots_is_input_that_trim_has_to_refuse():
    assert FlightCondition(speed="300 kt").speed > 150.0
