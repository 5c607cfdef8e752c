# SPDX-License-Identifier: MIT OR Apache-2.0
"""Examples run, short, as they stand; each is small and draws a figure."""

import importlib.util
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "examples"
SHORT = {
    "first_flight": {"revolutions": 1},
    "inflow_models": {"seconds": 0.3},
    "power_curve": {"speeds": ("60 kt", "100 kt")},
    "envelope": {"n_speeds": 2, "n_altitudes": 2},
    "monte_carlo": {"members": 2, "revolutions": 1},
    "derivatives": {"speeds": ("60 kt",)},
    "uh60a_modes": {},
    "bandwidth": {"names": ("uh60a",)},
    "own_maneuver": {"seconds": 1.0},
    "hover_stand": {"collectives": (6, 8), "wake_at": None},
    "autopilot": {"seconds": 0.6},
    "gym_autopilot": {"seconds": 0.6},
    "hover_taxi": {"seconds": 0.6},
    "turboshaft": {"seconds": 0.6},
    "vortex_ring": {"n_segments": 90},
    "blade_frequencies": {"n_speeds": 2},
    "dynamic_stall": {"steps": 360},
    "other_programs": {"revolutions": 1},
}
"""Arguments of each example's `main` that make it short."""


def _module(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_example_is_tested():
    assert {path.stem for path in FOLDER.glob("*.py")} == set(SHORT)


@pytest.mark.parametrize("name", SHORT)
def test_an_example_runs_and_draws(name, tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "Agg")
    path = FOLDER / f"{name}.py"
    figure = _module(path).main(tmp_path, **SHORT[name])
    assert figure.is_file()
    assert path.read_text().count("\n") <= 60
