"""Induced velocity against closed forms; the data's headers say how each was computed."""

import csv
import math
import os
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

import wakeflight as wf

DATA = Path(__file__).parent / "data"
CORE_NAMES = {
    "singular": "singular",
    "vatistas_n1_scully": "scully",
    "vatistas_n1": "scully",
    "vatistas_n2": "vatistas2",
    "vatistas_ninf_rankine": "rankine",
    "lamb_oseen": "lamb_oseen",
}


def rows(name):
    lines = (line for line in (DATA / name).read_text().splitlines() if not line.startswith("#"))
    return list(csv.DictReader(lines))


def table(name):
    return tomllib.loads((DATA / name).read_text())


def velocity(point, nodes, core="singular", core_radius=0.0, **options):
    n = len(nodes) - 1
    return wf.induced_velocity([point], [nodes], np.ones(n), np.full(n, core_radius), core=core, **options)[0]


def polygon(n):
    angle = 2.0 * np.pi * np.arange(n + 1) / n
    nodes = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(n + 1)])
    nodes[-1] = nodes[0]
    return nodes


def identity(row):
    return "-".join(row.values())


@pytest.mark.parametrize("row", rows("K01_segment_points.csv"), ids=identity)
def test_verif_a_segment_induces_the_exact_velocity(row):
    # sign and size of the kernel, near, far, beside and beyond the segment
    value = {name: float(text) for name, text in row.items()}
    start, end, point, expected = ([value[f"{p}{axis}"] for axis in "xyz"] for p in "ABPu")
    error = np.linalg.norm(velocity(point, [start, end]) - expected)
    assert error <= 1e-12 * np.linalg.norm(expected)


@pytest.mark.parametrize("row", rows("K02_segment_core.csv"), ids=identity)
def test_verif_a_core_factor_acts_on_the_perpendicular_distance(row):
    # each core model multiplies the singular law at its own core radius
    point = (0.5, float(row["h"]), 0.0)
    v = velocity(point, [(0, 0, 0), (1, 0, 0)], CORE_NAMES[row["core"]], float(row["rc"]))
    assert v[2] == pytest.approx(float(row["uz"]), rel=1e-11)
    assert v[0] == v[1] == 0.0


@pytest.mark.parametrize("row", rows("K02b_swirl_profiles.csv"), ids=identity)
def test_verif_a_long_filament_has_the_swirl_profile_of_its_core(row):
    # far ends at 1e7 core radii leave 1e-12 of the line vortex out
    core_radius = 0.1
    point = (float(row["r_over_rc"]) * core_radius, 0.0, 0.0)
    v = velocity(point, [(0, 0, -1e6), (0, 0, 1e6)], CORE_NAMES[row["core"]], core_radius)
    assert v[1] * 2.0 * np.pi * core_radius == pytest.approx(float(row["v_nd"]), rel=1e-10)


def test_verif_a_softened_kernel_swirls_as_the_algebraic_profile():
    # r / (r^2 + eps^2) is the integral of the softened kernel over an infinite line; peak at eps
    for r in (0.01, 0.1, 0.4):
        v = velocity((r, 0, 0), [(0, 0, -1e6), (0, 0, 1e6)], "rosenhead_moore", 0.1)
        assert v[1] * 2.0 * np.pi == pytest.approx(r / (r**2 + 0.1**2), rel=1e-10)


def test_verif_long_filaments_are_lines_and_half_lines():
    # what a filament cut at S leaves out falls as (d / S)^2 / 2
    data = table("K03_lines.toml")
    far, d = 1e7, data["infinite_line"]["d"]
    line, half = data["infinite_line"], data["semi_infinite_line"]
    inside = -half["offset_inside"]
    for bottom, expected in ((-far, line["v"]), (0.0, half["v_foot"]), (inside, half["v_offset"])):
        v = velocity((d, 0, 0), [(0, 0, bottom), (0, 0, far)])
        assert v[1] == pytest.approx(expected, rel=1e-12)
    limit = data["segment_to_line_limit"]
    for half_length, error in zip(limit["S"], limit["rel_error"], strict=True):
        v = velocity((1, 0, 0), [(0, 0, -half_length), (0, 0, half_length)])
        assert 1.0 - 2.0 * np.pi * v[1] == pytest.approx(error, rel=1e-10)


