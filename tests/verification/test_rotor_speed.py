# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rotor whose speed is prescribed: flights and stands against those of constant speed, and kept flights to the bit."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.results.turns import revolutions
from wakeflight.simulation import Simulation

DROOP = [("0.21 s", 1.0), ("0.63 s", 0.93)]


@pytest.fixture(scope="module")
def start(uh60a):
    return wf.trim(uh60a, wf.FlightCondition(speed="80 kt"), inflow="dynamic")


@pytest.fixture(scope="module")
def drooped(start):
    return wf.fly(start, wf.arrested_descent(), revolutions=6, integrator="fixed", rotor_speed=DROOP).data


def test_a_history_that_stays_is_the_flight_at_constant_speed(start):
    maneuver = wf.arrested_descent()
    constant = wf.fly(start, maneuver, revolutions=3, integrator="fixed").data
    # where steps end: a corner within one would end a step of the solver there
    steady = [(f"{k * float(constant.time[1])!r} s", 1.0) for k in (12, 40)]
    same = wf.fly(start, maneuver, revolutions=3, integrator="fixed", rotor_speed=steady).data
    assert np.abs(same.time.values - constant.time.values).max() < 1e-12
    for name in ("w", "q", "roll", "modal", "inflow", "power"):
        scale = np.abs(constant[name].values).max()
        assert np.abs(same[name].values - constant[name].values).max() < 1e-9 * scale, name


def test_coupling_steps_are_steps_of_azimuth(drooped):
    turns = revolutions(drooped)
    n, lengths = drooped.time.size - 1, np.diff(drooped.time.values)
    # trapezoids of a linear speed; in the two steps that hold a corner they err by the jump of its rate, h^2/8 of it at most
    error = np.abs(np.diff(turns) - 6.0 / n)
    jump = 0.07 * drooped.attrs["omega"] / (0.63 - 0.21)
    assert np.sort(error)[-3] < 1e-12
    assert error.max() < jump * lengths.max() ** 2 / 8 / (2 * np.pi)
    psi = np.unwrap(drooped.azimuth.values[:, 0])
    assert np.abs(np.diff(psi) - 2 * np.pi * 6 / n).max() < 1e-12
    assert lengths[-1] / lengths[0] == pytest.approx(1 / 0.93, rel=1e-9)
    assert drooped.rotor_speed.values[-1] == pytest.approx(0.93 * drooped.attrs["omega"], rel=1e-12)


def test_a_slower_rotor_lets_the_aircraft_sink(start, drooped):
    constant = wf.fly(start, wf.Maneuver("nothing", (), seconds=1.0), revolutions=5, integrator="fixed")
    held = wf.fly(start, wf.Maneuver("nothing", (), seconds=1.0), revolutions=5, integrator="fixed", rotor_speed=DROOP)
    t = float(held.data.time[-1])
    level = np.interp(t, constant.data.time.values, constant.data.w.values)
    # a seventh of the thrust is gone after 0.6 s
    assert held.data.w.values[-1] - level > 0.2


def test_energy_is_the_work_of_the_loads_as_the_step_vanishes(uh60a):
    off = []
    for step in ("10 deg", "5 deg"):
        start = wf.trim(uh60a, wf.FlightCondition(speed="80 kt"), inflow=wf.DynamicInflow(azimuth_step=step))
        held = wf.fly(
            start, wf.Maneuver("nothing", (), seconds=1.0), revolutions=5, integrator="fixed", rotor_speed=DROOP
        )
        off.append(np.abs(held.data.energy_balance.values).max())
    # the work is counted by trapezoids, of order two; what had no part in it would stay
    assert off[1] < off[0] / 3


@pytest.mark.parametrize("integrator", ["fixed", "ida"])
@pytest.mark.parametrize("blades", ["flexible", "rigid"])
def test_a_kept_flight_goes_on_to_the_same_bits(uh60a, start, integrator, blades):
    if blades == "rigid":
        start = wf.trim(uh60a.with_rigid_blades(), wf.FlightCondition(speed="80 kt"), inflow="dynamic")
    sim = Simulation(start, integrator=integrator, rotor_speed=DROOP)

    def flown():
        rows = []
        for _ in range(6):
            sim.step({"lateral": 0.3})
            rows.append(np.concatenate([sim.y, [sim.t]]))
        return np.array(rows)

    flown()
    # the first corner of the speed lies in the steps that are kept
    for _ in range(22):
        sim.step()
    kept = sim.snapshot()
    rest = flown()
    sim.restore(kept)
    assert np.array_equal(flown(), rest)
    other = Simulation(start, integrator=integrator)
    with pytest.raises(wf.InputError, match="rotor speed"):
        other.restore(kept)


def test_integrators_agree_while_the_speed_changes(start):
    runs = [
        wf.fly(start, wf.arrested_descent(), revolutions=4, integrator=name, rotor_speed=DROOP).data
        for name in ("fixed", "ida")
    ]
    for name in ("w", "q", "p"):
        a, b = (run[name].values for run in runs)
        assert np.abs(a - b).max() < 2e-3 * max(np.abs(a - a[0]).max(), 0.05), name


@pytest.mark.parametrize(("blades", "within"), [("rigid", 1e-6), ("flexible", 1e-3)])
def test_a_stand_that_has_slowed_down_is_the_stand_at_that_speed(uh60a, blades, within):
    share = 0.9
    asked = {"collective": "16 deg", "speed": "0 kt", "inflow": "dynamic"}
    # blades that bend keep the modes of the nominal speed: 1.3 % of the thrust with five of them, 0.04 % with eight
    rotor = uh60a.with_rigid_blades() if blades == "rigid" else uh60a.discretised(n_modes=8)
    stand = wf.tunnel(rotor, **asked)
    slow = wf.tunnel(rotor, omega=f"{share * stand.model.omega} rad/s", **asked)
    speed = [("0.2 s", 1.0), ("2.2 s", share)]
    data = stand.transient([("0.1 s", "16 deg")], "9 s", rotor_speed=speed)
    settled = data.thrust.values[-36:].mean()
    assert settled == pytest.approx(slow.data.thrust.item(), rel=within)
    assert data.torque.values[-36:].mean() == pytest.approx(slow.data.torque.item(), rel=within)
    assert data.rotor_speed.values[-1] == pytest.approx(share * stand.model.omega)
