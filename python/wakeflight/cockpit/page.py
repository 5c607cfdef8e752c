# SPDX-License-Identifier: MIT OR Apache-2.0
"""The cockpit's page: one text with its style and program in it, so that nothing else is asked for."""

from __future__ import annotations

from functools import cache
from importlib import resources

import jinja2

SCRIPTS = ("view.js", "instruments.js", "hands.js", "cockpit.js")
"""In the order in which they stand on each other."""


def page(nonce: str) -> str:
    """The page; nonce: the mark that its style and program carry."""
    return _template().render(nonce=nonce, style=_file("cockpit.css"), scripts=[_file(name) for name in SCRIPTS])


@cache
def _template() -> jinja2.Template:
    return jinja2.Environment(autoescape=True).from_string(_file("cockpit.html"))


@cache
def _file(name: str) -> str:
    return (resources.files(__package__) / "templates" / name).read_text(encoding="utf-8")
