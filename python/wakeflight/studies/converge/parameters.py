# SPDX-License-Identifier: MIT OR Apache-2.0
"""What can be refined: each discretisation by its name, where it acts, which way is finer, and the order expected of it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeVar

from ...arguments import is_number, is_whole
from ...errors import InputError, one_line
from ...inflow import Inflow, InflowModel, RelaxationWake
from ...options import DECLARED, options_of
from ...units import quantity
from ..case import Case

INFLOW_TOLERANCE = 1e-5
"""Of a trim on a free wake in a study, ten times tighter than by default: iterations must not hide what is studied."""

CONTROL_TOLERANCE = 1e-5
"""The same for the pitch controls [rad], a hundred times tighter than by default."""

Part = Literal["inflow", "aircraft", "trim", "flight"]
Kind = Literal["angle", "whole", "number"]
Model = TypeVar("Model", bound=Inflow)


@dataclass(frozen=True)
class Parameter:
    """One discretisation.

    option: keyword of the inflow model, key of the aircraft's discretisation, or argument of the verb. finer: which way.
    formal_order: order in the size (the value, or its inverse where larger is finer); None where none is expected.
    physical: a number of the physical model, whose two ends are different models, not a better and a worse one.
    """

    name: str
    option: str
    part: Part
    kind: Kind
    finer: Literal["smaller", "larger"]
    formal_order: float | None
    meaning: str
    physical: bool = False
    low: float = 0.0
    high: float = math.inf


def _clause(meaning: str) -> str:
    """First clause of a sentence, to stand within another."""
    clause = meaning.split(";")[0].split(",")[0].rstrip(".")
    return clause[0].lower() + clause[1:]


def _of_the_inflow() -> tuple[Parameter, ...]:
    """The discretisations among the options of the inflow models, as the core declares them."""
    return tuple(
        Parameter(
            told.name,
            option.name,
            "inflow",
            "angle" if option.is_angle else "whole" if option.kind == "whole" else "number",
            "larger" if told.larger else "smaller",
            told.order,
            _clause(option.meaning),
            told.physical,
        )
        for option in DECLARED
        if (told := option.refinement) is not None
    )


PARAMETERS: tuple[Parameter, ...] = (
    *_of_the_inflow(),
    Parameter("modes", "n_modes", "aircraft", "whole", "larger", None, "modes of a blade"),
    Parameter("elements", "n_elements", "aircraft", "whole", "larger", 4.0, "finite elements of a blade"),
    Parameter("gauss-points", "n_gauss", "aircraft", "whole", "larger", None, "quadrature points of an element"),
    Parameter("harmonics", "n_harmonics", "trim", "whole", "larger", None, "harmonics of the blades in trim", low=1, high=40),
    Parameter(
        "control-tolerance", "control_tolerance", "trim", "number", "smaller", 1.0, "rest of the pitch controls [rad]",
        low=1e-9, high=0.1,
    ),
    Parameter("tolerance", "rtol", "flight", "number", "smaller", 1.0, "relative tolerance of the solver", low=1e-12, high=0.1),
)  # fmt: skip
"""In the order in which help shows them."""


def parameter(name: str) -> Parameter:
    """Parameter by its name on the command line, or by the name of its option."""
    if "," in name:
        raise InputError.of("vary", name, "one discretisation at a time: the sum of two errors says nothing of either")
    for each in PARAMETERS:
        if name in (each.name, each.option):
            return each
    raise InputError.choice("vary", name, [each.name for each in PARAMETERS])


@dataclass(frozen=True)
class Setting:
    """One value of a parameter: as given, as an argument, and its size, smaller being finer."""

    label: str
    argument: Any
    size: float


def settings(chosen: Parameter, values: Any) -> list[Setting]:
    """Settings from a list, or from text with commas, coarse to fine."""
    given = values.split(",") if isinstance(values, str) else list(values)
    read = [_setting(chosen, value) for value in given]
    if len(read) < 2:
        raise InputError.of("values", values, f"give two or more values of {chosen.name}")
    read.sort(key=lambda setting: -setting.size)
    for before, after in zip(read, read[1:], strict=False):
        if math.isclose(before.size, after.size, rel_tol=1e-9):
            raise InputError.of("values", after.label, "is given twice")
    return read


def _label(value: Any) -> str:
    """A setting as it is told."""
    if isinstance(value, str):
        return value.strip()
    if is_whole(value):
        return str(value) if abs(value) < 1e15 else "beyond all range"
    return f"{value:g}" if is_number(value) else one_line(value)


def _setting(chosen: Parameter, value: Any) -> Setting:
    label = _label(value)
    if chosen.kind == "angle":
        argument: Any = label if isinstance(value, str) else value
        number = quantity(argument, "rad", chosen.option)
    else:
        try:
            number = float(label)
        except ValueError:
            raise InputError.of(chosen.name, label, "must be a number") from None
        whole = number.is_integer()
        if chosen.kind == "whole" and not whole:
            raise InputError.of(chosen.name, label, "must be a whole number")
        argument = int(number) if chosen.kind == "whole" else number
    if not (math.isfinite(number) and chosen.low <= number <= chosen.high):
        allowed = f"must lie between {chosen.low:g} and {chosen.high:g}"
        raise InputError.of(chosen.name, label, "must be finite, 0 or more" if chosen.high == math.inf else allowed)
    # a larger number is finer: its inverse is the size; none at all is the coarsest there is
    size = number if chosen.finer == "smaller" else (1.0 / number if number > 0.0 else 1e6)
    return Setting(label, argument, size)


def applied(chosen: Parameter, setting: Setting, case: Case) -> Case:
    """`case` with the setting, checked as everything that is typed."""
    if chosen.part == "inflow":
        if chosen.option not in options_of(case.inflow.name):
            raise InputError.of("vary", chosen.name, f"not an option of inflow {case.inflow.name}")
        return replace(case, inflow=replace(case.inflow, **{chosen.option: setting.argument}))
    if chosen.part == "aircraft":
        return replace(case, aircraft=case.aircraft.discretised(**{chosen.option: setting.argument}))
    if chosen.option == "control_tolerance" and case.inflow.is_dynamic:
        raise InputError.of("vary", chosen.name, "a trim with inflow dynamic does not iterate")
    return replace(case, **{chosen.option: setting.argument})


def tightened(chosen: Parameter, inflow: Model) -> Model | RelaxationWake:
    """Inflow model of a trim with its iterations tight, unless they are what is varied."""
    if not inflow.is_relaxed or chosen.option == "inflow_tolerance":
        return inflow
    wake = inflow.relaxed
    tolerance = min(wake.inflow_tolerance, INFLOW_TOLERANCE)
    return replace(wake, inflow_tolerance=tolerance, max_loops=max(wake.max_loops, 100))


def check_run(chosen: Parameter, run: str, inflow: InflowModel) -> None:
    """Refuse a parameter that the run does not have; run: `trim`, `modes`, `tunnel`, anything else is a flight."""
    if run == "tunnel" and (chosen.part == "flight" or chosen.name in ("convergence-revolutions", "control-tolerance")):
        raise InputError.of("vary", chosen.name, "not a discretisation of a rotor on a stand")
    if run == "modes" and chosen.name != "elements":
        raise InputError.of("vary", chosen.name, "not a discretisation of the blade's modes; allowed: elements")
    if run == "trim" and (chosen.part == "flight" or chosen.name == "convergence-revolutions"):
        raise InputError.of("vary", chosen.name, "not a discretisation of a trim: choose a manoeuvre")
    if chosen.name == "convergence-revolutions" and not inflow.is_marching:
        raise InputError.of("vary", chosen.name, f"not an option of inflow {inflow.name}")
