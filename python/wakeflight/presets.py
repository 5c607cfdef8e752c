# SPDX-License-Identifier: MIT OR Apache-2.0
"""Presets of the inflow models: options that belong together, by a name.

`standard` is what the core declares as default: three trailers a blade and what is shed between them for two turns, what is older
carried on in its mean for two turns in forward flight, four at low speed, six in hover; in axial descent a lone tip vortex
(docs/numerics/wake-defaults.md). `paper` is what the manoeuvres of the paper are flown with (docs/paper.md): one tip vortex, an
exchange at every 10 deg, the dynamics on the inflow of a revolution with the relaxation wake, ten revolutions at frozen states
before the time-marching wake flies; it stays what it is where a default moves. `reference` is the finest wake that was found to
settle in forward flight and, marched, in hover: free trailers all over the span.
"""

from __future__ import annotations

from typing import Any

from .errors import InputError
from .options import options_of

PRESETS: dict[str, dict[str, Any]] = {
    "standard": {},
    "paper": {
        "azimuth_step": "10 deg",
        "n_stations": 20,
        "trailers": "tip",
        "tip_strength": "equivalent",
        "inboard_wake": "none",
        "near_wake_angle": "30 deg",
        "core_radius": 0.02,
        "core_growth": 3e-4,
        "far_wake": "repeat",
        "scheme": "bdf2",
        "predictor": "same",
        "evaluation": "pece",
        "form": "displacement",
        "precision": "single",
        "convergence_revolutions": 10,
        "recorrect": 0,
        "extrapolate": False,
        "max_loops_response": 10,
    },
    "reference": {
        "trailers": "full-span",
        "n_trailers": 10,
        "trailer_core": 0.08,
        "azimuth_step": "15 deg",
        "turns": 10,
        "far_wake_turns": 0,
        "precision": "double",
    },
}
"""Options of each preset; a model takes those it has."""


def preset(model: str, name: str) -> dict[str, Any]:
    """Options of the preset `name` for the model of that name."""
    if name not in PRESETS:
        raise InputError.choice("preset", name, PRESETS)
    known = options_of(model)
    return {option: value for option, value in PRESETS[name].items() if option in known}
