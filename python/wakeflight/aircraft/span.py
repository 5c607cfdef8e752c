# SPDX-License-Identifier: MIT OR Apache-2.0
# mypy: disable-error-code="valid-type"
# annotations are made by calls (unit, range): types to pydantic, not to mypy
"""Sections along the span: what a file may hold of them, and their tables as the core is given them.

One `[rotor.airfoil]` holds along the whole span. Several, `[[rotor.airfoil]]`, either name `stations`, between which tables
are linear in the station and beyond which they are held, or an `extent` each, within which they hold.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, ValidationInfo, model_validator

from ..errors import InputError, known
from ..text import read_text
from .airfoils import EXTENSIONS, NAMED_WAYS, Grid, analytic_polar, covers, extended
from .c81 import read_c81
from .fields import Angle, Group, Name
from .number import Provenance, numbers, provenance_of, scalar, vector
from .sections import check_sections
from .tables import Table, by_mach, keep, named_file

JOIN = 1e-6
"""Fraction of the radius by which extents of neighbouring sections may differ: rounding."""


@dataclass(frozen=True)
class Deck:
    """A C81 deck that was read; `notes`: what is to be warned of."""

    path: Path
    grids: dict[str, Grid]
    provenance: Provenance
    notes: tuple[str, ...] = ()


def _deck(entry: Any, info: ValidationInfo) -> Deck:
    allowed = "a table { table, source, confidence } naming a C81 file beside this one"
    provenance = provenance_of(entry, info, {"table", "source", "confidence", "note"}, allowed)
    name = entry.get("table")
    if not isinstance(name, str) or not name:
        raise ValueError(f"must be {allowed}")
    path = named_file(name, info)
    grids, notes = read_c81(path)
    keep(info, name, read_text(path))
    published = Provenance(name, "table", provenance.sources, provenance.confidence, provenance.note)
    return Deck(path=path, grids=grids, provenance=published, notes=tuple(notes))


class Polar(Group):
    """Analytic polar: cl = slope (alpha - zero_lift), cd = d0 + d1 alpha + d2 alpha^2 (alpha in rad)."""

    lift_curve_slope: scalar("1/rad", above=0.0, high=10.0)
    cd: vector("1", 3, low=-10.0, high=10.0)
    zero_lift: Angle | None = None
    cm: scalar("1", low=-1.0, high=1.0) | None = None
    prandtl_glauert: bool = False

    def grids(self) -> dict[str, Grid]:
        """Tables {cl, cd, cm} in SI."""
        zero_lift, moment = float(self.zero_lift or 0.0), float(self.cm or 0.0)
        return analytic_polar(float(self.lift_curve_slope), zero_lift, tuple(self.cd), moment, self.prandtl_glauert)


class Section(Group):
    """A section: `cl`, `cd`, `cm` by Mach number, a `c81` deck, or an analytic `polar`; `stations` and `extent` in radii."""

    name: Name
    stations: numbers("1", low=0.0, high=1.0) | None = None
    extent: vector("1", 2, low=0.0, high=1.0) | None = None
    cl: Table | None = None
    cd: Table | None = None
    cm: Table | None = None
    c81: Annotated[Deck, BeforeValidator(_deck)] | None = None
    polar: Polar | None = None
    cd_increment: scalar("1", low=-0.1, high=0.1) | None = None
    extend: Literal[tuple(EXTENSIONS)] | None = None

    @model_validator(mode="after")
    def _one_kind(self) -> Section:
        tables = self.cl is not None or self.cd is not None or self.cm is not None
        if tables + (self.c81 is not None) + (self.polar is not None) != 1:
            raise ValueError("needs one of: the tables cl and cd (and cm), a c81 deck, a polar")
        if tables and (self.cl is None or self.cd is None):
            raise ValueError("needs both tables, cl and cd")
        if self.polar is not None and self.extend is not None:
            raise ValueError("has extend, but a polar holds at all angles")
        return self

    @property
    def increment(self) -> float:
        """Added to every drag coefficient."""
        return float(self.cd_increment or 0.0)

    def grids(self) -> dict[str, Grid]:
        """Tables {cl, cd, cm} in SI, over all angles of attack; ValueError where they do not reach and the file names no way."""
        if self.polar is not None:
            return self.polar.grids()
        grids = self._as_read
        if self.extend is not None:
            return extended(grids, self.extend)[0]
        for name, grid in grids.items():
            if not covers(grid):
                ends = f"{math.degrees(grid['x'][0]):.6g} .. {math.degrees(grid['x'][-1]):.6g} deg"
                raise self.error(
                    "rotor.airfoil", name, ends, f"must cover -180 to 180 deg; {NAMED_WAYS}", Path(self.name)
                )
        return grids

    @property
    def _as_read(self) -> dict[str, Grid]:
        """Tables as they stand in the file."""
        if self.c81 is not None:
            return self.c81.grids
        grids = {"cl": by_mach(known(self.cl)), "cd": by_mach(known(self.cd))}
        if self.cm is not None:
            grids["cm"] = by_mach(self.cm)
        else:
            grids["cm"] = {**grids["cl"], "values": [[0.0] * len(row) for row in grids["cl"]["values"]]}
        return grids

    @property
    def notes(self) -> list[str]:
        """What is to be told of how the tables were read."""
        notes = [] if self.c81 is None else list(self.c81.notes)
        return notes if self.extend is None else [*notes, *extended(self._as_read, self.extend)[1]]

    def error(self, key: str, name: str, value: object, allowed: str, path: Path) -> InputError:
        """Error about the table `name` of the section `key` of the file at `path`."""
        if self.c81 is not None:
            return InputError.of(f"{key}.c81 {name}", value, allowed, file=self.c81.path)
        if self.polar is not None:
            return InputError.of(f"{key}.polar {name}", value, allowed, file=path)
        table = {"cl": self.cl, "cd": self.cd, "cm": self.cm}[name]
        return InputError.of(f"{key}.{name}", value, allowed, file=path if table is None else table.path)


def _placed(sections: Sequence[Section]) -> Sequence[Section]:
    """Refuse sections whose places along the span are not said, or not all in the same way."""
    if len(sections) == 1:
        given = [key for key, value in (("stations", sections[0].stations), ("extent", sections[0].extent)) if value]
        if given:
            raise ValueError(f"has {given[0]}, but is the only section: it holds along the whole span")
        return sections
    names = [section.name for section in sections]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise ValueError(f"lists the section {name} twice; a section may have several stations")
    for section in sections:
        if (section.stations is None) == (section.extent is None):
            raise ValueError(
                f"lists {len(sections)} sections; {section.name} needs stations (tables linear between) or an extent"
            )
        if (section.extent is None) != (sections[0].extent is None):
            raise ValueError("has stations for one section and an extent for another; the way along the span is one")
    if sections[0].extent is None:
        places = sorted(station for section in sections for station in known(section.stations))
        for before, after in itertools.pairwise(places):
            if not after > before:
                raise ValueError(f"has two sections at the station {after:g} R")
        return sections
    for section in sections:
        extent = known(section.extent)
        if not extent[0] < extent[1]:
            raise ValueError(f"has the extent {list(extent)} of {section.name}, which must ascend")
    for inner, outer in itertools.pairwise(sections):
        end, begin = known(inner.extent)[1], known(outer.extent)[0]
        if abs(begin - end) > JOIN:
            ends = f"{inner.name} ends at {end:g} R and {outer.name} begins at {begin:g} R"
            raise ValueError(f"has extents that do not join, inboard to outboard: {ends}")
    return sections


def along_span(kind: type[Section]) -> Any:
    """Type of the sections of a blade: one group, or several that say where they are."""

    def listed(entry: Any) -> Any:
        return entry if isinstance(entry, list) else [entry]

    def placed(sections: list[Section]) -> list[Section]:
        return list(_placed(sections))

    return Annotated[list[kind], BeforeValidator(listed), Field(min_length=1), AfterValidator(placed)]


def keys_of(sections: Sequence[Section]) -> list[str]:
    """Key of each section in messages: that of the file, with the section's name where there are several."""
    if len(sections) == 1:
        return ["rotor.airfoil"]
    return [f"rotor.airfoil[{section.name}]" for section in sections]


