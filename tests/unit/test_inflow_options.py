# SPDX-License-Identifier: MIT OR Apache-2.0
"""Inflow models: defaults, checks, and what the physics core is given."""

import dataclasses
import json
import math
import pickle
import pydoc

import numpy as np
import pytest

from wakeflight import _core
from wakeflight.aircraft import load_aircraft
from wakeflight.condition import FlightCondition
from wakeflight.errors import InputError
from wakeflight.inflow import (
    AnnularInflow,
    DynamicInflow,
    RelaxationWake,
    TimeMarchingWake,
    check_azimuth_step,
    inflow_model,
    like,
    trim_model,
)
from wakeflight.model import Model
from wakeflight.options import DECLARED, options_of
from wakeflight.references import known_keys


def test_the_defaults_are_those_of_the_coupled_flight():
    options = TimeMarchingWake().resolved("forward").core_options(load_aircraft("uh60a"))
    assert set(options) == {"rotor", "wake", "marching"}
    wake, marching = options["wake"], options["marching"]
    assert wake["azimuth_step"] == pytest.approx(math.pi / 18)
    assert wake["near_wake_angle"] == pytest.approx(math.pi / 6)
    assert options["rotor"]["chord"] == pytest.approx(0.527304)
    expected = {
        "trailers": "full-span",
        "n_trailers": 3,
        "turns": 2,
        "form": "displacement",
        "core_radius": 0.02,
        "core_growth": 3e-4,
        "bound_core": 0.25,
    }
    expected |= {"tip_strength": "equivalent", "inboard_wake": "none", "near_wake_segments": 6, "n_stations": 20}
    expected |= {"station_core_floor": 0.25, "far_wake_turns": 2, "sheet_factor": 1.0}
    assert {key: wake[key] for key in expected} == expected
    assert (marching["scheme"], marching["predictor"]) == ("pcc", "same")
    relaxed = RelaxationWake().resolved("forward").core_options(load_aircraft("uh60a"))
    assert relaxed["wake"] == wake
    assert relaxed["relaxation"]["relaxation"] == 0.5


def test_options_reach_the_core():
    wake = TimeMarchingWake(turns=5, azimuth_step="5 deg", scheme="pc2b", tip_strength="max", inboard_wake="sheet")
    options = wake.resolved("forward").core_options(load_aircraft("uh60a"))
    assert (options["wake"]["turns"], options["wake"]["azimuth_step"]) == (5, pytest.approx(math.pi / 36))
    assert (options["wake"]["tip_strength"], options["wake"]["inboard_wake"]) == ("max", "sheet")
    assert options["marching"]["scheme"] == "pc2b"


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
        (AnnularInflow, {"tip_loss": "some"}),
        (TimeMarchingWake, {"near_wake_angle": "120 deg"}),
        (TimeMarchingWake, {"update_interval": "3700 deg"}),
        (RelaxationWake, {"n_trailers": 2.0}),
        (RelaxationWake, {"far_wake_turns": True}),
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


def test_a_step_that_does_not_divide_says_which_do():
    with pytest.raises(
        InputError,
        match=r"azimuth_step = '10 deg': must divide 72 deg \(5 blades\): nearest are 9 deg or 10.2857142857 deg",
    ):
        check_azimuth_step(math.radians(10.0), 5)
    check_azimuth_step(math.radians(10.2857142857), 7)
    with pytest.raises(InputError, match=r"'10.285714 deg': must divide .* nearest are .*10.2857142857 deg"):
        check_azimuth_step(math.radians(10.285714), 7)
    with pytest.raises(InputError, match=r"'40 deg': must divide 51.4286 deg .* nearest are 25.7142857143 deg$"):
        check_azimuth_step(math.radians(40.0), 7)


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


def test_the_core_declares_each_option_with_all_that_is_said_of_it():
    for option in DECLARED:
        assert option.meaning
        assert option.models
        assert (option.range is None) == (option.kind in ("word", "switch")), option.name
        assert bool(option.words) == (option.kind == "word"), option.name
        # the default can be given, as it is shown
        if option.default is not None:
            assert option.checked(option.shown(option.default)) == option.default


