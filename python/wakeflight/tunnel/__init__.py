# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tunnel: the verb that puts an isolated rotor on a stand, in hover, climb, descent or a wind from the front."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..arguments import checked
from ..errors import InputError, NumericalFailure
from ..inflow import DynamicInflow
from ..progress import Reported, heard, reporting
from ..trim.equations import trim_problem
from ..units import whole
from .annular import check_axial, on_annuli
from .condition import (
    StandCondition,
    air,
    control_equations,
    filled,
    higher_harmonics,
    hub_velocity,
    rotor_speed,
    within,
)
from .model import StandInflow, StandModel, stand_inflow
from .results import Tunnel
from .solve import first_guess, solution, with_dynamic_inflow

if TYPE_CHECKING:
    from ..aircraft import Aircraft, Rotor

BLADE_MODELS = ("lifting-line", "second-order", "weissinger")
"""Models of the blade's lift, the default first."""

__all__ = ["Tunnel", "check", "stand_inflow", "tunnel"]


@reporting
@checked
def tunnel(
    aircraft: str | Path | Aircraft | Rotor = "uh60a",
    collective: Any = None,
    speed: Any = "0 kt",
    shaft_angle: Any = "0 deg",
    inflow: str | StandInflow = "time-marching",
    *,
    climb: Any = "0 m/s",
    roll_rate: Any = "0 deg/s",
    pitch_rate: Any = "0 deg/s",
    collective_at: Any = "root",
    lateral_cyclic: Any = None,
    longitudinal_cyclic: Any = None,
    higher_harmonics: Sequence[Any] | Mapping[str, Any] = (),
    thrust: Any = None,
    ct: float | None = None,
    torque: Any = None,
    power: Any = None,
    flapping: Any = None,
    hub_roll: Any = None,
    hub_pitch: Any = None,
    omega: Any = None,
    rpm: float | None = None,
    altitude: Any = "0 m",
    density: Any = None,
    speed_of_sound: Any = None,
    blades: str | None = None,
    blade_model: str = "lifting-line",
    prandtl_glauert: bool = True,
    n_harmonics: int = 8,
    revolutions: int | None = None,
    averaged: int | None = None,
    progress: Reported = None,
) -> Tunnel:
    """Isolated rotor on a stand: thrust, torque, flapping, section loads, inflow, tip-vortex path.

    Angles, speeds, forces are text with units or pint quantities.

    Parameters
    ----------
    aircraft : the rotor: a loaded `Rotor` or `Aircraft`, the name of a shipped aircraft, or the path of a rotor file or an
        aircraft file. It turns counter-clockwise seen from above.
    collective : blade pitch at `collective_at`. Where neither collective, thrust, ct, torque nor power is given, thrust is the
        weight that the aircraft (or the rotor file's `[condition]`) names, else C_T/sigma = 0.07; and where cyclic pitch,
        flapping and hub moments are open too and there is a wind across the shaft, flapping is zero (hub moments, where
        clamped rigid blades cannot flap). What was assumed is in `.assumed`, the table and the attributes.
    speed, shaft_angle : wind from the front, and tilt of the shaft, positive aft (disk met from below, as in descent);
        +90 deg is axial descent, -90 deg axial climb.
    inflow : `time-marching`, `relaxation`, `dynamic`, `annular` (hover and axial climb: blade elements and momentum ring by
        ring, a baseline), or a configured model. What a model leaves to the regime (hover and climb, axial descent, forward
        flight) takes its numbers (`wakeflight.regime`); what is given stays.
    climb : speed of the hub up the shaft, on top of the wind; negative is descent.
    roll_rate, pitch_rate : steady rates of the stand, right side down and nose up positive.
    collective_at : `root` (the twist of the file is added to the collective) or a radius such as "0.75 R" (the
        collective is the pitch there).
    lateral_cyclic, longitudinal_cyclic : theta_1c, theta_1s of theta = theta_0 + theta_1c cos psi + theta_1s sin psi, pitch
        of the blade at its own azimuth (a swashplate phase does not enter); 0 where a collective, thrust, ct or torque is
        given and nothing is asked of flapping or hub moments.
    higher_harmonics : list of (order, cosine, sine) or {"order", "amplitude", "phase"}: amplitude cos(order psi - phase).
    thrust, ct, torque, power : find the collective for aerodynamic thrust along the shaft, its coefficient, shaft torque
        (torque="zero": autorotation at the given rotor speed), or shaft power.
    flapping : find both cyclics for `zero` first-harmonic flapping (first flap mode), or a pair (beta_1c, beta_1s).
    hub_roll, hub_pitch : find both cyclics for mean hub moments, right side down and nose up positive.
    omega, rpm : rotor speed, as text with a unit or as a number of revolutions per minute; the rotor's own.
    altitude, density, speed_of_sound : standard atmosphere, and what a tunnel states instead.
    blades : `rigid` takes flexibility away: blades move about their hinges alone, or not at all where clamped.
    blade_model : `lifting-line`: section tables at the angle of attack of the quarter chord; `second-order`: the same
        tables at the angle of three quarters of the chord, where the finite length of the bound line is felt; `weissinger`:
        flow tangency there, thin sections (2 pi), `prandtl_glauert` factor, drag and moment from the tables at the angle of
        the same lift, no stall. The last two matter for stubby blades, need a free wake and have no meaning in reverse flow.
    n_harmonics : harmonics of the blade motion.
    revolutions, averaged : revolutions of the marching wake and, of them, the last ones in the means; defaults
        12 and 4 forward, 24 and 12 in hover, 40 and 20 in axial descent. Ends early where the wake is periodic.

    Returns
    -------
    Tunnel : `.ct`, `.cq`, `.cp`, `.figure_of_merit`, `.thrust`, `.torque`, `.power`, `.beta_0`, `.beta_1c`, `.beta_1s`,
        `.theta_0`, `.theta_1c`, `.theta_1s`, `.hub_force`, `.hub_moment`, `.aero_force`, `.aero_moment`, `.assumed`,
        `.settled`, `.notes`, `.warnings`, `.monitors`, `.data` (xarray Dataset), `.wake_velocity(points)`, `.table()`,
        `.save(path)`.

    Raises `InputError` for bad input and `NumericalFailure` where no solution is found, or one beyond physics, which is then its
    `partial`. A wake that does not settle is no error: `.settled` is False, `.notes` and the means' scatter say how much it
    moves. What is beyond a limit of the model stands in `.warnings`, and in `.notes`.
    """
    started = time.perf_counter()
    progress = heard(progress)
    given = {
        name: value for name, value in locals().items() if name not in ("progress", "started", "aircraft", "inflow")
    }
    rotor, condition, model = _prepared(aircraft, inflow, given)
    options = _marching_options(revolutions, averaged, model)
    sections = "weissinger-incompressible" if blade_model == "weissinger" and not prandtl_glauert else blade_model
    simple, wake = _compiled(rotor, condition, model, n_harmonics, sections)
    progress.phase("rotor on the stand", None)
    try:
        if wake is not None and wake.inflow.is_annular:
            found = on_annuli(wake, with_dynamic_inflow(simple, progress), progress)
        else:
            found = solution(simple, wake, options, progress)
    except NumericalFailure as reason:
        if reason.partial is None:
            raise
        raise NumericalFailure(str(reason), partial=Tunnel(reason.partial, time.perf_counter() - started)) from reason
    stand = Tunnel(found, time.perf_counter() - started)
    if stand.failures:
        raise NumericalFailure(f"rotor on the stand: {'; '.join(stand.failures)}", partial=stand)
    return stand


