# SPDX-License-Identifier: MIT OR Apache-2.0
"""Inflow models: defaults, checks, and what the physics core is given."""

import dataclasses
import math

import pytest

from wakeflight.aircraft import load_aircraft
from wakeflight.errors import InputError
from wakeflight.inflow import DynamicInflow, RelaxationWake, TimeMarchingWake, inflow_model, like, trim_model
from wakeflight.references import known_keys

KEYS = (
    "n_blades radius root_cutout hinge_offset chord omega n_stations turns steps_per_revolution scheme "
    "predictor evaluation summation tree_tolerance form time_filter trailers n_trailers trailer_core shed_wake tip_strength "
    "tip_strength_inner inboard_wake n_sheet sheet_factor core_radius core_growth core_stretching "
    "core_distance curvature_correction rates near_wake_angle near_wake_segments bound_core station_core_floor "
    "far_wake far_wake_turns release_radius relaxation "
)


def test_the_defaults_are_those_of_the_coupled_flight():
    options = TimeMarchingWake().resolved("forward").core_options(load_aircraft("uh60a"))
    assert list(options) == KEYS.split()
    assert options["steps_per_revolution"] == 36
    assert options["near_wake_angle"] == pytest.approx(math.pi / 6)
    assert options["chord"] == pytest.approx(0.527304)
    expected = {
        "turns": 4.0,
        "scheme": "bdf2",
        "predictor": "same",
        "form": "displacement",
        "core_radius": 0.02,
    }
    expected |= {
        "core_growth": 3e-4,
        "tip_strength": "equivalent",
        "inboard_wake": "none",
        "bound_core": 0.25,
    }
    expected |= {"near_wake_segments": 6, "relaxation": 0.5, "n_stations": 20, "station_core_floor": 0.25}
    assert {key: options[key] for key in expected} == expected


def test_options_reach_the_core():
    wake = TimeMarchingWake(turns=5, azimuth_step="5 deg", scheme="pc2b", tip_strength="max", inboard_wake="sheet")
    options = wake.resolved("forward").core_options(load_aircraft("uh60a"))
    assert (options["turns"], options["steps_per_revolution"]) == (5.0, 72)
    assert (options["scheme"], options["tip_strength"], options["inboard_wake"]) == ("pc2b", "max", "sheet")


@pytest.mark.parametrize(
    ("model", "given"),
    [
        (TimeMarchingWake, {"azimuth_step": "7 deg"}),
        (TimeMarchingWake, {"azimuth_step": 10}),
        (TimeMarchingWake, {"azimuth_step": "0 deg"}),
        (TimeMarchingWake, {"scheme": "euler"}),
        (TimeMarchingWake, {"trailers": "all"}),
        (TimeMarchingWake, {"n_trailers": 1}),
        (TimeMarchingWake, {"n_trailers": 12, "n_stations": 10}),
        (TimeMarchingWake, {"trailers": "full-span", "inboard_wake": "sheet"}),
        (RelaxationWake, {"trailers": "full-span", "release_radius": 0.98}),
        (TimeMarchingWake, {"turns": 0}),
        (TimeMarchingWake, {"turns": "4"}),
        (TimeMarchingWake, {"n_stations": 20.5}),
        (TimeMarchingWake, {"curvature_correction": 1}),
        (TimeMarchingWake, {"tip_strength": "median"}),
        (TimeMarchingWake, {"core_radius": float("nan")}),
        (TimeMarchingWake, {"time_filter": 0.05, "form": "position"}),
        (RelaxationWake, {"relaxation": 0.0}),
        (RelaxationWake, {"max_loops": 0}),
        (DynamicInflow, {"azimuth_step": "7 deg"}),
    ],
)
def test_a_wrong_option_is_refused_by_name(model, given):
    with pytest.raises(InputError, match=next(iter(given))):
        model(**given)


def test_the_step_divides_the_angle_between_blades():
    aircraft = load_aircraft("uh60a")
    # 8 deg divides a turn, not the 90 deg between four blades
    with pytest.raises(InputError, match="90 deg"):
        TimeMarchingWake(azimuth_step="8 deg").step(aircraft)
    with pytest.raises(InputError, match="near_wake_angle"):
        TimeMarchingWake(azimuth_step="9 deg").resolved("forward").core_options(aircraft)
    with pytest.raises(InputError, match="turns"):
        TimeMarchingWake(turns=4.01).resolved("forward").core_options(aircraft)


def test_names_are_models_and_models_are_themselves():
    assert isinstance(inflow_model(), TimeMarchingWake)
    assert isinstance(inflow_model("relaxation"), RelaxationWake)
    configured = DynamicInflow()
    assert inflow_model(configured) is configured
    with pytest.raises(InputError, match="time-marching, relaxation, dynamic"):
        inflow_model("magic")


def test_a_marching_wake_is_trimmed_with_a_relaxation_wake_of_its_options():
    start = trim_model(TimeMarchingWake(turns=6, azimuth_step="5 deg", tip_strength="max"))
    assert isinstance(start, RelaxationWake)
    assert (start.turns, start.tip_strength) == (6, "max")
    assert start.azimuth_step == pytest.approx(math.radians(5))
    assert dataclasses.replace(start, turns=3).near_wake_angle == start.near_wake_angle


@pytest.mark.parametrize("model", [TimeMarchingWake(), RelaxationWake(), DynamicInflow()])
def test_every_model_has_references(model):
    assert model.references
    assert set(model.references) <= known_keys()


def test_a_wake_of_the_other_kind_takes_the_common_options_only():
    # both kinds have an update interval, and it means a revolution in one and every step in the other
    relaxed = RelaxationWake(turns=3.0, core_radius=0.03)
    marching = like(TimeMarchingWake, relaxed)
    assert (marching.turns, marching.core_radius) == (3.0, 0.03)
    assert marching.update_interval is None


@pytest.mark.parametrize(("value", "steps"), [("360 deg", 36), ("90 deg", 9), ("10 deg", 1)])
def test_update_intervals_are_whole_steps(uh60a, value, steps):
    for kind in (RelaxationWake, TimeMarchingWake):
        assert kind(update_interval=value).update_steps(uh60a) == steps
    assert TimeMarchingWake().update_steps(uh60a) == 1


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"update_interval": "15 deg"}, "update_interval = '15 deg': must be a whole number of azimuth steps"),
        ({"update_interval": "0 deg"}, "update_interval"),
        ({"recorrect": 4}, "recorrect = 4"),
        ({"extrapolate": 1}, "extrapolate"),
    ],
)
def test_options_of_the_exchange_are_checked(uh60a, options, named):
    with pytest.raises(InputError, match=named):
        TimeMarchingWake(**options).resolved("forward").core_options(uh60a)
