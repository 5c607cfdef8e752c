"""Trims that several tests look at, made once."""

import pytest

import wakeflight as wf

LONG = (
    "test_resuming.py",
    "test_linear_identified.py",
    "test_linear_wake_states.py",
    "test_docs.py",
    "test_atomic.py",
    "test_sweep.py",
    "test_control_in_flight.py",
    "test_envelope.py",
    "test_stub.py",
)
"""Files that take longest, begun first: a process is given whole files, and what is begun last is waited for alone."""


def pytest_collection_modifyitems(items):
    """Long files first, the others in their order."""
    items.sort(key=lambda item: LONG.index(item.path.name) if item.path.name in LONG else len(LONG))


@pytest.fixture(scope="session")
def uh60a():
    return wf.load_aircraft("uh60a")


@pytest.fixture(scope="session")
def baseline_dynamic(uh60a):
    return wf.trim(uh60a, inflow="dynamic")


@pytest.fixture(scope="session")
def baseline_relaxation(uh60a):
    return wf.trim(uh60a, inflow="relaxation")


@pytest.fixture(scope="session")
def baseline_paper(uh60a):
    return wf.trim(uh60a, inflow=wf.RelaxationWake.preset("paper"))


@pytest.fixture(scope="session")
def baseline_marching(uh60a):
    return wf.trim(uh60a, inflow="time-marching")


@pytest.fixture(scope="session")
def starts(uh60a):
    """Trims on coarse wakes by kind of blades and inflow."""
    condition = wf.FlightCondition(speed="80 kt", flight_path="-6 deg", altitude="5250 ft", weight="16000 lbf")
    found = {}
    for blades, aircraft in (("flexible", uh60a), ("rigid", uh60a.with_rigid_blades())):
        found[blades, "dynamic"] = wf.trim(aircraft, condition, inflow="dynamic")
        coarse = wf.RelaxationWake(turns=2, azimuth_step="15 deg", update_interval="90 deg")
        found[blades, "relaxation"] = wf.trim(aircraft, condition, inflow=coarse)
        found[blades, "time-marching"] = found[blades, "relaxation"]
    return found