def check(aircraft: str | Path | Aircraft | Rotor, inflow: str | StandInflow, **given: Any) -> None:
    """Refuse what `tunnel` would refuse of the same arguments; nothing is started."""
    apart = ("aircraft", "inflow", "progress")
    defaults = {name: each.default for name, each in signature(tunnel).parameters.items() if name not in apart}
    for name in given:
        if name not in defaults:
            raise InputError.of(name, given[name], f"not an argument of tunnel; allowed: {', '.join(defaults)}")
    _prepared(aircraft, inflow, defaults | given)


def _prepared(aircraft: Any, inflow: Any, given: dict[str, Any]) -> tuple[Rotor, StandCondition, StandInflow]:
    """Rotor, condition and inflow model, everything checked; nothing is started."""
    from ..aircraft import load_rotor

    n_harmonics = whole("n_harmonics", given["n_harmonics"], 1, 40)
    rotor = load_rotor(aircraft)
    if given["blades"] not in (None, "rigid", "flexible"):
        raise InputError.of("blades", given["blades"], "allowed: rigid, flexible")
    if given["blades"] == "rigid":
        rotor = rotor.with_rigid_blades()
    elif given["blades"] == "flexible" and not rotor.flexible:
        raise InputError.of("blades", "flexible", f"the blades of {rotor.name} are rigid in its file")
    rotor = rotor.with_speed(rotor_speed(rotor, given["omega"], given["rpm"]))
    density, speed_of_sound = air(given["altitude"], given["density"], given["speed_of_sound"])
    roll, pitch = (within(name, given[name], "rad/s", -10.0, 10.0, "rad/s") for name in ("roll_rate", "pitch_rate"))
    velocity = hub_velocity(given["speed"], given["shaft_angle"], given["climb"])
    asked, assumed = filled(rotor, math.hypot(velocity[0], velocity[1]), density, given)
    condition = StandCondition(
        velocity=velocity,
        # hub axes point aft, right, up: right side down is about -x, nose up about +y
        rates=(-roll, pitch, 0.0),
        density=density,
        speed_of_sound=speed_of_sound,
        controls=control_equations(rotor, density, rotor.omega, asked),
        higher=higher_harmonics(given["higher_harmonics"], n_harmonics),
        as_given={name: value if isinstance(value, int | float) else str(value) for name, value in given.items()},
        assumed=assumed,
    )
    model = stand_inflow(inflow).resolved(condition.regime(rotor.omega * rotor.radius))
    model.step(rotor)
    blade_model = given["blade_model"]
    if blade_model not in BLADE_MODELS:
        raise InputError.choice("blade_model", blade_model, BLADE_MODELS)
    if blade_model != BLADE_MODELS[0] and model.remembers:
        raise InputError.of(
            "unsteady", model.sections["unsteady"], f"must be quasi-steady with blade_model = {blade_model}"
        )
    if not isinstance(given["prandtl_glauert"], bool):
        raise InputError.of("prandtl_glauert", given["prandtl_glauert"], "must be True or False")
    if model.name == "annular":
        check_axial(condition, rotor.omega * rotor.radius)
    if model.name in ("relaxation", "time-marching"):
        model.free_wake.core_options(rotor)
        if blade_model != BLADE_MODELS[0] and model.free_wake.near_wake_angle == 0.0:
            raise InputError.of("near_wake_angle", "0 deg", f"a {blade_model} blade needs a near wake")
    elif blade_model != BLADE_MODELS[0]:
        raise InputError.of("blade_model", blade_model, "needs a free wake: inflow relaxation or time-marching")
    return rotor, condition, model


