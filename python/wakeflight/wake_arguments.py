# SPDX-License-Identifier: MIT OR Apache-2.0
"""`--wake` of the command line: a preset, or NAME=VALUE of any option of the inflow model."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

import typer

from .errors import InputError

WakeArguments = Annotated[
    list[str] | None,
    typer.Option("--wake", metavar="PRESET|NAME=VALUE", help="standard, paper, reference, or any option; repeatable"),
]


def with_arguments(model: Any, arguments: list[str] | None, given: dict[str, Any], lenient: bool = False) -> Any:
    """`model` with the preset and the options of `arguments`, and with those `given` by flags of their own.

    lenient: leave out options that another model has instead of refusing them.
    """
    from .options import DECLARED, option_of, options_of
    from .presets import preset

    known = options_of(model.name)
    presets = [each.strip() for each in arguments or [] if "=" not in each]
    if len(presets) > 1:
        raise InputError.of("--wake", ", ".join(presets), "one preset at a time")
    options = preset(model.name, presets[0]) if presets else {}
    typed = dict(given)
    for each in arguments or []:
        if "=" not in each:
            continue
        name, text = (part.strip() for part in each.split("=", 1))
        if name in typed:
            raise InputError.of("--wake", each, f"{name} is given twice")
        if lenient and name not in known and any(name == option.name for option in DECLARED):
            continue
        typed[name] = option_of(model.name, name, "--wake").read(text)
    return replace(model, **{**options, **typed})
