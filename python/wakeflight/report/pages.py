# SPDX-License-Identifier: MIT OR Apache-2.0
"""How pages are made of their templates: every name escaped, nothing left undefined."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment


@dataclass(frozen=True)
class Drawn:
    """A figure in a page: its name, its caption and its PNG as base64 text."""

    name: str
    caption: str
    png: str


def environment(*packages: str) -> Environment:
    """Templates of the packages of these names, the first that has one."""
    from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=ChoiceLoader([PackageLoader(each, "templates") for each in packages]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
