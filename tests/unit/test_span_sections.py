# SPDX-License-Identifier: MIT OR Apache-2.0
"""Several sections along the span: linear between stations or in steps, in rotor and aircraft files alike."""

import math
import shutil
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.limits import StallAlongSpan, StallAngles, stall_along_span, stalled, table_end

UH60A = Path(str(resources.files("wakeflight.aircraft"))) / "uh60a"
ROTOR = """format = 1
name = "rotor"
[rotor]
n_blades = 2
radius = "2 m"
omega = "60 rad/s"
[rotor.blade]
root = "clamped"
flexible = false
root_station = "0 m"
root_cutout = "0.4 m"
geometry = { columns = { r_R = [0, 1], chord_m = [0.2, 0.2], twist_deg = [0, 0] } }
"""


def section(name, slope, where=""):
    polar = f'polar = {{ lift_curve_slope = "{slope} 1/rad", cd = [0.01, 0, 1.0] }}'
    return f'[[rotor.airfoil]]\nname = "{name}"\n{where}\n{polar}\n'


def rotor(tmp_path, *sections):
    path = tmp_path / "rotor.toml"
    path.write_text(ROTOR + "".join(sections))
    return path


def hover(path, **options):
    return wf.tunnel(path, collective="8 deg", speed="0 kt", **options)


def slopes(stand):
    """Lift slope of every station."""
    data = stand.data
    return np.asarray(data.station), np.asarray(data.cl / data.alpha).reshape(-1, data.sizes["station"])


@pytest.mark.parametrize("inflow", ["dynamic", "time-marching"])
def test_tables_are_linear_between_stations_and_held_beyond(tmp_path, inflow):
    path = rotor(tmp_path, section("root", 5.0, "stations = [0.3, 0.5]"), section("tip", 6.0, "stations = 0.9"))
    stand = hover(path, inflow=inflow)
    station, found = slopes(stand)
    expected = np.interp(station, [0.3, 0.5, 0.9], [5.0, 5.0, 6.0])
    assert np.unique(np.round(expected, 6)).size > 3
    assert found == pytest.approx(np.broadcast_to(expected, found.shape), rel=1e-9)


@pytest.mark.parametrize("inflow", ["dynamic", "time-marching"])
def test_within_extents_a_section_holds_to_its_end(tmp_path, inflow):
    inner, outer = section("root", 5.0, "extent = [0.2, 0.6]"), section("tip", 6.0, "extent = [0.6, 1.0]")
    stand = hover(rotor(tmp_path, inner, outer), inflow=inflow)
    station, found = slopes(stand)
    expected = np.where(station < 0.6, 5.0, 6.0)
    assert found == pytest.approx(np.broadcast_to(expected, found.shape), rel=1e-9)


@pytest.mark.parametrize("blade_model", ["lifting-line", "second-order", "weissinger"])
def test_two_equal_sections_are_one(tmp_path, blade_model):
    one = hover(rotor(tmp_path, section("a", 5.7)), inflow="time-marching", blade_model=blade_model)
    two = hover(
        rotor(tmp_path, section("a", 5.7, "extent = [0, 0.5]"), section("b", 5.7, "extent = [0.5, 1]")),
        inflow="time-marching",
        blade_model=blade_model,
    )
    assert one.ct == two.ct
    assert np.array_equal(one.data.circulation, two.data.circulation)


