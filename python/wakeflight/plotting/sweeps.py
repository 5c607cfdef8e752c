# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tables of sweeps: quantities over an axis with a line for every other case, histories of an ensemble with their spread."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from ..errors import InputError
from .style import GREY, blank, looks, plain, styled

if TYPE_CHECKING:
    import xarray as xr

SHOWN = {"W": ("kW", 1e-3), "rad": ("deg", 180.0 / np.pi), "rad/s": ("deg/s", 180.0 / np.pi), "Pa": ("kPa", 1e-3)}
"""Units in which quantities are drawn, and their factors."""
MOST_LINES = 12
DEFAULT = ("power", "collective", "pitch")
"""Quantities drawn where none are named, those that there are."""


def quantities(table: xr.Dataset, y: str | Sequence[str] | None = None) -> list[str]:
    """Names of what is drawn: as asked, else the usual ones, else the first numbers of the table."""
    numbers = [str(name) for name, each in table.data_vars.items() if each.dtype.kind == "f"]
    if y is not None:
        names = [y] if isinstance(y, str) else list(y)
        for name in names:
            if name not in numbers:
                raise InputError.choice("figure.y", name, numbers)
        return names
    return [name for name in DEFAULT if name in numbers] or numbers[:3]


@styled
def figure(table: xr.Dataset, y: str | Sequence[str] | None = None, x: str | None = None) -> Figure:
    """Quantities `y` of a table over its axis `x`, by default the first with numbers; an ensemble's histories over time."""
    names = quantities(table, y)
    if not names:
        raise InputError.of("figure.y", "nothing", "there are no numbers in the table")
    drawn = blank(0.6 + 1.9 * len(names))
    rows = drawn.subplots(len(names), 1, sharex=True, squeeze=False)[:, 0]
    outer = tuple(str(dim) for dim in table["failure"].dims)
    if outer == ("member",) and all(table[name].dims == ("member", "time") for name in names):
        for axes, name in zip(rows, names, strict=True):
            _histories(axes, table, name)
        rows[-1].set_xlabel("time [s]")
        drawn.legend(*rows[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
        return drawn
    along = _axis(table, outer, x)
    for axes, name in zip(rows, names, strict=True):
        if table[name].dims != outer:
            raise InputError.of("figure.y", name, f"must have the dimensions of the cases alone: {', '.join(outer)}")
        _lines(axes, table, name, along, outer)
    rows[-1].set_xlabel(_label(table, along))
    handles, labels = rows[0].get_legend_handles_labels()
    if len(labels) > 1:
        drawn.legend(handles, labels, loc="outside lower center", ncols=3)
    return drawn


def _axis(table: xr.Dataset, outer: tuple[str, ...], x: str | None) -> str:
    """The axis of the cases that is drawn along."""
    if x is not None:
        if x not in table.coords or len(table[x].dims) != 1 or table[x].dims[0] not in outer:
            raise InputError.choice("figure.x", x, [str(each) for each in table.coords])
        return x
    long = [dim for dim in outer if table.sizes[dim] > 1]
    numbered = [dim for dim in long if f"{dim}_value" in table.coords or table[dim].dtype.kind in "if"]
    chosen = [*numbered, *long, *outer]
    if not chosen:
        raise InputError.of("figure.x", "missing", "a table of one case has no axis")
    return chosen[0]


def _places(table: xr.Dataset, along: str) -> tuple[np.ndarray, list[str] | None]:
    """Values along an axis, and their names where they are no numbers."""
    values = table[f"{along}_value"] if f"{along}_value" in table.coords else table[along]
    if values.dtype.kind in "if":
        return values.values, None
    return np.arange(values.size), [str(each) for each in values.values]


def _label(table: xr.Dataset, name: str) -> str:
    """A name with its unit."""
    values = table[f"{name}_value"] if f"{name}_value" in table.coords else table[name]
    unit = SHOWN.get(values.attrs.get("units", "1"), (values.attrs.get("units", "1"), 1.0))[0]
    words = plain(name.replace("_", " "))
    return words if unit in ("1", "") else f"{words} [{unit}]"


def _lines(axes: Any, table: xr.Dataset, name: str, along: str, outer: tuple[str, ...]) -> None:
    dim = str(table[along].dims[0])
    others = [each for each in outer if each != dim]
    places, words = _places(table, along)
    values = table[name] * SHOWN.get(table[name].attrs.get("units", "1"), ("", 1.0))[1]
    stacked = values.transpose(dim, *others).values.reshape(table.sizes[dim], -1)
    if stacked.shape[1] > MOST_LINES:
        raise InputError.of(
            "figure", f"{stacked.shape[1]} lines", f"must be at most {MOST_LINES}: choose x, or fewer cases"
        )
    labels = []
    for k in range(stacked.shape[1]):
        at = np.unravel_index(k, [table.sizes[each] for each in others]) if others else ()
        told = [str(table[each].values[i]) for each, i in zip(others, at, strict=True) if table.sizes[each] > 1]
        labels.append(", ".join(told) or name)
    for line, (label, (color, style)) in zip(stacked.T, looks(labels).items(), strict=True):
        order = np.argsort(places, kind="stable")
        marker = "o" if table.sizes[dim] <= 40 else ""
        axes.plot(places[order], line[order], color=color, ls=style, marker=marker, ms=2.5, label=plain(label))
    if words is not None:
        axes.set_xticks(places, words)
    axes.set_ylabel(_label(table, name))


def _histories(axes: Any, table: xr.Dataset, name: str) -> None:
    values = table[name].values * SHOWN.get(table[name].attrs.get("units", "1"), ("", 1.0))[1]
    time, values = table["time"].values, values[np.isfinite(values).all(axis=1)]
    if values.size:
        low, middle, high = np.quantile(values, (0.05, 0.5, 0.95), axis=0)
        axes.plot(time, values.T, color=GREY, lw=0.3, alpha=0.5)
        axes.fill_between(time, low, high, color="#0072B2", alpha=0.25, lw=0.0, label="5 to 95 % of the members")
        axes.plot(time, middle, color="#0072B2", label="median")
    axes.set_ylabel(_label(table, name))