def test_verif_a_horseshoe_induces_its_downwash():
    # from infinity along one leg, over the bound segment, back along the other
    data = table("K03_lines.toml")["horseshoe"]
    nodes = [(1e7, -1, 0), (0, -1, 0), (0, 1, 0), (1e7, 1, 0)]
    at_origin, behind = velocity((0, 0, 0), nodes), velocity((1, 0, 0), nodes)
    assert -at_origin[2] == pytest.approx(data["w_origin_legs_only"], rel=1e-12)
    assert -behind[2] == pytest.approx(data["w_at_1_0_0_total"], rel=1e-12)


@pytest.mark.parametrize("row", [r for r in rows("K04_ring_field.csv") if r["kind"] == "ngon"], ids=identity)
def test_verif_a_polygon_induces_the_exact_axial_velocity(row):
    v = velocity((0, 0, float(row["z"])), polygon(int(row["N"])))
    assert v[2] == pytest.approx(float(row["uz"]), rel=1e-11)


def ring_velocity(r, z):
    """Radial and axial velocity of the unit ring off its axis, by complete elliptic integrals."""
    a = math.sqrt((r + 1) ** 2 + z**2)
    m = 4.0 * r / a**2
    p, q = z**2 + r**2 + 1.0, -2.0 * r
    i1 = 4.0 / a * ellipk(m)
    i2 = 4.0 / a**3 * ellipe(m) / (1.0 - m)
    radial = z / q * (i1 - p * i2)
    axial = (1.0 + r * p / q) * i2 - r / q * i1
    return np.array([radial, axial]) / (4.0 * np.pi)


@pytest.mark.parametrize("row", [r for r in rows("K04_ring_field.csv") if r["kind"] == "ring"], ids=identity)
def test_verif_polygons_converge_to_the_ring_to_second_order(row):
    # on and off the axis; between nodes, so that the polygon has no symmetry to help it
    r, z, expected = float(row["r"]), float(row["z"]), np.array([float(row["ur"]), float(row["uz"])])
    if r > 0.0:
        assert ring_velocity(r, z) == pytest.approx(expected, rel=1e-9, abs=1e-13)
    direction = np.array([math.cos(0.3), math.sin(0.3)])
    errors = []
    for n in (360, 720):
        v = velocity((*(r * direction), z), polygon(n))
        errors.append(np.linalg.norm(np.array([v[:2] @ direction, v[2]]) - expected))
    scale = np.linalg.norm(expected)
    assert errors[1] < 1e-3 * scale
    assert errors[0] / errors[1] == pytest.approx(4.0, abs=0.1)


def test_verif_the_extrapolated_polygon_is_the_ring_off_axis():
    # second order leaves a fourth-order rest: a far sharper check of the field than the polygon's own error
    for r, z in ((0.3, 0.4), (1.5, -0.6), (2.5, 1.0)):
        coarse, fine = (velocity((r, 0, z), polygon(n))[[0, 2]] for n in (720, 1440))
        assert (4.0 * fine - coarse) / 3.0 == pytest.approx(ring_velocity(r, z), rel=1e-9)


@pytest.mark.parametrize("row", rows("K05_polygon_ring_self.csv"), ids=identity)
def test_verif_a_vertex_of_a_polygon_moves_with_the_open_sum(row):
    # the two segments that end at the vertex give nothing
    nodes = polygon(int(row["N"]))
    v = velocity(nodes[0], nodes, CORE_NAMES[row["core"]], float(row["rc"]))
    assert 4.0 * np.pi * v[2] == pytest.approx(float(row["fourpiV"]), abs=1e-9)


