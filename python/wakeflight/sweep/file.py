# SPDX-License-Identifier: MIT OR Apache-2.0
"""A sweep as a TOML file: verb, axes or a sample, what is the same in all cases, what is kept and drawn.

    verb = "trim"
    [axes]
    speed = { from = "0 kt", to = "160 kt", by = "10 kt" }
    inflow = ["dynamic", "relaxation"]
    [fixed]
    flight_path = "0 deg"

Names are those of `wf.sweep`, dotted ones (`aircraft.rotor.omega`) quoted or not.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..text import read_toml
from .cases import Cases, Normal, Uniform, arange, grid, sample

KEYS = ("verb", "axes", "sample", "fixed", "keep", "workers", "outputs", "figure")
DISTRIBUTIONS = {"normal": Normal, "uniform": Uniform}


@dataclass(frozen=True)
class SweepFile:
    """What a file asks for."""

    verb: str
    cases: Cases
    fixed: dict[str, Any]
    keep: Any = None
    workers: int | None = None
    folder: Path | None = None
    figure: dict[str, Any] = field(default_factory=dict)


def read_sweep(path: Path) -> SweepFile:
    """Read a file; InputError names file, key and value."""
    try:
        data = read_toml(path)
    except ValueError as reason:
        raise InputError(f"{path}: {reason}") from reason
    for key, value in data.items():
        if key not in KEYS:
            raise InputError.choice("key", key, KEYS, file=path)
        if key in ("axes", "sample", "fixed", "outputs", "figure") and not isinstance(value, dict):
            raise InputError.of(key, value, "must be a group", file=path)
    if "verb" not in data:
        raise InputError.of(
            "verb", "missing", "must be given: trim, fly, linearize, handling_qualities, tunnel", file=path
        )
    if ("axes" in data) == ("sample" in data):
        given = "both" if "axes" in data else "neither"
        raise InputError.of("axes, sample", given, "must be given either as [axes] or as [sample]", file=path)
    outputs = data.get("outputs", {})
    for key in outputs:
        if key != "folder" or not isinstance(outputs[key], str):
            raise InputError.of(f"outputs.{key}", outputs[key], "allowed: folder, as text", file=path)
    try:
        cases = _sampled(dict(data["sample"])) if "sample" in data else grid(**_axes(data["axes"]))
        fixed = {name: _beside(path, name, value) for name, value in _flat(data.get("fixed", {})).items()}
        fixed = {name: _drawn(name, value) for name, value in fixed.items()}
    except InputError as reason:
        raise reason.within(path) from None
    folder = Path(outputs["folder"]) if "folder" in outputs else None
    return SweepFile(data["verb"], cases, fixed, data.get("keep"), data.get("workers"), folder, data.get("figure", {}))


def _flat(group: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Values of a group by dotted names; a group that says how an axis runs is a value."""
    found: dict[str, Any] = {}
    for name, value in group.items():
        if isinstance(value, Mapping) and not ({"from", "to", "by"} <= set(value) or set(value) & set(DISTRIBUTIONS)):
            found |= _flat(value, f"{before}{name}.")
        else:
            found[f"{before}{name}"] = value
    return found


def _axes(group: Mapping[str, Any]) -> dict[str, Any]:
    found = {}
    for name, value in _flat(group).items():
        if isinstance(value, Mapping):
            if set(value) != {"from", "to", "by"}:
                raise InputError.of(f"axes.{name}", value, "must be a list, or { from, to, by }")
            value = arange(value["from"], value["to"], value["by"])
        if not isinstance(value, list):
            raise InputError.of(
                f"axes.{name}", value, "must be a list, or { from, to, by }; one value stands in [fixed]"
            )
        found[name] = value
    return found


def _sampled(group: dict[str, Any]) -> Cases:
    n, seed = group.pop("n", None), group.pop("seed", 0)
    if n is None:
        raise InputError.of("sample.n", "missing", "must be the number of members")
    return sample(n, seed, **{name: _drawn(f"sample.{name}", value) for name, value in _flat(group).items()})


def _drawn(name: str, value: Any) -> Any:
    """A distribution, where a group names one."""
    if not isinstance(value, Mapping):
        return value
    ((kind, pair),) = value.items() if len(value) == 1 else (("", None),)
    if kind not in DISTRIBUTIONS or not isinstance(pair, list) or len(pair) != 2:
        allowed = 'must be { normal = ["mean", "deviation"] } or { uniform = ["low", "high"] }'
        raise InputError.of(name, dict(value), allowed)
    return DISTRIBUTIONS[kind](*pair)


def _beside(path: Path, name: str, value: Any) -> Any:
    """A file that lies beside this one is found there."""
    if name not in ("aircraft", "maneuver") or not isinstance(value, str):
        return value
    beside = path.parent / value
    return str(beside) if value.endswith(".toml") and beside.is_file() else value
