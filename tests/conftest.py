"""Trims that several tests look at, made once."""

import pytest

import wakeflight as wf


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