def test_verif_a_refined_ring_with_the_softened_kernel_moves_at_its_exact_speed():
    # exact integral over the circle; the trapezoidal-like error of straight pieces falls as N^-2
    data = table("K06_thin_ring_speed.toml")["rosenhead_moore_exact"]
    for softening, expected in zip(data["mu"], data["fourpiV"], strict=True):
        rings = (polygon(2000), polygon(4000))
        speeds = [4.0 * np.pi * velocity((1, 0, 0), ring, "rosenhead_moore", softening)[2] for ring in rings]
        assert (4.0 * speeds[1] - speeds[0]) / 3.0 == pytest.approx(expected, rel=1e-8)
        assert speeds[1] == pytest.approx(expected, rel=1e-4)


def test_verif_cores_at_the_distance_to_the_line_have_their_own_limit():
    # the defect of the usual core: refined, the ring is 40 % slower than the thin ring
    data = table("K06_thin_ring_speed.toml")["perpendicular_core_continuum"]
    for core in ("vatistas_n1", "vatistas_n2", "lamb_oseen"):
        errors = []
        for n in (1440, 2880):
            speed = 4.0 * np.pi * velocity((1, 0, 0), polygon(n), CORE_NAMES[core], data["rc"])[2]
            errors.append(abs(speed - data[core]))
        assert errors[1] < 2e-6, core
        assert errors[0] / errors[1] == pytest.approx(4.0, abs=0.5), core


def test_verif_the_singular_polygon_grows_with_the_logarithm_of_its_nodes():
    constant = table("K06_thin_ring_speed.toml")["polygon_singular_vertex"]["c"]
    nodes = polygon(2048)
    speed = 4.0 * np.pi * velocity(nodes[0], nodes)[2]
    assert speed - math.log(2048) == pytest.approx(constant, abs=2e-6)


def test_verif_core_profiles_have_their_thin_ring_constants():
    # C = 1/2 - A, A = lim (2 pi / circulation)^2 int r v^2 dr - ln(X / a), by quadrature of the swirl in ln r
    constants = table("K06_thin_ring_speed.toml")["constants"]
    core_radius, nodes = 0.1, [(0, 0, -1e10), (0, 0, 1e10)]
    of_core = {
        "scully": (constants["vatistas_n1"], core_radius),
        "vatistas2": (constants["vatistas_n2"], core_radius),
        "rankine": (constants["vatistas_ninf_rankine"], core_radius),
        "lamb_oseen": (constants["lamb_oseen_delta"], core_radius / math.sqrt(1.2564312086261697)),
    }
    # breaks at the core radius, where the Rankine profile has its kink
    abscissa, weight = np.polynomial.legendre.leggauss(20)
    breaks = np.linspace(-12.0, 12.0, 97)
    half = 0.5 * (breaks[1] - breaks[0])
    log_r = (breaks[:-1, None] + half + half * abscissa).ravel() + math.log(core_radius)
    r = np.exp(log_r)
    points = np.column_stack([r, np.zeros_like(r), np.zeros_like(r)])
    for core, (expected, a) in of_core.items():
        v = wf.induced_velocity(points, [nodes], [1.0], [core_radius], core=core)[:, 1]
        energy = np.sum(np.tile(half * weight, 96) * (2.0 * np.pi * r * v) ** 2)
        limit = energy - math.log(core_radius * math.exp(12.0) / a)
        assert 0.5 - limit == pytest.approx(expected, abs=5e-7), core


@pytest.mark.parametrize("core_radius", [0.01, 0.02, 0.05])
def test_verif_a_ring_of_chords_moves_at_its_exact_speed_with_the_curvature_correction(core_radius):
    """Thin ring with the Vatistas n = 2 core: S = 4 pi R U/circulation = ln(8 R/r_c) - 1/2."""
    ring = circle(36)
    strengths, cores = np.ones(36), np.full(36, core_radius)
    given = {"core_distance": "segment"}
    without, with_it = (
        wf.induced_velocity(ring[1:-1], [ring], strengths, cores, **given, curvature_correction=on)
        for on in (False, True)
    )
    exact = (math.log(8.0 / core_radius) - 0.5) / (4.0 * math.pi)
    assert np.abs(with_it[:, 2] / exact - 1.0).max() < 1e-3
    assert np.all(without[:, 2] < 0.9 * exact)
    # points beside the nodes, ends of a filament and straight filaments get nothing of it
    beside = np.concatenate([ring[:1], ring[1:-1] + 1e-9])
    plain = wf.induced_velocity(beside, [ring], strengths, cores, **given)
    assert np.array_equal(
        wf.induced_velocity(beside, [ring], strengths, cores, **given, curvature_correction=True), plain
    )
    with pytest.raises(wf.InputError, match="core = 'scully': allowed is vatistas2 with curvature_correction"):
        wf.induced_velocity(ring, [ring], strengths, cores, core="scully", curvature_correction=True)