MODELS = (TimeMarchingWake, RelaxationWake, DynamicInflow, AnnularInflow)


@pytest.mark.parametrize("kind", MODELS)
def test_help_tells_every_option_of_a_model_and_no_other(kind):
    told = pydoc.render_doc(kind, renderer=pydoc.plaintext)
    for option in DECLARED:
        assert (f"{option.name} : " in told) == (option.name in options_of(kind.name))
        if kind.name in option.models:
            assert option.meaning in told
            assert option.default_in_words in told


@pytest.mark.parametrize("kind", MODELS)
def test_a_model_is_a_value(kind):
    first = next(iter(options_of(kind.name).values()))
    assert first.name == "turns" or kind in (DynamicInflow, AnnularInflow)
    model = kind(n_stations=12, azimuth_step="15 deg")
    assert model == kind(azimuth_step="15 deg", n_stations=12) != kind()
    assert hash(model) == hash(dataclasses.replace(kind(azimuth_step="15 deg"), n_stations=12))
    assert pickle.loads(pickle.dumps(model)) == model
    assert dataclasses.replace(pickle.loads(pickle.dumps(model)), n_stations=12) == model
    assert repr(model) == f"{kind.__name__}(azimuth_step='15 deg', n_stations=12)"
    assert eval(repr(model), {kind.__name__: kind}) == model
    with pytest.raises(dataclasses.FrozenInstanceError):
        model.n_stations = 20
    with pytest.raises(TypeError, match="colour"):
        kind(colour="blue")


def test_options_that_do_not_go_together_are_refused_when_the_model_is_made():
    for given, named in (
        ({"far_wake": "cylinder", "inboard_wake": "sheet"}, "far_wake = 'cylinder': for tip vortices"),
        ({"turns": 1.0, "far_wake_turns": 1}, "far_wake_turns = 1: must be 0 unless turns"),
    ):
        with pytest.raises(InputError, match=named):
            RelaxationWake(**given)


def test_another_rotors_options_are_refused(uh60a):
    model = Model.build(uh60a, FlightCondition().completed(uh60a), RelaxationWake())
    options = json.loads(model.wake_options)
    n, modes = model.steps_per_revolution, len(model.rotor["frequencies"])
    y = np.zeros(len(model.core.state_names()))

    def solve():
        wake = _core.SteadyWake(model.core, json.dumps(options), False, np.full((n, 20), 0.02))
        wake.converge(model.core, y, np.full(4, 0.1), (np.zeros((n, modes)), np.zeros((n, modes))), 1)

    for name, value in (("radius", 7.0), ("n_blades", 5), ("hinge_offset", 0.1), ("omega", 30.0), ("root_cutout", 1.0)):
        kept, options["rotor"][name] = options["rotor"][name], value
        with pytest.raises(ValueError, match=f"{name} = .*that of the rotor|azimuth_step"):
            solve()
        options["rotor"][name] = kept


@pytest.mark.parametrize("kind", MODELS)
def test_the_standard_preset_is_the_default_and_options_replace_those_of_a_preset(kind):
    assert kind.preset() == kind.preset("standard") == kind()
    assert kind.preset("paper", n_stations=30).n_stations == 30
    with pytest.raises(InputError, match="standard, paper, reference"):
        kind.preset("best")


def test_presets_are_what_they_say():
    reference = TimeMarchingWake.preset("reference")
    assert (reference.trailers, reference.n_trailers, reference.turns) == ("full-span", 10, 10)
    # the manoeuvres of the paper are flown with a lone tip vortex (docs/paper.md)
    paper = TimeMarchingWake.preset("paper").resolved("forward").core_options(load_aircraft("uh60a"))["wake"]
    assert (paper["trailers"], paper["turns"], paper["far_wake_turns"]) == ("tip", 4, 0)
    assert RelaxationWake.preset("paper").max_loops_response == 10


def test_models_say_what_they_are():
    assert [kind.is_free_wake for kind in MODELS] == [True, True, False, False]
    assert [kind.is_marching for kind in MODELS] == [True, False, False, False]
    assert [kind.is_dynamic for kind in MODELS] == [False, False, True, False]
    assert [kind.is_annular for kind in MODELS] == [False, False, False, True]
