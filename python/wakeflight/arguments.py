# SPDX-License-Identifier: MIT OR Apache-2.0
"""Arguments of public functions, checked against their annotations where they come in.

    @checked
    def fly(start: Trim, maneuver: Maneuver, revolutions: float | None = None): ...

What an argument may be is declared once, in the signature; `checked` refuses whatever else is given, in one line that names
the argument, the value and what is allowed. Numbers must be finite and no truth values, texts must be text; quantities with a
unit are annotated `Any` and read by `units.quantity`; ranges are checked where they are known, in the function itself. Where an
object holds something else than it is given: `Annotated[held, given]`.
"""

from __future__ import annotations

import inspect
import math
import os
import types
from collections.abc import Callable, Mapping, Sequence
from difflib import get_close_matches
from functools import cache, wraps
from importlib import import_module
from numbers import Integral, Real
from typing import (
    Annotated,
    Any,
    Literal,
    NamedTuple,
    ParamSpec,
    Protocol,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from .errors import ArgumentError, InputError

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
Made = TypeVar("Made")

MADE_BY = {
    "Aircraft": "wf.load_aircraft(name or path)",
    "Rotor": "wf.load_rotor(name or path)",
    "FlightCondition": 'wf.FlightCondition(speed="80 kt", ...)',
    "Maneuver": "wf.load_maneuver(name or path), wf.Maneuver(...)",
    "Trim": "wf.trim(...)",
    "Snapshot": "Simulation.snapshot()",
    "Simulation": "wf.Simulation(start)",
}
"""How a user comes by an object of a class, for the line that asks for one."""


class Kind(NamedTuple):
    """What an argument may be: a test of a value, and its words."""

    fits: Callable[[Any], bool]
    words: str


def checked(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """`function` with its arguments checked against its annotations at every call; InputError names the one that does not fit.

    Annotations are read at the first call: names that a module imports for type checking alone are those of the package.
    """
    signature = inspect.signature(function)
    # of a method, the object it is called on is no argument
    named = [name for name in signature.parameters if name not in ("self", "cls")]

    @cache
    def kinds() -> dict[str, Kind]:
        hints = _hints_of(function)
        return {name: kind_of(hints[name]) for name in named if name in hints}

    @wraps(function)
    def called(*arguments: Arguments.args, **by_name: Arguments.kwargs) -> Result:
        try:
            bound = signature.bind(*arguments, **by_name)
        except TypeError as reason:
            raise _unfit(function.__qualname__, named, by_name, reason) from None
        declared = kinds()
        for name, value in bound.arguments.items():
            if name in declared:
                parameter = signature.parameters[name]
                for each in _values(parameter, value):
                    if not declared[name].fits(each):
                        raise InputError.of(name, each, f"must be {declared[name].words}")
        return function(*arguments, **by_name)

    called.__checked__ = kinds  # type: ignore[attr-defined]  # for the test that asks whether all is declared
    return called


def with_checked_init(kind: type[Made]) -> type[Made]:
    """A class whose `__init__` is checked: of a dataclass, the one that is made for it."""
    kind.__init__ = checked(kind.__init__)  # type: ignore[method-assign]
    return kind


def _hints_of(function: Callable[..., Any]) -> dict[str, Any]:
    """Annotations of a function; a name that its module does not have is one of the package's public ones, or may be anything."""
    found: dict[str, Any] = {}
    while True:
        try:
            return get_type_hints(function, localns=found, include_extras=True)
        except NameError as unknown:
            # what a mapping would answer by itself is not asked for: from Python 3.14 on names are copied out of it first
            if unknown.name is None or unknown.name in found:
                raise
            package = import_module(__package__)
            public = unknown.name in package.__all__
            found[unknown.name] = getattr(package, unknown.name) if public else _Anything()


class _Anything:
    """An annotation of which nothing is known: its parts and unions neither."""

    def __getattr__(self, name: str) -> Any:
        """A part of it, a class of a module for instance."""
        return Any

    def __or__(self, other: Any) -> Any:
        """It, or something else."""
        return Any

    __ror__ = __getitem__ = __or__


def _values(parameter: inspect.Parameter, value: Any) -> Sequence[Any]:
    """Values of one parameter: several where it takes any number."""
    if parameter.kind is inspect.Parameter.VAR_POSITIONAL:
        return tuple(value)
    return tuple(value.values()) if parameter.kind is inspect.Parameter.VAR_KEYWORD else (value,)


def _unfit(function: str, named: Sequence[str], by_name: Mapping[str, Any], reason: TypeError) -> ArgumentError:
    """Arguments that do not fit the signature, with the name that was meant."""
    function = function.removesuffix(".__init__")
    unknown = next((name for name in by_name if name not in named), None)
    if unknown is None:
        return ArgumentError(f"{function}: {reason}; its arguments: {', '.join(named)}")
    near = get_close_matches(unknown, named, n=1)
    meant = f"is {near[0]} meant? " if near else ""
    return ArgumentError.of(f"{function}: {unknown}", by_name[unknown], f"{meant}allowed: {', '.join(named)}")


def kind_of(annotation: Any) -> Kind:
    """What a value of `annotation` may be."""
    origin, inner = get_origin(annotation), get_args(annotation)
    if annotation is Any or annotation is inspect.Parameter.empty:
        return ANYTHING
    if annotation is None or annotation is type(None):
        return Kind(lambda value: value is None, "None")
    if origin is Annotated:
        # what is held, and what may be given for it
        return kind_of(inner[1])
    if origin in (Union, types.UnionType):
        return _one_of([kind_of(each) for each in inner])
    if origin is Literal:
        return Kind(lambda value: any(type(value) is type(word) and value == word for word in inner), _listed(inner))
    if origin is not None:
        return _container(origin, inner)
    if annotation in PLAIN:
        return PLAIN[annotation]
    if not inspect.isclass(annotation):
        # variables of types: what takes them checks them
        return ANYTHING
    if Protocol in annotation.__mro__:
        return _answering(annotation)
    made = f" ({MADE_BY[annotation.__name__]})" if annotation.__name__ in MADE_BY else ""
    article = "an" if annotation.__name__[0] in "AEIOU" else "a"
    return Kind(lambda value: isinstance(value, annotation), f"{article} {annotation.__name__}{made}")


def _one_of(kinds: Sequence[Kind]) -> Kind:
    """Any of several kinds; None is said last."""
    if ANYTHING in kinds:
        return ANYTHING
    words = [kind.words for kind in sorted(kinds, key=lambda kind: kind.words == "None")]
    return Kind(lambda value: any(kind.fits(value) for kind in kinds), _listed(words))


def _container(origin: Any, inner: tuple[Any, ...]) -> Kind:
    """Sequences, mappings and functions; texts and bytes are no sequences here."""
    if not inspect.isclass(origin):
        return ANYTHING
    if Protocol in origin.__mro__:
        return _answering(origin)
    if issubclass(origin, Mapping):
        return Kind(lambda value: isinstance(value, Mapping), "a mapping by name")
    if issubclass(origin, Sequence):
        # of a tuple of given length, the places are checked where they are read
        each = kind_of(inner[0]) if len(inner) == 1 or inner[1:] == (...,) else ANYTHING
        if each is ANYTHING:
            return Kind(_in_a_row, "a list, tuple or array")
        return Kind(
            lambda value: _in_a_row(value) and all(map(each.fits, value)), f"a list or tuple, each {each.words}"
        )
    if origin is Callable:
        return Kind(callable, "a function")
    return Kind(lambda value: isinstance(value, origin), f"a {origin.__name__}")


def _answering(protocol: type) -> Kind:
    """Whatever has the methods of a protocol; one of numpy's has none that are public, and fits anything."""
    members = {name for part in protocol.__mro__ for name in vars(part) if Protocol in part.__mro__ and name[0] != "_"}
    if not members:
        return ANYTHING
    return Kind(lambda value: members <= set(dir(value)), f"an object with {', '.join(sorted(members))}")


def _in_a_row(value: Any) -> bool:
    """Whether a value is several in a row: a list, a tuple, an array; no text and no mapping."""
    if isinstance(value, str | bytes | Mapping) or not {"__len__", "__getitem__", "__iter__"} <= set(dir(value)):
        return False
    try:
        return len(value) >= 0
    except TypeError:  # an array without dimensions, a class
        return False


def is_whole(value: Any) -> bool:
    """Whether a value is a whole number; truth values are none."""
    return isinstance(value, Integral) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Whether a value is a finite number; truth values are none."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def _listed(words: Sequence[Any]) -> str:
    """`a, b or c`."""
    told = [f"'{word}'" if isinstance(word, str) and " " not in word else f"{word}" for word in words]
    told = [each.strip("'") if each.strip("'") == "None" else each for each in told]
    return told[0] if len(told) == 1 else f"{', '.join(told[:-1])} or {told[-1]}"


ANYTHING = Kind(lambda value: True, "anything")
"""What takes it checks it: quantities with a unit, arrays."""

PLAIN: dict[Any, Kind] = {
    str: Kind(lambda value: isinstance(value, str), "a text"),
    bytes: Kind(lambda value: isinstance(value, bytes | bytearray | memoryview), "bytes"),
    bool: Kind(lambda value: isinstance(value, bool), "True or False"),
    int: Kind(is_whole, "a whole number"),
    float: Kind(is_number, "a finite number"),
    os.PathLike: Kind(lambda value: isinstance(value, os.PathLike), "a path"),
    list: Kind(lambda value: isinstance(value, list | tuple), "a list or tuple"),
    dict: Kind(lambda value: isinstance(value, Mapping), "a mapping by name"),
    object: ANYTHING,
}
"""Kinds of the plain types."""
