# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight list`."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .groups import offered

KINDS = ("aircraft", "maneuvers", "inflow", "presets", "formats", "cases")


def listing(
    kind: Annotated[
        str | None,
        typer.Argument(metavar="[KIND]", help=", ".join(KINDS), show_default="all", autocompletion=offered(*KINDS)),
    ] = None,
    cases: Annotated[
        Path | None, typer.Option("--cases", help="folder of cases", show_default="validation/ of the checkout")
    ] = None,
) -> None:
    """Print what there is by name: aircraft, manoeuvres, inflow models, presets, formats of export, reference cases."""
    if kind is not None and kind not in KINDS:
        raise InputError.choice("KIND", kind, KINDS)
    tables: dict[str, Callable[[], Iterator[tuple[str, str]]]] = {
        "aircraft": _aircraft,
        "maneuvers": _maneuvers,
        "inflow": _inflow,
        "presets": _presets,
        "formats": _formats,
        "cases": lambda: _cases(cases),
    }
    for name in KINDS if kind is None else (kind,):
        print(name)
        for label, text in tables[name]():
            print(f"  {label:<18}{text}")


def _aircraft() -> Iterator[tuple[str, str]]:
    from ..aircraft import SHIPPED, load_aircraft
    from ..units import shown

    for name in SHIPPED:
        loaded = load_aircraft(name)
        rotor = loaded.rotor
        weight = shown(loaded.condition.weight or 0.0, "lbf")
        yield name, f"{loaded.name}: {int(rotor.n_blades)} blades, radius {float(rotor.radius):.2f} m, {weight}"


def _maneuvers() -> Iterator[tuple[str, str]]:
    from ..maneuver_files import SHIPPED, load_maneuver

    for name in SHIPPED:
        loaded = load_maneuver(name)
        moved = ", ".join(stick for stick, _ in loaded.corners_of)
        yield name, f"{moved}, {loaded.revolutions or 0.0:g} revolutions"


def _inflow() -> Iterator[tuple[str, str]]:
    from ..inflow import STAND_MODELS

    for name, model in STAND_MODELS.items():
        yield name, (model.__doc__ or "").strip().splitlines()[0]


def _presets() -> Iterator[tuple[str, str]]:
    from ..presets import PRESETS

    for name, options in PRESETS.items():
        yield name, ", ".join(f"{key}={value}" for key, value in options.items()) or "the defaults of every option"


def _formats() -> Iterator[tuple[str, str]]:
    from ..export import FORMATS

    for name, (text, _) in FORMATS.items():
        yield name, text


def _cases(folder: Path | None) -> Iterator[tuple[str, str]]:
    from .. import validate

    try:
        found = validate.cases(validate.cases_folder(folder))
    except InputError:
        if folder is not None:
            raise
        yield "none here", "reference cases are in validation/ of a checkout: stand in one, or give --cases DIR"
        return
    for case in found:
        yield case.id, case.title
