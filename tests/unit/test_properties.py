# SPDX-License-Identifier: MIT OR Apache-2.0
"""What holds for any input: parsers give back what was written or refuse it, units convert both ways, tables keep values,
geometry its invariants."""

import json
import math
import tempfile
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import wakeflight as wf
from wakeflight import _core, units
from wakeflight.aircraft.airfoils import analytic_polar, extended
from wakeflight.aircraft.c81 import read_c81
from wakeflight.text import lines_of, plain_number, read_toml, slug

settings.register_profile(
    "short", max_examples=60, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("short")

finite = st.floats(allow_nan=False, allow_infinity=False, width=64)
lengths = st.floats(-1e3, 1e3)
points = st.tuples(lengths, lengths, lengths)


# --- text and numbers ----------------------------------------------------------------------------------------------------------


@given(finite)
def test_a_number_that_is_written_is_read_to_the_bit(x):
    assert plain_number(repr(x)) == x
    assert plain_number(f" {x:.17e}\t") == x
    assert plain_number(f"{x:.17E}".replace("E", "D")) == x


@given(st.text(max_size=40))
def test_what_is_no_number_is_none_and_what_is_one_is_that_of_python(text):
    found = plain_number(text)
    if found is not None:
        assert found == float(text.replace("d", "e").replace("D", "e"))
        assert text.isascii()


@given(st.text(max_size=300))
def test_any_name_becomes_a_folder_of_its_own(name):
    folder = slug(name)
    assert folder not in ("", ".", "..")
    assert Path(folder).name == folder
    assert not folder.startswith(".")


@given(
    st.lists(st.text(st.characters(exclude_characters="\r\n", exclude_categories=["Cs"])), max_size=5),
    st.sampled_from(["\n", "\r\n", "\r"]),
)
def test_lines_are_what_was_joined(lines, end):
    assert lines_of(end.join(lines)) == (lines or [""])


@given(st.binary(max_size=400))
def test_any_bytes_are_toml_or_refused(content):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "x.toml"
        path.write_bytes(content)
        try:
            assert isinstance(read_toml(path), dict)
        except ValueError as reason:
            assert type(reason) is ValueError


# --- units ---------------------------------------------------------------------------------------------------------------------

KNOWN = sorted(units._DIMENSIONS)


@given(st.floats(-1e6, 1e6), st.lists(st.tuples(st.sampled_from(KNOWN), st.integers(-3, 3)), min_size=1, max_size=4))
def test_a_unit_converts_both_ways(value, parts):
    unit = " ".join(f"{name}^{power}" for name, power in parts)
    factor, dimension = units.factor(unit)
    assume(max(map(abs, dimension)) <= units.HIGHEST_POWER)
    si = " ".join(f"{name}^{power}" for name, power in zip(("kg", "m", "s", "rad"), dimension, strict=True))
    there = units.convert(value, unit, si)
    assert units.convert(there, si, unit) == pytest.approx(value, rel=1e-12, abs=1e-300)
    assert there == pytest.approx(value * factor, rel=1e-12)
    # the inverse of a unit has the inverse factor
    inverse = " ".join(f"{name}^{-power}" for name, power in parts)
    assert units.factor(inverse)[0] * factor == pytest.approx(1.0, rel=1e-12)


@given(st.sampled_from(KNOWN), st.sampled_from(KNOWN))
def test_units_convert_where_their_dimensions_agree_and_nowhere_else(one, other):
    alike = units.factor(one)[1] == units.factor(other)[1]
    if alike:
        assert units.convert(1.0, one, other) * units.convert(1.0, other, one) == pytest.approx(1.0, rel=1e-14)
    else:
        with pytest.raises(ValueError, match="not a unit"):
            units.convert(1.0, one, other)


@given(st.text(max_size=100), st.sampled_from(["m/s", "rad", "kg", "N m/rad"]))
def test_any_text_is_a_quantity_or_refused_in_one_line(text, si):
    try:
        assert math.isfinite(units.quantity(text, si, "field"))
    except wf.InputError as reason:
        assert str(reason).startswith("field = ")
        assert str(reason).isprintable()


@given(st.floats(0.0, 250.0), st.floats(-80.0, 80.0), st.floats(-400.0, 10900.0))
def test_a_condition_holds_what_it_was_given(speed, path, altitude):
    condition = wf.FlightCondition(speed=f"{speed!r} m/s", flight_path=f"{path!r} deg", altitude=f"{altitude!r} m")
    assert condition.speed == speed
    assert condition.flight_path == pytest.approx(math.radians(path), rel=1e-15)
    assert condition.altitude == altitude


# --- tables --------------------------------------------------------------------------------------------------------------------


@given(st.integers(1, 12), st.integers(2, 9), st.randoms(use_true_random=False), st.sampled_from(["columns", "blanks"]))
def test_a_deck_is_read_as_it_was_written(n_mach, n_alpha, rng, form):
    mach = sorted(rng.sample([round(0.05 * i, 2) for i in range(20)], n_mach))
    alpha = sorted(rng.sample(range(-170, 171, 5), n_alpha))
    tables = {name: [[round(rng.uniform(-1.9, 1.9), 3) for _ in mach] for _ in alpha] for name in ("cl", "cd", "cm")}

    def line(first, values, width):
        if form == "blanks":
            return [" ".join([*([] if first is None else [f"{first}"]), *(f"{x}" for x in values)])]
        rows = [values[i : i + 9] for i in range(0, len(values), 9)]
        lead = [" " * 7 if first is None else f"{first:7.1f}", *[" " * 7] * (len(rows) - 1)]
        return [head + "".join(f"{x:7.{width}f}" for x in row) for head, row in zip(lead, rows, strict=True)]

    lines = [f"{'DECK':30s}" + f"{n_mach:02d}{n_alpha:02d}" * 3]
    for values in tables.values():
        lines += line(None, mach, 2)
        for a, row in zip(alpha, values, strict=True):
            lines += line(a, row, 3)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "deck.c81"
        path.write_text("\n".join(lines))
        grids, _ = read_c81(path)
    for name, values in tables.items():
        assert grids[name]["values"] == values
        assert grids[name]["y"] == mach
        assert np.degrees(grids[name]["x"]) == pytest.approx(alpha)


@given(st.integers(0, 30), st.sampled_from([-1, 1]))
def test_a_deck_whose_counts_disagree_with_its_lines_is_refused(at, change):
    lines = [f"{'DECK':30s}" + "0305" * 3]
    for _ in range(3):
        lines.append(" " * 7 + "".join(f"{m:7.2f}" for m in (0.0, 0.4, 0.8)))
        lines += [f"{a:7.1f}" + f"{0.1:7.3f}" * 3 for a in (-180, -90, 0, 90, 180)]
    i = 1 + at % (len(lines) - 1)
    if change > 0:
        lines.insert(i, lines[i])
    else:
        del lines[i]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "deck.c81"
        path.write_text("\n".join(lines))
        with pytest.raises(ValueError, match=r"line \d+|ends before|must ascend"):
            read_c81(path)


@given(st.floats(3.0, 8.0), st.integers(5, 60), st.sampled_from(["flat-plate", "mirror"]))
def test_a_table_that_is_continued_keeps_its_own_values_and_closes(slope, last, way):
    whole = analytic_polar(slope, 0.0, (0.01, 0.0, 1.0), 0.0, False)
    first = 0 if way == "mirror" else -last
    end = 180 if way == "mirror" else last
    kept = [i for i, x in enumerate(whole["cl"]["x"]) if first - 1e-9 <= math.degrees(x) <= end + 1e-9]
    assume(len(kept) > 2)
    cut = {
        name: {**g, "x": [g["x"][i] for i in kept], "values": [g["values"][i] for i in kept]}
        for name, g in whole.items()
    }
    found, notes = extended(cut, way)
    assert len(notes) == 3
    for name, grid in found.items():
        assert grid["x"][0] == pytest.approx(-math.pi)
        assert grid["x"][-1] == pytest.approx(math.pi)
        assert all(b > a for a, b in pairwise(grid["x"]))
        by_angle = dict(zip(grid["x"], grid["values"], strict=True))
        assert all(by_angle[x] == row for x, row in zip(cut[name]["x"], cut[name]["values"], strict=True))
    assert min(min(row) for row in found["cd"]["values"]) >= 0.0
    # the same attitude from both sides
    for name in ("cl", "cd"):
        assert found[name]["values"][0] == pytest.approx(found[name]["values"][-1], abs=1e-12)


def test_a_table_that_ends_before_half_a_turn_is_not_mirrored():
    grid = {"x": [0.0, math.radians(100.0)], "y": [0.0], "values": [[0.0], [0.0]]}
    with pytest.raises(ValueError, match="cd: extend = mirror needs angles up to 180 deg; the last is 100 deg"):
        extended({"cd": grid}, "mirror")


# --- sticks --------------------------------------------------------------------------------------------------------------------


@given(st.lists(st.tuples(st.floats(0.001, 2.0), st.floats(-3.0, 3.0)), min_size=2, max_size=8), st.floats(0.0, 20.0))
def test_sticks_pass_through_their_corners_and_stay_between_them(steps, t):
    times = np.cumsum([dt for dt, _ in steps])
    inches = [0.0, *(x for _, x in steps[1:])]
    assume(any(inches))
    corners = list(zip(times.tolist(), inches, strict=True))
    flown = wf.Maneuver("m", {"pedal": corners}, seconds=100.0)
    for time, value in corners:
        assert flown.offset(time)[3] == pytest.approx(value, abs=1e-9)
    assert min(inches) - 1e-12 <= flown.offset(t)[3] <= max(inches) + 1e-12
    # the rate is the slope of the offset
    h = 1e-7
    if all(abs(t - each) > 1e-5 for each in times):
        assert flown.rate(t)[3] == pytest.approx(
            (flown.offset(t + h)[3] - flown.offset(t - h)[3]) / (2 * h), rel=1e-3, abs=1e-4
        )


# --- geometry ------------------------------------------------------------------------------------------------------------------

LAW = {"core": "vatistas2", "core_distance": "line", "method": "direct", "curvature_correction": False}


def velocity(at, nodes, strength):
    """Velocity of one filament at some points."""
    nodes = np.asarray(nodes, dtype=float)
    n = len(nodes) - 1
    radius = np.full(n, 0.1)
    law = json.dumps(LAW)
    return _core.induced_velocity(np.asarray(at, float), nodes, np.array([n + 1]), (np.full(n, strength), radius), law)


@given(st.lists(points, min_size=2, max_size=6), points, points, st.floats(0.0, 2 * math.pi))
def test_induced_velocity_turns_and_moves_with_its_filament(nodes, at, shift, angle):
    nodes, at, shift = np.array(nodes), np.array([at]), np.array(shift)
    turn = np.array(
        [[math.cos(angle), -math.sin(angle), 0.0], [math.sin(angle), math.cos(angle), 0.0], [0.0, 0.0, 1.0]]
    )
    here = velocity(at, nodes, 10.0)
    there = velocity(at @ turn.T + shift, nodes @ turn.T + shift, 10.0)
    # rounding of the moved coordinates, over the least distance at which it counts: the core
    scale = 1e-9 * (1.0 + np.abs(here).max())
    distance = np.linalg.norm(nodes - at, axis=1).min()
    assume(distance > 1.0)
    assert there == pytest.approx(here @ turn.T, abs=1e-6 + scale)


# strengths whose products stay normal numbers: below 2e-308 there is no relative accuracy
strengths = st.floats(-1e3, 1e3).filter(lambda strength: strength == 0.0 or abs(strength) > 1e-200)


@given(st.lists(points, min_size=2, max_size=6), points, strengths)
def test_induced_velocity_is_linear_and_changes_sign_with_the_order_of_the_nodes(nodes, at, strength):
    # a distance from the line that is rounding of the coordinates has no accuracy to ask for
    size = np.abs([*nodes, at]).max()
    for begin, end in pairwise(np.array(nodes)):
        area = np.linalg.norm(np.cross(np.array(at) - begin, end - begin))
        assume(area == 0.0 or area > 1e-6 * size * np.linalg.norm(end - begin))
    one = velocity([at], nodes, 1.0)
    # parts that cancel leave their rounding
    parts = sum(np.abs(velocity([at], pair, 1.0)).max() for pair in pairwise(nodes))
    rounding = 1e-12 * parts + 1e-300
    assert velocity([at], nodes, strength) == pytest.approx(strength * one, rel=1e-12, abs=abs(strength) * rounding)
    assert velocity([at], nodes[::-1], 1.0) == pytest.approx(-one, rel=1e-9, abs=1e-9 * parts + 1e-300)
    # of the mirror image in y = 0 the velocity is the mirror image with the other sign
    mirror = np.array([1.0, -1.0, 1.0])
    there = velocity([np.array(at) * mirror], np.array(nodes) * mirror, 1.0)
    assert there == pytest.approx(-one * mirror, rel=1e-12, abs=rounding)
