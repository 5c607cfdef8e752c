# SPDX-License-Identifier: MIT OR Apache-2.0
"""The regime of a rotor, and the options of a wake that depend on it: the same in trim, flight and on the stand."""

import pytest
from typer.testing import CliRunner

import wakeflight as wf
from wakeflight import cli, options, regime
from wakeflight.condition import condition_for
from wakeflight.flight_start import flight_model
from wakeflight.inflow import trim_model
from wakeflight.model import Model
from wakeflight.tunnel.condition import StandCondition, hub_velocity
from wakeflight.tunnel.model import StandModel

KINDS = (wf.RelaxationWake, wf.TimeMarchingWake)


def left_to_the_regime(model):
    return {name: getattr(model, name) for name in options.BY_REGIME if hasattr(model, name)}


LATTICE = {option.name: option.lattice for option in options.DECLARED if option.lattice}


def numbers(kind, name, trailers=None):
    """What the regime gives to options left open, trailers being those of the regime or the ones named."""
    found = {option: options.BY_REGIME[option][name] for option in left_to_the_regime(kind())}
    found["trailers"] = trailers or found["trailers"]
    lattice = {option: each[name] for option, each in LATTICE.items()}
    return found | (lattice if found["trailers"] == "full-span" else {})


@pytest.mark.parametrize(
    ("in_plane", "climb", "name"),
    [
        (0.0, 0.0, "hover"),
        (5.9, 0.0, "hover"),
        (5.9, 20.0, "hover"),
        (5.9, -0.1, "descent"),
        (6.0, 0.0, "slow"),
        (6.0, -20.0, "slow"),
        (-6.0, 0.0, "slow"),
        (16.9, 0.0, "slow"),
        (17.0, 0.0, "forward"),
        (-17.0, -20.0, "forward"),
    ],
)
def test_regime_follows_from_the_advance_ratio_and_from_which_side_the_air_comes(in_plane, climb, name):
    assert regime.regime(in_plane, climb, 200.0) == name


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", regime.REGIMES)
def test_only_what_was_not_given_is_left_to_the_regime(kind, name):
    assert left_to_the_regime(kind().resolved(name)) == numbers(kind, name)
    # the report's case: other options given, hover's turns and far wake all the same
    mixed = kind(tip_strength="max", inboard_wake="sheet").resolved(name)
    assert left_to_the_regime(mixed) == numbers(kind, name, "tip")
    given = kind(turns=3.0, far_wake_turns=1, sheet_factor=1.1).resolved(name)
    assert (given.turns, given.far_wake_turns, given.sheet_factor) == (3.0, 1, 1.1)


def test_turns_are_not_repeated_where_a_cylinder_closes_the_wake_or_less_than_two_are_free():
    closed = wf.RelaxationWake(far_wake="cylinder").resolved("hover")
    assert (closed.trailers, closed.turns, closed.far_wake_turns) == ("tip", 5, 0)
    for name, trailers in (("forward", "full-span"), ("hover", "full-span"), ("descent", "tip")):
        short = wf.RelaxationWake(turns=1.5).resolved(name)
        assert (short.trailers, short.turns, short.far_wake_turns) == (trailers, 1.5, 0)


@pytest.mark.parametrize(
    "given",
    [
        {"tip_strength": "mean"},
        {"inboard_wake": "sheet"},
        {"far_wake": "cylinder"},
        {"release_radius": 0.98},
        {"sheet_factor": 1.2},
    ],
)
def test_an_option_of_a_lone_tip_vortex_asks_for_one(given):
    assert wf.RelaxationWake().resolved("forward").trailers == "full-span"
    assert wf.RelaxationWake(**given).resolved("forward").trailers == "tip"
    assert wf.RelaxationWake(trailers="full-span").resolved("descent").trailers == "full-span"


