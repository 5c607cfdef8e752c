# SPDX-License-Identifier: MIT OR Apache-2.0
"""Small tables by which objects show themselves, in a notebook and printed."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape


def html_table(title: str, rows: Iterable[tuple[str, str]]) -> str:
    """A table of names and values under a title."""
    lines = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th><td style='text-align:left'>{escape(value)}</td></tr>"
        for name, value in rows
    )
    return f"<table><caption>{escape(title)}</caption>{lines}</table>"


def text_table(rows: Iterable[tuple[str, str]]) -> str:
    """A table of names and values to print, one line each."""
    rows = list(rows)
    width = max(len(name) for name, _ in rows)
    return "\n".join(f"{name:<{width}}  {value.strip()}" for name, value in rows)
