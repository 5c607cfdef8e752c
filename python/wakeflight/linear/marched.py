# SPDX-License-Identifier: MIT OR Apache-2.0
"""How a marched wake answers small motions about its periodic orbit: at once, and later.

The wake of a flight is marched at the trim's own motion until it repeats itself. From there every cause is given to it, to either
side; half the difference is the answer, without what the orbit still drifts. A cause alone for one step, at every azimuth of a
passage of the blades, gives what is answered at once, blade by blade. A smooth pulse that lasts a revolution and as many
revolutions after it as the wake remembers give what is answered later: the pulse holds no frequency above half the blade passage,
so that one pulse says what pulses at every other azimuth would.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from ..errors import NumericalFailure, known
from ..exchange import Exchange
from ..flight_start import flight_model
from ..model import CompiledRotor
from ..trim import Trim
from .multiblade import columns, transformation
from .names import MOTION, Places
from .quasi_static import CONTROLS, PITCH, SIZES, TILT

SETTLED, NEAR, MOST = 1e-6, 1e-5, 40
"""Change of the inflow over a revolution, over its mean, at which a wake repeats itself (in single precision some remains)
and at which it still may be used; revolutions after which it is given up."""
KNOTS = 4
"""Passages of blades that a pulse lasts, a cubic B-spline."""
BEYOND = 2
"""Revolutions in which a wake may forget beyond its turns."""
FORGOTTEN = 2e-4
"""Answer in a revolution, over the largest, below which nothing more is waited for."""

SHARE = 0.1
"""Changes to either side over those that a relaxation wake is given: kinks of section tables are near."""
HARMONICS = tuple((f"{n}{part}", n, phase) for n in range(1, 6) for part, phase in (("c", 0.0), ("s", -0.5 * np.pi)))
"""Motion that every blade makes in turn, where multiblade coordinates do not hold it still: name, harmonic of its azimuth, phase
[rad]."""


@dataclass(frozen=True)
class Cause:
    """What moves the wake: motion of the hub [m/s, rad/s], a control [rad], a blade mode's coordinate [rad], or a rate [rad/s].

    kind: `hub`, `control`, `blade` or `harmonic`; index: which of them, of blades the mode; column: of `blade` the multiblade
    coordinate, of `harmonic` the place in HARMONICS: all blades move so at their azimuths.
    """

    name: str
    kind: str
    index: int
    column: int = 0
    rate_alone: bool = False

    @property
    def has_rate(self) -> bool:
        """Whether its rate acts by itself."""
        return self.kind != "hub"

    @property
    def of_blades(self) -> bool:
        """Whether it is motion of the blades."""
        return self.kind in ("blade", "harmonic")

    def unit(self, model: CompiledRotor) -> float:
        """A change that counts like those of other causes: of the tip speed, of the rotor speed, or of a radian."""
        return {"u": model.tip_speed, "v": model.tip_speed, "w": model.tip_speed}.get(
            self.name, model.omega if self.kind == "hub" else 1.0
        )

    @property
    def size(self) -> float:
        """Change to either side."""
        return SHARE * SIZES.get(self.name, PITCH if self.kind == "control" else TILT)


@dataclass(frozen=True)
class Answer:
    """What a pulse does, per unit of its cause, at every step since the beginning."""

    inflow: np.ndarray
    """Inflow (steps + 1, n_blades, n_width)."""
    mean: np.ndarray
    """Its mean over the latest passages of all azimuths (steps + 1,)."""
    circulation: np.ndarray
    """Bound circulation (steps + 1, n_blades, n_stations) [m2/s]."""


class Orbit:
    """A marched wake that repeats itself, and what it answers."""

    def __init__(self, start: Trim, where: Places, revolutions: int | None = None):
        """Until it repeats itself, refused where it does not; with `revolutions` for so many at most, whatever comes of it."""
        self.start, self.where = start, where
        self.exchange = _begun(start)
        self.model = self.exchange.model
        self.n, self.n_blades = self.model.steps_per_revolution, where.n_blades
        self.passage = self.n // self.n_blades
        self.omega = self.model.omega
        # share of a step by which a flight that holds the inflow feels it late
        self.late = 0.0 if self.model.inflow.marching.extrapolate else 0.5
        core = self.model.core
        self.y = core.trim_state(start.problem, start.x, 0.0)[0]
        self.motion = core.trim_motion(start.problem, start.x, self.n)
        self.controls = np.linalg.inv(np.asarray(start.model.data["rigging"]["matrix"])[:3, :3])
        self.distance = self._settle(MOST if revolutions is None else revolutions)
        if revolutions is None and self.distance > NEAR:
            raise NumericalFailure(
                f"linearize: wake = states: the marched wake of this trim has no periodic orbit: after {MOST} revolutions its "
                f"inflow still changes by {self.distance:.1e} of its mean from one to the next (allowed {NEAR:.0e}); there is "
                "none in hover and at low speed: wake = identified takes its answers in the mean"
            )
        self.begin = self.exchange.step_index

    def _settle(self, most: int) -> float:
        """Change of the inflow over the last revolution, over its mean."""
        before, distance = None, np.inf
        for _ in range(most):
            now, _ = self.exchange.turn(self.start.problem, self.start.x)
            if before is not None:
                distance = float(np.abs(now - before).max()) / abs(self.model.disk_mean(now))
                if distance < SETTLED:
                    break
            before = now
        return distance

    @cached_property
    def most(self) -> int:
        """Revolutions over which answers are followed at most: twice the turns of the wake and two more."""
        wake = self.model.inflow.free_wake
        return round(2 * (float(wake.turns) + float(wake.far_wake_turns or 0) + BEYOND))

    def rows(self, step: int) -> np.ndarray:
        """Row of every blade `step` steps after the beginning, which is at azimuth zero."""
        found: np.ndarray = (step + np.arange(self.n_blades) * self.passage) % self.n
        return found

    def stepped(self, exchange: Exchange, step: int, cause: Cause | None, value: float, rate: float) -> None:
        """To `step` steps after the beginning, with a cause at this value and rate [per s]."""
        rows = self.rows(step)
        q, q_dot = (each[rows].copy() for each in self.motion)
        y, stick, stick_rate = self.y.copy(), np.array(self.start.x[:4]), np.zeros(4)
        if cause is not None:
            if cause.kind == "hub":
                y[self.where.motion[cause.index]] += value
            elif cause.kind == "control":
                stick[:3] += value * self.controls[:, cause.index]
                stick_rate[:3] += rate * self.controls[:, cause.index]
            else:
                shape, slope = self.shapes(cause, step)
                per = 1.0 / self.where.angle[cause.index]
                q[:, cause.index] += per * value * shape
                q_dot[:, cause.index] += per * (rate * shape + value * self.omega * slope)
        exchange.reach(self.begin + step, y, stick, stick_rate, (q, q_dot))

    def shapes(self, cause: Cause, step: int) -> tuple[np.ndarray, np.ndarray]:
        """Motion (n_blades,) of the blades by a cause of theirs `step` steps after the beginning, and its slope by azimuth."""
        psi = 2 * np.pi * step / self.n
        if cause.kind == "harmonic":
            _, order, phase = HARMONICS[cause.column]
            at = order * (psi + 2 * np.pi * np.arange(self.n_blades) / self.n_blades) + phase
            return np.cos(at), -order * np.sin(at)
        one, two = (transformation(self.n_blades, np.array([psi]), k)[0, :, cause.column] for k in (0, 1))
        return one, two

    def at_once(self, causes: list[Cause]) -> tuple[np.ndarray, np.ndarray]:
        """Answers in the step of the cause by azimuth, of the blade that is there.

        Inflow (n, n_width, causes) and bound circulation (n, n_stations, causes) [m2/s].
        """
        exchange, names = self.exchange.copy(), columns(self.n_blades)
        n_width = exchange.inflow.shape[1]
        found = np.zeros((self.n, n_width + exchange.circulation.shape[1], len(causes)))

        def answer(step: int, cause: Cause) -> np.ndarray:
            both = []
            for side in (cause.size, -cause.size):
                beside = exchange.copy()
                self.stepped(beside, step, cause, *((0.0, side) if cause.rate_alone else (side, 0.0)))
                both.append(np.hstack([beside.inflow, beside.circulation]))
            # a passage on, a coordinate that changes its sign with every passage has changed it
            sign = -1.0 if step == self.passage and cause.kind == "blade" and names[cause.column] == "d" else 1.0
            return np.asarray(sign * (both[0] - both[1]) / (2 * cause.size))

        with ThreadPoolExecutor(workers()) as pool:
            for step in range(1, self.passage + 1):
                for i, answered in enumerate(pool.map(partial(answer, step), causes)):
                    found[self.rows(step), :, i] = answered
                self.stepped(exchange, step, None, 0.0, 0.0)
        return found[:, :n_width], found[:, n_width:]

    def pulse(self, step: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The pulse, at most one, and its rate [1/s], `step` steps after the beginning."""
        dt = 2 * np.pi / self.omega / self.n
        value, slope = spline(np.asarray(step) / self.passage)
        return value, slope / (self.passage * dt)

    def all_later(self, causes: list[Cause]) -> Iterator[Answer]:
        """The same of many, in their order; wakes are marched beside each other, which changes none of them."""
        with ThreadPoolExecutor(workers()) as pool:
            yield from pool.map(self.later, causes)

    def later(self, cause: Cause, share: float = 1.0) -> Answer:
        """What a pulse of the cause does, until the wake has forgotten it."""
        size = share * cause.size
        sides = (size, -size)
        both = [self.exchange.copy() for _ in sides]
        inflow, mean = [np.zeros_like(self.exchange.inflow)], [0.0]
        circulation = [np.zeros_like(self.exchange.circulation)]
        largest, turn = 0.0, 0
        for turn in range(self.most):
            for step in range(turn * self.n + 1, (turn + 1) * self.n + 1):
                (value,), (rate,) = self.pulse(np.array([step]))
                for exchange, side in zip(both, sides, strict=True):
                    self.stepped(exchange, step, cause, side * value, side * rate)
                up, down = both
                inflow.append((np.array(up.inflow) - np.array(down.inflow)) / (2 * size))
                circulation.append((np.array(up.circulation) - np.array(down.circulation)) / (2 * size))
                mean.append((up.held(self.begin + step)[1] - down.held(self.begin + step)[1]) / (2 * size))
            last = float(np.abs(inflow[-self.n :]).max())
            largest = max(largest, last)
            if turn * self.n >= KNOTS * self.passage and last < FORGOTTEN * largest:
                break
        forgotten = (self.most - turn - 1) * self.n
        return Answer(
            np.concatenate([inflow, np.zeros((forgotten, *inflow[0].shape))]),
            np.concatenate([mean, np.zeros(forgotten)]),
            np.concatenate([circulation, np.zeros((forgotten, *circulation[0].shape))]),
        )


