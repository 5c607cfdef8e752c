# SPDX-License-Identifier: MIT OR Apache-2.0
"""Options of the inflow models as the physics core declares them: everything said of an option is made from this.

An option's name, kind, unit, range or words, default, meaning and source stand in `crates/wakeflight/src/wake/options/` and
nowhere else. Keyword arguments, help, checks, command line, stub and reference page are made from what the core tells.
"""

from __future__ import annotations

import difflib
import json
import math
from dataclasses import dataclass
from functools import cache
from typing import Any

from . import _core
from .errors import InputError, known
from .regime import REGIMES
from .units import quantity


class Radians(float):
    """An angle in radians that is a quantity by itself: what a model holds, and takes when it is copied with other options."""

    @property
    def magnitude(self) -> float:
        """The number."""
        return float(self)

    def to(self, unit: str) -> Radians:
        """The angle itself; it has no other unit."""
        if unit != "rad":
            raise ValueError(f"an angle in radians is no quantity of {unit}")
        return self


@dataclass(frozen=True)
class Refinement:
    """How a discretisation is refined: name in a study, which way is finer, order expected, a number of the model or not."""

    name: str
    larger: bool
    order: float | None
    physical: bool


@dataclass(frozen=True)
class Option:
    """One option of one or several inflow models.

    kind: number, whole, switch, word. unit: rad, R (rotor radius), c (chord) ...; range: least, largest value, whether the
    least is itself refused. default: None where it is left open (`left_open` says what holds then) or depends on the regime;
    lattice: what replaces it in each regime where trailers leave all over the span. tip_alone: whether it acts on a lone tip
    vortex only.
    """

    name: str
    group: str
    models: tuple[str, ...]
    kind: str
    unit: str
    range: tuple[float, float, bool] | None
    words: dict[str, str]
    default: Any
    by_regime: dict[str, Any]
    lattice: dict[str, Any]
    tip_alone: bool
    left_open: str
    meaning: str
    sources: tuple[str, ...]
    refinement: Refinement | None

    @property
    def is_angle(self) -> bool:
        """Whether values are angles: text with a unit outside, radians inside."""
        return self.unit == "rad"

    def checked(self, value: Any) -> Any:
        """`value` as the model holds it, angles in radians; an InputError naming what is allowed."""
        if value is None and self.default is None:
            return None
        if self.kind == "word":
            if not isinstance(value, str) or value not in self.words:
                raise InputError.choice(self.name, value, self.words)
            return value
        if self.kind == "switch":
            if not isinstance(value, bool):
                raise InputError.of(self.name, value, "must be True or False")
            return value
        number = Radians(quantity(value, "rad", self.name)) if self.is_angle else value
        kind = int if self.kind == "whole" else (int, float)
        if isinstance(number, bool) or not isinstance(number, kind) or not self._allows(number):
            raise InputError.of(self.name, value, f"must {self._allowed}")
        return number

    def read(self, text: str) -> Any:
        """Value from text as it is typed in a command line, checked."""
        text = text.strip()
        if self.default is None and text.lower() == "none":
            return None
        if self.kind == "switch":
            said = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}
            if text.lower() not in said:
                raise InputError.of(self.name, text, "allowed: true, false")
            return said[text.lower()]
        if self.is_angle or self.kind == "word":
            return self.checked(text)
        try:
            number = int(text) if self.kind == "whole" else float(text)
        except ValueError:
            raise InputError.of(self.name, text, f"must {self._allowed}") from None
        return self.checked(number)

    def shown(self, value: Any) -> Any:
        """`value` as a person types it: angles in degrees."""
        return value if value is None or not self.is_angle else f"{math.degrees(value):.6g} deg"

    @property
    def allowed(self) -> str:
        """What may be given, in words: `a number between 0 and 0.2`, `equivalent, max, mean`."""
        if self.kind == "word":
            return ", ".join(self.words)
        return "True, False" if self.kind == "switch" else self._allowed.removeprefix("be ").removeprefix("lie ")

    @property
    def default_in_words(self) -> str:
        """The default: a value, the three of the regimes, or what holds where none is given."""
        if self.by_regime:
            values = self.by_regime.values()
            if len(set(values)) == 1:
                return f"{next(iter(values))}"
            lattice = f"; with full-span trailers {_by_regime(self.lattice)}" if self.lattice else ""
            return f"by regime: {_by_regime(self.by_regime)}{lattice}"
        if self.left_open:
            return f"None, {self.left_open}"
        return f"{self.shown(self.default)}"

    def _allows(self, number: float) -> bool:
        low, high, above = known(self.range)
        # an angle of 3600 deg may be off by its rounding
        high = high * (1.0 + 1e-12) if self.is_angle else high
        return low <= number <= high and not (above and number == low)

    @property
    def _allowed(self) -> str:
        low, high, above = known(self.range)
        if self.is_angle:
            least, most = (f"{math.degrees(each):.6g} deg" for each in (low, high))
            return f"lie above {least} and at most {most}" if above else f"lie between {least} and {most}"
        return f"be {'a whole number' if self.kind == 'whole' else 'a number'} between {low:g} and {high:g}"


