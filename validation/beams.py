"""Uniform blades for the cases of blade structures, as the physics core reads them."""

import json

import numpy as np

from wakeflight import _core

FLAP, LAG, TORSION = range(3)


def uniform(root="clamped", root_station=0.0, radius=1.0, ei_flap=1.0, ei_lag=1e4, **changes):
    """A uniform blade of 1 kg/m without twist and rotary inertia, stiff in torsion; `changes` by the core's names."""
    structure = {
        "r_in": [root_station],
        "r_out": [radius],
        "mass": [1.0],
        "ei_flap": [ei_flap],
        "ei_lag": [ei_lag],
        "gj": [1.0],
        "i_theta": [0.0],
        "x_cg": [0.0],
    }
    structure |= {key: changes.pop(key) for key in list(changes) if key in structure}
    return {
        "root": root,
        "root_station": root_station,
        "radius": radius,
        "root_cutout": root_station,
        "structure": structure,
        "twist": {"x": [0.0], "y": [0.0]},
        "chord": {"x": [0.0], "y": [1.0]},
        "pitch_axis_chord_fraction": 0.25,
        "control_stiffness": 1.0,
        "km1_over_ktheta": 0.0,
        "ka_over_ktheta": 0.0,
        "structural_damping_ratio": 0.0,
        "delta3": 0.0,
        "precone": 0.0,
        **changes,
    }


def modes(blade, omega, n_modes, n_elements=4, pitch=0.0):
    """Modes of the rotating blade."""
    return _core.BladeModes(json.dumps(blade), omega, pitch, n_elements, n_modes)


def mostly(found, kind):
    """Frequencies [rad/s] of the modes whose kinetic energy is mostly of one kind."""
    return np.asarray(found.frequencies)[np.asarray(found.energy_shares)[:, kind] > 0.5]
