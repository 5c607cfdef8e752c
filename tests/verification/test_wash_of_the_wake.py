# SPDX-License-Identifier: MIT OR Apache-2.0
"""The wake felt by the airframe, and the fuselage by the blades: the velocity is that of the wake at the parts, trims and flights
feel it, snapshots keep it, the mirror image has it mirrored; on a stand and with dynamic inflow there is no such thing."""

import numpy as np
import pytest

import wakeflight as wf

COARSE = {"azimuth_step": "15 deg", "turns": 2, "n_stations": 12}
SLOW = wf.FlightCondition(speed="70 kt", flight_path="0 deg")
FUSELAGE, STABILATOR, FIN, TAIL_ROTOR = range(4)


@pytest.fixture(scope="module")
def rigid():
    return wf.load_aircraft("uh60a").with_rigid_blades()


@pytest.fixture(scope="module")
def washed(rigid):
    return wf.trim(rigid, SLOW, inflow=wf.RelaxationWake(**COARSE, wash="wake"))


@pytest.fixture(scope="module")
def by_tables(rigid):
    return wf.trim(rigid, SLOW, inflow=wf.RelaxationWake(**COARSE))


def rotation(tilt):
    # x_h = -(u cos i + w sin i), z_h = u sin i - w cos i
    c, s = np.cos(tilt), np.sin(tilt)
    return np.array([[-c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, -c]]).T


def stabilator_points(model):
    """Middles of five strips of a span of sqrt(4 area), hub axes [m]."""
    part = model.data["stabilator"]
    span = np.sqrt(4.0 * part["area"])
    from_hub = np.asarray(part["position"]) - np.asarray(model.data["rotor"]["position"])
    body = from_hub + np.outer([-0.4, -0.2, 0.0, 0.2, 0.4], [0.0, span, 0.0])
    return np.ascontiguousarray(body @ rotation(model.data["rotor"]["shaft_tilt_forward"]))


