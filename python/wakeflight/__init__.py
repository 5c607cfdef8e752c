# SPDX-License-Identifier: MIT OR Apache-2.0
"""Helicopters in unsteady manoeuvres with a time-accurate free vortex wake.

    import wakeflight as wf

    aircraft = wf.load_aircraft("uh60a")
    condition = wf.FlightCondition(speed="80 kt", flight_path="-6 deg", altitude="5250 ft")
    start = wf.trim(aircraft, condition, inflow="relaxation")
    flight = wf.fly(start, wf.arrested_descent(), inflow="time-marching")

Names are imported when they are first used, so that `import wakeflight` costs nothing.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .acoustics import noise
    from .aircraft import Aircraft, Rotor, load_aircraft, load_rotor
    from .airfoil_loop import airfoil_loop
    from .blade_loads import blade_loads, wake_velocity
    from .condition import FlightCondition, condition_for
    from .control import (
        AltitudeHold,
        AttitudeHold,
        Augmentation,
        Controller,
        Hands,
        PitchBiasActuator,
        RateDamping,
        Sensors,
        Servos,
        TurnCoordination,
        follow,
        from_control,
        load_control,
    )
    from .engine import Engine, FreeEngine, GovernedEngine
    from .errors import GroundContact, InputError, Interrupted, NumericalFailure, StorageFailure, WakeflightError
    from .export import export, export_wopwop
    from .file_schemas import file_schema
    from .flight import Flight, fly
    from .handling import HandlingQualities, handling_qualities
    from .inflow import AnnularInflow, DynamicInflow, RelaxationWake, TimeMarchingWake, inflow_model
    from .linear import LinearModel, inflow_constants, linearize
    from .maneuver_files import arrested_descent, load_maneuver, roll_reversal
    from .maneuvers import Maneuver
    from .modes import blade_modes
    from .references import bibtex
    from .report.load_factor import load_factor
    from .resuming import branch, open_run, recover, rerun, resume
    from .simulation import Simulation
    from .snapshot import Snapshot
    from .stick_inputs import doublet, frequency_sweep, recorded_sticks, step, three_two_one_one
    from .studies.converge import converge
    from .sweep import Normal, Uniform, arange, grid, sample, sweep
    from .trim import Trim, trim
    from .tunnel import Tunnel, tunnel
    from .vortex import induced_velocity
    from .wind import Dryden, Gust, SteadyWind, VonKarman, Wind, WindField
    from .wing import Wing, wing

    __version__: str

_HOME = {
    "noise": "acoustics",
    "Aircraft": "aircraft",
    "load_aircraft": "aircraft",
    "Rotor": "aircraft",
    "load_rotor": "aircraft",
    "airfoil_loop": "airfoil_loop",
    "blade_loads": "blade_loads",
    "wake_velocity": "blade_loads",
    "load_factor": "report.load_factor",
    "FlightCondition": "condition",
    "condition_for": "condition",
    "AltitudeHold": "control",
    "AttitudeHold": "control",
    "Augmentation": "control",
    "Controller": "control",
    "Hands": "control",
    "PitchBiasActuator": "control",
    "RateDamping": "control",
    "Sensors": "control",
    "Servos": "control",
    "TurnCoordination": "control",
    "follow": "control",
    "from_control": "control",
    "load_control": "control",
    "converge": "studies.converge",
    "Normal": "sweep",
    "Uniform": "sweep",
    "arange": "sweep",
    "grid": "sweep",
    "sample": "sweep",
    "sweep": "sweep",
    "InputError": "errors",
    "Interrupted": "errors",
    "GroundContact": "errors",
    "NumericalFailure": "errors",
    "StorageFailure": "errors",
    "WakeflightError": "errors",
    "export": "export",
    "export_wopwop": "export",
    "file_schema": "file_schemas",
    "Flight": "flight",
    "fly": "flight",
    "HandlingQualities": "handling",
    "handling_qualities": "handling",
    "AnnularInflow": "inflow",
    "DynamicInflow": "inflow",
    "RelaxationWake": "inflow",
    "TimeMarchingWake": "inflow",
    "inflow_model": "inflow",
    "LinearModel": "linear",
    "inflow_constants": "linear",
    "linearize": "linear",
    "Maneuver": "maneuvers",
    "arrested_descent": "maneuver_files",
    "load_maneuver": "maneuver_files",
    "roll_reversal": "maneuver_files",
    "blade_modes": "modes",
    "bibtex": "references",
    "Engine": "engine",
    "Dryden": "wind",
    "Gust": "wind",
    "SteadyWind": "wind",
    "VonKarman": "wind",
    "Wind": "wind",
    "WindField": "wind",
    "FreeEngine": "engine",
    "GovernedEngine": "engine",
    "branch": "resuming",
    "open_run": "resuming",
    "recover": "resuming",
    "rerun": "resuming",
    "resume": "resuming",
    "Simulation": "simulation",
    "Snapshot": "snapshot",
    "doublet": "stick_inputs",
    "frequency_sweep": "stick_inputs",
    "recorded_sticks": "stick_inputs",
    "step": "stick_inputs",
    "three_two_one_one": "stick_inputs",
    "Trim": "trim",
    "trim": "trim",
    "Tunnel": "tunnel",
    "tunnel": "tunnel",
    "induced_velocity": "vortex",
    "Wing": "wing",
    "wing": "wing",
}

__all__ = [
    "Aircraft",
    "AltitudeHold",
    "AnnularInflow",
    "AttitudeHold",
    "Augmentation",
    "Controller",
    "Dryden",
    "DynamicInflow",
    "Engine",
    "Flight",
    "FlightCondition",
    "FreeEngine",
    "GovernedEngine",
    "GroundContact",
    "Gust",
    "HandlingQualities",
    "Hands",
    "InputError",
    "Interrupted",
    "LinearModel",
    "Maneuver",
    "Normal",
    "NumericalFailure",
    "PitchBiasActuator",
    "RateDamping",
    "RelaxationWake",
    "Rotor",
    "Sensors",
    "Servos",
    "Simulation",
    "Snapshot",
    "SteadyWind",
    "StorageFailure",
    "TimeMarchingWake",
    "Trim",
    "Tunnel",
    "TurnCoordination",
    "Uniform",
    "VonKarman",
    "WakeflightError",
    "Wind",
    "WindField",
    "Wing",
    "__version__",
    "airfoil_loop",
    "arange",
    "arrested_descent",
    "bibtex",
    "blade_loads",
    "blade_modes",
    "branch",
    "condition_for",
    "converge",
    "doublet",
    "export",
    "export_wopwop",
    "file_schema",
    "fly",
    "follow",
    "frequency_sweep",
    "from_control",
    "grid",
    "handling_qualities",
    "induced_velocity",
    "inflow_constants",
    "inflow_model",
    "linearize",
    "load_aircraft",
    "load_control",
    "load_factor",
    "load_maneuver",
    "load_rotor",
    "noise",
    "open_run",
    "recorded_sticks",
    "recover",
    "rerun",
    "resume",
    "roll_reversal",
    "sample",
    "step",
    "sweep",
    "three_two_one_one",
    "trim",
    "tunnel",
    "wake_velocity",
    "wing",
]


if not TYPE_CHECKING:
    # to whoever checks types the names are those imported above, and a misspelt one is an error

    def __getattr__(name: str) -> Any:
        """Import a public name from its module on first use."""
        if name == "__version__":
            from importlib.metadata import PackageNotFoundError, version

            try:
                value: Any = version("wakeflight")
            except PackageNotFoundError:  # run from a source tree
                value = "0+unknown"
        elif name == "gym":
            # a module, which needs Gymnasium
            value = import_module(".gym", __name__)
        elif name in _HOME:
            value = getattr(import_module(f".{_HOME[name]}", __name__), name)
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    """Public names, imported or not."""
    return sorted(set(globals()) | set(__all__))


class _Package(ModuleType):
    """This package: `wakeflight.trim` is the verb, even after the module of that name was imported."""

    def __setattr__(self, name: str, value: Any) -> None:
        """Keep a submodule from hiding the function of the same name."""
        if not (isinstance(value, ModuleType) and _HOME.get(name) == name):
            super().__setattr__(name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        """By name, as other modules are: functions that use it can be sent to other processes."""
        return import_module, (self.__name__,)


sys.modules[__name__].__class__ = _Package
