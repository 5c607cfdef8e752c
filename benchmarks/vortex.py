"""Segment sums: nanoseconds per evaluation, threads, and growth with the number of segments."""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from measure import peak_memory, seconds, table

import wakeflight as wf
from wakeflight import _core

ROOT = Path(__file__).resolve().parents[1]
DOUBLE = ("textbook", "scalar", "avx2", "avx512")
SETS = (*DOUBLE, "avx2-single", "avx512-single", "directional")


def kernel() -> str:
    """Each core model on each instruction set, beside the plain loop (an example of the Rust crate)."""
    command = ["cargo", "run", "--release", "--quiet", "--package", "wakeflight"]
    output = subprocess.run(
        [*command, "--example", "induced_velocity_speed"], cwd=ROOT, check=True, capture_output=True, text=True
    ).stdout
    found: dict[tuple[str, str], dict[str, tuple[float, float]]] = {}
    for line in output.splitlines():
        distance, core, name, median, best = line.split()
        found.setdefault((core, distance), {})[name] = (float(median), float(best))
    rows = []
    for (core, distance), times in found.items():
        cells = ["{:.2f} ({:.2f})".format(*times[name]) if name in times else "" for name in SETS]
        value = min(best for name, (_, best) in times.items() if name in DOUBLE)
        ratios = [times["textbook"][1] / value, times["directional"][1] / value]
        rows.append([core, distance.lower(), *cells, f"{ratios[0]:.0f}", f"{ratios[1]:.1f}"])
    head = ["core", "distance to", "textbook loop", "scalar", "AVX2", "AVX-512"]
    head += ["AVX2, single precision", "AVX-512, single precision", "with derivative"]
    head += ["loop over fastest", "with derivative over fastest"]
    return table(head, rows) + "\nMedian and, in brackets, best of 51; ratios are of the best.\n"


def helices(n_filaments: int, turns: float, step_deg: float) -> tuple[np.ndarray, list[np.ndarray], np.ndarray]:
    """Markers, nodes and circulation of four blades that trail a tip vortex and a sheet of the opposite sign."""
    age = np.deg2rad(np.arange(round(turns * 360.0 / step_deg) + 1) * step_deg)
    radii = 0.15 + 0.85 * np.arange(1, n_filaments + 1) / n_filaments
    filaments, circulation = [], []
    for blade in range(4):
        psi = 0.5 * np.pi * blade - age
        for i, r in enumerate(radii):
            x, y = r * np.cos(psi) + 0.1 * age, r * np.sin(psi)
            filaments.append(np.column_stack([x, y, -0.02 * age + 0.02 * np.sin(3.3 * age + i)]))
            circulation.append(np.full(age.size - 1, 1.0 if i + 1 == n_filaments else -1.0 / n_filaments))
    return np.concatenate([f[1:] for f in filaments]), filaments, np.concatenate(circulation)


def numpy_sum(points: np.ndarray, nodes: list[np.ndarray], circulation: np.ndarray, core_radius: float) -> np.ndarray:
    """The same law, Vatistas n = 2, with arrays of every point by every segment."""
    start, end = (np.concatenate([f[s] for f in nodes]) for s in (slice(None, -1), slice(1, None)))
    a, b = points[:, None] - start, points[:, None] - end
    r1, r2 = np.linalg.norm(a, axis=2), np.linalg.norm(b, axis=2)
    cross, along = np.cross(a, b), np.linalg.norm(end - start, axis=1)
    h_sq = (cross**2).sum(2) / along**2
    product = r1 * r2
    with np.errstate(divide="ignore", invalid="ignore"):
        weight = circulation / (4.0 * np.pi) * (r1 + r2) / (product * (product + (a * b).sum(2)))
        weight *= h_sq / np.sqrt(h_sq**2 + core_radius**4)
    return (np.where(product > 1e-12 * along**2, weight, 0.0)[..., None] * cross).sum(1)


