# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim with dynamic inflow wherever there is one: several starts, each followed to the condition asked for.

The closed-form start comes first, and what Newton's method finds from it is the trim, also where there are others. Where it finds
none, trims are followed from a condition that is easier in one respect: nose on the wind, straight, from hover, level, light.
Where such a path ends before its goal, the last trim on it tells what limits. All is deterministic; a budget of
linearisations bounds the work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from .. import _core
from ..condition import CompleteCondition, smooth_step
from ..errors import NumericalFailure, known
from ..model import PITCH, ROLL, YAW, Model
from ..units import STANDARD_GRAVITY, convert
from .equations import INCH, scales, trim_problem, unmet
from .limits import limiting, over_the_disk
from .newton import Attempt, Work, newton
from .on_wake import BUDGET, FOLLOWED, LEAST_ADVANCE
from .start import first_guess

LARGEST_CHANGE = 15.0
"""Largest change of a stick or of roll and pitch from where the last trims on a path point: 1.5 in, 15 deg."""
LIGHT = 0.05
"""Blade loading C_T/sigma of the light aircraft from which weight is followed."""


@dataclass(frozen=True)
class Path:
    """Models from an easy one (0) to that asked for (1); `told` says where the trim `x` on it stands."""

    at: Callable[[float], Model]
    told: Callable[[Model, np.ndarray], str]
    start: np.ndarray | None = None
    """Trim of the easy one, where it is known."""


@dataclass(frozen=True)
class Reached:
    """How far a path was followed: share of it, and the last trim on it."""

    share: float
    model: Model
    problem: _core.TrimProblem
    x: np.ndarray
    told: str


def solve_condition(model: Model, work: Work | None = None) -> tuple[_core.TrimProblem, np.ndarray]:
    """Trim of the model's condition with dynamic inflow: its equations and unknowns."""
    work = work or Work(BUDGET)
    if model.target is not None:
        return to_target(model, work)
    problem = trim_problem(model, None)
    attempt = newton(model, problem, first_guess(model, problem), work)
    if attempt.met:
        return problem, attempt.x
    ended: list[Reached] = []
    for path in paths(model, work):
        reached = follow(model, path, work)
        if reached is None:
            continue
        if reached.share == 1.0:
            return problem, reached.x
        ended.append(reached)
    last = newton(model, problem, mid_sticks(model, problem), work)
    if last.met:
        return problem, last.x
    raise NumericalFailure(why_none(model, problem, attempt, ended))


def to_target(model: Model, work: Work) -> tuple[_core.TrimProblem, np.ndarray]:
    """Trim to a power or a collective with a part of the path left free, from the trim of the condition as it stands.

    There the power is another; what it is more turns into climb, what it is less into descent: the start of the trim asked for.
    """
    target = known(model.target)
    given = replace(model, target=None)
    start_problem, x = solve_condition(given, work)
    problem = trim_problem(model, None)
    first = given.core.trim_layout(start_problem).path
    x = np.insert(x, first, model.question.path[("speed", "flight_path").index(target.free)])
    has = value_of(model, problem, x)
    start = x.copy()
    if target.name == "power" and target.free == "flight_path":
        c = model.condition
        climb = (target.value - has) / (c.gross_mass * STANDARD_GRAVITY * max(c.speed, 1.0))
        start[first] = np.arcsin(np.clip(np.sin(c.flight_path) + climb, -0.5, 0.5))
    attempt = newton(model, problem, start, work)
    if attempt.met:
        return problem, attempt.x
    path = Path(
        lambda s: replace(model, target=target.at(has + s * (target.value - has))),
        lambda now, x: (
            f"{target.name} ends at {target.shown(known(now.target).value)} of {target.shown(target.value)} "
            f"{told_path(now, problem, x)}"
        ),
        x,
    )
    reached = follow(model, path, work)
    if reached is not None and reached.share == 1.0:
        return problem, reached.x
    raise NumericalFailure(why_none(model, problem, attempt, [reached] if reached else []))


