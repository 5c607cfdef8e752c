"""The free wake: a step against the number of segments, an isolated rotor marched, a rotor in hover from nothing."""

import json
import os
import sys
import time
from pathlib import Path

import numpy as np
from measure import seconds, table
from vortex import helices, numpy_sum

import wakeflight as wf
from wakeflight import _core
from wakeflight.exchange import Exchange
from wakeflight.inflow import trim_model

ROOT = Path(__file__).resolve().parents[1]
CARADONNA_TUNG = ROOT / "validation" / "rotors" / "caradonna-tung.toml"
RADIUS, OMEGA = 8.0, 27.0
HUB = ((-20.0, 0.0, 0.0), (0.0, 0.0, 0.0))

# trailers of a blade, steps of a revolution, turns
SIZES = [(1, 36, 4), (4, 36, 2), (8, 36, 4), (21, 36, 4), (21, 72, 8), (41, 72, 10), (61, 108, 20)]
AFFORDABLE = 1.2e9
"""Evaluations of a field up to which the direct sum is timed whole; beyond, at part of the markers, and scaled."""


def naive() -> float:
    """Seconds that numpy needs for an evaluation."""
    points, nodes, circulation = helices(1, 4, 10.0)
    median, _ = seconds(lambda: numpy_sum(points, nodes, circulation, 0.05), 5)
    return median / (points.shape[0] * circulation.size)


def lattice(n_trailers: int, steps: int, turns: int, summation: str) -> tuple[_core.TimeMarchingWake, int, int]:
    """Rigid wake of four blades in forward flight, ready to march; its markers and its segments."""
    n_stations = max(20, n_trailers - 1)
    kind = (
        {"trailers": "tip"}
        if n_trailers == 1
        else {"trailers": "full-span", "n_trailers": n_trailers, "far_wake_turns": 0}
    )
    options = {
        "rotor": {
            "n_blades": 4,
            "radius": RADIUS,
            "root_cutout": 1.2,
            "hinge_offset": 0.4,
            "chord": 0.5,
            "omega": OMEGA,
        },
        "wake": {
            "n_stations": n_stations,
            "turns": turns,
            "azimuth_step": 2 * np.pi / steps,
            "summation": summation,
            **kind,
        },
        "relaxation": {},
        "marching": {},
    }
    relaxation = _core.RelaxationWake(json.dumps(options), HUB, 0.02)
    circulation = np.tile(20.0 * np.sin(np.linspace(0.1, 3.0, n_stations)), (steps, 1))
    relaxation.set_state(HUB, np.zeros((steps, 2)), circulation)
    wake = _core.TimeMarchingWake(relaxation, 0, json.dumps(options))
    length = steps * turns
    markers = 4 * n_trailers * (length + 1)
    return wake, markers, 4 * (n_trailers * length + (n_trailers - 1) * length + n_stations)


def one_step(wake: _core.TimeMarchingWake, steps: int) -> float:
    """Processor seconds of a step of a marching wake: two fields, predictor, corrector."""
    n_stations = max(20, wake.lattice().shape[1] - 1)
    circulation = np.tile(20.0 * np.sin(np.linspace(0.1, 3.0, n_stations)), (4, 1))
    psi = 2 * np.pi * (np.arange(4) / 4 + 1 / steps)
    blades = np.column_stack([psi, np.zeros(4), np.zeros(4)])
    begun = time.process_time()
    wake.step(HUB, blades, circulation)
    return time.process_time() - begun


def steps(quick: bool) -> str:
    """Processor time of a step of the wake on one thread, directly and by the tree; error of the tree's field at markers."""
    _core.set_threads(1)
    rows = []
    for n_trailers, per_turn, turns in SIZES[:5] if quick else SIZES:
        direct, markers, segments = lattice(n_trailers, per_turn, turns, "direct")
        whole = markers * segments < AFFORDABLE
        every = 1 if whole else max(1, round(markers * segments / 5e8))
        points = direct.lattice().reshape(-1, 3)[::every]
        begun = time.process_time()
        reference = direct.wake_velocity(points)
        by_direct = 2.0 * (time.process_time() - begun) * markers / points.shape[0]
        repetitions = 3 if segments < 30_000 else 1
        if whole:
            by_direct = min(one_step(direct.copy(), per_turn) for _ in range(repetitions))
        tree, _, _ = lattice(n_trailers, per_turn, turns, "tree")
        by_tree = min(one_step(tree.copy(), per_turn) for _ in range(repetitions))
        # the tree's field at all markers: which points are asked together is part of its answer
        found = tree.wake_velocity(tree.lattice().reshape(-1, 3))[::every]
        error = np.linalg.norm(found - reference, axis=1).max() / np.linalg.norm(reference, axis=1).max()
        cells = [f"{by_direct:.3g}{'' if whole else ' (scaled)'}", f"{by_tree:.3g}", f"{by_direct / by_tree:.2f}"]
        per = by_tree / (segments * np.log2(segments)) * 1e9
        rows.append([str(n_trailers), str(markers), str(segments), *cells, f"{per:.0f}", f"{error:.1e}"])
        del direct, tree
    _core.set_threads(os.cpu_count() or 1)
    head = ["trailers", "markers", "segments", "direct [s]", "tree [s]", "direct / tree"]
    return table([*head, "tree / (N log2 N) [ns]", "error"], rows)