def test_the_stabilator_feels_the_mean_velocity_of_the_wake_over_span_and_passage(washed):
    model = washed.model
    points = stabilator_points(model)
    rows = range(model.steps_per_revolution // model.n_blades)
    at_hub = np.mean([washed.wake.relaxation.wake_velocity(points, row) for row in rows], axis=(0, 1))
    found = washed.wake.wash[STABILATOR]
    assert found == pytest.approx(rotation(model.data["rotor"]["shaft_tilt_forward"]) @ at_hub, rel=1e-12)
    # what was trimmed on is that of the wake one pass before it rested
    assert np.abs(washed.problem.wash - washed.wake.wash).max() < 0.2
    # down, by about the induced velocity to twice of it
    induced = washed.mean_outputs()["inflow_mean"] * model.tip_speed
    assert 0.5 * induced < found[2] < 2.5 * induced


def test_a_trim_feels_the_wake_and_says_what_it_felt(washed, by_tables):
    assert by_tables.problem.wash is None and "wash" not in by_tables.to_dataset()
    data = washed.to_dataset()
    assert data["wash"].dims == ("part", "xyz")
    assert list(data["part"].values) == ["fuselage", "stabilator", "fin", "tail rotor"]
    assert np.array_equal(data["wash"], washed.problem.wash)
    assert abs(washed.pitch - by_tables.pitch) > np.radians(0.1)
    # the wake takes the air down past the fuselage: its load is in the balances
    assert max(washed.residuals["linear"], washed.residuals["angular"]) < 1e-4


def test_the_parts_get_what_they_are_given(washed):
    """A wash at the tail rotor alone changes yaw and side force; one at the stabilator the pitching moment."""
    model, t = washed.model, 0.0
    y, y_dot = model.core.trim_state(washed.problem, washed.x, t)
    inputs = washed.inputs(t)

    def moment(wash):
        return np.array(model.core.outputs(t, y, y_dot, inputs.washed(wash))["moment"])

    none = moment(np.zeros((4, 3)))
    for part, velocity, axis, sign in (
        (STABILATOR, (0.0, 0.0, 5.0), 1, 1.0),  # air going down pushes the tail down: nose up
        (FIN, (0.0, 5.0, 0.0), 2, -1.0),  # air going right pushes the fin right: nose left
        (TAIL_ROTOR, (0.0, 5.0, 0.0), 2, -1.0),  # air with its thrust loads it more
    ):
        wash = np.zeros((4, 3))
        wash[part] = velocity
        assert sign * (moment(wash) - none)[axis] > 1000.0, part
    with pytest.raises(ValueError, match="wash"):
        inputs.washed(np.zeros((3, 3)))


@pytest.mark.parametrize("kind", [wf.TimeMarchingWake, wf.RelaxationWake])
def test_a_flight_records_it_and_goes_on_from_a_snapshot_with_the_same_bits(washed, kind):
    flown = kind(**COARSE, wash="wake", **({"convergence_revolutions": 2} if kind is wf.TimeMarchingWake else {}))
    sim = wf.Simulation(washed, inflow=flown)
    steps = sim.model.steps_per_revolution
    for _ in range(steps // 3):
        sim.step({"longitudinal": 0.5})
    kept, after = sim.snapshot(), []
    for _ in range(2):
        after.append([])
        for _ in range(steps // 3):
            sim.step({"longitudinal": 0.5})
            after[-1].append((sim.y, sim.exchange.wash))
        sim.restore(kept)
    for (y, wash), (again, wash_again) in zip(*after, strict=True):
        assert np.array_equal(y, again) and np.array_equal(wash, wash_again)
    # a relaxation wake is renewed once a revolution
    assert np.array_equal(after[0][0][1], after[0][-1][1]) == (kind is wf.RelaxationWake)

    data = wf.fly(washed, wf.roll_reversal(), inflow=flown, revolutions=0.5, integrator="fixed").data
    assert data["wash"].dims == ("time", "part", "xyz")
    assert np.all(data["wash"].sel(part="stabilator", xyz="z") > 0.0)


def test_what_a_marching_wake_gives_is_the_mean_of_its_own_velocity_over_the_last_passage(washed):
    sim = wf.Simulation(washed, inflow=wf.TimeMarchingWake(**COARSE, wash="wake", convergence_revolutions=0))
    points, per_passage = stabilator_points(sim.model), sim.model.steps_per_revolution // sim.model.n_blades
    seen = []
    for _ in range(per_passage):
        sim.step()
        seen.append(sim.exchange.wake().wake_velocity(points).mean(axis=0))
    expected = rotation(sim.model.data["rotor"]["shaft_tilt_forward"]) @ np.mean(seen, axis=0)
    assert sim.exchange.wash[STABILATOR] == pytest.approx(expected, rel=1e-12)


def test_the_mirror_image_feels_the_mirrored_wake(rigid, washed):
    image = wf.trim(rigid.mirrored(), SLOW, inflow=washed.inflow)
    assert np.abs(image.problem.wash * [1.0, -1.0, 1.0] - washed.problem.wash).max() < 1e-9
    assert image.pitch == pytest.approx(washed.pitch, abs=1e-12)


def test_the_fuselage_lifts_the_air_in_front_of_the_hub_and_lets_it_down_behind(rigid, by_tables):
    level = wf.FlightCondition(speed="100 kt", flight_path="0 deg")
    maps = [
        wf.trim(rigid, level, inflow=wf.RelaxationWake(**COARSE, fuselage_upwash=word)).inflow_map
        for word in ("none", "spheroid")
    ]
    change, n = maps[1] - maps[0], maps[0].shape[0]
    inboard = slice(0, 4)
    front, behind = (np.mean(change[row, inboard]) for row in (n // 2, 0))
    assert front < -5e-4 and behind > 5e-4
    # it falls with the cube of the distance: little is left at the tips abeam
    assert np.abs(change[n // 4, -2:]).max() < 0.3 * abs(front)


@pytest.mark.parametrize("given", [{"wash": "wake"}, {"fuselage_upwash": "spheroid"}])
def test_a_stand_and_dynamic_inflow_refuse_them_by_name(given):
    (name,) = given
    with pytest.raises(wf.InputError, match=f"{name} = .* on a stand, which has no airframe"):
        wf.tunnel(wf.load_rotor("uh60a"), inflow=wf.RelaxationWake(**given), thrust="70 kN")
    with pytest.raises(wf.InputError, match=name):
        wf.DynamicInflow(**given)
