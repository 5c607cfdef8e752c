# SPDX-License-Identifier: MIT OR Apache-2.0
"""A study as text: values, error estimates and orders by quantity, cost by setting; the same rows for terminal and page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .estimate import NOTHING, Estimate

if TYPE_CHECKING:
    from .findings import Findings

Block = tuple[str, list[list[str]]]
"""A heading and its rows, the first row naming the columns."""


def blocks(study: Findings) -> list[Block]:
    """Tables of the study: values (of a trim), errors with orders, cost."""
    found = [_errors(study), _cost(study)]
    return found if study.is_history else [_values(study), *found]


def table(study: Findings) -> str:
    """The study for a terminal."""
    parts = [study.title, *notes(study)]
    for heading, rows in blocks(study):
        widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
        last = len(widths) - 1
        lines = [
            "  ".join(
                cell.ljust(width) if i < 2 or (i == last and not _number(rows[1][i])) else cell.rjust(width)
                for i, (cell, width) in enumerate(zip(row, widths, strict=True))
            ).rstrip()
            for row in rows
        ]
        parts.append("\n".join(["", heading, *lines]))
    return "\n".join(parts)


def markdown(study: Findings) -> str:
    """The study as a section of a page."""
    parts = [f"## {study.title}", "\n".join(notes(study))]
    for heading, rows in blocks(study):
        lines = ["| " + " | ".join(row) + " |" for row in rows]
        lines.insert(1, "|" + "---|" * len(rows[0]))
        parts += [f"{heading}:", "\n".join(lines)]
    return "\n\n".join(part for part in parts if part)


def notes(study: Findings) -> list[str]:
    """What a reader must know before the numbers."""
    found = []
    if study.parameter.physical:
        found.append(
            f"{study.parameter.name} is a number of the physical model: differences are its influence, not an error"
        )
    if study.is_history:
        found.append(f"histories compared at {study.times.size} common instants up to {study.times[-1]:.3f} s")
    found += [f"{label}: {text}" for label, o in zip(study.labels, study.outcomes, strict=True) for text in o.notes]
    return [*found, *(f"failed: {text}" for text in study.failures)]


def _values(study: Findings) -> Block:
    rows = [["quantity", "unit", *study.labels, "limit"]]
    for i, (quantity, found) in enumerate(zip(study.quantities, study.estimates, strict=True)):
        values = [_plain(value, 6) for value in study.samples[:, 0, i]]
        rows.append(
            [quantity.name, quantity.unit, *values, _plain(found.limit[0], 6) if found.order is not None else "–"]
        )
    return "values", rows


def _errors(study: Findings) -> Block:
    """Errors: of a trim in its unit, of a history root mean square (largest) in per cent of its excursion."""
    same = len({found.note for found in study.estimates}) == 1
    rows = [["quantity", "of" if study.is_history else "unit", *study.labels, "order", *([] if same else ["basis"])]]
    for i, (quantity, found) in enumerate(zip(study.quantities, study.estimates, strict=True)):
        scale = study.scales[i]
        cells = []
        for rms, largest in zip(found.error, found.largest, strict=True):
            if rms is None or largest is None:
                cells.append("–")
            elif not study.is_history:
                cells.append(_plain(rms, 2))
            elif scale > 0.0:
                cells.append(f"{100 * rms / scale:.2g} ({100 * largest / scale:.2g})")
            else:
                cells.append(f"{rms:.2g} {quantity.unit}")
        unit = f"{scale:.3g} {quantity.unit}" if study.is_history else quantity.unit
        order = f"{found.order:.2f}" if found.order is not None else "–"
        rows.append([quantity.name, unit, *cells, order, *([] if same else [basis(found)])])
    heading = "error, per cent of the excursion: root mean square (largest)" if study.is_history else "error, magnitude"
    return f"{heading}; against the {basis(study.estimates[0])}" if same else heading, rows


def basis(found: Estimate) -> str:
    """What an error is measured against, and why."""
    return "limit, extrapolated" if found.order is not None else f"finest; {found.note}"


def _cost(study: Findings) -> Block:
    rows = [["cost", "unit", *study.labels]]
    rows.append(["wall clock", "s", *(f"{o.seconds:.2f}" for o in study.outcomes)])
    rows.append(["processor", "s", *(f"{o.cpu_seconds:.2f}" for o in study.outcomes)])
    for name in study.counters:
        rows.append([name.replace("_", " "), "1", *(f"{o.counters.get(name, 0):.4g}" for o in study.outcomes)])
    return "cost", rows


def _plain(value: float, digits: int) -> str:
    return f"{0.0 if abs(value) < NOTHING else value:.{digits}g}"


def _number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
