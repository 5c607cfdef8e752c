# SPDX-License-Identifier: MIT OR Apache-2.0
"""Manoeuvres: the paper's stick histories, and what a user's file may hold."""

import numpy as np
import pytest

from wakeflight.errors import InputError
from wakeflight.maneuver_files import arrested_descent, load_maneuver, roll_reversal
from wakeflight.maneuvers import Maneuver

OMEGA = 27.0
TRIM = (4.6, 5.0, 4.0, 2.7)
TRAVEL = (10.0, 10.0, 10.0, 5.38)


def test_arrested_descent_is_the_papers():
    maneuver = arrested_descent()
    assert maneuver.duration(OMEGA) == pytest.approx(12 * 2 * np.pi / 27)
    assert maneuver.duration_revolutions(OMEGA) == 12
    # starts after two revolutions, peaks half a second later, is back after another half
    assert maneuver.corners() == pytest.approx((2 * 2 * np.pi / 27, 0.9654, 1.4654), abs=1e-4)
    for t, inches in ((0.0, 0.0), (0.4, 0.0), (0.7154, 1.85), (0.9654, 3.7), (1.2154, 1.85), (2.0, 0.0)):
        assert maneuver.stick(t, TRIM) == pytest.approx([4.6, 5.0, 4.0 + inches, 2.7])
    assert maneuver.rate(0.7)[2] == pytest.approx(7.4)
    assert maneuver.rate(1.2)[2] == pytest.approx(-7.4)
    assert maneuver.rate(0.2)[2] == 0.0
    assert maneuver.check_travel(TRIM, TRAVEL) == []


def test_arrested_descent_can_start_when_the_paper_prints_it():
    assert arrested_descent(start="2 s").corners() == pytest.approx((2.0, 2.5, 3.0))
    for wrong in ("-1 s", "9 s", 2.0, "2 kt"):
        with pytest.raises(InputError, match="start"):
            arrested_descent(start=wrong)


def test_roll_reversal_is_the_papers():
    maneuver = roll_reversal()
    assert maneuver.duration(OMEGA) == pytest.approx(8.38, abs=0.005)
    lateral = [maneuver.stick(t, TRIM)[0] - TRIM[0] for t in (0.2, 0.43, 2.5, 3.3, 4.7, 5.5, 6.9, 7.2, 8.3)]
    assert lateral == pytest.approx([0.0, 2.59, 2.59, -5.13, -5.13, 2.59, 2.59, 0.0, 0.0])
    assert lateral[1] - lateral[3] == pytest.approx(7.72)
    assert maneuver.corners() == pytest.approx((0.23, 0.43, 2.6, 3.3, 4.8, 5.5, 7.0, 7.2))


def test_the_shipped_roll_reversal_is_flown_beyond_the_stop_with_a_warning():
    warnings = roll_reversal().check_travel(TRIM, TRAVEL)
    assert len(warnings) == 2
    assert "0.530 in beyond" in warnings[0]
    # the ramps of 0.2 s are the fastest: 2.59 in at 12.95 in/s against 10 in/s
    assert "beyond 10 in/s" in warnings[1]


def test_a_users_manoeuvre_beyond_the_travel_is_refused():
    with pytest.raises(InputError, match="lateral"):
        roll_reversal().check_travel(TRIM, TRAVEL, shipped=False)
    wide = Maneuver("wide", (("pedal", ((0.0, 0.0), (1.0, 6.0))),), seconds=2.0)
    with pytest.raises(InputError, match="travel"):
        wide.check_span(TRAVEL)


def test_rates_are_the_slopes_of_the_stick():
    maneuver = roll_reversal()
    for t in (0.1, 0.33, 1.0, 2.9, 4.0, 5.1, 7.1, 8.0):
        step = 1e-6
        slope = (maneuver.stick(t + step, TRIM) - maneuver.stick(t - step, TRIM)) / (2 * step)
        assert maneuver.rate(t) == pytest.approx(slope, abs=1e-6)