def circle(n):
    """Nodes of a closed polygon (n + 1, 3) in the unit circle."""
    angle = 2.0 * np.pi * np.arange(n + 1) / n
    nodes = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(n + 1)])
    nodes[-1] = nodes[0]
    return nodes


def test_filaments_of_different_lengths_add_up():
    first, second = polygon(12), polygon(7)[:4] + np.array([0.0, 0.0, 0.5])
    points = np.random.default_rng(0).normal(size=(100, 3))
    circulation, core_radius = np.linspace(1.0, 2.0, 15), np.linspace(0.02, 0.1, 15)
    both = wf.induced_velocity(points, [first, second], circulation, core_radius)
    apart = wf.induced_velocity(points, [first], circulation[:12], core_radius[:12])
    apart += wf.induced_velocity(points, [second], circulation[12:], core_radius[12:])
    assert both == pytest.approx(apart, rel=1e-12, abs=1e-14)
    assert wf.induced_velocity(points, [], [], []).tolist() == np.zeros((100, 3)).tolist()


def test_verif_tree_and_direct_sum_agree_to_a_thousandth_of_the_largest_velocity():
    # far turns by their multipoles, near ones with their cores: at the nodes themselves, where the largest errors are
    age = np.arange(721) * np.pi / 36
    radii = np.linspace(0.3, 1.0, 8)
    filaments = [np.column_stack([r * np.cos(age) + 0.05 * age, r * np.sin(age), -0.02 * age]) for r in radii]
    points = np.concatenate(filaments)
    strengths = np.repeat([*[-1 / 7] * 7, 1.0], 720), np.full(8 * 720, 0.03)
    direct = wf.induced_velocity(points, filaments, *strengths)
    largest = np.linalg.norm(direct, axis=1).max()
    # at small tolerances single segments whose prolongation passes a point take most of what is allowed
    for tolerance, share in ((1e-3, 0.5), (1e-5, 1.0)):
        tree = wf.induced_velocity(points, filaments, *strengths, method="tree", tolerance=tolerance)
        assert 0.0 < np.linalg.norm(tree - direct, axis=1).max() < share * tolerance * largest
    auto = wf.induced_velocity(points, filaments, *strengths, method="auto")
    assert np.array_equal(auto, wf.induced_velocity(points, filaments, *strengths, method="tree"))
    few = wf.induced_velocity(points, filaments[:1], strengths[0][:720], strengths[1][:720], method="auto")
    assert np.array_equal(few, wf.induced_velocity(points, filaments[:1], strengths[0][:720], strengths[1][:720]))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"points": [1.0, 2.0, 3.0]}, r"points: shape \(3,\)"),
        ({"points": [[0.0, float("nan"), 0.0]]}, r"points\[0, 1\] = nan"),
        ({"points": [[0.0, 1e20, 0.0]]}, r"points\[0, 1\] = 1e\+20: allowed are finite"),
        ({"points": "here"}, "points = 'here': allowed"),
        ({"filaments": np.zeros((4, 3))}, "filaments: an array of shape"),
        ({"filaments": [[[0.0, 0.0, 0.0]]]}, r"filaments\[0\]: 1 nodes; allowed are 2"),
        ({"filaments": [[[0.0, 0.0], [1.0, 0.0]]]}, r"filaments\[0\]: shape \(2, 2\)"),
        ({"circulation": [1.0, 2.0]}, r"circulation: shape \(2,\); allowed is \(1,\)"),
        ({"circulation": [float("inf")]}, r"circulation\[0\] = inf"),
        ({"core_radius": [-0.1]}, r"core_radius\[0\] = -0.1: allowed are 0 and more"),
        ({"core": "vatistas"}, "core = 'vatistas': allowed are singular, scully"),
        ({"core_distance": "point"}, "core_distance = 'point': allowed are line, segment"),
        ({"method": "fmm"}, "method = 'fmm': allowed are direct, tree, auto"),
        ({"core_radius": 10**5000}, "core_radius = <int>: allowed is an array of real numbers"),
        ({"tolerance": 10**5000}, "tolerance = <int>: must be a finite number"),
        ({"tolerance": 0.0}, "tolerance = 0.0: allowed are numbers above 0 and below 1"),
    ],
)
def test_bad_input_is_named_with_its_value_and_what_is_allowed(change, message):
    good = {
        "points": [[0.0, 1.0, 0.0]],
        "filaments": [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]],
        "circulation": [1.0],
        "core_radius": [0.1],
    }
    wf.induced_velocity(**good)
    with pytest.raises(ValueError, match=message):
        wf.induced_velocity(**(good | change))


