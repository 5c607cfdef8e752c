"""Flights by hand: runs that are flown again to the same bits, gone on with after a death, and by another inflow model."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.flight import Sticks
from wakeflight.flight_by_hand import FlyingByHand, by_hand
from wakeflight.flight_folder import RunFolder
from wakeflight.flight_input import Asked, FlightInput, Plan
from wakeflight.progress import Silent
from wakeflight.stick_samples import SampledSticks, sampled
from wakeflight.transfer import carried, harmonics

RNG = np.random.default_rng(5)


def _flying(folder, start, inflow=None, begin=None, control=None):
    plan = Plan(by_hand("by hand"), inflow, integrator="fixed", control=control, lattice=False)
    given = FlightInput.of(start.aircraft, Asked.of(start), plan)
    flying = FlyingByHand(start, given, Silent())
    flying.begin(folder, begin)
    return flying


def _end(flying, failure=None):
    flying.land(failure)
    return flying.keep()


def _move(flying, steps, seed=1):
    """Hands that wander, rest, and go against a stop."""
    rng, inches = np.random.default_rng(seed), flying.inches
    for k in range(steps):
        if k % 3 == 0 and k > 5:
            inches = inches + 0.05 * rng.normal(size=4)
        flying.step([-99.0, *inches[1:]] if k == 12 else inches)


def test_a_path_through_samples_has_the_bits_of_the_manoeuvre_made_of_them():
    trim_in, dt = np.array([5.1, 4.2, 2.5, 3.0]), 0.0064634
    times = np.arange(40) * dt
    inches = np.round(np.cumsum(RNG.normal(size=(40, 4)), axis=0) * 0.1, 4)
    inches[0] = 0.0
    inches[8:15, 1] = inches[8, 1]
    inches[:, 3] = 0.0
    maneuver = sampled("hands", times, inches)
    assert [stick for stick, _ in maneuver.corners_of] == ["lateral", "longitudinal", "collective"]
    assert len(maneuver.corners_of[1][1]) < 40
    whole = Sticks(maneuver, trim_in * 0.0254)
    for k in range(38):
        path = SampledSticks(whole.trim_in, tuple(times[k : k + 3]), inches[k : k + 3])
        for t in (times[k], times[k] + 0.3 * dt, times[k + 1]):
            assert np.array_equal(path.at(t), whole.at(t))
            assert np.array_equal(path.rate(t), whole.rate(t))
        assert whole.pieces(times[k], times[k + 1]) == path.pieces(times[k], times[k + 1])


@pytest.mark.parametrize("inflow", ["dynamic", "time-marching"])
def test_a_flight_by_hand_is_a_run_that_replays_to_the_same_bits(starts, inflow, tmp_path):
    start = starts["flexible", inflow]
    sas = wf.Augmentation([wf.RateDamping(roll="2 in/(rad/s)", authority="10 %", rate="100 Hz")])
    with RunFolder(tmp_path) as folder:
        flying = _flying(folder, start, inflow, control=sas)
        _move(flying, 40)
        flight = _end(flying)
    assert flight.finished and flight.data.sizes["time"] == 42
    assert float(np.ptp(flight.data.lateral.values)) > 1.0
    again = wf.rerun(tmp_path / "run.nc")
    assert again.same, again.differing
    # the folder goes on like that of any flight
    assert wf.resume(tmp_path, until="0.6 s").data.sizes["time"] > 42


def test_a_flight_by_hand_that_died_is_gone_on_with_to_the_same_bits(starts, tmp_path):
    start = starts["rigid", "dynamic"]
    with RunFolder(tmp_path / "dead", every=0.0) as folder:
        flying = _flying(folder, start)
        _move(flying, 30)
        folder.beat(flying.sim, last=True)
    seen = wf.open_run(tmp_path / "dead")
    assert not seen.attrs["finished"] and seen.sizes["time"] == 30
    with RunFolder(tmp_path / "whole") as folder:
        flying = _flying(folder, start)
        _move(flying, 30)
        whole = _end(flying).data
    data = wf.resume(tmp_path / "dead").data
    assert data.attrs["finished"]
    for name in ("p", "lateral", "inflow"):
        assert np.array_equal(data[name], whole[name])
    assert wf.rerun(tmp_path / "dead" / "run.nc").same
    # resumed once more it has come to its end
    assert wf.resume(tmp_path / "dead").data.sizes["time"] == data.sizes["time"]


def test_a_flight_by_hand_that_fails_keeps_what_was_flown(starts, tmp_path):
    with RunFolder(tmp_path) as folder:
        flying = _flying(folder, starts["rigid", "dynamic"])
        _move(flying, 10)
        flight = _end(flying, failure="a test")
    assert "a test" in flight.failure and flight.data.sizes["time"] == 10
    assert wf.open_run(tmp_path).sizes["time"] == 10


@pytest.mark.parametrize("first, then", [("dynamic", "time-marching"), ("time-marching", "dynamic")])
def test_a_flight_goes_on_with_another_inflow_model(starts, first, then, tmp_path):
    with RunFolder(tmp_path / "first") as folder:
        flying = _flying(folder, starts["rigid", first], first)
        per_revolution = flying.sim.model.steps_per_revolution
        _move(flying, 2 * per_revolution - 2)
        with pytest.raises(wf.InputError, match="must end a revolution"):
            carried(flying.sim, flying.sim, np.zeros(3))
        _move(flying, 1)
        before, sim = _end(flying).data, flying.sim
    assert sim.steps == 2 * per_revolution
    other = wf.Simulation(starts["rigid", then], inflow=then)
    fit = harmonics(sim, before.azimuth.values[-1], before.inflow.values[-1])
    begin = carried(sim, other, fit)
    if first == "dynamic":
        # the fit of what dynamic inflow gives is its states, but for the lag of the blades, some 2 deg
        states = sim.y[slice(*sim.model.layout["inflow"])]
        assert fit == pytest.approx(states, abs=0.05 * np.abs(states).max())
    with RunFolder(tmp_path / "then") as folder:
        flying = _flying(folder, other.start, then, begin)
        _move(flying, 20)
        after = _end(flying).data
    for name, near in (("u", 0.0), ("roll", 0.0), ("p", 0.0), ("flap", 1e-12), ("north", 0.0), ("collective", 1e-4)):
        assert np.allclose(after[name].values[0], before[name].values[-1], rtol=0.0, atol=near)
    assert float(after.inflow_mean[0]) == pytest.approx(float(before.inflow_mean[-1]), rel=0.1)
    assert np.abs(after.w.values[:10] - before.w.values[-1]).max() < 0.5
    again = wf.rerun(tmp_path / "then" / "run.nc")
    assert again.same, again.differing
