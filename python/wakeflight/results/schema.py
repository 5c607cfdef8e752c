# SPDX-License-Identifier: MIT OR Apache-2.0
"""The one schema of every result: which variables a flight, a trim, a stand and its transient leave, and their dimensions."""

from __future__ import annotations

from dataclasses import dataclass

from .variables import MEANINGS, UNITS

SCHEMA = 2
"""Version of what a result holds, its attribute `schema`; files without one are of version 1, which had no `input`."""


@dataclass(frozen=True)
class Variable:
    """One variable of a dataset: its dimensions, unit and meaning; `optional` ones may be absent."""

    name: str
    dims: tuple[str, ...]
    units: str
    long_name: str
    optional: bool = False


@dataclass(frozen=True)
class Attribute:
    """One attribute of a dataset: its meaning; `required` ones must be given by whoever assembles it."""

    name: str
    long_name: str
    required: bool = False


def _table(dims: tuple[str, ...], *names: str | tuple[str, str], optional: bool = False) -> list[Variable]:
    """Variables that share their dimensions, by name; a pair is a name with the meaning it has in this dataset alone."""
    pairs = [(each, MEANINGS[each]) if isinstance(each, str) else each for each in names]
    return [Variable(name, dims, UNITS[name], meaning, optional) for name, meaning in pairs]


TIME = ("time",)
BLADE = ("time", "blade")
STATION = ("time", "blade", "station")
DISK = ("azimuth", "station")

CONTROL = ("lateral", "longitudinal", "collective", "pedal")
"""Sticks that controllers and servos move."""

WATCHED = (
    "inflow_max",
    "inflow_bound",
    "mach_max",
    "mach_bound",
    "alpha_min",
    "alpha_max",
    "stalled_share",
    "reversed_share",
    "mu_z",
    "hover_inflow",
)
"""Monitors that trim, stand and flight have alike."""

COORDINATES: dict[str, Variable] = {
    variable.name: variable
    for variable in (
        Variable("time", ("time",), "s", "time from the start of the flight"),
        Variable("blade", ("blade",), "1", "blade number; blade 1 is at azimuth 0 when its azimuth is 0"),
        Variable("station", ("station",), "1", "radial station r/R, from the hub centre"),
        Variable("mode", ("mode",), "1", "blade mode in ascending order of frequency"),
        Variable("snapshot", ("snapshot",), "1", "wake snapshot number"),
        Variable("trailer", ("trailer",), "1", "free trailer of a blade, from root to tip"),
        Variable("age", ("age",), "rad", "wake age: angle turned by the blade since release"),
        Variable("part", ("part",), "1", "part of the airframe"),
        Variable("xyz", ("xyz",), "1", "component"),
        Variable("azimuth", ("azimuth",), "rad", "azimuth, 0 over the tail, in the direction of rotation"),
        Variable("psi", ("psi",), "rad", "azimuth of a disk map in a run, where `azimuth` is that of the blades"),
        Variable("revolution", ("revolution",), "1", "number of the marched revolution"),
        Variable("harmonic", ("harmonic",), "1", "mean, then cosine and sine of each harmonic"),
        Variable("phase", ("phase",), "rad", "phase of a harmonic motion, 0 where it passes its mean upward"),
        Variable("state", ("state",), "1", "state of an unsteady section"),
    )
}

NAMED = {"xyz": ("x", "y", "z"), "part": ("fuselage", "stabilator", "fin", "tail rotor")}
"""Coordinates whose values are words."""