@pytest.mark.parametrize(
    ("sections", "named"),
    [
        ((section("a", 5.7), section("b", 5.7)), ("2 sections", "a needs stations", "extent")),
        ((section("a", 5.7, "stations = 0.5"),), ("only section", "whole span")),
        ((section("a", 5.7, "stations = 0.5"), section("b", 5.7, "stations = 0.5")), ("two sections", "0.5 R")),
        ((section("a", 5.7, "stations = 0.5"), section("a", 5.7, "stations = 0.6")), ("section a twice",)),
        ((section("a", 5.7, "stations = 0.5"), section("b", 5.7, "extent = [0.5, 1]")), ("stations for one",)),
        ((section("a", 5.7, "extent = [0, 0.4]"), section("b", 5.7, "extent = [0.5, 1]")), ("do not join", "0.4 R")),
        (
            (section("a", 5.7, "extent = [0.3, 0.5]"), section("b", 5.7, "extent = [0.5, 1]")),
            ("must cover", "0.2 to 1"),
        ),
        (
            (section("a", 5.7, "extent = [0, 0.5]"), section("b", 5.7, "extent = [0.5, 0.9]")),
            ("must cover", "0.2 to 1"),
        ),
        (
            (section("a", 5.7, "stations = 1.5"), section("b", 5.7, "stations = 0.5")),
            ("rotor.airfoil.0.stations", "1.5"),
        ),
        ((section("a", 5.7, "stations = []"), section("b", 5.7, "stations = 0.5")), ("rotor.airfoil.0.stations",)),
        ((section("a", 5.7, 'stations = "0.5 ft"'), section("b", 5.7, "stations = 0.6")), ("airfoil.0.stations", "ft")),
        (
            (section("a", 5.7, "stations = 0.5"), section("b", 9.9, "station = 0.6")),
            ("airfoil.1.station", "is stations meant"),
        ),
        (
            (section("a", 5.7, "stations = 0.5"), section("b", 5.7, "stations = 0.6\ncd_increment = -0.02")),
            ("airfoil[b]",),
        ),
    ],
)
def test_sections_whose_place_is_not_said_are_refused(tmp_path, sections, named):
    with pytest.raises(wf.InputError) as caught:
        wf.load_rotor(rotor(tmp_path, *sections))
    for each in ("rotor.toml", "rotor.airfoil", *named):
        assert each in str(caught.value), str(caught.value)
    assert "\n" not in str(caught.value)


def lift_table(stall):
    alpha = np.radians([-180, -stall - 5, -stall, stall, stall + 5, 180])
    lift = 6.0 * np.radians([0, -0.8 * stall, -stall, stall, 0.8 * stall, 0])
    return {"x": alpha.tolist(), "y": [0.0, 0.8], "values": [[v, v] for v in lift]}


def test_stall_between_two_sections_lies_between_theirs():
    cells = {"x": [-math.pi, math.pi], "y": [0.0, 0.6], "values": [[0.0, 0.0], [0.0, 0.0]]}
    tables = [{"cl": lift_table(stall), "cd": cells, "cm": cells} for stall in (10.0, 14.0)]
    airfoil = {"stations": [1.0, 3.0], "stepwise": False, "tables": tables}
    stations = np.array([0.5, 1.5, 3.5])
    angles = stall_along_span(airfoil, stations)
    assert isinstance(angles, StallAlongSpan)
    ends = [angles.sections[i].positive[0] for i in (0, 1)]
    low, high = angles.at(np.full((2, 4, 3), 0.3))
    assert high.shape == (2, 4, 3)
    assert high[1, 2] == pytest.approx([ends[0], 0.75 * ends[0] + 0.25 * ends[1], ends[1]])
    assert low == pytest.approx(-high, abs=0.01)
    beyond = stalled(angles, np.full((1, 3), ends[0] + 0.02), np.full((1, 3), 0.3))
    assert beyond.tolist() == [[True, bool(0.25 * (ends[1] - ends[0]) < 0.02), False]]
    steps = stall_along_span({**airfoil, "stepwise": True}, stations)
    assert steps.at(np.full(3, 0.3))[1] == pytest.approx([ends[0], ends[0], ends[1]])
    assert isinstance(stall_along_span({**airfoil, "tables": tables[:1]}, stations), StallAngles)
    assert table_end(airfoil) == 0.6


DECKS = """
[[rotor.airfoil]]
name = "inner"
stations = { value = [0.2, 0.7], source = "genhel", confidence = "C" }
c81 = { table = "sc1095.c81", source = "genhel", confidence = "C" }
cd_increment = { value = 0.002, source = "genhel", confidence = "A" }

[[rotor.airfoil]]
name = "outer"
stations = { value = 0.9, source = "genhel", confidence = "C" }
cl = { table = "sc1095_cl.csv", source = "genhel", confidence = "A" }
cd = { table = "sc1095_cd.csv", source = "genhel", confidence = "A" }
cm = { table = "sc1095_cm.csv", source = "bemt", confidence = "A/C" }
cd_increment = { value = 0.002, source = "genhel", confidence = "A" }
"""