def test_turns_that_were_given_are_repeated_and_refused_before_a_cylinder():
    assert wf.RelaxationWake(trailers="full-span", far_wake_turns=1).resolved("hover").far_wake_turns == 1
    with pytest.raises(wf.InputError, match="far_wake = 'cylinder': for tip vortices"):
        wf.RelaxationWake(far_wake="cylinder", far_wake_turns=2)


def test_an_option_left_open_is_no_number_for_the_core(uh60a):
    with pytest.raises(wf.InputError, match="turns = None: must be a number here"):
        wf.RelaxationWake().core_options(uh60a)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("speed", "flight_path", "name", "stand"),
    [
        ("0 kt", "0 deg", "hover", {}),
        ("10 m/s", "90 deg", "hover", {"climb": "10 m/s"}),
        ("10 m/s", "-90 deg", "descent", {"climb": "-10 m/s"}),
        ("10 kt", "0 deg", "hover", {"speed": "10 kt"}),
        ("20 kt", "0 deg", "slow", {"speed": "20 kt"}),
        ("40 kt", "0 deg", "forward", {"speed": "40 kt"}),
        ("80 kt", "-6 deg", "forward", {"speed": "80 kt", "shaft_angle": "6 deg"}),
    ],
)
def test_trim_and_stand_take_the_same_numbers_in_the_same_regime(uh60a, kind, speed, flight_path, name, stand):
    condition = condition_for(uh60a, speed=speed, flight_path=flight_path)
    flown = Model.build(uh60a, condition, kind()).inflow
    assert left_to_the_regime(flown) == numbers(kind, name)
    tip_speed = uh60a.rotor.omega * uh60a.rotor.radius
    velocity = hub_velocity(**{"speed": "0 kt", "shaft_angle": "0 deg", "climb": "0 m/s"} | stand)
    on_stand = StandCondition(velocity, (0.0, 0.0, 0.0), 1.2, 340.0, (("collective", 0.1),) * 3, (), {})
    assert on_stand.regime(tip_speed) == name
    assert left_to_the_regime(StandModel.build(wf.load_rotor("uh60a"), on_stand, kind(), 8).inflow) == numbers(
        kind, name
    )


class Trimmed:
    """What `flight_model` asks of a trim."""

    def __init__(self, aircraft, condition, inflow):
        self.aircraft, self.condition = aircraft, condition
        self.model = Model.build(aircraft, condition, trim_model(inflow))
        self.inflow = self.model.inflow


@pytest.mark.parametrize("given", [{}, {"turns": 6.0}, {"tip_strength": "max"}])
@pytest.mark.parametrize("speed", ["0 kt", "80 kt"])
def test_a_flight_marches_the_wake_its_trim_relaxed(uh60a, speed, given):
    wake = wf.TimeMarchingWake(**given)
    start = Trimmed(uh60a, condition_for(uh60a, speed=speed, flight_path="0 deg"), wake)
    for asked in (wake, "relaxation", "time-marching", None):
        flown = flight_model(start, asked).inflow
        for name in ("turns", "far_wake_turns", "sheet_factor", "tip_strength"):
            assert getattr(flown, name) == getattr(start.inflow, name)
    with pytest.raises(wf.InputError, match="must be that of the trim"):
        flight_model(start, wf.TimeMarchingWake(**given | {"turns": 3.0}))


def test_help_names_the_numbers_of_every_regime():
    told = "by regime: 4 forward, 4 low speed, 5 hover and climb, 4 axial descent; with full-span trailers 2"
    assert options.described("turns") == told
    shown = CliRunner().invoke(cli.app, ["trim", "--help"], env={"COLUMNS": "300"}).output
    assert options.described("turns") in " ".join(shown.split())
    # the help of the options, which documentation shows, names the numbers of the table
    source = wf.RelaxationWake.__doc__
    for name, values in options.BY_REGIME.items():
        assert options.described(name) in source, name
        assert set(values) == set(regime.REGIMES)
