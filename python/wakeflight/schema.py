"""The one schema of every result: names, dimensions, units and meaning of what a run and a trim leave."""

from __future__ import annotations

from dataclasses import dataclass


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


def _rows(dims: tuple[str, ...], *rows: tuple[str, str, str], optional: bool = False) -> list[Variable]:
    """Variables that share their dimensions, from rows of (name, units, long_name)."""
    return [Variable(name, dims, units, long_name, optional) for name, units, long_name in rows]


TIME = ("time",)
BLADE = ("time", "blade")
STATION = ("time", "blade", "station")
DISK = ("azimuth", "station")

WATCHED = (
    ("inflow_max", "1", "largest induced inflow v_i/(Omega R) at any station, without its sign"),
    ("inflow_bound", "1", "largest induced inflow that momentum and vortices of the largest lift can give"),
    ("mach_max", "1", "largest section Mach number of all blades"),
    ("mach_bound", "1", "largest section Mach number that the blades' motion and the wind can give"),
    ("alpha_min", "rad", "smallest section angle of attack of all blades"),
    ("alpha_max", "rad", "largest section angle of attack of all blades"),
    ("stalled_share", "1", "share of the disk beyond the stall angle, over a passage of the blades"),
    ("reversed_share", "1", "share of the disk in reversed flow, over a passage of the blades"),
    ("mu_z", "1", "speed of the hub down the shaft over tip speed, descent positive"),
    ("hover_inflow", "1", "induced inflow of hover at this thrust, sqrt(|C_T|/2)"),
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
        Variable("xyz", ("xyz",), "1", "component"),
        Variable("azimuth", ("azimuth",), "rad", "azimuth, 0 over the tail, in the direction of rotation"),
        Variable("psi", ("psi",), "rad", "azimuth of a disk map in a run, where `azimuth` is that of the blades"),
        Variable("revolution", ("revolution",), "1", "number of the marched revolution"),
        Variable("harmonic", ("harmonic",), "1", "mean, then cosine and sine of each harmonic"),
    )
}

