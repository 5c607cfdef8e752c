"""The environment of Gymnasium: what the checker asks, seeds, limits, sticks, several at a time."""

import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import wakeflight as wf

STILL = np.zeros(4, dtype=np.float32)


@pytest.fixture(scope="module")
def env():
    return wf.gym.HelicopterEnv("cruise", seconds=1.0)


def test_the_checker_of_gymnasium_is_content():
    made = gymnasium.make("wakeflight.gym:wakeflight/Helicopter-v0", seconds=0.2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(made.unwrapped)


def test_an_episode_at_trim_stays_there_and_is_truncated(env):
    first, info = env.reset(seed=0, options={"upset": 0.0})
    assert info == {"t": 0.0, "condition": 0}
    assert first in env.observation_space
    assert env.dt == pytest.approx(0.02, abs=0.5 * env.sim.delta_t)
    steps, reward, over = 0, 1.0, False
    while not over:
        observation, reward, terminated, over, info = env.step(STILL)
        assert not terminated and reward > 0.9
        steps += 1
    assert steps == int(np.ceil(1.0 / env.dt)) and info["t"] == pytest.approx(1.0, abs=env.dt)
    named = dict(zip(wf.gym.OBSERVED, observation, strict=True))
    state = env.sim.state
    assert [named[name] for name in "uvw"] == pytest.approx(state.velocity, rel=1e-6)
    assert named["height"] == pytest.approx(-state.position[2], abs=1e-3)
    climb = (
        env.sim.model.core.consistent_rate(env.sim.t, env.sim.y, env.sim._inputs(env.sim.t, env.sim._stick, STILL)[0])
    )[12]
    assert named["climb_rate"] == pytest.approx(-climb, abs=1e-4)
    assert [named[name] for name in ("beta_1c", "beta_1s")] == pytest.approx(
        [env.sim.loads[name] for name in ("beta_1c", "beta_1s")], abs=0.01
    )


def test_the_same_seed_has_the_same_bits_and_another_has_others(env):
    def flown(seed):
        first, _ = env.reset(seed=seed)
        return np.array([first, *(env.step(np.full(4, 0.1, np.float32))[0] for _ in range(5))])

    one = flown(3)
    assert np.array_equal(one, flown(3))
    assert not np.array_equal(one, flown(4))
    assert np.abs(one[0, 3:9]).max() > 0.01


def test_a_reset_neither_trims_nor_flies(env, monkeypatch):
    asked = []
    for owner, name in ((wf.gym, "trim"), (wf.Simulation, "step"), (wf.Simulation, "follow")):
        monkeypatch.setattr(owner, name, lambda *_, name=name, **__: asked.append(name))
    env.reset()
    assert not asked


def test_sticks_go_to_the_stops_as_fast_as_they_may(env):
    env.reset(seed=0, options={"upset": 0.0})
    trim = [env.sim.start.stick[name] for name in ("lateral", "longitudinal", "collective", "pedal")]
    before = env.step(STILL)[0][-4:]
    after = env.step(np.array([1.0, -1.0, 0.0, 0.0], np.float32))[0][-4:]
    assert after - before == pytest.approx([10.0 * env.dt, -10.0 * env.dt, 0.0, 0.0], rel=1e-3)
    for _ in range(40):
        observation, _, over, _, info = env.step(np.array([1.0, 0.0, 0.0, 0.0], np.float32))
        if over:
            break
    assert (over and "roll" in info["beyond"]) or observation[-4] == pytest.approx(10.0 - trim[0], abs=1e-3)


def test_numbers_that_end_it_terminate_and_say_why(env, monkeypatch):
    env.reset(seed=0)

    def fails(*_):
        raise wf.NumericalFailure("the blades have left the rotor")

    monkeypatch.setattr(env.sim, "step", fails)
    observation, reward, terminated, truncated, info = env.step(STILL)
    assert (reward, terminated, truncated) == (0.0, True, False)
    assert "left the rotor" in info["failure"] and observation in env.observation_space


@pytest.mark.parametrize("action", [[0, 0, 0], [0, 0, 0, np.nan], [[0, 0, 0, 0]], "up", [0, 0, "up", 0]])
def test_actions_that_are_none_are_refused(env, action):
    env.reset(seed=0)
    with pytest.raises(wf.InputError, match="action"):
        env.step(action)


def test_options_that_cannot_be_are_refused(env):
    for options, named in (
        ({"task": "loop"}, "task"),
        ({"seconds": -1.0}, "seconds"),
        ({"conditions": []}, "conditions"),
        ({"dt": "0 s"}, "dt = '0 s': must be above 0 s"),
    ):
        with pytest.raises(wf.InputError, match=named):
            wf.gym.HelicopterEnv(**options)
    for options, named in (
        ({"condition": 5}, "condition"),
        ({"upset": -1.0}, "upset"),
        ({"upst": 0.0}, "did you mean upset"),
    ):
        with pytest.raises(wf.InputError, match=named):
            env.reset(options=options)


def test_conditions_are_drawn_from_a_bank(uh60a):
    both = [wf.FlightCondition(speed=speed, flight_path="0 deg") for speed in ("40 kt", "80 kt")]
    env = wf.gym.HelicopterEnv("cruise", uh60a, conditions=both)
    drawn = {env.reset(seed=seed)[1]["condition"] for seed in range(8)}
    assert drawn == {0, 1}
    slow = env.reset(options={"condition": 0, "upset": 0.0})[0]
    fast = env.reset(options={"condition": 1, "upset": 0.0})[0]
    assert np.hypot(slow[0], slow[2]) < 22.0 < 40.0 < np.hypot(fast[0], fast[2])


def test_a_wake_can_be_flown_in(uh60a):
    wake = wf.TimeMarchingWake(turns=2, azimuth_step="15 deg", update_interval="90 deg")
    env = wf.gym.HelicopterEnv("cruise", uh60a, inflow=wake)
    env.reset(seed=1)
    assert env.step(STILL)[1] > 0.1 and env.sim.wake is not None


def test_several_fly_beside_each_other_in_processes_of_their_own():
    made = [lambda: wf.gym.HelicopterEnv("hover", seconds=0.1)] * 2
    many = gymnasium.vector.AsyncVectorEnv(made, context="spawn")
    try:
        observations, _ = many.reset(seed=5)
        assert observations.shape == (2, len(wf.gym.OBSERVED))
        rewards = many.step(np.zeros((2, 4), np.float32))[1]
        assert ((rewards > 0.0) & (rewards <= 1.0)).all()
    finally:
        many.close()
