# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rotor on a stand: disk maps, section loads, tip vortices."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from ..results.turns import revolutions
from . import disk, style
from .style import styled

if TYPE_CHECKING:
    import xarray as xr

MAPS = (
    ("inflow", "inflow λ [–], down +"),
    ("circulation", "bound circulation Γ [m²/s]"),
    ("cl_m2", "C$_l$M² [–]"),
    ("alpha", "angle of attack [°]"),
)


@styled
def maps(data: xr.Dataset) -> Figure:
    """Inflow, circulation, lift times Mach squared and angle of attack over the disk."""
    figure = style.blank(6.4)
    for axes, (name, label) in zip(figure.subplots(2, 2).flat, MAPS, strict=True):
        field = data[name] * (180.0 / np.pi) if name == "alpha" else data[name]
        # about the reversed flow the angle of attack takes every value: off the scale, or the map shows nothing else
        about_zero = style.signed(field.values)
        limits = style.levels(np.array(style.robust(field.values)), symmetric=about_zero)
        filled = disk.draw(axes, field, limits, style.DIVERGING if about_zero else style.SEQUENTIAL, extend="both")
        disk.mark_directions(axes)
        disk.tidy(figure.colorbar(filled, ax=axes, shrink=0.8), label, limits)
    figure.suptitle(_title(data))
    return figure


@styled
def sections(data: xr.Dataset) -> Figure:
    """Lift coefficient and circulation along the blade (mean, range over the azimuth), lift over azimuth outboard."""
    figure = style.blank(2.9)
    left, middle, right = figure.subplots(1, 3)
    own = _color(data)
    for axes, name, label in ((left, "cl", "C$_l$ [–]"), (middle, "circulation", "Γ [m²/s]")):
        field = data[name]
        axes.fill_between(data.station, field.min("azimuth"), field.max("azimuth"), color=own, alpha=0.25, lw=0)
        axes.plot(data.station, field.mean("azimuth"), color=own)
        axes.set(xlabel="r/R", ylabel=label, xlim=(0, 1))
        axes.set_title("mean, range over azimuth")
    for r, color in zip((0.5, 0.75, 0.9), style.COLORS, strict=False):
        at = data.cn_m2.interp(station=r)
        turn = np.append(np.degrees(data.azimuth.values), 360.0)
        right.plot(turn, np.append(at.values, at.values[0]), color=color, label=f"r/R = {r:g}")
    right.set(xlabel="azimuth [°]", ylabel="C$_n$M² [–]", xlim=(0, 360), xticks=(0, 90, 180, 270, 360))
    style.least_span(right, 0.02)
    right.legend(
        loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, handlelength=1.0, columnspacing=0.8, fontsize=7
    )
    figure.suptitle(_title(data))
    return figure