RUN: tuple[Variable, ...] = (
    *_table(
        TIME,
        "u",
        "v",
        "w",
        "p",
        "q",
        "r",
        "roll",
        "pitch",
        "yaw",
        "north",
        "east",
        "down",
        "collective",
        "longitudinal",
        "lateral",
        "pedal",
        "force_x",
        "force_y",
        "force_z",
        "moment_x",
        "moment_y",
        "moment_z",
        "beta_1c",
        "beta_1s",
    ),
    *_table(("time", "xyz"), "hub_force", "hub_moment"),
    *_table(("time", "xyz"), "wind", optional=True),
    *_table(("time", "part", "xyz"), "wash", optional=True),
    *_table(("time", "blade", "mode"), "modal"),
    *_table(BLADE, "azimuth"),
    *_table(STATION, "inflow", "circulation", "cl", "cl_m2", "alpha", "mach"),
    *_table(("snapshot", "blade", "age", "xyz"), "wake", optional=True),
    *_table(("snapshot",), "snapshot_revolution", optional=True),
    *_table(("snapshot", "blade", "age"), "wake_circulation", "wake_core", optional=True),
    *_table(BLADE, "flap", "lead", optional=True),
    *_table(("snapshot", "blade", "trailer", "age", "xyz"), "wake_sheet", optional=True),
    *_table(("snapshot", "blade", "trailer", "age"), "wake_sheet_circulation", optional=True),
    *_table(
        TIME,
        *(f"{kind}_{stick}" for kind in ("sas", "actuator") for stick in CONTROL),
        "bank",
        "beta_0",
        "power",
        "ct",
        "inflow_mean",
        "rotor_speed",
        ("torque", "torque of the engines at the speed of the rotor, where it is a state"),
        "power_engine",
        "stabilator",
        "odd_even",
        "max_displacement",
        "stick_margin",
        "height",
        *WATCHED,
        "energy",
        "energy_balance",
        "vortex_blade_distance",
        optional=True,
    ),
    *_table(("psi", "station"), "inflow_trim", "inflow_before", "inflow_start", optional=True),
)

TRIM: tuple[Variable, ...] = (
    *_table(
        (),
        "collective",
        "longitudinal",
        "lateral",
        "pedal",
        "pitch",
        "roll",
        "theta_0",
        "theta_1c",
        "theta_1s",
        "ct",
        "ct_sigma",
        "mu",
        "power",
    ),
    *_table(DISK, "inflow"),
    *_table(("azimuth", "mode"), "modal"),
    *_table(("xyz",), "residual_linear", "residual_angular"),
    *_table((), "residual_blade"),
    *_table(
        (),
        "residual_inflow",
        "bank",
        "theta_tail",
        "beta_0",
        "beta_1c",
        "beta_1s",
        "power_main",
        "power_tail",
        "stabilator",
        "inflow_mean",
        "stick_margin",
        "sideslip",
        "vortex_blade_distance",
        *WATCHED,
        optional=True,
    ),
    *_table(("xyz",), "velocity_b", "rates_b", optional=True),
    *_table(("mode", "harmonic"), "modal_harmonics", optional=True),
    *_table(DISK, "circulation", "cl", "cl_m2", "alpha", "mach", optional=True),
    *_table(("part", "xyz"), "wash", optional=True),
)

TUNNEL: tuple[Variable, ...] = (
    *_table(
        (),
        "ct",
        "cq",
        "cp",
        "ct_sigma",
        "figure_of_merit",
        "mu",
        "mu_z",
        "thrust",
        "torque",
        ("power", "shaft power"),
        "h_force",
        "side_force",
        "beta_0",
        "beta_1c",
        "beta_1s",
        "theta_0",
        "theta_1c",
        "theta_1s",
        "theta_75",
        "inflow_mean",
        "inflow_1c",
        "inflow_1s",
        "ct_std",
        "cq_std",
    ),
    *_table(("xyz",), "hub_force", "hub_moment", "aero_force", "aero_moment", "velocity"),
    *_table(
        DISK,
        "inflow",
        "circulation",
        "cl",
        "cd",
        "cm",
        "cn",
        "cl_m2",
        "cn_m2",
        "cm_m2",
        "alpha",
        "mach",
        "cl_std",
        "inflow_std",
    ),
    *_table(("station",), "radial_cl", "radial_circulation", "radial_inflow", "radial_alpha", "chord", "width"),
    *_table(("azimuth",), "theta", "flap", "lead", "tip_flap", "tip_lead", "tip_twist"),
    *_table(
        (), "vortex_blade_distance", "max_displacement", *(name for name in WATCHED if name != "mu_z"), optional=True
    ),
    *_table(("revolution",), "ct_history", "cq_history", "theta_0_history", optional=True),
    *_table(("age",), "tip_vortex_radius", "tip_vortex_height", "tip_vortex_circulation", optional=True),
    *_table(("azimuth", "mode"), "modal", optional=True),
    *_table(("blade", "age", "xyz"), "wake", optional=True),
    *_table(("azimuth", "age", "xyz"), "wake_path", optional=True),
    *_table(("azimuth", "age"), "wake_path_std", optional=True),
)