def threads() -> str:
    """The public function on one and two threads and numpy, 580 markers of four turns at 10 degrees."""
    points, nodes, circulation = helices(1, 4, 10.0)
    radius = np.full(circulation.size, 0.05)
    reference = numpy_sum(points, nodes, circulation, 0.05)
    n = points.shape[0] * circulation.size
    by_numpy, _ = seconds(lambda: numpy_sum(points, nodes, circulation, 0.05), 5)
    rows = [["numpy", "1", f"{by_numpy / n * 1e9:.1f}", "1.0"]]
    for factor, repetitions in ((1, 201), (16, 15)):
        many, others = np.tile(points, (factor, 1)), nodes * factor
        strengths, radii = np.tile(circulation, factor), np.tile(radius, factor)
        for n_threads in (1, 2):
            _core.set_threads(n_threads)
            median, best = seconds(lambda a=(many, others, strengths, radii): wf.induced_velocity(*a), repetitions)
            ns, least = (t / (n * factor**2) * 1e9 for t in (median, best))
            name = f"induced_velocity, {points.shape[0] * factor} x {circulation.size * factor}"
            rows.append([name, str(n_threads), f"{ns:.2f} ({least:.2f})", f"{by_numpy / n * 1e9 / ns:.0f}"])
    _core.set_threads(os.cpu_count() or 1)
    error = np.abs(wf.induced_velocity(points, nodes, circulation, radius) - reference).max() / np.abs(reference).max()
    return table(["sum", "threads", "ns per evaluation", "times faster"], rows) + (
        f"\nMedian and, in brackets, best. Largest difference of the two, over the largest velocity: {error:.1e}.\n"
    )


def one_size(n_filaments: int, turns: int, step_deg: float) -> None:
    """Prints segments, processor seconds of tree and direct sum, error and memory of one wake; a process of its own."""
    # helpers that stand by would be counted too
    _core.set_threads(1)
    points, nodes, circulation = helices(n_filaments, turns, step_deg)
    radius = np.full(circulation.size, 0.02)
    # the first call loads the library
    wf.induced_velocity(points[:64], nodes, circulation, radius)
    # the direct sum at as many points as a few seconds allow, its time scaled
    every = max(1, round(points.shape[0] * circulation.size / 5e8))
    some = points[::every]
    # processor time is counted in ticks of milliseconds: small sums are done many times
    repetitions = max(1, round(3e8 / (some.shape[0] * circulation.size)))
    begun = time.process_time()
    for _ in range(repetitions):
        direct = wf.induced_velocity(some, nodes, circulation, radius)
    by_direct = (time.process_time() - begun) / repetitions * points.shape[0] / some.shape[0]
    # what the packed segments take is taken; what the tree takes comes on top
    before = peak_memory()
    begun = time.process_time()
    for _ in range(repetitions):
        tree = wf.induced_velocity(points, nodes, circulation, radius, method="tree")
    by_tree = (time.process_time() - begun) / repetitions
    error = np.linalg.norm(tree[::every] - direct, axis=1).max() / np.linalg.norm(direct, axis=1).max()
    of_tree = (peak_memory() - before) * 1e6 / circulation.size
    print(circulation.size, by_direct, by_tree, error, peak_memory(), of_tree)


def scaling(quick: bool, figure: Path | None) -> str:
    """Velocity of all markers of a wake at its own segments, by the tree and directly, against their number."""
    sizes = [(1, 4, 10.0), (2, 4, 10.0), (4, 4, 10.0), (8, 4, 10.0), (20, 4, 10.0), (20, 4, 5.0), (20, 8, 2.5)]
    if not quick:
        sizes += [(40, 10, 2.5), (100, 18, 2.5)]
    found = []
    for size in sizes:
        command = [sys.executable, __file__, *map(str, size)]
        output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        found.append([float(x) for x in output.split()])
    rows = [
        [
            f"{n:.0f}",
            f"{d:.3g}",
            f"{t:.3g}",
            f"{d / t:.2f}",
            f"{t / n / np.log2(n) * 1e9:.0f}",
            f"{e:.1e}",
            f"{m:.0f}",
            f"{b:.0f}",
        ]
        for n, d, t, e, m, b in found
    ]
    if figure is not None:
        draw(np.array(found), figure)
    head = [
        "segments",
        "direct [processor s]",
        "tree [processor s]",
        "direct / tree",
        "tree / (N log2 N) [ns]",
        "error",
        "peak memory [MB]",
        "of the tree, bytes per segment",
    ]
    return table(head, rows)


def draw(found: np.ndarray, path: Path) -> None:
    """Cost against the number of segments."""
    import matplotlib.pyplot as plt

    n = found[:, 0]
    fig, ax = plt.subplots(figsize=(6.0, 4.2), layout="constrained")
    ax.loglog(n, found[:, 1], "s-", color="#888888", label="direct sum")
    ax.loglog(n, found[:, 2], "o-", color="#1f4e79", label="tree")
    # through the tree's time at the first size of 10^4 and more
    k = int(np.argmax(n >= 1e4))
    growth = n * np.log(n) / (n[k] * np.log(n[k]))
    ax.loglog(n, found[k, 2] * growth, ":", color="#1f4e79", label="N log N")
    ax.set(xlabel="segments N (and as many points)", ylabel="time for all points [s]")
    ax.grid(visible=True, which="major", alpha=0.3)
    ax.legend(frameon=False)
    fig.savefig(path, dpi=150)


if __name__ == "__main__":
    one_size(int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]))
