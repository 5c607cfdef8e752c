# SPDX-License-Identifier: MIT OR Apache-2.0
"""Options of the inflow model as they are typed: a preset, NAME=VALUE of any of them, flags of their own for three."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..errors import InputError

if TYPE_CHECKING:
    from .groups import Wake

OPTION_OF = {"azimuth_step": "azimuth_step", "wake_turns": "turns", "wake_scheme": "scheme"}
"""Option of the inflow model by its name in `Wake`, of those that have a flag of their own."""


def typed_options(model: str, wake: Wake, lenient: bool) -> dict[str, Any]:
    """Options of the inflow model of that name: those of a preset, replaced by those typed one by one.

    lenient: leave out options that other models have instead of refusing them.
    """
    from ..options import DECLARED, option_of, options_of
    from ..presets import preset

    known, anywhere = options_of(model), {option.name for option in DECLARED}
    given = wake.given()
    arguments = [each.split("=", 1) for each in given.pop("wake", [])]
    options: dict[str, Any] = {}
    for flag, value in given.items():
        if OPTION_OF[flag] in known:
            options[OPTION_OF[flag]] = value
        elif not lenient:
            raise InputError.of(f"--{flag.replace('_', '-')}", value, f"not an option of --inflow {model}")
    presets = [name for name, *value in arguments if not value]
    if len(presets) > 1:
        raise InputError.of("--wake", ", ".join(presets), "one preset at a time")
    for name, text in (each for each in arguments if len(each) == 2):
        option = name.strip()
        if option in options:
            raise InputError.of("--wake", f"{name}={text}", f"{option} is given twice")
        if not (lenient and option in anywhere - set(known)):
            options[option] = option_of(model, option, "--wake").read(text)
    return {**(preset(model, presets[0].strip()) if presets else {}), **options}
