# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rotor in a climb, which carries its wake away and makes it periodic."""

from pathlib import Path

CARADONNA = Path(__file__).resolve().parents[2] / "validation/rotors/caradonna-tung.toml"
WAKE = {
    "trailers": "tip",
    "turns": 2,
    "far_wake_turns": 0,
    "azimuth_step": "15 deg",
    "n_stations": 10,
    "near_wake_angle": "30 deg",
}
