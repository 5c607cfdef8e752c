# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tables beside an aircraft file: CSV with a comment as header and a unit suffix on every column."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

from pydantic import BeforeValidator, ValidationInfo

from ..errors import InputError, shortened
from ..text import file_beside, lines_of, plain_number, read_text
from ..units import convert
from .number import Provenance, provenance_of
from .shipped import SHIPPED, folder_of

SUFFIXES = {
    "deg": "deg",
    "rad": "rad",
    "m": "m",
    "ft": "ft",
    "in": "in",
    "m2": "m2",
    "ft2": "ft2",
    "m3": "m3",
    "ft3": "ft3",
    "kg_m": "kg/m",
    "kgm": "kg m",
    "Nm2": "N m2",
    "m_s": "m/s",
    "in_s": "in/s",
    "N": "N",
    "lbf": "lbf",
}
"""Unit of each column suffix; `_R` is a fraction of the radius, no suffix a number without dimension."""

LARGEST = {
    "1": (1e3, "coefficients and ratios are of order one"),
    "rad": (2.0 * math.pi, "a turn, the whole range of any angle"),
    "m": (100.0, "the largest rotor flown has a radius of 17.5 m"),
    "m2": (1e4, "flat-plate area of a body 100 m long"),
    "m3": (1e5, "flat-plate area times length of a body 100 m long"),
    "kg/m": (1e5, "solid steel a metre square has 8e3 kg/m"),
    "kg m": (1e5, "solid steel a metre square has 1.3e3 kg m"),
    "N m2": (1e12, "solid steel a metre square has 1.8e10 N m2"),
    "m/s": (100.0, "a damper's piston does not reach a third of the speed of sound"),
    "N": (1e7, "weight of a thousand tonnes"),
}
"""Largest magnitude of a table's cell by its dimension, and why: beyond it is a slip of the file, not a helicopter."""


@dataclass(frozen=True)
class TableFile:
    """A CSV file, read: columns by header, comment lines, where it comes from; `texts`: columns that hold text."""

    path: Path
    columns: dict[str, tuple[float, ...]]
    comment: str
    provenance: Provenance
    texts: tuple[tuple[str, tuple[str, ...]], ...] = ()
    content: str = ""
    """Text of the file, as it was read."""

    def error(self, column: str, value: object, allowed: str) -> InputError:
        """Error about one column of this file."""
        return InputError.of(column, value, allowed, file=self.path)

    def column(self, base: str, si_unit: str, radius: float | None = None) -> list[float]:
        """Column `base` in `si_unit`; its header has a suffix of that dimension (`_R`: times `radius`)."""
        if si_unit == "1" and base in self.columns:
            return self._bounded(base, list(self.columns[base]), si_unit)
        found: list[tuple[str, list[float]]] = []
        for header, values in self.columns.items():
            suffix = header.removeprefix(base + "_") if header.startswith(base + "_") else None
            if suffix == "R" and radius is not None:
                found.append((header, [value * radius for value in values]))
            elif suffix in SUFFIXES:
                try:
                    found.append((header, [convert(value, SUFFIXES[suffix], si_unit) for value in values]))
                except ValueError as reason:
                    raise self.error(header, f"column in {SUFFIXES[suffix]}", str(reason)) from reason
        if len(found) != 1:
            allowed = self._suffixes(si_unit, radius)
            given = ", ".join(header for header, _ in found) or "missing"
            raise self.error(base, given, f"one column is needed, {base} with a suffix of {allowed}")
        return self._bounded(*found[0], si_unit)

    def _bounded(self, header: str, values: list[float], si_unit: str) -> list[float]:
        """`values` if none is beyond what a helicopter can have of its dimension."""
        largest, why = LARGEST[si_unit]
        for value in values:
            if not abs(value) <= largest:
                raise self.error(header, f"{value:g} {si_unit}", f"must lie within +-{largest:g} {si_unit}: {why}")
        return values

    def refuse_unused(self, bases: tuple[str, ...], zero_is_nothing: bool = False) -> None:
        """Refuse a column that would be dropped: one that is none of `bases`, no note, and says something.

        A note is a column whose name begins with `note`, text under `source` or `conf...`, or text that is the same in every
        line. zero_is_nothing: an unknown column of zeros (sweep of a straight blade) says nothing and is let through.
        """
        allowed = f"unknown column, it would not be used; allowed: {', '.join(bases)}, note..."
        for header, values in self.columns.items():
            if header.startswith("note") or any(_is_of(header, base) for base in bases):
                continue
            if not zero_is_nothing:
                raise self.error(header, f"{values[0]:g} ...", allowed)
            said = next((value for value in values if value != 0.0), None)
            if said is not None:
                raise self.error(header, f"{said:g}", f"{allowed}; others only where all zero")
        for header, cells in self.texts:
            if header.startswith(("note", "source", "conf")) or len(set(cells)) == 1:
                continue
            if header in ("airfoil", "section"):
                several = "several sections are named by [[rotor.airfoil]] with their stations"
                raise self.error(header, ", ".join(dict.fromkeys(cells)), f"must be the same in every line: {several}")
            raise self.error(header, cells[0], f"column of text that varies; {allowed}")

    def has(self, base: str) -> bool:
        """Whether there is a column `base`, with or without suffix."""
        return any(header == base or header.rsplit("_", 1)[0] == base for header in self.columns)

    def _suffixes(self, si_unit: str, radius: float | None) -> str:
        names = ["_R"] if radius is not None else []
        for suffix, unit in SUFFIXES.items():
            try:
                convert(1.0, unit, si_unit)
            except ValueError:
                continue
            names.append("_" + suffix)
        return ", ".join(names) or "none (no unit)"