RUN: tuple[Variable, ...] = (
    *_rows(
        TIME,
        ("u", "m/s", "body velocity, forward"),
        ("v", "m/s", "body velocity, right"),
        ("w", "m/s", "body velocity, down"),
        ("p", "rad/s", "roll rate, right side down positive"),
        ("q", "rad/s", "pitch rate, nose up positive"),
        ("r", "rad/s", "yaw rate, nose right positive"),
        ("roll", "rad", "roll attitude (3-2-1), right side down positive"),
        ("pitch", "rad", "pitch attitude (3-2-1), nose up positive"),
        ("yaw", "rad", "heading (3-2-1), clockwise from north seen from above"),
        ("north", "m", "position, north of the start"),
        ("east", "m", "position, east of the start"),
        ("down", "m", "position, below the start"),
        ("collective", "in", "collective stick from its stop, up positive"),
        ("longitudinal", "in", "longitudinal stick from its stop, as in the aircraft file"),
        ("lateral", "in", "lateral stick from its stop, right positive"),
        ("pedal", "in", "pedal from its stop, as in the aircraft file"),
        ("force_x", "N", "force on the airframe except gravity, body x forward, at the body origin"),
        ("force_y", "N", "force on the airframe except gravity, body y right, at the body origin"),
        ("force_z", "N", "force on the airframe except gravity, body z down, at the body origin"),
        ("moment_x", "N m", "moment on the airframe except gravity, roll right, at the body origin"),
        ("moment_y", "N m", "moment on the airframe except gravity, pitch nose up, at the body origin"),
        ("moment_z", "N m", "moment on the airframe except gravity, yaw nose right, at the body origin"),
        ("beta_1c", "rad", "cosine of the first flap mode, multiblade transform; > 0 is disk forward-down"),
        ("beta_1s", "rad", "sine of the first flap mode, multiblade transform; > 0 is advancing side up"),
    ),
    Variable("hub_force", ("time", "xyz"), "N", "main rotor's force on the hub, hub axes (x aft, y right, z up)"),
    Variable("hub_moment", ("time", "xyz"), "N m", "main rotor's moment at the hub centre, hub axes"),
    Variable(
        "modal",
        ("time", "blade", "mode"),
        "rad",
        "modal coordinate as an angle: its largest tip deflection over R - e, or its tip twist",
    ),
    Variable("azimuth", BLADE, "rad", "blade azimuth, 0 over the tail, in the direction of rotation"),
    *_rows(
        STATION,
        ("inflow", "1", "induced inflow v_i/(Omega R) along -z_h, positive down through the disk"),
        ("circulation", "m2/s", "bound circulation, positive with upward lift"),
        ("cl", "1", "section lift coefficient"),
        ("cl_m2", "1", "section lift coefficient times Mach number squared"),
        ("alpha", "rad", "section angle of attack"),
        ("mach", "1", "section Mach number"),
    ),
    Variable("wake", ("snapshot", "blade", "age", "xyz"), "m", "tip vortex position, hub axes", optional=True),
    Variable("snapshot_revolution", ("snapshot",), "1", "revolutions flown at the snapshot", optional=True),
    Variable(
        "wake_circulation",
        ("snapshot", "blade", "age"),
        "m2/s",
        "tip vortex circulation at its nodes",
        optional=True,
    ),
    Variable("wake_core", ("snapshot", "blade", "age"), "m", "tip vortex core radius at its nodes", optional=True),
    *_rows(
        BLADE,
        ("flap", "rad", "flap angle of the rigid blade with the same tip, up positive"),
        ("lead", "rad", "lead angle of the rigid blade with the same tip, in the direction of rotation positive"),
        optional=True,
    ),
    Variable(
        "wake_sheet",
        ("snapshot", "blade", "trailer", "age", "xyz"),
        "m",
        "position of every trailer of a full-span wake, hub axes; left out of runs where it has over five million numbers",
        optional=True,
    ),
    Variable(
        "wake_sheet_circulation",
        ("snapshot", "blade", "trailer", "age"),
        "m2/s",
        "circulation of the trailers of a full-span wake at their nodes, kept with `wake_sheet`",
        optional=True,
    ),
    *_rows(
        TIME,
        ("beta_0", "rad", "coning beyond precone: mean of the first flap mode over the blades"),
        ("power", "W", "engine power: main rotor, tail rotor and accessories"),
        ("ct", "1", "aerodynamic thrust coefficient of the main rotor along z_h"),
        ("inflow_mean", "1", "disk mean of the induced inflow v_i/(Omega R), positive down"),
        ("stabilator", "rad", "stabilator incidence, nose up positive"),
        ("odd_even", "1", "odd-even content of the wake in time: RMS second difference of its nodes, share of R"),
        ("max_displacement", "m", "largest displacement of a wake node in the step"),
        ("stick_margin", "in", "smallest distance of a stick from its stops, negative beyond one"),
        ("height", "m", "height of the body origin above sea level, or above its start where that is lower"),
        *WATCHED,
        ("energy", "J", "kinetic and potential energy of the airframe without blades, height from the start"),
        ("energy_balance", "J", "change of that energy less the work of all loads on the airframe but gravity"),
        ("vortex_blade_distance", "1", "smallest distance of a tip vortex from a blade, in core radii"),
        optional=True,
    ),
    *_rows(
        ("psi", "station"),
        (
            "inflow_trim",
            "1",
            "induced inflow of the trim the flight starts from, v_i/(Omega R), positive down",
        ),
        (
            "inflow_before",
            "1",
            "time-marching inflow before the convergence phase, v_i/(Omega R), positive down",
        ),
        ("inflow_start", "1", "inflow at the start of the flight, converged, v_i/(Omega R), positive down"),
        optional=True,
    ),
)