def _by_regime(values: dict[str, Any]) -> str:
    """One value, or that of every regime in words."""
    if len(set(values.values())) == 1:
        return f"{next(iter(values.values()))}"
    return ", ".join(f"{values[regime]} {words}" for regime, words in REGIMES.items())


def _number(value: Any) -> Any:
    """A number as it is typed: 4 for 4.0 of the core; words and None as they are."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _each_regime(default: dict[str, Any] | None) -> dict[str, Any]:
    """A default of the core by regime, empty where there is none."""
    if default is None:
        return {}
    values = default["by_regime"] if "by_regime" in default else dict.fromkeys(REGIMES, default["always"])
    return {name: _number(value) for name, value in values.items()}


def _told(raw: dict[str, Any]) -> Option:
    """One descriptor of the core."""
    default, angle = raw["default"], raw["unit"] == "rad"
    always = default.get("always")
    bounds, refinement = raw["range"], raw["refinement"]
    return Option(
        name=raw["name"],
        group=raw["group"],
        models=tuple(raw["models"]),
        kind=raw["kind"],
        unit=raw["unit"],
        range=None if bounds is None else (bounds["low"], bounds["high"], bounds["above"]),
        words={each["word"]: each["meaning"] for each in raw["words"]},
        default=Radians(always) if angle and always is not None else always,
        by_regime=_each_regime(default) if "by_regime" in default else {},
        lattice=_each_regime(raw["lattice"]),
        tip_alone=raw["tip_alone"],
        left_open=default.get("left_open", ""),
        meaning=raw["meaning"],
        sources=tuple(raw["sources"]),
        refinement=None if refinement is None else Refinement(**refinement),
    )


DECLARED: tuple[Option, ...] = tuple(map(_told, json.loads(_core.option_descriptors())))
"""Every option of every model, in the order of their declaration."""

BY_REGIME: dict[str, dict[str, Any]] = {option.name: option.by_regime for option in DECLARED if option.by_regime}
"""Defaults of the options that depend on the regime: the same for every rotor, in trim, flight and on the stand."""


@cache
def options_of(model: str) -> dict[str, Option]:
    """Options of the model of that name, by name."""
    return {option.name: option for option in DECLARED if model in option.models}


def option_of(model: str, name: str, field: str = "option") -> Option:
    """Option `name` of the model; an InputError of `field` that lists the nearest names where there is none."""
    known = options_of(model)
    if name not in known:
        near = difflib.get_close_matches(name, known, n=3, cutoff=0.5)
        listed = f"nearest: {', '.join(near)}" if near else f"allowed: {', '.join(known)}"
        raise InputError.of(field, name, f"not an option of {model} inflow; {listed}")
    return known[name]


def resolved(values: dict[str, Any], regime: str) -> dict[str, Any]:
    """Those of `values` that are None because their default depends on the regime, with that of `regime`.

    Where an option is set that acts on a lone tip vortex only, trailers left open are that. No turns are repeated where a
    vortex cylinder closes the wake or less than two turns are free.
    """
    found = {name: BY_REGIME[name][regime] for name, value in values.items() if value is None and name in BY_REGIME}
    if "trailers" not in values:
        return found
    told = {option.name: option for option in DECLARED}
    if "trailers" in found and any(told[name].tip_alone and v != told[name].default for name, v in values.items()):
        found["trailers"] = "tip"
    if (values["trailers"] or found["trailers"]) == "full-span":
        found.update({name: told[name].lattice[regime] for name in found if told[name].lattice})
    if "far_wake_turns" in found and (values["far_wake"] == "cylinder" or (values["turns"] or found["turns"]) < 2):
        found["far_wake_turns"] = 0
    return found


def described(name: str) -> str:
    """The defaults of an option of a free wake in words: `by regime: 4 forward, 5 hover and climb, 8 axial descent`."""
    return next(option for option in DECLARED if option.name == name).default_in_words


def choices(name: str) -> str:
    """What may be given for an option of a free wake: `bdf2, pc2b, pcc`."""
    return next(option for option in DECLARED if option.name == name).allowed