PROGRAM = """
import hashlib, numpy as np, wakeflight as wf
nodes = np.cumsum(np.random.default_rng(1).normal(size=(400, 3)), axis=0)
points = np.random.default_rng(2).normal(size=(1000, 3))
v = wf.induced_velocity(points, [nodes], np.ones(399), np.full(399, 0.1))
print(hashlib.sha256(v.tobytes()).hexdigest())
"""


def run_with_threads(value):
    environment = os.environ | {"WAKEFLIGHT_THREADS": value}
    return subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True)


def test_the_number_of_threads_does_not_change_a_bit():
    results = {run_with_threads(n).stdout for n in ("1", "2", "5")}
    assert len(results) == 1
    assert len(results.pop().strip()) == 64


def test_a_wrong_number_of_threads_is_named():
    run = run_with_threads("many")
    assert run.returncode != 0
    assert "WAKEFLIGHT_THREADS = many: allowed are whole numbers from 1" in run.stderr


def run_with_instructions(name):
    environment = os.environ | {"WAKEFLIGHT_SIMD": name}
    return subprocess.run([sys.executable, "-c", SETS], env=environment, capture_output=True, text=True)


SETS = """
import numpy as np, wakeflight as wf
nodes = np.cumsum(np.random.default_rng(1).normal(size=(400, 3)), axis=0)
points = np.random.default_rng(2).normal(size=(100, 3))
v = wf.induced_velocity(points, [nodes], np.ones(399), np.full(399, 0.1))
print(wf._core.instruction_set(), *v.ravel())
"""


def test_every_instruction_set_gives_the_same_velocity():
    # a machine that lacks one says so
    scalar = run_with_instructions("scalar").stdout.split()
    assert scalar[0] == "scalar"
    reference = np.array(scalar[1:], dtype=float)
    for name in ("avx2", "avx512"):
        run = run_with_instructions(name)
        if run.returncode != 0:
            assert f"WAKEFLIGHT_SIMD = {name}: " in run.stderr
            continue
        found = run.stdout.split()
        assert found[0] == name
        assert np.abs(np.array(found[1:], dtype=float) - reference).max() < 1e-13 * np.abs(reference).max()


def test_an_instruction_set_that_does_not_exist_is_named():
    run = run_with_instructions("mmx")
    assert run.returncode != 0
    last = run.stderr.strip().splitlines()[-1]
    assert last.startswith(
        "wakeflight.errors.InputError: WAKEFLIGHT_SIMD = mmx: no such instruction set, allowed are scalar"
    )


FORKING = """
import os, numpy as np, wakeflight as wf
from wakeflight import _core
_core.set_threads(2)
nodes = np.cumsum(np.random.default_rng(1).normal(size=(400, 3)), axis=0)
def total():
    return wf.induced_velocity(nodes, [nodes], np.ones(399), np.full(399, 0.1)).sum()
before = total()
child = os.fork()
if child == 0:
    os._exit(0 if total() == before else 1)
raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_forked_process_computes_the_same():
    # the threads of the parent do not exist in the child: it must not wait for them
    command = [sys.executable, "-W", "ignore", "-c", FORKING]
    run = subprocess.run(command, timeout=60, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