TRIM: tuple[Variable, ...] = (
    *_rows(
        (),
        ("collective", "in", "collective stick from its stop, up positive"),
        ("longitudinal", "in", "longitudinal stick from its stop, as in the aircraft file"),
        ("lateral", "in", "lateral stick from its stop, right positive"),
        ("pedal", "in", "pedal from its stop, as in the aircraft file"),
        ("pitch", "rad", "pitch attitude, nose up positive"),
        ("roll", "rad", "roll attitude, right side down positive"),
        ("theta_0", "rad", "collective blade pitch at the root"),
        ("theta_1c", "rad", "cosine of the blade pitch at the root"),
        ("theta_1s", "rad", "sine of the blade pitch at the root"),
        ("ct", "1", "aerodynamic thrust coefficient along z_h"),
        ("ct_sigma", "1", "blade loading: thrust coefficient over solidity"),
        ("mu", "1", "advance ratio"),
        ("power", "W", "engine power: main rotor, tail rotor and accessories"),
    ),
    Variable("inflow", DISK, "1", "induced inflow v_i/(Omega R) along -z_h, positive down through the disk"),
    Variable("modal", ("azimuth", "mode"), "rad", "periodic modal coordinate as an angle at the tip"),
    Variable("residual_linear", ("xyz",), "m/s2", "linear acceleration left over, body axes"),
    Variable("residual_angular", ("xyz",), "rad/s2", "angular acceleration left over, body axes"),
    Variable("residual_blade", (), "rad", "largest blade harmonic left over, equivalent tip angle"),
    *_rows(
        (),
        ("residual_inflow", "1", "remaining change of the inflow, RMS in Omega R"),
        ("theta_tail", "rad", "tail rotor collective pitch"),
        ("beta_0", "rad", "coning of the first flap mode, beyond precone"),
        ("beta_1c", "rad", "cosine of the first flap mode; > 0 is disk forward-down"),
        ("beta_1s", "rad", "sine of the first flap mode; > 0 is advancing side up"),
        ("power_main", "W", "main rotor power"),
        ("power_tail", "W", "tail rotor power"),
        ("stabilator", "rad", "stabilator incidence, nose up positive"),
        ("inflow_mean", "1", "disk mean of the induced inflow v_i/(Omega R), positive down"),
        ("stick_margin", "in", "smallest distance of a stick from its stops, negative beyond one"),
        ("sideslip", "rad", "sideslip of the body velocity, atan2(v, u), wind from the right positive"),
        ("vortex_blade_distance", "1", "smallest distance of a tip vortex from a blade, in core radii"),
        *WATCHED,
        optional=True,
    ),
    *_rows(("xyz",), ("velocity_b", "m/s", "body velocity"), ("rates_b", "rad/s", "body rates"), optional=True),
    Variable(
        "modal_harmonics",
        ("mode", "harmonic"),
        "rad",
        "harmonics of the modal coordinates as angles at the tip",
        optional=True,
    ),
    *_rows(
        DISK,
        ("circulation", "m2/s", "bound circulation, positive with upward lift"),
        ("cl", "1", "section lift coefficient"),
        ("cl_m2", "1", "section lift coefficient times Mach number squared"),
        ("alpha", "rad", "section angle of attack"),
        ("mach", "1", "section Mach number"),
        optional=True,
    ),
)