def _is_of(header: str, base: str) -> bool:
    """Whether `header` is the column `base`, bare or with the suffix of a unit; `M...` is any Mach number."""
    if base == "M...":
        return header.startswith("M") and plain_number(header[1:]) is not None
    suffix = header.removeprefix(base + "_") if header.startswith(base + "_") else None
    return header == base or suffix == "R" or suffix in SUFFIXES


def read_csv(path: Path, provenance: Provenance, content: str | None = None) -> TableFile:
    """Read a CSV file: `#` lines first, one header line, numbers, and columns of text where no cell is a number.

    content: its text, where it is known.
    """
    try:
        content = read_text(path) if content is None else content
        lines = lines_of(content)
    except ValueError as reason:
        raise ValueError(f"names the file {path}, which {reason}") from reason
    comment = [line[1:].strip() for line in lines if line.startswith("#")]
    rows = [[cell.strip() for cell in line.split(",")] for line in lines if line.strip() and not line.startswith("#")]
    if len(rows) < 2:
        raise ValueError(f"names the file {path}, which has no header line with numbers below it")
    header, body = rows[0], rows[1:]
    if len(header) == 1 and ";" in header[0]:
        raise ValueError(f"names the file {path}, whose columns are parted by semicolons; commas are needed")
    if len(set(header)) != len(header):
        raise ValueError(f"names the file {path}, in which a column stands twice")
    for row in body:
        if len(row) != len(header):
            raise ValueError(f"names the file {path}, whose line '{','.join(row)[:40]}' has not {len(header)} columns")
    columns: dict[str, tuple[float, ...]] = {}
    texts: list[tuple[str, tuple[str, ...]]] = []
    for index, name in enumerate(header):
        cells = [row[index] for row in body]
        numbers = [number for number in map(plain_number, cells) if number is not None]
        if not numbers and not any(map(_is_float, cells)):
            texts.append((name, tuple(cells)))
            continue
        if len(numbers) != len(cells):
            wrong = next(cell for cell in cells if plain_number(cell) is None)
            told = f"whose column {shortened(name, 40)} holds '{shortened(wrong, 40)}', not a finite number"
            raise ValueError(f"names the file {path}, {told}")
        columns[name] = tuple(numbers)
    return TableFile(path, columns, "\n".join(comment), provenance, tuple(texts), content)


def in_place(columns: Any, provenance: Provenance, info: ValidationInfo) -> TableFile:
    """Table written in the file itself: lists of numbers by the header of their column."""
    if not isinstance(columns, dict) or not columns:
        raise ValueError("has columns that are not lists of numbers by name")
    lengths = set()
    for name, values in columns.items():
        if not isinstance(values, list) or not values or not all(map(_is_finite, values)):
            raise ValueError(f"has the column {name}, which is not a list of finite numbers")
        lengths.add(len(values))
    if len(lengths) != 1:
        raise ValueError("has columns of different length")
    path = (info.context or {}).get("file", Path(str(info.field_name)))
    numbers = {name: tuple(float(v) for v in values) for name, values in columns.items()}
    return TableFile(Path(f"{path}: {info.field_name}"), numbers, "", provenance)


