# SPDX-License-Identifier: MIT OR Apache-2.0
"""The end of a hovering wake, and blades whose sections meet the air at three quarters of the chord."""

import numpy as np
import pytest

import wakeflight as wf


def hover(rotor, blade_model="lifting-line", **options):
    wake = wf.RelaxationWake(trailers="tip", azimuth_step="15 deg", n_stations=12, **options)
    return wf.tunnel(rotor, collective="8 deg", inflow=wake, blade_model=blade_model)


def test_closed_end_makes_a_hovering_wake_independent_of_its_turns(two_blades):
    # from 4 to 6 turns; without closure the thrust still changes by per cent
    closed = [hover(two_blades, turns=t, far_wake="cylinder").ct for t in (4, 6)]
    cut = [hover(two_blades, turns=t, far_wake_turns=0).ct for t in (4, 6)]
    assert closed[1] == pytest.approx(closed[0], rel=2e-3)
    assert abs(cut[1] / cut[0] - 1) > 5 * abs(closed[1] / closed[0] - 1)
    # what the repeats of the last turn approach
    repeats = hover(two_blades, turns=4, far_wake_turns=20).ct
    assert closed[0] == pytest.approx(repeats, rel=5e-3)


def test_the_lattice_of_a_hovering_wake_depends_little_on_the_turns_of_its_far_wake(two_blades):
    # each pair of turns brings less: 4, 8, 16 turns behind two free ones
    wakes = [wf.RelaxationWake(azimuth_step="15 deg", n_stations=12, far_wake_turns=n) for n in (4, 8, 16)]
    ct = [wf.tunnel(two_blades, collective="8 deg", inflow=wake).ct for wake in wakes]
    first, second = abs(ct[1] / ct[0] - 1), abs(ct[2] / ct[1] - 1)
    assert second < 0.5 * first
    assert second < 1e-2


def test_a_helicopter_that_hovers_with_its_sticks_held_stays_in_hover(uh60a):
    # a far wake that acted at once fed back with the period of the free turns: -Z/W between 0.2 and 1.2 in these two seconds
    start = wf.trim(uh60a, wf.FlightCondition(speed="0 kt", flight_path="0 deg"), inflow="relaxation")
    held = wf.Maneuver("held", {"lateral": [(0.0, 0.0), (0.1, 0.0)]}, seconds=2.0)
    data = wf.fly(start, held, inflow="time-marching", integrator="fixed").data
    assert np.ptp(data["force_z"].values) < 0.05 * start.condition.weight
    assert np.ptp(data["inflow_mean"].values) < 0.05 * float(data["inflow_mean"].mean())


def test_the_closed_end_is_for_tip_vortices_in_axial_flow():
    with pytest.raises(wf.InputError, match="far_wake"):
        wf.tunnel("uh60a", speed="60 kt", inflow=wf.RelaxationWake(far_wake="cylinder"))
    for given in ({"trailers": "full-span"}, {"inboard_wake": "sheet"}, {"far_wake_turns": 2}, {"turns": 1}):
        with pytest.raises(wf.InputError, match="far_wake"):
            wf.tunnel("uh60a", inflow=wf.RelaxationWake(far_wake="cylinder", **given))


def test_second_order_lifting_line_is_weissinger_where_tables_are_thin(two_blades):
    # section tables of slope 2 pi against flow tangency: sin alpha apart; so slow that the chord is that of incompressible flow
    slow = wf.load_rotor(two_blades).with_({"rotor.omega": "125 rpm"})
    table = hover(slow, "second-order", turns=3).data
    tangency = wf.tunnel(
        slow,
        collective="8 deg",
        inflow=wf.RelaxationWake(trailers="tip", azimuth_step="15 deg", n_stations=12, turns=3),
        blade_model="weissinger",
        prandtl_glauert=False,
    ).data
    assert table.circulation.values == pytest.approx(tangency.circulation.values, rel=5e-3, abs=1e-4)
    assert float(table.ct) == pytest.approx(float(tangency.ct), rel=5e-3)


@pytest.fixture(scope="module")
def two_blades(tmp_path_factory):
    path = tmp_path_factory.mktemp("rotor") / "rotor.toml"
    path.write_text(
        """
format = 1
name = "Two blades"
[rotor]
n_blades = 2
radius = "1.143 m"
omega = "1250 rpm"
[rotor.blade]
root = "clamped"
flexible = false
root_station = "0 m"
root_cutout = "0.1905 m"
geometry = { columns = { r_R = [0.0, 1.0], chord_m = [0.1905, 0.1905], twist_deg = [0.0, 0.0] } }
[rotor.airfoil]
name = "thin"
polar = { lift_curve_slope = "6.283185307179586 1/rad", cd = [0.01, 0.0, 0.0], prandtl_glauert = false }
"""
    )
    return path