@styled
def wake(data: xr.Dataset) -> Figure:
    """Tip vortices from the side and from above; distance from the shaft and height against age."""
    radius = data.attrs["radius"]
    figure = style.blank(5.6)
    (side, top), (far, height) = figure.subplots(2, 2)
    n = data.sizes["azimuth"]
    n_blades = data.sizes["blade"]
    for b in range(n_blades):
        path = data.wake_path.isel(azimuth=b * n // n_blades) / radius
        now = data.wake.isel(blade=b) / radius
        x, y, z = (path.sel(xyz=c) for c in "xyz")
        color = style.COLORS[b % 6]
        side.plot(x, z, color=color)
        top.plot(x, y, color=color, label=f"blade {b + 1}")
        if data.attrs["averaged"] > 0:
            side.plot(now.sel(xyz="x"), now.sel(xyz="z"), color=color, lw=0.5, alpha=0.6)
            top.plot(now.sel(xyz="x"), now.sel(xyz="y"), color=color, lw=0.5, alpha=0.6)
    side.plot((-1, 1), (0, 0), color="black", lw=2)
    around = np.linspace(0, 2 * np.pi, 181)
    top.plot(np.cos(around), np.sin(around), color=style.GREY, lw=0.7)
    thin = ", thin: at the end" if data.attrs["averaged"] > 0 else ""
    side.set(xlabel="x/R, aft +", ylabel="z/R, up +", title=f"from the side{thin}", aspect="equal")
    top.set(xlabel="x/R, aft +", ylabel="y/R, right +", title="from above", aspect="equal")
    figure.legend(*top.get_legend_handles_labels(), loc="outside lower center", ncols=n_blades)
    age = np.degrees(data.age)
    # whole turns, as many as have room
    turns = np.arange(0.0, age[-1] + 1.0, 360.0 * (1 + age[-1].item() // 2520))
    for axes in (far, height):
        axes.set_xticks(turns)
    far.plot(age, data.tip_vortex_radius, color=_color(data))
    far.set(xlabel="wake age [°]", ylabel="r/R", title="distance from the shaft, mean over azimuth")
    height.plot(age, data.tip_vortex_height, color=_color(data))
    height.set(xlabel="wake age [°]", ylabel="Δz/R", title="height above the release, mean over azimuth")
    figure.suptitle(_title(data))
    return figure


@styled
def transient(data: xr.Dataset) -> Figure:
    """Collective, thrust, torque, inflow and flapping over the revolutions of a transient."""
    figure = style.blank(6.4)
    panels = figure.subplots(3, 2, sharex=True)
    turns = revolutions(data)
    rows = (
        (np.degrees(data.theta_0), "collective at the root [°]"),
        (1e3 * data.ct, "1000 C$_T$ [–]"),
        (1e4 * data.cq, "10 000 C$_Q$ [–]"),
        (data.inflow_mean, "mean inflow λ [–], down +"),
        (np.degrees(data.flap), "flap of each blade [°], up +"),
    )
    for axes, (values, label) in zip(panels.flat, rows, strict=False):
        if values.ndim == 2:
            for b in range(values.shape[1]):
                axes.plot(turns, values[:, b], color=style.COLORS[b % 6], lw=0.9, label=f"blade {b + 1}")
            axes.legend(
                ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0), handlelength=1.0, columnspacing=0.8, fontsize=7
            )
        else:
            axes.plot(turns, values, color=_color(data))
        axes.set_ylabel(label)
    at = data.station.values
    strength = data.circulation.mean("blade")
    last = panels.flat[-1]
    for r, color in zip((0.5, 0.75, 0.95), style.COLORS, strict=False):
        last.plot(turns, strength.interp(station=r), color=color, label=f"r/R = {min(max(r, at[0]), at[-1]):g}")
    last.set_ylabel("mean circulation [m²/s]")
    last.legend(ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0), handlelength=1.0, columnspacing=0.8, fontsize=7)
    for axes in panels[-1]:
        axes.set_xlabel("revolutions")
    a = data.attrs
    figure.suptitle(f"{style.plain(a['aircraft'])}, {a['inflow_model']}: a collective that moves")
    return figure


def write_transient(data: xr.Dataset, folder: Path, figure_format: str = "png") -> Path:
    """Write the figure of a transient beside its result."""
    return style.save(transient(data), folder / f"transient.{figure_format}")


def write(data: xr.Dataset, folder: Path, figure_format: str = "png") -> list[Path]:
    """Write the figures that the data allow beside the result."""
    figures = {"maps": maps, "sections": sections, **({"wake": wake} if "wake" in data else {})}
    return [style.save(draw(data), folder / f"{name}.{figure_format}") for name, draw in figures.items()]


def _color(data: xr.Dataset) -> str:
    """That of the run's inflow model."""
    name = str(data.attrs["inflow_model"])
    return style.looks([name])[name][0]


def _title(data: xr.Dataset) -> str:
    a = data.attrs
    averaged = f", mean of {a['averaged']} revolutions" if a["averaged"] else ""
    return f"{style.plain(a['aircraft'])}, {a['inflow_model']}{averaged}: $C_T$ = {data.ct.item():.5f}, μ = {data.mu.item():.3f}"
