# SPDX-License-Identifier: MIT OR Apache-2.0
"""One section in harmonic pitch or plunge: the stand of an unsteady airfoil."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from .aircraft import Aircraft, Rotor
from .aircraft.section_at import section_at
from .errors import InputError, NumericalFailure
from .results import assemble_loop
from .units import number, quantity, whole

if TYPE_CHECKING:
    import xarray as xr

MOTIONS = ("pitch", "plunge")
COLUMNS = ("phase", "alpha", "cl", "cl_circulatory", "cd", "cm", "cn", "alpha_effective", "separation", "work")


def airfoil_loop(
    airfoil: str | Path | Aircraft | Rotor = "uh60a",
    mean: Any = "10 deg",
    amplitude: Any = "10 deg",
    k: float = 0.1,
    mach: float = 0.3,
    motion: str = "pitch",
    model: str = "hgm",
    *,
    station: float | None = None,
    pitch_axis: float = 0.25,
    steps: int = 720,
) -> xr.Dataset:
    """Coefficients and states of a section over the cycle of a harmonic motion that repeats: mean + amplitude sin(phase).

    airfoil: path of a C81 deck, or an aircraft or rotor (name, file, loaded) whose section at `station` (r/R, 0.75) is meant.
    mean, amplitude: angles, text with a unit; in plunge those of the angle of attack. k: reduced frequency omega c/(2 V).
    mach: Mach number. motion: `pitch` about `pitch_axis` (chords behind the leading edge), or `plunge`.
    model: `quasi-steady` (the table), `attached` (shed wake and impulsive loads [leishman1989]), `oye` (separation with one lag
    [oye1991]), `hgm` (shed wake, pressure and separation in four states [hansen2004]). steps: of a cycle; error of second order.

    Dataset along `phase`: `alpha` [rad], `cl`, `cd`, `cn`, `cm` about the quarter chord with the damping of the pitch rate,
    `cl_circulatory`, `alpha_effective`, `separation`, the model's `states` by name, and the `work` of the air in a cycle
    (negative: damped). No stall vortex: deep stall lacks its peaks of lift and moment.
    """
    for name, value, allowed in (("motion", motion, MOTIONS), ("model", model, _core.unsteady_models())):
        if value not in allowed:
            raise InputError.of(name, value, f"allowed: {', '.join(allowed)}")
    section = section_at(airfoil, station)
    asked = {
        "sections": section.data,
        "station": section.station,
        "model": model,
        "mean": quantity(mean, "rad", "mean"),
        "amplitude": quantity(amplitude, "rad", "amplitude"),
        "reduced_frequency": number("k", k),
        "mach": number("mach", mach),
        "pitch_axis": number("pitch_axis", pitch_axis) if motion == "pitch" else None,
        "steps": whole("steps", steps, 36, 100_000),
    }
    try:
        cycle = _core.airfoil_cycle(json.dumps(asked))
    except ValueError as reason:
        raise InputError(str(reason)) from reason
    except ArithmeticError as reason:
        raise NumericalFailure(str(reason)) from reason
    arrays = {name: getattr(cycle, name) for name in COLUMNS}
    if cycle.state_names:
        arrays |= {"states": cycle.states, "state": cycle.state_names}
    told = {name: value for name, value in asked.items() if name not in ("sections", "station")}
    attributes = {
        "airfoil": section.name,
        "motion": motion,
        **told,
        "cycles": cycle.cycles,
        "warnings": "\n".join(section.warnings),
        "references": ", ".join(dict.fromkeys((*cycle.sources, *section.references))),
    }
    return assemble_loop(arrays, attributes)