def value_of(model: Model, problem: _core.TrimProblem, x: np.ndarray) -> float:
    """Power [W] or collective [rad] at the unknowns `x`."""
    if known(model.target).name == "collective":
        return float(model.pitch_controls(x[:4])[2])
    return over_the_disk(model, problem, x, None)["power"]


def paths(model: Model, work: Work) -> Iterator[Path]:
    """Paths to the condition, the one that tells most where it ends first."""
    c = model.condition

    def to(**values: float) -> Model:
        return conditioned(model, c.changed(**values))

    if c.bank_share > 0.0:
        yield to_bank(model, work)
    if c.turn_rate != 0.0:
        yield Path(
            lambda s: to(turn_rate=s * c.turn_rate, bank=np.arctan(s * np.tan(c.bank or 0.0)), **slower_turn(c, s)),
            lambda now, x: f"turns end at {told_turn(now, x)} of {np.degrees(abs(c.turn_rate)):.1f} deg/s",
        )
    slope = abs(c.flight_path)
    if c.speed > 0.0:
        speeds = Path(
            lambda s: to(speed=s * c.speed, bank_share=c.bank_share * smooth_step(2.0 * s - 1.0), **slower_turn(c, s)),
            lambda now, x: f"speeds end at {told_speed(now.condition.speed)} of {told_speed(c.speed)}",
        )
        slopes = Path(
            lambda s: to(flight_path=s * c.flight_path),
            lambda now, x: (
                f"paths end at {np.degrees(now.condition.flight_path):.1f} of {np.degrees(c.flight_path):.1f} deg"
            ),
        )
        # a steep path is followed from hover, a shallow one from level flight
        steep = slope > np.radians(30.0)
        yield from (speeds, slopes) if steep else (slopes, speeds) if slope > np.radians(3.0) else (speeds,)
    light = c.gross_mass * LIGHT / blade_loading(model)
    if light < c.gross_mass:
        yield Path(
            lambda s: to(gross_mass=light + s * (c.gross_mass - light)),
            lambda now, x: f"weights end at {told_mass(now.condition.gross_mass)} of {told_mass(c.gross_mass)} lb",
        )


def slower_turn(condition: CompleteCondition, share: float) -> dict[str, float]:
    """The load factor of a turn at a share of its lateral acceleration, where it is given."""
    if condition.load_factor is None:
        return {}
    return {"load_factor": float(np.hypot(1.0, share * np.sqrt(condition.load_factor**2 - 1.0)))}


def to_bank(model: Model, work: Work) -> Path:
    """From the trim with the nose on the wind, whose bank is found, to the bank asked for."""
    c = model.condition
    aligned = replace(model, condition=c.changed(bank_share=0.0, sideslip=0.0, bank=0.0))
    _, x = solve_condition(aligned, work)
    found, asked = float(x[ROLL]), c.bank or 0.0
    if c.bank_share < 1.0:
        return Path(
            lambda s: conditioned(model, c.changed(bank_share=s * c.bank_share)),
            lambda now, x: (
                f"the share of the bank in the convention ends at {now.condition.bank_share:.2f} of {c.bank_share:.2f}"
            ),
        )
    return Path(
        lambda s: conditioned(model, c.changed(bank=found + s * (asked - found))),
        lambda now, x: (
            f"with the heading free sideslip holds no bank beyond {np.degrees(x[ROLL]):.1f} of {np.degrees(asked):.1f} deg "
            f"(heading against track {np.degrees(x[YAW]):.0f} deg there; nose on the wind it is {np.degrees(found):.1f} deg)"
        ),
    )


def follow(model: Model, path: Path, work: Work) -> Reached | None:
    """Trims along a path, from 0 as far as they go; None where it does not begin."""
    here, problem = at(model, path, 0.0)
    start = first_guess(here, problem) if path.start is None else path.start
    attempt = newton(here, problem, start, work)
    if not attempt.met:
        return None
    reached = Reached(0.0, here, problem, attempt.x, path.told(here, attempt.x))
    before: Reached | None = None
    advance = 0.25
    while reached.share < 1.0 and advance >= LEAST_ADVANCE and work.left > 0:
        share = min(1.0, reached.share + advance)
        here, problem = at(model, path, share)
        start = reached.x
        if before is not None:
            # along the secant of the last two
            start = start + (share - reached.share) / (reached.share - before.share) * (start - before.x)
        attempt = newton(here, problem, start, work, FOLLOWED)
        if attempt.met and not jumped(here, problem, start, attempt.x):
            before = reached
            reached = Reached(share, here, problem, attempt.x, path.told(here, attempt.x))
            advance *= 1.5 if attempt.steps <= FOLLOWED // 2 else 1.0
        else:
            advance *= 0.5
    return reached