REVOLUTION = ("revolution",)
TUNNEL: tuple[Variable, ...] = (
    *_rows(
        (),
        ("ct", "1", "thrust coefficient, aerodynamic thrust along the shaft over rho pi R^2 (Omega R)^2"),
        ("cq", "1", "torque coefficient, aerodynamic torque about the shaft over rho pi R^3 (Omega R)^2"),
        ("cp", "1", "power coefficient, equal to cq"),
        ("ct_sigma", "1", "blade loading, thrust coefficient over solidity"),
        ("figure_of_merit", "1", "ideal over actual power of hover, ct^1.5/(sqrt(2) cp); 0 for negative thrust"),
        ("mu", "1", "advance ratio, in-plane speed of the hub over tip speed"),
        ("mu_z", "1", "speed of the hub down the shaft over tip speed, descent positive"),
        ("thrust", "N", "aerodynamic thrust along the shaft"),
        ("torque", "N m", "aerodynamic torque about the shaft that the drive must supply"),
        ("power", "W", "shaft power"),
        ("h_force", "N", "aerodynamic force in the disk plane, aft positive"),
        ("side_force", "N", "aerodynamic force in the disk plane, right positive"),
        ("beta_0", "rad", "coning of the first flap mode, precone not included"),
        ("beta_1c", "rad", "cosine of the first flap mode; > 0 is disk forward-down"),
        ("beta_1s", "rad", "sine of the first flap mode; > 0 is advancing side up"),
        ("theta_0", "rad", "collective pitch at the root"),
        ("theta_1c", "rad", "lateral cyclic, cosine of the blade pitch"),
        ("theta_1s", "rad", "longitudinal cyclic, sine of the blade pitch"),
        ("theta_75", "rad", "collective pitch at three quarters of the radius, twist included"),
        ("inflow_mean", "1", "area mean of the induced inflow v_i/(Omega R), positive down"),
        ("inflow_1c", "1", "cosine of the induced inflow, fit of r cos psi over the stations"),
        ("inflow_1s", "1", "sine of the induced inflow, fit of r sin psi over the stations"),
        ("ct_std", "1", "standard deviation of the revolutions' ct over those averaged"),
        ("cq_std", "1", "standard deviation of the revolutions' cq over those averaged"),
    ),
    *_rows(
        ("xyz",),
        ("hub_force", "N", "mean force of the rotor on the hub, blades' inertia and weight included, hub axes"),
        ("hub_moment", "N m", "mean moment of the rotor on the hub centre, hub axes"),
        ("aero_force", "N", "mean force of the air on the blades, hub axes"),
        ("aero_moment", "N m", "mean moment of the air on the blades about the hub centre, hub axes"),
        ("velocity", "m/s", "velocity of the hub through the air, hub axes"),
    ),
    *_rows(
        DISK,
        ("inflow", "1", "induced inflow v_i/(Omega R), positive down, near wake included"),
        ("circulation", "m2/s", "bound circulation, positive with upward lift"),
        ("cl", "1", "section lift coefficient"),
        ("cd", "1", "section drag coefficient"),
        ("cm", "1", "section moment coefficient about the quarter chord, nose up positive"),
        ("cn", "1", "section normal-force coefficient, cl cos alpha + cd sin alpha"),
        ("cl_m2", "1", "section lift coefficient times Mach number squared"),
        ("cn_m2", "1", "section normal-force coefficient times Mach number squared"),
        ("cm_m2", "1", "section moment coefficient times Mach number squared"),
        ("alpha", "rad", "section angle of attack"),
        ("mach", "1", "section Mach number"),
        ("cl_std", "1", "standard deviation of cl over the passages averaged"),
        ("inflow_std", "1", "standard deviation of the inflow over the passages averaged"),
    ),
    *_rows(
        ("station",),
        ("radial_cl", "1", "mean of cl over the revolution"),
        ("radial_circulation", "m2/s", "mean of the bound circulation over the revolution"),
        ("radial_inflow", "1", "mean of the induced inflow over the revolution"),
        ("radial_alpha", "rad", "mean of the angle of attack over the revolution"),
        ("chord", "m", "chord"),
        ("width", "m", "width of the blade element"),
    ),
    *_rows(
        ("azimuth",),
        ("theta", "rad", "pitch of the blade at its root, higher harmonics included"),
        ("flap", "rad", "equivalent rigid flap angle, precone included, up positive"),
        ("lead", "rad", "equivalent rigid lead angle, forward positive"),
        ("tip_flap", "m", "flap displacement of the tip from the preconed undeflected blade, up positive"),
        ("tip_lead", "m", "lead displacement of the tip, forward positive"),
        ("tip_twist", "rad", "elastic twist and pitch-flap coupling at the tip, nose up positive"),
    ),
    *_rows(
        (),
        ("vortex_blade_distance", "1", "smallest distance of a tip vortex from a blade, in core radii"),
        ("max_displacement", "m", "largest displacement of a wake node in a step of the revolutions averaged"),
        *(each for each in WATCHED if each[0] != "mu_z"),
        optional=True,
    ),
    *_rows(
        REVOLUTION,
        ("ct_history", "1", "thrust coefficient, mean of each marched revolution"),
        ("cq_history", "1", "torque coefficient, mean of each marched revolution"),
        ("theta_0_history", "rad", "collective pitch of each marched revolution"),
        optional=True,
    ),
    *_rows(
        ("age",),
        ("tip_vortex_radius", "1", "distance of the tip vortex from the shaft over R, mean over azimuth"),
        ("tip_vortex_height", "1", "height of the tip vortex above its release over R, mean over azimuth"),
        ("tip_vortex_circulation", "m2/s", "circulation of the tip vortex, mean over azimuth"),
        optional=True,
    ),
    Variable("modal", ("azimuth", "mode"), "rad", "modal coordinates as angles at the tip", optional=True),
    Variable("wake", ("blade", "age", "xyz"), "m", "tip vortices at the end, hub axes", optional=True),
    Variable(
        "wake_path",
        ("azimuth", "age", "xyz"),
        "m",
        "tip vortex of the blade at each azimuth, mean over the passages averaged, hub axes",
        optional=True,
    ),
    Variable(
        "wake_path_std",
        ("azimuth", "age"),
        "m",
        "root of the mean squared distance of the tip vortex from its mean path over the passages averaged",
        optional=True,
    ),
)