def _is_float(cell: str) -> bool:
    """Whether a cell is a number, finite or not."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _is_finite(value: Any) -> bool:
    """Whether a value of a TOML list is a number that is finite as a float."""
    try:
        return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:
        return False


def _validate(entry: Any, info: ValidationInfo) -> TableFile:
    allowed = "a table { table, source, confidence } naming a CSV file beside this one, or { columns, ... } in place"
    provenance = provenance_of(entry, info, {"table", "columns", "source", "confidence", "note"}, allowed)
    if "columns" in entry and "table" in entry:
        raise ValueError("has both a table and columns; one of the two is used")
    if "columns" in entry:
        return in_place(entry["columns"], provenance, info)
    name = entry.get("table")
    if not isinstance(name, str) or not name:
        raise ValueError(f"must be {allowed}")
    published = Provenance(name, "table", provenance.sources, provenance.confidence, provenance.note)
    table = read_csv(*file_of(name, info, published))
    keep(info, name, table.content)
    return table


def keep(info: ValidationInfo, name: str, content: str) -> None:
    """Remember the text of a file by the name it is given: an aircraft knows what it was read from."""
    (info.context or {}).get("contents", {})[name] = content


def file_of(name: str, info: ValidationInfo, provenance: Provenance) -> tuple[Path, Provenance, str | None]:
    """Path of a file named in the one that is read, its provenance, and its text where it was read before."""
    context = info.context or {}
    known = context.get("known", {}).get(name)
    if known is not None:
        return Path(context.get("directory", ".")) / name, provenance, known
    return named_file(name, info), provenance, None


def named_file(name: str, info: ValidationInfo) -> Path:
    """Path of a file named in the one that is read: beside it or below, elsewhere where the user allows it.

    A shipped aircraft, a colon and a name (`bo105:naca23012_cl.csv`) is a table of that aircraft.
    """
    aircraft, colon, of_shipped = name.partition(":")
    if colon and aircraft in SHIPPED:
        return file_beside(folder_of(aircraft), of_shipped)
    context = info.context or {}
    return file_beside(Path(context.get("directory", ".")), name, context.get("allow_outside", False))


Table = Annotated[TableFile, BeforeValidator(_validate)]
"""Type of a table named in an aircraft file."""


HIGHEST_MACH = 2.0
"""Highest Mach number of a section table: no blade of a helicopter flies faster."""


def ascending(table: TableFile, name: str, values: list[float]) -> None:
    """Refuse a column that does not ascend strictly."""
    for before, after in itertools.pairwise(values):
        if not after > before:
            raise table.error(name, f"{before:g}, {after:g}", "must ascend strictly")


def covering(table: TableFile, name: str, values: list[float], low: float, high: float, what: str) -> None:
    """Refuse a column that does not reach from `low` to `high` (SI, to rounding)."""
    slack = 1e-6 * max(abs(low), abs(high), 1e-12)
    if values[0] > low + slack or values[-1] < high - slack:
        raise table.error(name, f"{values[0]:.6g} .. {values[-1]:.6g}", f"must cover {what}")


def curve(table: TableFile, x: str, x_unit: str, y: str, y_unit: str) -> dict[str, list[float]]:
    """Piecewise linear function {x, y} in SI."""
    arguments = table.column(x, x_unit)
    ascending(table, x, arguments)
    return {"x": arguments, "y": table.column(y, y_unit)}


def grid(table: TableFile, x: str, y: str, value: str, unit: str) -> dict[str, list[Any]]:
    """Bilinear function {x, y, values} in SI from a table in long form: one line for each pair of angles."""
    rows, columns = table.column(x, "rad"), table.column(y, "rad")
    values = table.column(value, unit)
    axis_x, axis_y = sorted(set(rows)), sorted(set(columns))
    cells = dict(zip(zip(rows, columns, strict=True), values, strict=True))
    if len(cells) != len(values) or len(cells) != len(axis_x) * len(axis_y):
        allowed = f"must hold every pair of {x} and {y} once ({len(axis_x)} x {len(axis_y)})"
        raise table.error(f"{x}, {y}", f"{len(values)} lines", allowed)
    return {"x": axis_x, "y": axis_y, "values": [[cells[a, b] for b in axis_y] for a in axis_x]}


def by_mach(table: TableFile) -> dict[str, list[Any]]:
    """Section coefficient {x, y, values}: alpha [rad], by Mach number, held beyond its first and last."""
    table.refuse_unused(("alpha", "M..."))
    alpha = table.column("alpha", "rad")
    ascending(table, "alpha", alpha)
    headers = [header for header in table.columns if header.startswith("M") and plain_number(header[1:]) is not None]
    mach = [float(header[1:]) for header in headers]
    if not mach:
        raise table.error("M...", "missing", "columns by Mach number are needed, such as M0.0, M0.3")
    ascending(table, "M...", mach)
    if mach[0] < 0.0 or mach[-1] > HIGHEST_MACH:
        raise table.error(
            "M...", f"{mach[0]:g} .. {mach[-1]:g}", f"Mach numbers must lie between 0 and {HIGHEST_MACH:g}"
        )
    values = [[table.columns[header][row] for header in headers] for row in range(len(alpha))]
    return {"x": alpha, "y": mach, "values": values}