def _marching_options(revolutions: Any, averaged: Any, model: StandInflow) -> dict[str, int | None]:
    for name, value in (("revolutions", revolutions), ("averaged", averaged)):
        if value is None:
            continue
        whole(name, value, 1, 10000)
        if model.name != "time-marching":
            raise InputError.of(name, value, f"has no meaning with {model.name} inflow")
    if revolutions is not None and averaged is not None and averaged > revolutions:
        raise InputError.of("averaged", averaged, f"must not be more than revolutions = {revolutions}")
    return {"revolutions": revolutions, "averaged": averaged}


def _compiled(
    rotor: Rotor, condition: StandCondition, model: StandInflow, n_harmonics: int, blade_model: str
) -> tuple[StandModel, StandModel | None]:
    """The rotor with dynamic inflow, and with the free wake where that is asked for."""
    dynamic = model if model.is_dynamic else DynamicInflow(n_stations=model.n_stations, azimuth_step=None)
    try:
        simple = StandModel.build(rotor, condition, dynamic, n_harmonics)
        if rotor.flexible and not rotor.fixed_reference_pitch:
            # modes at the pitch the blade will have, where the file does not say
            guess = first_guess(simple, trim_problem(simple, None))[0]
            rotor = rotor.with_reference_pitch(guess)
            simple = StandModel.build(rotor, condition, dynamic, n_harmonics)
        return simple, None if model.is_dynamic else StandModel.build(rotor, condition, model, n_harmonics, blade_model)
    except InputError as reason:
        raise reason.within(rotor.path) from reason