def isolated_rotor() -> str:
    """432 steps of the UH-60A's rotor at 80 kt on one thread, circulation solved twice a step."""
    _core.set_threads(1)
    options = {"trailers": "full-span", "n_trailers": 2, "shed_wake": "all", "summation": "direct"}
    wind = {"speed": "80 kt", "shaft_angle": "-5 deg"}
    rows, by_numpy = [], naive()
    for evaluation in ("pece", "pec"):
        inflow = wf.TimeMarchingWake(**options, evaluation=evaluation)
        start = wf.tunnel("uh60a", collective="14 deg", inflow=inflow, revolutions=1, **wind).solution
        march = Exchange.marching(start.model, start.wake)
        before, begun, busy = march.segment_evaluations, time.perf_counter(), time.process_time()
        for _ in range(432):
            march.frozen_step(start.problem, start.x)
        wall, busy, n = time.perf_counter() - begun, time.process_time() - busy, march.segment_evaluations - before
        flown = 432 / march.n * 2 * np.pi / start.model.aircraft.rotor.omega
        cells = [f"{n:.3g}", f"{wall:.2f}", f"{busy:.2f}", f"{flown / busy:.2f}", f"{busy / n * 1e9:.2f}"]
        rows.append([evaluation, *cells, f"{by_numpy * n:.0f}"])
    _core.set_threads(os.cpu_count() or 1)
    head = ["fields of a step", "evaluations", "wall [s]", "processor [s]", "times faster than the rotor"]
    return table([*head, "ns per evaluation, all included", "evaluations by numpy [s]"], rows)


def pec(quick: bool) -> str:
    """Roll reversal with one field a step against two, beside what half the step changes."""
    _core.set_threads(1)
    names = ("p", "q", "roll", "beta_1c", "beta_1s", "ct", "inflow_mean")
    flights = {}
    for label, step, evaluation in (("two", 10, "pece"), ("one", 10, "pec"), ("two at 5 deg", 5, "pece")):
        inflow = wf.TimeMarchingWake(azimuth_step=f"{step} deg", evaluation=evaluation)
        trimmed = wf.trim(wf.load_aircraft("uh60a"), inflow=trim_model(inflow))
        flight = wf.fly(trimmed, wf.roll_reversal(), inflow=inflow, revolutions=3 if quick else 15, integrator="fixed")
        every = 10 // step
        flights[label] = ({name: flight.data[name].values[::every] for name in names}, flight.data.attrs)
    rows = []
    for label in ("one", "two at 5 deg"):
        found, attributes = flights[label]
        cells = []
        for name in names:
            scale = np.abs(flights["two"][0][name]).max()
            cells.append(f"{np.abs(found[name] - flights['two'][0][name]).max() / scale:.1e}")
        seconds_wake = float(attributes["seconds_wake"]) / float(flights["two"][1]["seconds_wake"])
        rows.append([label, f"{seconds_wake:.2f}", *cells])
    _core.set_threads(os.cpu_count() or 1)
    return table(["fields of a step", "time of the wake, two at 10 deg = 1", *names], rows) + (
        "\nLargest difference from two fields at 10 deg, over the largest value, "
        f"{3 if quick else 15} revolutions of the roll reversal.\n"
    )


def caradonna_tung() -> str:
    """Hover at 8 degrees and 1250 rpm from nothing on one thread, until the steadiness asked for."""
    _core.set_threads(1)
    rows, by_numpy = [], naive()
    for kind, options in (
        (wf.RelaxationWake, {}),
        (wf.RelaxationWake, {"tip_strength": "max", "inboard_wake": "sheet"}),
        (wf.TimeMarchingWake, {}),
    ):
        begun, busy = time.perf_counter(), time.process_time()
        run = wf.tunnel(CARADONNA_TUNG, collective="8 deg", rpm=1250, inflow=kind(**options))
        wall, busy = time.perf_counter() - begun, time.process_time() - busy
        solved = run.solution
        evaluations = solved.wake.counters["wake_segment_evaluations"]
        if solved.march is not None:
            evaluations += solved.march.segment_evaluations
        thrust = [turn.passages["aero_force"][..., 2].sum(axis=1).mean() for turn in solved.revolutions][-4:]
        spread = f"{np.ptp(thrust) / np.mean(thrust):.1%} over the last four revolutions" if thrust else "converged"
        steady = spread if thrust or solved.settled else "not converged"
        setting = ", ".join([kind.name, *map(str, options.values())])
        cells = [f"{wall:.2f}", f"{busy:.2f}", f"{run.ct:.5f}", steady, f"{evaluations:.2g}"]
        rows.append([setting, *cells, f"{by_numpy * evaluations:.0f}"])
    _core.set_threads(os.cpu_count() or 1)
    head = ["wake", "wall [s]", "processor [s]", "C_T (measured 0.00460)", "thrust", "evaluations"]
    return table([*head, "evaluations by numpy [s]"], rows)


if __name__ == "__main__":
    sys.exit("a part of bench.py")