def span_data(sections: Sequence[Section], radius: float, root_cutout: float, path: Path) -> dict[str, Any]:
    """Sections as the core reads them: stations [m], whether in steps, tables; of a blade that lifts from `root_cutout` [m]."""
    tables = []
    for key, section in zip(keys_of(sections), sections, strict=True):
        try:
            tables.append({**section.grids(), "cd_increment": section.increment})
        except ValueError as reason:
            raise reason if isinstance(reason, InputError) else InputError(f"{path}: {key}: {reason}") from reason
    if len(sections) == 1:
        return {"stations": [0.0], "stepwise": False, "tables": tables}
    if sections[0].extent is None:
        placed = sorted((float(at) * radius, i) for i, section in enumerate(sections) for at in known(section.stations))
        return {"stations": [at for at, _ in placed], "stepwise": False, "tables": [tables[i] for _, i in placed]}
    extents = [known(each.extent) for each in sections]
    first, last = extents[0][0], extents[-1][1]
    if first * radius > root_cutout * (1.0 + JOIN) or last < 1.0 - JOIN:
        allowed = f"extents must cover the blade, {root_cutout / radius:.4g} to 1 R"
        raise InputError.of("rotor.airfoil", f"{first:g} to {last:g} R", allowed, file=path)
    return {"stations": [float(each[0]) * radius for each in extents], "stepwise": True, "tables": tables}


def check_span(sections: Sequence[Section], data: dict[str, Any], path: Path) -> list[str]:
    """Warnings about the sections of a blade; InputError where one is impossible. data: as the core is given them."""
    warnings = []
    for key, section in zip(keys_of(sections), sections, strict=True):

        def refuse(name: str, value: object, allowed: str, key: str = key, section: Section = section) -> InputError:
            return section.error(key, name, value, allowed, path)

        notes = section.notes
        notes += check_sections(section.grids(), section.increment, refuse, polar=section.polar is not None)
        warnings += [f"{key}: {text}" for text in notes]
    return warnings


def tip_section(data: dict[str, Any]) -> dict[str, Grid]:
    """Tables {cl, cd, cm} of the outermost section, of `data` as the core is given them."""
    return {name: data["tables"][-1][name] for name in ("cl", "cd", "cm")}