TRANSIENT: tuple[Variable, ...] = (
    *_rows(
        TIME,
        ("theta_0", "rad", "collective pitch at the root"),
        ("ct", "1", "thrust coefficient of the instant, aerodynamic thrust over rho pi R^2 (Omega R)^2"),
        ("cq", "1", "torque coefficient of the instant, aerodynamic torque over rho pi R^3 (Omega R)^2"),
        ("thrust", "N", "aerodynamic thrust along the shaft"),
        ("torque", "N m", "aerodynamic torque about the shaft that the drive must supply"),
        ("beta_0", "rad", "mean of the blades' flap angles, precone included"),
        ("inflow_mean", "1", "area mean of the induced inflow v_i/(Omega R) at the blades, positive down"),
    ),
    *_rows(
        BLADE,
        ("azimuth", "rad", "azimuth of the blade, 0 over the tail"),
        ("flap", "rad", "equivalent rigid flap angle, precone included, up positive"),
        ("lead", "rad", "equivalent rigid lead angle, forward positive"),
    ),
    *_rows(
        STATION,
        ("inflow", "1", "induced inflow v_i/(Omega R), positive down, near wake included"),
        ("circulation", "m2/s", "bound circulation, positive with upward lift"),
        ("cl", "1", "section lift coefficient"),
        ("alpha", "rad", "section angle of attack"),
    ),
    *_rows(
        ("time", "xyz"),
        ("hub_force", "N", "force of the rotor on the hub, blades' inertia and weight included, hub axes"),
        ("hub_moment", "N m", "moment of the rotor on the hub centre, hub axes"),
    ),
    Variable("wake", ("time", "blade", "age", "xyz"), "m", "tip vortices, hub axes", optional=True),
    *_rows(
        ("time", "blade", "age"),
        ("tip_circulation", "m2/s", "circulation of the nodes of the tip vortices"),
        optional=True,
    ),
)

ATTRIBUTES: tuple[Attribute, ...] = (
    Attribute("aircraft", "aircraft", required=True),
    Attribute("inflow_model", "inflow model", required=True),
    Attribute("radius", "rotor radius [m]", required=True),
    Attribute("omega", "rotor speed [rad/s]", required=True),
    Attribute("configuration", "the whole configuration, as JSON", required=True),
    Attribute("maneuver", "manoeuvre"),
    Attribute("maneuver_adapted", "adapted to this aircraft"),
    Attribute("condition", "flight condition"),
    Attribute("program_version", "program version"),
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
    Attribute("warnings", "warnings, one a line"),
)