def test_another_aircraft_gets_the_same_share_of_its_travel_and_the_same_times():
    own, travel = arrested_descent(), (8.65, 12.12, 9.0, 4.34)
    flown = own.for_aircraft(travel, 44.4)
    assert flown.offset(0.9654)[2] == pytest.approx(3.7 * 0.9)
    assert flown.corners() == own.corners()
    # 12 revolutions at 27 rad/s are 19.73 at 44.4 rad/s: the next whole number
    assert flown.revolutions == 20
    assert own.duration(27.0) <= flown.duration(44.4) < own.duration(27.0) + 2 * np.pi / 44.4
    assert "collective inches times 0.9" in flown.adapted[0]
    assert "20 at 44.4 rad/s" in flown.adapted[1]
    # once adapted it is the aircraft's own
    assert flown.for_aircraft(travel, 44.4) == flown
    assert own.for_aircraft(TRAVEL, OMEGA).adapted == ()
    # every corner of the longer manoeuvre is flown on the faster rotor
    assert roll_reversal().for_aircraft(travel, 44.4).duration(44.4) > roll_reversal().corners()[-1]


def test_inches_without_a_travel_are_flown_as_they_are():
    own = Maneuver("step", (("pedal", ((0.0, 0.0), (1.0, 0.5))),), revolutions=3)
    flown = own.for_aircraft((8.65, 12.12, 9.0, 4.34), 44.4)
    assert (flown.offset(1.0)[3], flown.revolutions, flown.adapted) == (0.5, 3, ())


def test_any_history_can_come_from_a_file(tmp_path):
    path = tmp_path / "doublet.toml"
    path.write_text(
        'name = "doublet"\nduration = { seconds = 3 }\n[controls]\n'
        "pedal = [[0.5, 0], [0.6, 0.5], [1.5, 0.5], [1.6, -0.5]]\nlongitudinal = [[0, 0], [1, 1.0]]\n"
    )
    maneuver = load_maneuver(path)
    assert not maneuver.shipped
    assert maneuver.duration_revolutions(OMEGA) == pytest.approx(3 * OMEGA / (2 * np.pi))
    assert maneuver.offset(10.0) == pytest.approx([0.0, 1.0, 0.0, -0.5])
    assert maneuver.corners() == pytest.approx((0.0, 0.5, 0.6, 1.0, 1.5, 1.6))


GOOD = 'name = "x"\nduration = { revolutions = 5 }\n[controls]\ncollective = [[0.5, 0], [1, 1]]\n'


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("[0.5, 0]", "[-0.5, 0]", "collective"),
        ("[0.5, 0]", "[1.5, 0]", "collective"),
        ("[0.5, 0]", "[0.5, 1]", "trim"),
        ("[0.5, 0]", "[nan, 0]", "finite"),
        ("[0.5, 0]", '["0.5", 0]', "collective"),
        ("[0.5, 0], ", "", "two corner"),
        ("collective", "throttle", "throttle"),
        ("revolutions = 5", "revolutions = 0", "duration"),
        ("revolutions = 5", "turns = 5", "turns"),
        ("revolutions = 5", "revolutions = 5, seconds = 2", "duration"),
        ("duration = { revolutions = 5 }\n", "", "duration"),
        ('name = "x"\n', 'name = "x"\nspeed = 3\n', "speed"),
        ("[controls]", "[controls", "TOML"),
    ],
)
def test_a_wrong_file_gets_one_line(tmp_path, old, new, named):
    path = tmp_path / "wrong.toml"
    assert old in GOOD
    path.write_text(GOOD.replace(old, new))
    with pytest.raises(InputError) as caught:
        load_maneuver(path)
    message = str(caught.value)
    assert "wrong.toml" in message
    assert named in message
    assert "\n" not in message


def test_an_unknown_name_lists_the_known_ones():
    with pytest.raises(InputError, match=r"arrested-descent, roll-reversal"):
        load_maneuver("loop")