def c81_of(tables):
    """Lines of a C81 deck with cells of section tables: every second degree within 30, every twelfth beyond."""
    degrees = np.degrees(tables["cl"]["x"])
    kept = [i for i, a in enumerate(degrees) if round(a) % (2 if abs(a) <= 30 else 12) == 0]
    mach = tables["cl"]["y"]
    lines = [f"{'DECK':30s}" + f"{len(mach):02d}{len(kept):02d}" * 3]

    def rows(lead, values):
        for i in range(0, len(values), 9):
            yield (lead if i == 0 else " " * 7) + "".join(f"{v:7.4f}"[:7] for v in values[i : i + 9])

    for name in ("cl", "cd", "cm"):
        lines += rows(" " * 7, mach)
        for i in kept:
            lines += rows(f"{degrees[i]:7.1f}", tables[name]["values"][i])
    return "\n".join(lines) + "\n"


ONE = """
[rotor.airfoil]
name = "deck"
c81 = { table = "sc1095.c81", source = "genhel", confidence = "C" }
cd_increment = { value = 0.002, source = "genhel", confidence = "A" }
"""


def with_sections(folder, sections):
    """The UH-60A with `sections` in place of its own, and a deck of these beside it."""
    shutil.copytree(UH60A, folder / "uh60a")
    path = folder / "uh60a" / "uh60a.toml"
    text = path.read_text()
    tables = wf.load_aircraft("uh60a").core_data()["rotor"]["airfoil"]["tables"][0]
    (folder / "uh60a" / "sc1095.c81").write_text(c81_of(tables))
    start, end = text.index("[rotor.airfoil]"), text.index("# Damper length")
    path.write_text(text[:start] + sections + text[end:])
    return path


def test_an_aircraft_takes_several_decks_and_tables(tmp_path):
    aircraft = wf.load_aircraft(with_sections(tmp_path, DECKS))
    airfoil = aircraft.core_data()["rotor"]["airfoil"]
    assert airfoil["stations"] == pytest.approx([each * 8.177784 for each in (0.2, 0.7, 0.9)])
    assert not airfoil["stepwise"]
    rows = {row.key: row for row in aircraft.sources()}
    assert rows["rotor.airfoil[inner].c81"].value == "sc1095.c81"
    assert rows["rotor.airfoil[outer].cl"].value == "sc1095_cl.csv"
    start = wf.trim(aircraft, inflow="dynamic")
    # the same section but for the deck's coarser angles
    plain = wf.trim(wf.load_aircraft("uh60a"), inflow="dynamic")
    assert list(start.stick.values()) == pytest.approx(list(plain.stick.values()), abs=0.2)
    flight = wf.fly(start, wf.arrested_descent(), inflow="dynamic", revolutions=1, integrator="fixed")
    assert np.all(np.isfinite(flight.data.cl))


def test_decks_of_an_aircraft_are_those_of_a_stand(tmp_path):
    tip = DECKS[: DECKS.index("cl = {")] + ONE[ONE.index("c81 = {") :]
    one = wf.load_aircraft(with_sections(tmp_path / "one", ONE))
    two = wf.load_aircraft(with_sections(tmp_path / "two", tip))
    # equal sections: what lies between them is the same but for rounding
    found, expected = (list(wf.trim(each, inflow="dynamic").stick.values()) for each in (two, one))
    assert found == pytest.approx(expected, abs=1e-6)
    stand = [wf.tunnel(each, collective="8 deg", speed="0 kt", inflow="dynamic").ct for each in (one, two)]
    assert stand[0] == pytest.approx(stand[1], rel=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ('name = "outer"\n', 'name = "outer"\nstation = 3\n', ("rotor.airfoil.1.station", "is stations meant?")),
        ('cm = { table = "sc1095_cm.csv", source = "bemt", confidence = "A/C" }\n', "", ("rotor.airfoil.1", "cm")),
        (
            'c81 = { table = "sc1095.c81", source = "genhel", confidence = "C" }\ncd_increment = { value = 0.002, '
            'source = "genhel", confidence = "A" }\n',
            'c81 = { table = "sc1095.c81", source = "genhel", confidence = "C" }\n',
            ("rotor.airfoil.0.cd_increment", "missing"),
        ),
    ],
)
def test_an_aircraft_leaves_nothing_of_a_section_to_a_default(tmp_path, old, new, named):
    assert old in DECKS
    path = with_sections(tmp_path, DECKS.replace(old, new))
    with pytest.raises(wf.InputError) as caught:
        wf.load_aircraft(path)
    for each in named:
        assert each in str(caught.value), str(caught.value)
