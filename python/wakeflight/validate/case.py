# SPDX-License-Identifier: MIT OR Apache-2.0
"""A reference case: a folder with its data, its source and a function that asks the program for the same quantities."""

from __future__ import annotations

import csv
import importlib.util
import math
import sys
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KINDS = ("exact", "measured", "waits")
_REQUIRED = ("id", "title", "group", "kind", "source", "confidence", "read", "tolerance", "tests")
_OPTIONAL = ("slow", "waits_for", "settings")


@dataclass(frozen=True)
class Check:
    """One number beside its reference.

    tolerance: allowed difference, absolute in `unit` or `relative` to the reference. gate: False for a number that is shown
    without a verdict, because the reference states none or the quantity only explains another.
    """

    quantity: str
    ours: float
    reference: float
    tolerance: float = math.nan
    unit: str = "-"
    kind: Literal["absolute", "relative"] = "absolute"
    gate: bool = True
    note: str = ""

    def __post_init__(self) -> None:
        """Plain numbers, whatever scalars were given."""
        for name in ("ours", "reference", "tolerance"):
            object.__setattr__(self, name, float(getattr(self, name)))

    @property
    def difference(self) -> float:
        """Ours less the reference, over the reference where the tolerance is relative."""
        difference = self.ours - self.reference
        if self.kind == "relative":
            return difference / abs(self.reference) if self.reference != 0.0 else math.copysign(math.inf, difference)
        return difference

    @property
    def within(self) -> bool | None:
        """Whether the difference keeps the tolerance; None where there is no verdict. A number that is not finite never does."""
        if not self.gate:
            return None
        return math.isfinite(self.ours) and abs(self.difference) <= self.tolerance

    @classmethod
    def largest(
        cls,
        quantity: str,
        ours: Sequence[float] | np.ndarray,
        reference: Sequence[float] | np.ndarray,
        tolerance: float,
        unit: str = "-",
        kind: Literal["absolute", "relative"] = "absolute",
        note: str = "",
    ) -> Check:
        """The worst of many numbers; relative differences are over each reference."""
        mine, theirs = np.asarray(ours, float).ravel(), np.asarray(reference, float).ravel()
        if mine.shape != theirs.shape or mine.size == 0:
            raise ValueError(f"{quantity}: {mine.size} numbers beside {theirs.size} references")
        error = np.abs(mine - theirs)
        if kind == "relative":
            error = error / np.abs(theirs)
        # what is not finite is the worst of all
        worst = int(np.argmax(np.where(np.isfinite(error), error, np.inf)))
        text = f"worst of {mine.size}" + (f"; {note}" if note else "")
        return cls(quantity, float(mine[worst]), float(theirs[worst]), tolerance, unit, kind, note=text)


@dataclass(frozen=True)
class Outcome:
    """What a case found: numbers, a figure, and what they mean in plain words."""

    checks: Sequence[Check]
    figure: Figure | None = None
    notes: Sequence[str] = ()


@dataclass(frozen=True)
class Table:
    """A data file: the lines of its header without the comment mark, and its columns by name."""

    header: tuple[str, ...]
    columns: dict[str, np.ndarray] = field(repr=False)

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), ()))

    def where(self, **values: Any) -> Table:
        """The rows whose columns have these values."""
        keep = np.ones(len(self), bool)
        for name, value in values.items():
            keep &= self.columns[name] == value
        return Table(self.header, {name: column[keep] for name, column in self.columns.items()})


@dataclass(frozen=True)
class Case:
    """A case as its folder describes it."""

    folder: Path
    meta: dict[str, Any]

    @classmethod
    def read(cls, folder: Path) -> Case:
        """The case in `folder`; raises `InputError` naming what its `case.toml` lacks."""
        path = folder / "case.toml"
        try:
            meta = tomllib.loads(path.read_text(encoding="utf-8"))
        except (OSError, tomllib.TOMLDecodeError) as reason:
            raise InputError.of("case", str(path), str(reason)) from reason
        for key in _REQUIRED:
            if key not in meta:
                raise InputError.of(key, "missing", f"needed are {', '.join(_REQUIRED)}", path)
        unknown = set(meta) - {*_REQUIRED, *_OPTIONAL}
        if unknown:
            raise InputError.of(sorted(unknown)[0], "given", f"allowed are {', '.join((*_REQUIRED, *_OPTIONAL))}", path)
        if meta["kind"] not in KINDS:
            raise InputError.of("kind", meta["kind"], f"allowed: {', '.join(KINDS)}", path)
        if (meta["kind"] == "waits") != ("waits_for" in meta):
            raise InputError.of("waits_for", meta.get("waits_for", "missing"), "goes with kind = 'waits'", path)
        return cls(folder, meta)

    @property
    def slug(self) -> str:
        """Name of the folder."""
        return self.folder.name

    @property
    def id(self) -> str:
        """Identifier in the bank of cases."""
        return str(self.meta["id"])

    @property
    def title(self) -> str:
        """What the case is."""
        return str(self.meta["title"])

    @property
    def group(self) -> str:
        """Group of cases it belongs to."""
        return str(self.meta["group"])

    @property
    def kind(self) -> str:
        """`exact`, `measured`, or `waits` for a part of the program that is not there yet."""
        return str(self.meta["kind"])

    @property
    def slow(self) -> bool:
        """Whether it takes more than a few seconds."""
        return bool(self.meta.get("slow", False))

    @cached_property
    def words(self) -> str:
        """The case's README."""
        return (self.folder / "README.md").read_text(encoding="utf-8")

    def path(self, name: str) -> Path:
        """A file of the case, or of the folder `rotors` beside it."""
        own = self.folder / name
        return own if own.exists() else self.folder.parent / name

    def table(self, name: str) -> Table:
        """A CSV file with `#` lines on top: columns of numbers where every entry is one, else of text."""
        lines = self.path(name).read_text(encoding="utf-8").splitlines()
        header = tuple(line[1:].strip() for line in lines if line.startswith("#"))
        rows = list(csv.reader(line for line in lines if line.strip() and not line.startswith("#")))
        names, body = rows[0], rows[1:]
        columns = {key.strip(): _column([row[i].strip() for row in body]) for i, key in enumerate(names)}
        return Table(header, columns)

    def toml(self, name: str) -> dict[str, Any]:
        """A TOML file of the case."""
        return tomllib.loads(self.path(name).read_text(encoding="utf-8"))

    def run(self) -> Outcome:
        """Ask the program: `run(case)` of the case's `case.py`."""
        path = self.folder / "case.py"
        name = f"wakeflight_case_{self.slug.replace('-', '_')}"
        spec = importlib.util.spec_from_file_location(name, path)
        if spec is None or spec.loader is None or not path.is_file():
            raise InputError.of("case", str(path), "no such file")
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        sys.path.insert(0, str(self.folder.parent))
        try:
            spec.loader.exec_module(module)
            outcome = module.run(self)
        finally:
            sys.path.remove(str(self.folder.parent))
        if not isinstance(outcome, Outcome) or not outcome.checks:
            raise TypeError(f"{path}: run(case) must return an Outcome with at least one check")
        return outcome


def _column(texts: list[str]) -> np.ndarray:
    """Numbers, an empty entry being one that is missing, or texts where any entry is no number."""
    try:
        return np.array([float(text) if text else math.nan for text in texts])
    except ValueError:
        return np.array(texts)
