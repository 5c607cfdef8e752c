# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a study leaves in the report: what was done, a figure, a table and a finding."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.figure import Figure

    from ..statements import Statement


@dataclass(frozen=True)
class Finding:
    """An entry of the report; `name` is that of its figure's file."""

    name: str
    title: str
    done: str
    figure: Figure
    head: tuple[str, ...]
    rows: list[list[str]]
    finding: str


def verdict_changes(base: Sequence[Statement], other: Sequence[Statement]) -> list[tuple[str, str, str]]:
    """Statements whose verdict differs between two tables: where, verdict of the first, of the second."""
    return [(a.key, a.verdict, b.verdict) for a, b in zip(base, other, strict=True) if a.verdict != b.verdict]
