# SPDX-License-Identifier: MIT OR Apache-2.0
"""Sums of the wake in single precision: as near to double precision as its rounding says, on the stand, in trim and in flight."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import wakeflight as wf
from wakeflight import _core

SHORT = {"turns": 1, "far_wake_turns": 0, "azimuth_step": "15 deg", "n_stations": 10}
KINDS = {
    "tip": {"trailers": "tip"},
    "lattice": {"trailers": "full-span", "n_trailers": 3},
    "segment": {"trailers": "tip", "core_distance": "segment"},
}


def away(name, single, double):
    """Largest difference of a variable over its largest value."""
    return float(np.abs(single[name] - double[name]).max() / np.abs(double[name]).max())


@pytest.mark.parametrize("kind", KINDS)
def test_a_rotor_on_the_stand_differs_by_rounding(kind):
    given = {"thrust": "72 kN", "speed": "80 kt", "shaft_angle": "-5 deg"}
    runs = {
        precision: wf.tunnel(
            "uh60a", inflow=wf.RelaxationWake(**SHORT, **KINDS[kind], precision=precision), **given
        ).data
        for precision in ("single", "double")
    }
    for name in ("inflow", "circulation"):
        # what is left of rounding 6e-8 in sums of some hundred segments, not nothing: it was in single precision
        assert 1e-9 < away(name, **runs) < 3e-6, name


def test_a_flight_with_its_trim_differs_by_rounding(uh60a):
    runs = {}
    for precision in ("single", "double"):
        options = {**SHORT, "trailers": "full-span", "n_trailers": 3, "precision": precision}
        start = wf.trim(uh60a, inflow=wf.RelaxationWake(**options))
        wake = wf.TimeMarchingWake(**options, convergence_revolutions=1)
        runs[precision] = wf.fly(start, wf.roll_reversal(), inflow=wake, integrator="fixed", revolutions=3).data
    for name in ("inflow", "circulation", "p", "q", "beta_1c"):
        assert 1e-11 < away(name, **runs) < 1e-5, name


ROTOR = {"n_blades": 2, "radius": 8.0, "root_cutout": 1.0, "hinge_offset": 0.4, "chord": 0.5, "omega": 27.0}
LATTICE = {"n_stations": 16, "trailers": "full-span", "turns": 1.0, "azimuth_step": np.pi / 18}
FOUND = """
import json, sys, numpy as np
from wakeflight import _core
wake = _core.RelaxationWake(sys.argv[1], ([-40.0, 0.0, 0.0], [0.0] * 3), 0.02)
wake.set_state(([-40.0, 0.0, 0.0], [0.0] * 3), np.zeros((36, 2)), 10 + np.sin(np.arange(36 * 16.0)).reshape(36, 16))
wake.sweep(1)
json.dump([wake.lattice().tolist(), wake.inflow_far().tolist()], sys.stdout)
"""


def options(precision):
    """Of a rotor of two blades with a lattice, as the core reads them."""
    return json.dumps({"rotor": ROTOR, "wake": {**LATTICE, "precision": precision}, "relaxation": {}})


def found(**environment):
    """Lattice and inflow of a process of its own with these variables; None where it does not run."""
    command = [sys.executable, "-c", FOUND, options("single")]
    done = subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else None


def test_what_is_asked_at_points_is_summed_in_double_precision():
    points = np.array([[1.0, 2.0, -1.0], [-6.0, 0.5, -2.0]])
    hub = [-40.0, 0.0, 0.0], [0.0] * 3
    velocities = []
    for precision in ("single", "double"):
        wake = _core.RelaxationWake(options(precision), hub, 0.02)
        wake.set_state(hub, np.zeros((36, 2)), np.full((36, 16), 10.0))
        velocities.append(wake.wake_velocity(points, 0))
    assert np.abs(velocities[0]).max() > 0.1
    assert np.array_equal(*velocities)


def test_the_same_bits_for_one_thread_and_for_two():
    one = found(WAKEFLIGHT_THREADS="1")
    assert one is not None
    assert one == found(WAKEFLIGHT_THREADS="2")


def test_instruction_sets_differ_by_their_roots_alone():
    # a few units of the last place of single precision, over the largest inflow
    scalar = np.array(found(WAKEFLIGHT_SIMD="scalar")[1])
    for name in ("avx2", "avx512", "neon"):
        other = found(WAKEFLIGHT_SIMD=name)
        if other is not None:
            assert np.abs(np.array(other[1]) - scalar).max() < 2e-6 * np.abs(scalar).max(), name


def test_a_word_that_is_no_precision_is_refused():
    with pytest.raises(wf.InputError, match="precision"):
        wf.RelaxationWake(precision="half")
