# SPDX-License-Identifier: MIT OR Apache-2.0
"""The verb that is meant; those of the package are imported only where one of them is."""

from __future__ import annotations

from typing import Any

from ..errors import InputError
from .verb import Own, Verb


def verb_of(given: Any) -> Verb:
    """A verb by its name or its function; any other function of a case as it is."""
    module = ""
    match given:
        case str():
            module = "wakeflight"
        case object(__module__=str() as found):
            module = found
    if module.split(".")[0] == "wakeflight":
        from .verbs import VERBS, built_in

        made = built_in(given)
        if made is not None:
            return made
        if isinstance(given, str):
            raise InputError.choice("verb", given, VERBS, ", or a function of a case")
    return Own(given)