@pytest.mark.parametrize(
    ("given", "named"),
    [
        # clock times: nothing of it would be flown
        (
            {"corners_of": (("lateral", ((1.7e9, 0.0), (1.7e9 + 1, 0.2))),), "seconds": 2.0},
            "before the end of the flight",
        ),
        ({"corners_of": (("lateral", ((2.0, 0.0), (3.0, 0.2))),), "seconds": 2.0}, "lateral"),
        ({"corners_of": (("throttle", ((0.0, 0.0), (1.0, 0.2))),), "seconds": 2.0}, "throttle"),
        ({"corners_of": (("pedal", ((0.0, 0.0), (1.0, 0.2))),) * 2, "seconds": 2.0}, "given twice"),
        ({"corners_of": (("pedal", ((0.0, 0.1), (1.0, 0.2))),), "seconds": 2.0}, "trim"),
        ({"corners_of": (("pedal", ((-1.0, 0.0), (1.0, 0.2))),), "seconds": 2.0}, "0 s or later"),
        ({"corners_of": (("pedal", ((0.0, 0.0), (0.0, 0.2))),), "seconds": 2.0}, "ascend"),
        ({"corners_of": (("pedal", ((0.0, 0.0), (1.0, "0.2"))),), "seconds": 2.0}, "must be a finite number"),
        ({"corners_of": (("pedal", ((0.0, 0.0), (1.0, 1e400))),), "seconds": 2.0}, "finite"),
        ({"corners_of": (("pedal", (0.0, 0.0, 1.0, 0.2)),), "seconds": 2.0}, "pairs of numbers"),
        ({"corners_of": (("pedal", ((0.0, 0.0), (1.0, 10**400))),), "seconds": 2.0}, "finite"),
        ({"corners_of": None, "seconds": 2.0}, "corners_of"),
        ({"corners_of": (("pedal", ((0.0, 0.0), (1.0, 0.2))),), "seconds": "2"}, "seconds"),
        (
            {"corners_of": (("pedal", ((0.0, 0.0), (1.0, 0.2))),), "revolutions": 2, "rotor_speed": 1e-308},
            "rotor_speed",
        ),
        ({"corners_of": (("pedal", ((0.0, 0.0), (1.0, 0.2))),), "seconds": 2, "travel_in": "1"}, "travel"),
        ({"corners_of": {"pedal": (0.0, 1.0)}, "seconds": 2.0}, "pairs of numbers"),
        ({"corners_of": (("pedal", ((0.0, 0.0), (1.0, 0.2))),), "seconds": 2.0, "rotor_speed": 27.0}, "rotor_speed"),
    ],
)
def test_a_history_that_would_not_be_flown_is_refused(given, named):
    with pytest.raises(InputError) as caught:
        Maneuver("x", **given)
    assert named in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_history_in_revolutions_that_begins_after_the_end_is_refused_for_the_aircraft():
    # three revolutions at 27 rad/s are 0.698 s
    late = Maneuver("late", (("pedal", ((0.8, 0.0), (1.0, 0.5))),), revolutions=3)
    with pytest.raises(InputError, match=r"0\.698"):
        late.for_aircraft(TRAVEL, OMEGA)
    assert late.for_aircraft(TRAVEL, OMEGA / 2).check_end(1.396) == []


def test_corners_after_the_end_of_the_flight_are_named():
    cut = Maneuver("cut", (("pedal", ((0.5, 0.0), (1.0, 0.5), (3.0, 0.5), (4.0, 0.0))),), seconds=2.0)
    (warning,) = cut.check_end(2.0)
    assert "pedal corners from 4 s on" in warning
    # held at the end, nothing is lost
    held = Maneuver("held", (("pedal", ((0.5, 0.0), (1.0, 0.5), (9.0, 0.5))),), seconds=2.0)
    assert held.check_end(2.0) == []
    still = Maneuver("still", (("pedal", ((0.0, 0.0), (9.0, 0.0))),), seconds=2.0)
    assert still.check_end(2.0) == []


def test_a_manoeuvre_file_may_begin_with_a_byte_order_mark(tmp_path):
    path = tmp_path / "bom.toml"
    path.write_bytes(b"\xef\xbb\xbf" + GOOD.encode())
    assert load_maneuver(path).name == "x"
    path.write_bytes(GOOD.replace('"x"', '"\u00fc"').encode("latin-1"))
    with pytest.raises(InputError, match="UTF-8"):
        load_maneuver(path)


def test_sticks_may_be_given_by_name():
    by_name = Maneuver("step", {"lateral": [(0.1, 0.0), (0.3, 1)]}, seconds=3.0)
    assert by_name == Maneuver("step", (("lateral", ((0.1, 0.0), (0.3, 1.0))),), seconds=3.0)
    assert hash(by_name) == hash(by_name.for_aircraft(TRAVEL, OMEGA))
    with pytest.raises(InputError, match="throttle"):
        Maneuver("step", {"throttle": [(0.1, 0.0), (0.3, 1.0)]}, seconds=3.0)


def test_a_stick_does_not_jump():
    # times that ascend by less than a recorder resolves are a jump, whose rate is no number
    for gap in (1e-9, 5e-324):
        with pytest.raises(InputError, match="jump"):
            Maneuver("jump", {"pedal": [(0.0, 0.0), (gap, 1.0)]}, seconds=1.0)
