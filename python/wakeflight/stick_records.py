# SPDX-License-Identifier: MIT OR Apache-2.0
"""Recorded sticks: a CSV file with a column of times and one for each stick that moves, a unit on every column.

# comment
time_s,lateral_in,longitudinal_in
0.000,0.02,-0.11
"""

from __future__ import annotations

import itertools
from pathlib import Path

from .errors import InputError
from .sticks import STICKS
from .text import lines_of, plain_number, read_text
from .units import convert

ABOUT = ("first", "trim", "stop")
"""What recorded inches count from: the first sample, trim, or the stick's stop."""

LONGEST_JOIN = 60.0
"""Longest time [s] within which a stick goes from trim to where its record is."""

Record = dict[str, list[tuple[float, float]]]
"""Samples (time [s], inches) of every stick that moves."""


def read_sticks(path: Path, about: str = "first") -> Record:
    """Samples of a file, times from its first one; InputError names file, column and line.

    about: `first`: inches count from the first sample, which is trim; `trim`, `stop`: they are as they stand.
    """
    if about not in ABOUT:
        raise InputError.choice("about", about, ABOUT, file=path)
    try:
        lines = [line for line in lines_of(read_text(path)) if line.strip() and not line.startswith("#")]
    except ValueError as reason:
        raise InputError(f"{path}: {reason}") from reason
    header = [cell.strip() for cell in lines[0].split(",")] if lines else []
    units = {name: _unit(path, column, name) for column in header for name in [_quantity(path, column)] if name}
    for name in ("time", *units):
        if [_quantity(path, column) for column in header].count(name) != 1:
            raise InputError.of(name, "missing or twice", "must be one column, time_s, lateral_in, ...", file=path)
    if len(units) < 2 or len(lines) < 3:
        allowed = "must have times, at least one stick, and two lines: time_s,lateral_in"
        raise InputError.of("columns", ", ".join(header), allowed, file=path)
    samples: dict[str, list[float]] = {name: [] for name in units}
    for number, line in enumerate(lines[1:], 2):
        cells = line.split(",")
        if len(cells) != len(header):
            raise InputError.of(f"line {number}", line, f"must have {len(header)} columns", file=path)
        for column, cell in zip(header, cells, strict=True):
            measured = _quantity(path, column)
            if measured is None:
                continue
            value = plain_number(cell)
            if value is None:
                raise InputError.of(f"{column}, line {number}", cell.strip(), "must be a finite number", file=path)
            samples[measured].append(value * units[measured])
    times = [each - samples["time"][0] for each in samples["time"]]
    for before, after in itertools.pairwise(times):
        if not after > before:
            raise InputError.of("time", f"{before:g} s, {after:g} s", "times must ascend strictly", file=path)
    found: Record = {}
    for stick in (each for each in STICKS if each in samples):
        first = samples[stick][0] if about == "first" else 0.0
        found[stick] = [(t, x - first) for t, x in zip(times, samples[stick], strict=True)]
    return found


def _quantity(path: Path, column: str) -> str | None:
    """What a column holds: `time`, a stick, or None of a note."""
    if column.startswith("note"):
        return None
    name = column.partition("_")[0]
    if name not in ("time", *STICKS):
        raise InputError.choice(
            "column", column, ("time_s", *(f"{stick}_in" for stick in STICKS), "note..."), file=path
        )
    return name


def _unit(path: Path, column: str, name: str) -> float:
    """Seconds or inches in a unit of a column."""
    unit, wanted = column.partition("_")[2], "s" if name == "time" else "in"
    try:
        if not unit:
            raise ValueError(f"must have its unit behind its name, {name}_{wanted}")
        return convert(1.0, unit, wanted)
    except ValueError as reason:
        raise InputError.of("column", column, str(reason), file=path) from None
