"""Constants of a three-state inflow identified from a marched wake."""

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.linear.three_states import BAND, constants

WAKE = {"azimuth_step": "10 deg", "turns": 2, "trailers": "tip"}


def level(inflow):
    condition = wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 ft", weight="16000 lbf")
    aircraft = wf.load_aircraft("uh60a").discretised(n_modes=3, n_elements=4)
    return wf.trim(aircraft, condition, inflow=inflow)


@pytest.fixture(scope="module")
def start():
    return level(wf.RelaxationWake(**WAKE))


def test_three_states_that_are_put_in_come_out():
    omega, w = 27.0, np.concatenate([[0.0], BAND])
    gain = np.array([[2.6, 0.1, 1.5], [-0.4, 12.0, 0.3], [4.0, 0.2, 5.0]])
    mass = np.diag([0.849, 0.113, 0.113])
    distortion = np.array([[0.1, 0.0], [1.4, 0.1], [-0.1, 1.5]])
    model = np.linalg.inv(np.linalg.inv(gain) + 1j * w[:, None, None] * mass)
    rng = np.random.default_rng(3)
    loads = rng.normal(size=(w.size, 3, 5)) + 1j * rng.normal(size=(w.size, 3, 5))
    loads[0] = loads[0].real
    inflow = model @ loads
    inflow[:, :, 3:] += model @ np.linalg.inv(gain) @ (distortion / omega)
    found = constants((inflow, loads), w, omega)
    assert np.allclose(found["L"], gain) and np.allclose(found["M"], mass) and np.allclose(found["K"], distortion)
    assert float(found["K_p"]) == pytest.approx(1.4) and float(found["K_q"]) == pytest.approx(1.5)
    assert float(found["tau_0"]) == pytest.approx(2.6 * 0.849 / omega)
    assert found.attrs["stable"] == 1 and float(found["misfit"].max()) < 1e-9


def test_in_forward_flight_gains_are_those_of_momentum_theory_and_distortion_is_small(start):
    found = wf.inflow_constants(start)
    model = start.model
    velocity = np.linalg.norm(start.state(0.0)[:3]) / model.tip_speed
    # momentum theory: 1/(2 V); the literature: distortion is small beyond an advance ratio of 0.1
    assert float(found["L"][0, 0]) == pytest.approx(0.5 / velocity, rel=0.6)
    assert float(found["L"].sel(inflow="lambda_1c", load="thrust")) > 0.0
    # a tilt of the lift tilts the inflow the same way, across more than along at this skew
    across, along = (
        float(found["L"].sel(inflow=f"lambda_{i}", load=load)) for i, load in (("1s", "roll"), ("1c", "pitch"))
    )
    assert across > along > 0.0
    assert abs(float(found["K_p"])) < 0.3 and abs(float(found["K_q"])) < 0.3
    assert 0.0 < float(found["tau_0"]) < 0.1
    # at rest the constants say what the wake says of controls
    assert float(found["misfit"].isel(frequency=0).max()) < 1e-6


def test_what_has_no_marched_wake_is_refused():
    with pytest.raises(wf.InputError, match="start"):
        wf.inflow_constants(level("dynamic"))
    with pytest.raises(wf.InputError, match="start"):
        wf.inflow_constants("uh60a")