def jumped(model: Model, problem: _core.TrimProblem, expected: np.ndarray, found: np.ndarray) -> bool:
    """Whether a trim on a path is another than the one followed: beyond stall a second one exists, at far more collective."""
    change = np.abs(model.normalised(found) - expected)[:YAW] / scales(model, problem)[:YAW]
    return float(np.max(change)) > LARGEST_CHANGE


def at(model: Model, path: Path, share: float) -> tuple[Model, _core.TrimProblem]:
    """Model and equations of a point of a path; at its end those of the condition itself."""
    here = model if share == 1.0 else path.at(share)
    return here, trim_problem(here, None)


def conditioned(model: Model, condition: CompleteCondition) -> Model:
    """The model in another condition, compiled anew where its mass is another."""
    if condition.gross_mass == model.condition.gross_mass:
        return replace(model, condition=condition)
    return Model.build(model.aircraft, condition, model.inflow, model.target, model.n_harmonics)


def mid_sticks(model: Model, problem: _core.TrimProblem) -> np.ndarray:
    """The closed-form start with sticks at mid travel and the aircraft level."""
    x = first_guess(model, problem)
    x[:4] = 0.5 * INCH * np.asarray(model.aircraft.stick_travel_in)
    x[ROLL] = x[PITCH] = 0.0
    return x


def why_none(model: Model, problem: _core.TrimProblem, attempt: Attempt, ended: list[Reached]) -> str:
    """What limits, where the paths to the condition ended, and the equation that is not met."""
    stopped = f"[{unmet(model, problem, attempt.x)}]"
    if not ended:
        limits = "; ".join(limiting(model, problem, attempt.x)) or "no stick, stall or inflow limit is near"
        return f"no trim found: {limits}, where the iteration stopped {stopped}"
    told = [(limiting(each.model, each.problem, each.x), each.told) for each in ended]
    # the first path that ended at a limit, else the first
    said, where = next((each for each in told if each[0]), told[0])
    if not said:
        return f"no trim found: {where}, without a stick, stall or inflow limit in the last trim {stopped}"
    return f"no trim found: {'; '.join(said)}, where {where} {stopped}"


def blade_loading(model: Model) -> float:
    """C_T/sigma that carries the weight in straight flight."""
    force = model.density * np.pi * model.rotor["radius"] ** 2 * model.tip_speed**2
    return float(model.condition.gross_mass * STANDARD_GRAVITY / force / model.aircraft.solidity)


def told_turn(now: Model, x: np.ndarray) -> str:
    """Rate, bank and load factor of a turn."""
    c = now.condition
    load = np.hypot(1.0, c.turn_rate * c.speed * np.cos(c.flight_path) / STANDARD_GRAVITY)
    return f"{np.degrees(x[ROLL]):.0f} deg of bank, load factor {load:.2f}, {np.degrees(abs(c.turn_rate)):.1f}"


def told_path(now: Model, problem: _core.TrimProblem, x: np.ndarray) -> str:
    """Speed and slope of a path that was found."""
    speed, flight_path, _ = now.core.trim_path(problem, x)
    return f"with {told_speed(speed)} on a path of {np.degrees(flight_path):.1f} deg"


def told_speed(speed: float) -> str:
    """A speed as the condition is given: knots, slow ones in m/s."""
    return f"{convert(speed, 'm/s', 'kt'):.0f} kt" if speed > 10.0 else f"{speed:.1f} m/s"


def told_mass(mass: float) -> str:
    """A mass in pounds."""
    return f"{convert(mass, 'kg', 'lb'):.0f}"