TRANSIENT: tuple[Variable, ...] = (
    *_table(
        TIME,
        "theta_0",
        "ct",
        "cq",
        "thrust",
        "torque",
        ("beta_0", "mean of the blades' flap angles, precone included"),
        "inflow_mean",
    ),
    *_table(TIME, "rotor_speed", optional=True),
    *_table(BLADE, "azimuth", "flap", "lead"),
    *_table(STATION, "inflow", "circulation", "cl", "alpha"),
    *_table(("time", "xyz"), "hub_force", "hub_moment"),
    *_table(("time", "blade", "age", "xyz"), "wake", optional=True),
    *_table(("time", "blade", "age"), "tip_circulation", optional=True),
)

LOOP: tuple[Variable, ...] = (
    *_table(
        ("phase",),
        ("alpha", "angle of attack of the motion: pitch angle, or that of the velocity of plunge"),
        "cl",
        "cl_circulatory",
        "cd",
        "cm",
        "cn",
        "alpha_effective",
        "separation",
    ),
    *_table((), "work"),
    *_table(("phase", "state"), "states", optional=True),
)

ATTRIBUTES: tuple[Attribute, ...] = (
    Attribute("aircraft", "aircraft", required=True),
    Attribute("inflow_model", "inflow model", required=True),
    Attribute("radius", "rotor radius [m]", required=True),
    Attribute("omega", "nominal rotor speed [rad/s]", required=True),
    Attribute("configuration", "the whole configuration, as JSON", required=True),
    Attribute("maneuver", "manoeuvre"),
    Attribute("maneuver_adapted", "adapted to this aircraft"),
    Attribute("condition", "flight condition"),
    Attribute("schema", "version of what the file holds"),
    Attribute("input", "everything the run was made of, as JSON: `wakeflight rerun` flies it again"),
    Attribute("program_version", "program version"),
    Attribute("instruction_set", "instruction set of the vortex sums"),
    Attribute("finished", "1 if the run came to its end, 0 if it failed"),
    Attribute("failure", "where and why a failed run stopped"),
    Attribute("ct", "thrust coefficient at trim"),
    Attribute("ct_sigma", "blade loading at trim"),
    Attribute("mu", "advance ratio at trim"),
    Attribute("power", "power at trim [W]"),
    Attribute("seconds_trim", "wall clock: trim [s]"),
    Attribute("seconds_convergence", "wall clock: convergence phase [s]"),
    Attribute("seconds_wake", "wall clock: wake in flight [s]"),
    Attribute("seconds_dynamics", "wall clock: flight dynamics [s]"),
    Attribute("seconds_total", "wall clock: total [s]"),
    Attribute("blades", "flexible or rigid"),
    Attribute("blade_modes", "what each blade mode mostly is, in ascending order of frequency"),
    Attribute("geometry", "place and shape of the rotor, as JSON"),
    Attribute("integrator", "integrator"),
    Attribute("integration_method", "what the integrator does"),
    Attribute("residual_evaluations", "residual evaluations"),
    Attribute("jacobians", "Jacobians"),
    Attribute("relaxation_iterations", "relaxation iterations"),
    Attribute("unconverged_revolutions", "revolutions whose inflow-circulation loop did not converge"),
    Attribute("segment_evaluations", "wake segment evaluations"),
    Attribute("segment_evaluations_trim", "wake segment evaluations: trim"),
    Attribute("segment_evaluations_convergence", "wake segment evaluations: convergence phase"),
    Attribute("relaxation_iterations_trim", "relaxation iterations: trim"),
    Attribute("sas_saturated", "seconds that an authority held controllers, by stick [s]"),
    Attribute("actuator_rate_limited", "seconds that their rate held the servos, by blade pitch [s]"),
    Attribute("actuator_at_stop", "seconds that servos were at a stop, by blade pitch [s]"),
    Attribute("warnings", "warnings, one a line"),
)