def workers() -> int:
    """Threads that march wakes beside each other: as many as the core may use."""
    return int(os.environ.get("WAKEFLIGHT_THREADS", os.cpu_count() or 1))


def spline(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Cubic B-spline with knots 0, 1 .. 4, its largest value one, and its slope."""
    value, slope = np.zeros_like(x, float), np.zeros_like(x, float)
    for k, sign in enumerate((1.0, -4.0, 6.0, -4.0, 1.0)):
        beyond = np.clip(x - k, 0.0, None)
        value += 0.25 * sign * beyond**3
        slope += 0.75 * sign * beyond**2
    inside = (x > 0.0) & (x < KNOTS)
    return np.where(inside, value, 0.0), np.where(inside, slope, 0.0)


def causes_of(where: Places, remembered: list[int]) -> tuple[list[Cause], list[Cause]]:
    """Causes that are answered later, and all that are answered at once; `remembered`: blade modes of the former."""
    names = columns(where.n_blades)
    hub = [Cause(name, "hub", i) for i, name in enumerate(MOTION)]
    controls = [Cause(name, "control", i) for i, name in enumerate(CONTROLS)]
    cyclic = [i for i, name in enumerate(names) if name != "d"]
    slow = [Cause(f"{where.labels[m]}_{names[i]}", "blade", m, i) for m in remembered for i in cyclic]
    slow += [
        Cause(f"{where.labels[m]}_{name}", "harmonic", m, i)
        for m in remembered
        for i, (name, order, _) in enumerate(HARMONICS)
        if order > (where.n_blades - 1) // 2
    ]
    rates = [replace(each, name=f"{each.name}_rate", rate_alone=True) for each in controls]
    blades = [
        Cause(f"{label}_{name}{'_rate' if rate else ''}", "blade", m, i, rate)
        for i, name in enumerate(names)
        for rate in (False, True)
        for m, label in enumerate(where.labels)
    ]
    return [*hub, *controls, *slow], [*hub, *controls, *rates, *blades]


def _begun(start: Trim) -> Exchange:
    """The marched wake of this trim, from its relaxation wake."""
    return Exchange.marching(flight_model(start, "time-marching"), known(start.wake))
