# SPDX-License-Identifier: MIT OR Apache-2.0
"""Winds as they are stated: objects, lists, tables, words; what a run's file tells of them, and what it cannot."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.flight_input import FlightInput
from wakeflight.wind import wind_from_text, wind_of, wind_of_table

POINTS = np.random.default_rng(2).uniform(-50, 50, (9, 3))
PARTS = [
    wf.SteadyWind("8 m/s", from_="200 deg"),
    wf.Gust(),
    wf.Dryden("1 m/s", "100 m", 5),
    wf.VonKarman("2 m/s", "80 m"),
]


@pytest.mark.parametrize("wind", [*PARTS, PARTS], ids=lambda wind: getattr(wind, "kind", "sum"))
def test_what_is_told_of_a_wind_makes_it_again(wind):
    made = wind_of(wind)
    again = wind_of_table(made.described())
    assert np.array_equal(again(POINTS, 2.5), made(POINTS, 2.5))


def test_words_and_files_state_a_wind(tmp_path):
    assert wind_from_text("10 kt from 270 deg") == wf.SteadyWind("10 kt", "270 deg")
    assert wind_from_text("3 m/s") == wf.SteadyWind("3 m/s")
    file = tmp_path / "breeze.toml"
    file.write_text('[wind]\nkind = "gust"\namplitude = "3 m/s"\n')
    assert wind_from_text(str(file)) == wf.Gust(amplitude="3 m/s")
    for text, named in (
        ('[wind]\nkind = "storm"\n', "wind.kind = 'storm'"),
        ('[wind]\nkind = "gust"\nlong = "3 m"\n', "wind.long"),
        ('[wind]\nkind = "gust"\nlength = "-3 m"\n', "breeze.toml: gust length"),
        ("[gust]\n", "must have a table"),
    ):
        file.write_text(text)
        with pytest.raises(wf.InputError, match=named):
            wind_from_text(str(file))
    with pytest.raises(wf.InputError, match="wind speed"):
        wind_from_text("windy")


def test_a_flight_in_wind_carries_it_and_is_flown_again_to_the_bit():
    bo105 = wf.load_aircraft("bo105")
    start = wf.trim(bo105, wf.FlightCondition(speed="60 kt"), inflow="dynamic")
    nothing = wf.Maneuver("nothing", (), seconds=1.0)
    run = wf.fly(start, nothing, revolutions=1, integrator="fixed", wind=PARTS).data
    given = FlightInput.from_text(run.attrs["input"])
    assert given.plan.wind.described() == wind_of(PARTS).described()
    again = wf.fly(start, nothing, revolutions=1, integrator="fixed", wind=given.plan.wind).data
    assert np.array_equal(again.w.values, run.w.values) and np.abs(run.wind.values).max() > 5.0
    own = wf.fly(start, nothing, revolutions=0.2, integrator="fixed", wind=lambda points, t: 0.0 * points).data
    with pytest.raises(wf.InputError, match="in no file"):
        FlightInput.from_text(own.attrs["input"])


def raising(points, t):
    if t > 0.05:
        raise KeyError("no air")
    return 0.0 * points


def test_a_function_that_raises_ends_the_flight_by_name_and_keeps_it():
    start = wf.trim(wf.load_aircraft("uh60a").with_rigid_blades(), wf.FlightCondition(speed="60 kt"), inflow="dynamic")
    nothing = wf.Maneuver("nothing", {}, seconds=0.2)
    with pytest.raises(wf.NumericalFailure, match=r"wind raising at t = 0.05.* s: KeyError: 'no air'") as stop:
        wf.fly(start, nothing, integrator="fixed", wind=raising)
    assert stop.value.partial.data.sizes["time"] > 5
    for wrong, told in (
        (lambda points: points, "wind .*<lambda> at t = 0.0000 s: TypeError"),
        (lambda points, t: "calm", "calm"),
    ):
        with pytest.raises(wf.NumericalFailure, match=told) as stop:
            wf.fly(start, nothing, integrator="fixed", wind=[wf.SteadyWind("3 kt"), wrong])
    assert "in revolution -" not in str(stop.value)
