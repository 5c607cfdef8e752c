# SPDX-License-Identifier: MIT OR Apache-2.0
"""Manoeuvres: what the pilot's hands do, as piecewise-linear stick histories about trim.

Before its first corner a stick stays at trim, after its last where it was left. Inches that belong to a `travel` are flown on any
aircraft by the same share of its travel; revolutions that belong to a `rotor_speed` last as long on any aircraft: times are the
pilot's and stay.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from .arguments import with_checked_init
from .control import Augmentation
from .errors import InputError
from .stick_histories import SHORTEST_PIECE, Corner, check_history, slopes_of
from .stick_records import LONGEST_JOIN
from .sticks import STICKS
from .text import name_of
from .units import number

ROUNDING = 1e-9
"""Times [s] nearer than this are one: corners at the edge of a coupling step are met there."""


@with_checked_init
@dataclass(frozen=True)
class Maneuver:
    """A stick history about trim.

    corners_of: for each stick that moves, its corner points (time [s], inches from trim), times ascending; given as a mapping
    by the stick's name or as pairs.
    revolutions, seconds: duration, one of the two given. travel_in: travel the inches belong to [in], rotor_speed: rotor
    speed the revolutions belong to [rad/s]; None: they are those of whatever aircraft flies. shipped: whether it comes with
    the package and is flown as published, even beyond the stops. adapted: what `for_aircraft` changed, a sentence each. control:
    what is between sticks and blades where a flight is not given another, its inches those of `travel_in`. off_trim: whether
    sticks may begin elsewhere than at trim, as they do where a flight goes on from another. absolute: whether inches count from
    the stop instead of trim; from trim a stick then goes to its first place within `join` [s].
    """

    name: str
    corners_of: Annotated[tuple[tuple[str, tuple[Corner, ...]], ...], Mapping[str, Any] | Sequence[Any]]
    revolutions: float | None = None
    seconds: float | None = None
    notes: str = ""
    references: tuple[str, ...] = ()
    travel_in: float | None = None
    rotor_speed: float | None = None
    shipped: bool = False
    adapted: tuple[str, ...] = ()
    control: Augmentation | None = None
    off_trim: bool = False
    absolute: bool = False
    join: float = 0.5

    if TYPE_CHECKING:
        # what it is made of is more than what it then holds
        def __init__(
            self,
            name: str,
            corners_of: Mapping[str, Sequence[Corner]] | Sequence[tuple[str, Sequence[Corner]]],
            revolutions: float | None = None,
            seconds: float | None = None,
            notes: str = "",
            references: tuple[str, ...] = (),
            travel_in: float | None = None,
            rotor_speed: float | None = None,
            shipped: bool = False,
            adapted: tuple[str, ...] = (),
            control: Augmentation | None = None,
            off_trim: bool = False,
            absolute: bool = False,
            join: float = 0.5,
        ) -> None: ...

    def __post_init__(self) -> None:
        """Check names, times and values."""
        try:
            name_of(self.name)
        except ValueError as reason:
            raise InputError.of("name", self.name, str(reason)) from None
        if (self.revolutions is None) == (self.seconds is None):
            raise InputError.of("duration", self.name, "must be given either in revolutions or in seconds")
        length = self.revolutions if self.revolutions is not None else self.seconds
        if not 0.0 < number("duration", length) <= 10000.0:
            raise InputError.of("duration", length, "must lie above 0 and at most 10000")
        for name, value, unit, low, high in (
            ("travel", self.travel_in, "in", 0.1, 100.0),
            ("rotor_speed", self.rotor_speed, "rad/s", 0.1, 1000.0),
        ):
            if value is not None and not low <= number(name, value) <= high:
                raise InputError.of(name, value, f"must lie between {low:g} and {high:g} {unit}")
        if self.rotor_speed is not None and self.seconds is not None:
            allowed = "belongs to a duration in revolutions; one in seconds does not use it"
            raise InputError.of("rotor_speed", self.rotor_speed, allowed)
        if isinstance(self.corners_of, Mapping):
            object.__setattr__(self, "corners_of", tuple(self.corners_of.items()))
        if not isinstance(self.corners_of, tuple | list):
            raise InputError.of(
                "corners_of", self.corners_of, "must hold the corners of each stick that moves, by its name"
            )
        if not 0.0 < number("join", self.join) <= LONGEST_JOIN:
            raise InputError.of("join", self.join, f"must lie above 0 and at most {LONGEST_JOIN:g} s")
        for given in self.corners_of:
            check_history(given, self.absolute or self.off_trim)
        own = tuple((stick, tuple((float(t), float(x)) for t, x in corners)) for stick, corners in self.corners_of)
        object.__setattr__(self, "corners_of", own)
        sticks = [stick for stick, _ in self.corners_of]
        for stick in sticks:
            if sticks.count(stick) > 1:
                raise InputError.of("controls", stick, "given twice; one history for each stick")
        if self.seconds is not None:
            self._check_begins(self.seconds)

    @cached_property
    def _histories(self) -> tuple[tuple[int, list[float], list[float], list[float]], ...]:
        """For each stick that moves: its place among the sticks, corner times [s], inches, slopes of the pieces [in/s]."""
        found = []
        for stick, corners in self.corners_of:
            times, inches = ([float(x) for x in each] for each in zip(*corners, strict=True))
            found.append((STICKS.index(stick), times, inches, slopes_of(corners)))
        return tuple(found)

    def _check_begins(self, end: float) -> None:
        """Refuse a stick that would first move when the flight is over."""
        for stick, corners in self.corners_of:
            begins = next((t for (t, _), slope in zip(corners, slopes_of(corners), strict=False) if slope != 0.0), None)
            if begins is not None and begins >= end:
                allowed = f"must begin to move before the end of the flight at {end:.6g} s: times count from its start"
                raise InputError.of(stick, f"{begins:.12g} s", allowed)

    def check_end(self, end: float) -> list[str]:
        """Warnings about motion of the sticks after the end of the flight at `end` [s]."""
        warnings = []
        for stick, corners in self.corners_of:
            moved = [t for (t, _), slope in zip(corners[1:], slopes_of(corners), strict=True) if slope != 0.0]
            if moved and moved[-1] > end * (1.0 + 1e-9):
                first = next(t for t in moved if t > end * (1.0 + 1e-9))
                warnings.append(
                    f"{self.name}: the flight ends at {end:.6g} s; {stick} corners from {first:.6g} s on, to {moved[-1]:.6g} s, "
                    "are not flown"
                )
        return warnings

    def duration(self, omega: float) -> float:
        """Length of the flight [s] with a rotor turning at `omega` [rad/s]."""
        return self.seconds if self.seconds is not None else self.duration_revolutions(omega) * 2.0 * math.pi / omega

    def duration_revolutions(self, omega: float) -> float:
        """Length of the flight in revolutions of a rotor turning at `omega` [rad/s].

        Revolutions that belong to another rotor speed become the next whole number that lasts as long.
        """
        if self.seconds is not None:
            return self.seconds * omega / (2.0 * math.pi)
        assert self.revolutions is not None, "one of the two is given"
        if self.rotor_speed is None or abs(omega / self.rotor_speed - 1.0) < 1e-9:
            return self.revolutions
        return float(math.ceil(self.revolutions * omega / self.rotor_speed - 1e-6))

    def corners(self) -> tuple[float, ...]:
        """Times at which the slope of a stick changes [s], ascending, each once: the solver stops there."""
        times = set()
        for _, corners in self.corners_of:
            slopes = [0.0, *slopes_of(corners), 0.0]
            times |= {time for (time, _), a, b in zip(corners, slopes, slopes[1:], strict=False) if a != b}
        return tuple(sorted(times))

    def offset(self, t: float) -> np.ndarray:
        """Sticks from trim (4,) [in] at time `t` [s]."""
        # plain numbers: asked several times at every step
        sticks = [0.0] * 4
        for stick, times, inches, slopes in self._histories:
            piece = bisect_right(times, t) - 1
            if piece < 0:
                sticks[stick] = inches[0]
            elif piece < len(slopes):
                sticks[stick] = slopes[piece] * (t - times[piece]) + inches[piece]
            else:
                sticks[stick] = inches[-1]
        return np.array(sticks)

    def stick(self, t: float, trim_in: Sequence[float] | np.ndarray) -> np.ndarray:
        """Sticks (4,) [in] from the stop at time `t` [s], about the trim sticks `trim_in` (4,) [in]."""
        sticks: np.ndarray = np.asarray(trim_in, dtype=float) + self.offset(t)
        return sticks

    def rate(self, t: float) -> np.ndarray:
        """Stick rates (4,) [in/s] at time `t` [s]; at a corner the rate that follows."""
        rates = [0.0] * 4
        for stick, times, _, slopes in self._histories:
            piece = bisect_right(times, t) - 1
            if 0 <= piece < len(slopes):
                rates[stick] = slopes[piece]
        return np.array(rates)

    def for_aircraft(self, travel_in: Sequence[float], omega: float) -> Maneuver:
        """The manoeuvre in an aircraft's own inches and revolutions; `adapted` says what that changed.

        Inches: times the aircraft's travel over the `travel_in` they belong to. Times stay. Revolutions: as many of its own
        as last as long. travel_in: travel of the four sticks (4,) [in]; omega: rotor speed [rad/s].
        """
        corners_of, adapted = [], list(self.adapted)
        for stick, corners in self.corners_of:
            travel = float(travel_in[STICKS.index(stick)])
            share = 1.0 if self.travel_in is None else travel / self.travel_in
            if abs(share - 1.0) > 1e-9:
                corners = tuple((time, inches * share) for time, inches in corners)
                adapted.append(
                    f"{self.name}: {stick} inches times {share:.4g}, as they were written for {self.travel_in:g} in of "
                    f"travel and this stick has {travel:.4g} in; times as written"
                )
            corners_of.append((stick, corners))
        control = self.control
        if control is not None and self.travel_in is not None:
            shares = [travel / self.travel_in for travel in travel_in]
            # the one travel of a file is that of the hand's sticks: pedals have their own
            control = control.scaled([*shares[:3], 1.0])
            if any(abs(share - 1.0) > 1e-9 for share in shares[:3]):
                adapted.append(f"{self.name}: inches of its augmentation times travel over {self.travel_in:g} in")
        revolutions = self.revolutions
        if self.revolutions is not None:
            revolutions = self.duration_revolutions(omega)
            if self.rotor_speed is not None and revolutions != self.revolutions:
                written = self.revolutions * 2.0 * math.pi / self.rotor_speed
                adapted.append(
                    f"{self.name}: {self.revolutions:g} revolutions at {self.rotor_speed:g} rad/s last {written:.3f} s, which "
                    f"are {revolutions:g} at {omega:g} rad/s, rounded up to whole ones ({self.duration(omega):.3f} s)"
                )
        own = replace(
            self,
            corners_of=tuple(corners_of),
            revolutions=revolutions,
            travel_in=None,
            rotor_speed=None,
            adapted=tuple(adapted),
            control=control,
        )
        own._check_begins(own.duration(omega))
        return own

    def about(self, trim_in: Sequence[float] | np.ndarray) -> Maneuver:
        """The manoeuvre about trim: inches from the stop become those from `trim_in` (4,) [in], each stick led from trim to
        them."""
        if not self.absolute:
            return self
        corners_of, adapted = [], list(self.adapted)
        for stick, corners in self.corners_of:
            times, inches = (np.array(each, dtype=float) for each in zip(*corners, strict=True))
            offset = inches - float(trim_in[STICKS.index(stick)])
            # corners where the lead-in begins and ends, as far as they are not there
            grid = np.concatenate(
                [times, [each for each in (0.0, self.join) if np.abs(times - each).min() > SHORTEST_PIECE]]
            )
            grid.sort()
            gap = offset[0]
            led = np.interp(grid, times, offset) - gap * np.clip(1.0 - grid / self.join, 0.0, None)
            led[grid <= SHORTEST_PIECE] = 0.0
            corners_of.append((stick, tuple(zip(grid.tolist(), led.tolist(), strict=True))))
            if abs(gap) > 1e-6:
                said = f"{stick} begins {gap:+.3f} in from trim and is led there within {self.join:g} s"
                adapted.append(f"{self.name}: {said}")
        return replace(self, corners_of=tuple(corners_of), absolute=False, adapted=tuple(adapted))

    def check_span(self, travel_in: Sequence[float]) -> None:
        """Refuse a user's manoeuvre that fits between the stops for no trim; travel_in (4,) [in]."""
        for stick, corners in self.corners_of:
            inches = [value for _, value in corners]
            span, travel = max(inches) - min(inches), float(travel_in[STICKS.index(stick)])
            if not self.shipped and span > travel * (1.0 + 1e-9):
                allowed = f"must fit into the stick's travel of {travel:.4g} in"
                raise InputError.of(f"{self.name}: {stick}", f"{span:g} in from end to end", allowed)

    def check_travel(
        self,
        trim_in: Sequence[float] | np.ndarray,
        travel_in: Sequence[float],
        shipped: bool | None = None,
        rate_limit_in: Sequence[float] | None = None,
    ) -> list[str]:
        """Warnings about sticks beyond travel or rate limit; a user's manoeuvre beyond travel is refused.

        trim_in, travel_in (4,) [in]: trim sticks and travel. shipped: as published; None is its own.
        rate_limit_in (4,) [in/s]: None is the full travel in one second.
        """
        warnings = []
        shipped = self.shipped if shipped is None else shipped
        limits = travel_in if rate_limit_in is None else rate_limit_in
        for stick, corners in self.corners_of:
            index = STICKS.index(stick)
            trim, travel, limit = float(trim_in[index]), float(travel_in[index]), float(limits[index])
            beyond, time, inches = max((max(-(trim + x), trim + x - travel), t, x) for t, x in corners)
            if beyond > 1e-9:
                reached = f"{trim + inches:.3f} in at {time:.4g} s, {beyond:.3f} in beyond its travel"
                if not shipped:
                    allowed = f"from {trim:.3f} in reaches {reached}; must stay between 0 and {travel:.4g} in"
                    raise InputError.of(f"{self.name}: {stick}", f"{inches:g} in", allowed)
                how = "as published, scaled" if self.adapted else "as published"
                warnings.append(f"{self.name}: {stick} stick reaches {reached}; flown {how}")
            fastest = max((abs(slope) for slope in slopes_of(corners)), default=0.0)
            if fastest > limit * (1.0 + 1e-9):
                warnings.append(f"{self.name}: {stick} moves at {fastest:.1f} in/s, beyond {limit:.4g} in/s; flown so")
        return warnings
