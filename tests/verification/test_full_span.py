"""The full-span wake through the verbs: trim, flight, what a run keeps, export, and the same bits for any number of threads."""

import hashlib
import os
import subprocess
import sys

import numpy as np
import pytest

import wakeflight as wf
from wakeflight.export import vtk

OPTIONS = {
    "trailers": "full-span",
    "n_trailers": 5,
    "azimuth_step": "30 deg",
    "turns": 1.0,
    "near_wake_angle": "30 deg",
    "trailer_core": 0.05,
    "core_radius": 0.05,
    "inflow_tolerance": 1e-3,
}
MARCHING = {name: value for name, value in OPTIONS.items() if name != "inflow_tolerance"}


@pytest.fixture(scope="module")
def coarse_trim(uh60a):
    return wf.trim(uh60a, inflow=wf.RelaxationWake(**OPTIONS))


def test_what_every_blade_releases_is_zero_in_total(coarse_trim):
    released = coarse_trim.wake.relaxation.released_circulation()
    assert released.shape == (12, 5)
    assert np.max(np.abs(released)) > 5.0
    assert np.max(np.abs(released.sum(axis=1))) < 1e-11


@pytest.mark.parametrize("model", [wf.TimeMarchingWake, wf.RelaxationWake])
def test_a_run_keeps_the_sheets_and_exports_them(coarse_trim, model, tmp_path):
    options = {**MARCHING, "convergence_revolutions": 1} if model is wf.TimeMarchingWake else OPTIONS
    data = wf.fly(coarse_trim, wf.arrested_descent(), inflow=model(**options), revolutions=0.5).data
    assert dict(data["wake_sheet"].sizes) == {"snapshot": 3, "blade": 4, "trailer": 5, "age": 13, "xyz": 3}
    # the last trailer is the one that leaves the tip
    np.testing.assert_array_equal(data["wake_sheet"].isel(trailer=-1), data["wake"])
    strength = data["wake_sheet_circulation"].values
    assert np.max(np.abs(strength.sum(axis=2))) < 1e-11
    assert np.all(strength[:, :, -1].mean() > 1.0)
    series = vtk.write(data, tmp_path)
    first = (tmp_path / "wake-000.vtp").read_text()
    assert series.exists()
    assert 'NumberOfLines="20"' in first
    assert 'Name="trailer"' in first


def test_a_full_span_trim_keeps_the_momentum_balance(coarse_trim):
    # Glauert's inflow with the velocity through the disk that the trim found, and what a real wake adds to it
    mean = coarse_trim.mean_outputs()
    lambda_0 = mean["ct"] / (2 * mean["mu"])
    assert 0.85 < mean["inflow_mean"] / lambda_0 < 1.35


def test_the_same_bits_for_one_thread_and_for_two():
    code = (
        "import hashlib, json, numpy as np\n"
        "from wakeflight import _core\n"
        "o = dict(rotor=dict(n_blades=2, radius=8.0, root_cutout=1.0, hinge_offset=0.4, chord=0.5, omega=27.0),\n"
        "         wake=dict(n_stations=16, trailers='full-span', azimuth_step=np.pi / 18, turns=1.0), relaxation={})\n"
        "h = [-40.0, 0, 0], [0.0] * 3\n"
        "w = _core.RelaxationWake(json.dumps(o), h, 0.02)\n"
        "g = 10 + np.sin(np.arange(36 * 16.0)).reshape(36, 16)\n"
        "w.set_state(h, np.zeros((36, 2)), g)\n"
        "w.sweep(1)\n"
        "print(hashlib.sha256(w.lattice().tobytes() + w.inflow_far().tobytes()).hexdigest())\n"
    )
    digests = set()
    for threads in ("1", "2"):
        environment = {**os.environ, "WAKEFLIGHT_THREADS": threads}
        done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
        digests.add(done.stdout)
    assert len(digests) == 1
    assert len(digests.pop().strip()) == len(hashlib.sha256().hexdigest())
