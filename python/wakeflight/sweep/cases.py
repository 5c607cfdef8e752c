# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cases of a sweep: a grid of axes, a sample of distributions, or a list; each a set of arguments by name, with its
coordinates."""

from __future__ import annotations

import itertools
import math
import zlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ..arguments import checked, is_number
from ..errors import InputError, one_line, shortened
from ..units import convert, parted, whole

MOST = 100_000
"""Most cases of a sweep."""

Coordinate = tuple[tuple[str, ...], np.ndarray, dict[str, str]]
"""Dimensions, values and attributes of a coordinate."""


@dataclass(frozen=True)
class Cases:
    """Cases in the order of the table: dimensions with their lengths, coordinates, and the arguments of every case."""

    shape: tuple[tuple[str, int], ...]
    coordinates: Mapping[str, Coordinate]
    cases: tuple[Mapping[str, Any], ...]

    def __len__(self) -> int:
        """How many."""
        return len(self.cases)

    def with_fixed(self, fixed: Mapping[str, Any]) -> Cases:
        """The same with arguments that are those of every case."""
        for case in self.cases:
            for name in fixed:
                if name in case:
                    raise InputError.of(name, fixed[name], "is given by the cases too: one of the two")
        return Cases(self.shape, self.coordinates, tuple({**fixed, **case} for case in self.cases))

    def place(self, k: int) -> tuple[int, ...]:
        """Indices of case `k` along the dimensions."""
        return tuple(int(i) for i in np.unravel_index(k, [n for _, n in self.shape])) if self.shape else ()

    def label(self, k: int) -> str:
        """Case `k` by its coordinates: `speed = 80 kt, inflow = dynamic`."""
        at = dict(zip((name for name, _ in self.shape), self.place(k), strict=True))
        told = [f"{name} = {value[tuple(at[d] for d in dims)]}" for name, (dims, value, _) in self.coordinates.items()]
        return ", ".join(each for each in told if "_value = " not in each)


class Distribution(Protocol):
    """What values of a sample are drawn from."""

    def drawn(self, random: np.random.Generator, n: int) -> list[Any]:
        """`n` values, as an argument takes them."""


class _Pair:
    """Two numbers of one dimension, as text with units or plain."""

    words: tuple[str, str]

    def __init__(self, first: Any, second: Any) -> None:
        self.given = (first, second)
        read = [(float(each), "") if is_number(each) else parted(each) for each in self.given]
        for word, value, each in zip(self.words, self.given, read, strict=True):
            if each is None:
                raise InputError.of(word, value, "must be a number, or text with a unit")
        (self.first, self.unit), (number, unit) = (each for each in read if each is not None)
        if bool(unit) != bool(self.unit):
            raise InputError.of(self.words[1], second, f"must have a unit as {self.words[0]} = {first} has it")
        try:
            self.second = convert(number, unit, self.unit) if unit else number
        except ValueError as reason:
            raise InputError.of(self.words[1], second, str(reason)) from None

    def __repr__(self) -> str:
        """As it is typed."""
        return f"{type(self).__name__}({', '.join(map(repr, self.given))})"

    def _told(self, values: Iterable[float]) -> list[Any]:
        return [f"{float(each)!r} {self.unit}" if self.unit else float(each) for each in values]


class Normal(_Pair):
    """Normal distribution about a mean: `wf.Normal("16000 lbf", "300 lbf")`."""

    words = ("mean", "deviation")

    @checked
    def __init__(self, mean: Any, deviation: Any) -> None:
        """Mean and standard deviation, text with units or numbers."""
        super().__init__(mean, deviation)
        if self.second < 0.0:
            raise InputError.of("deviation", deviation, "must not be negative")

    def drawn(self, random: np.random.Generator, n: int) -> list[Any]:
        """`n` values."""
        return self._told(self.first + self.second * random.standard_normal(n))


class Uniform(_Pair):
    """Uniform distribution between two values: `wf.Uniform("70 kt", "90 kt")`."""

    words = ("low", "high")

    @checked
    def __init__(self, low: Any, high: Any) -> None:
        """Least and largest value, text with units or numbers."""
        super().__init__(low, high)
        if self.second < self.first:
            raise InputError.of("high", high, f"must not be below low = {low}")

    def drawn(self, random: np.random.Generator, n: int) -> list[Any]:
        """`n` values."""
        return self._told(self.first + (self.second - self.first) * random.random(n))


@checked
def arange(start: Any, stop: Any, step: Any) -> list[Any]:
    """Values from `start` to `stop`, both included, by `step`: text with units, shown in that of `step`, or numbers.

    `wf.arange("0 kt", "160 kt", "10 kt")`.
    """
    pair = _Pair.__new__(Uniform)
    numbers = []
    for word, value in (("start", start), ("stop", stop)):
        pair.words = ("step", word)
        _Pair.__init__(pair, step, value)
        numbers.append(pair.second)
    first, last, by = *numbers, pair.first
    count = (last - first) / by if by else math.nan
    if not 0.0 <= count <= MOST or abs(count - round(count)) > 1e-9 * max(1.0, abs(count)):
        raise InputError.of("step", step, f"must lead from {start} to {stop} in a whole number of steps")
    values = [first + k * by for k in range(round(count) + 1)]
    return [f"{each:.12g} {pair.unit}" if pair.unit else each for each in values]


@checked
def grid(**axes: Any) -> Cases:
    """Cases of every combination: a list is an axis, with its values as coordinates; anything else is the same in all cases.

    `wf.grid(speed=["40 kt", "80 kt"], inflow=["dynamic", "relaxation"], **{"aircraft.rotor.omega": ["26 rad/s", "27 rad/s"]})`.
    Names are arguments of the verb, of the condition, `inflow.turns` an option of the inflow model, `aircraft.` and a dotted name
    what `Aircraft.with_` takes. Axes whose values have units get their numbers as a second coordinate, `speed_value`.
    """
    along = {_name(name): list(values) for name, values in axes.items() if isinstance(values, list | tuple)}
    along |= {_name(name): list(values.tolist()) for name, values in axes.items() if isinstance(values, np.ndarray)}
    fixed = {_name(name): values for name, values in axes.items() if name not in along}
    count = math.prod(len(values) for values in along.values())
    if not 0 < count <= MOST:
        empty = next((name for name, values in along.items() if not values), "cases")
        raise InputError.of(empty, count, f"must be at least one case and at most {MOST}")
    coordinates: dict[str, Coordinate] = {}
    for name, values in along.items():
        coordinates |= _coordinates(name, (name,), values)
        labels = coordinates[name][1].tolist()
        for label in labels:
            if labels.count(label) > 1:
                raise InputError.of(name, label, "stands twice on its axis")
    combined = itertools.product(*along.values())
    cases = tuple({**fixed, **dict(zip(along, values, strict=True))} for values in combined)
    return Cases(tuple((name, len(values)) for name, values in along.items()), coordinates, cases)


@checked
def sample(n: int, seed: int = 0, **given: Any) -> Cases:
    """`n` cases along the dimension `member`: of a distribution a value is drawn for each, a list has one for each, anything
    else is the same in all.

    `wf.sample(200, seed=1, weight=wf.Normal("16000 lbf", "300 lbf"), speed=wf.Uniform("70 kt", "90 kt"))`. What is drawn for
    a name depends on the seed and the name alone: one more name leaves the others as they are, more members leave the first ones.
    """
    whole("n", n, 1, MOST)
    whole("seed", seed, 0, 2**63)
    drawn: dict[str, list[Any]] = {}
    fixed: dict[str, Any] = {}
    for name, value in given.items():
        match value:
            case Normal() | Uniform():
                random = np.random.Generator(np.random.PCG64([seed, zlib.crc32(name.encode())]))
                drawn[_name(name)] = value.drawn(random, n)
            case list() | tuple():
                if len(value) != n:
                    raise InputError.of(name, f"{len(value)} values", f"must be one for each of n = {n} members")
                drawn[_name(name)] = list(value)
            case _:
                fixed[_name(name)] = value
    members = np.arange(n)
    coordinates: dict[str, Coordinate] = {"member": (("member",), members, {})}
    for name, values in drawn.items():
        coordinates |= _coordinates(name, ("member",), values)
    cases = tuple({**fixed, **{name: values[k] for name, values in drawn.items()}} for k in range(n))
    return Cases((("member", n),), coordinates, cases)


def cases_of(given: Any) -> Cases:
    """Cases as they are, or of a list of arguments by name, along the dimension `case`."""
    match given:
        case Cases():
            return given
        case [*listed] if listed and len(listed) <= MOST:
            for k, each in enumerate(listed):
                if not isinstance(each, Mapping):
                    raise InputError.of(f"cases[{k}]", each, "must be arguments by name")
                for name in each:
                    _name(name)
            places = np.arange(len(listed))
            return Cases((("case", len(listed)),), {"case": (("case",), places, {})}, tuple(map(dict, listed)))
    raise InputError.of("cases", given, "must be wf.grid(...), wf.sample(...), or a list of arguments by name")


def _name(name: Any) -> str:
    """A name of an argument, which becomes one of a table."""
    if not isinstance(name, str) or not name or "/" in name or not name.isprintable() or len(name) > 120:
        raise InputError.of("cases", name, "names must be printable text without /")
    return name


def _coordinates(name: str, dims: tuple[str, ...], values: Sequence[Any]) -> dict[str, Coordinate]:
    """Values as they were given, and their numbers in the unit of the first where all have one."""
    if all(is_number(value) for value in values):
        return {name: (dims, np.array(values), {})}
    found: dict[str, Coordinate] = {name: (dims, np.array([_label(value) for value in values]), {})}
    read = [parted(value) for value in values]
    if None in read:
        return found
    unit = next(pair[1] for pair in read if pair is not None)
    try:
        numbers = [convert(pair[0], pair[1], unit) for pair in read if pair is not None]
    except ValueError:
        return found
    return found | {f"{name}_value": (dims, np.array(numbers), {"units": unit})}


def _label(value: Any) -> str:
    """A value as a coordinate: text as it is, an object by its name or as it shows itself."""
    match value:
        case str():
            return shortened(one_line(value), 120)
        case object(name=str() as name):
            shown = repr(value)
            return shown if shown.startswith(type(value).__name__) and len(shown) <= 120 else name
    return shortened(one_line(repr(value)), 120)
