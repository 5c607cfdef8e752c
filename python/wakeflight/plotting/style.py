# SPDX-License-Identifier: MIT OR Apache-2.0
"""One look for all figures: fonts, colours that colour-blind readers can tell apart, restrained axes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from ..atomic import written

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

# Okabe and Ito's palette, yellow left out: it vanishes on white
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
LINES = ("-", "--", "-.", ":", "-", "--", "-.")
# every model has its look wherever it is drawn; other runs take the rest in turn
MODELS = {"dynamic": ("#009E73", "-."), "relaxation": ("#D55E00", "--"), "time-marching": ("#0072B2", "-")}
# sequential map for quantities, diverging one for changes and for quantities that change sign
SEQUENTIAL = "cividis"
DIVERGING = "RdBu_r"
GREY = "#777777"

WIDTH = 7.2
INCH = 0.0254

# what belongs to the reader's session, not to the look of a figure
SESSION = (
    "backend",
    "interactive",
    "toolbar",
    "webagg.",
    "tk.",
    "macosx.",
    "date.epoch",
    "timezone",
    "savefig.directory",
)

RC: dict[Any, Any] = {
    **{name: value for name, value in dict.items(matplotlib.rcParamsDefault) if not name.startswith(SESSION)},
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.labelsize": 9,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "lines.linewidth": 1.3,
    "axes.formatter.useoffset": False,
    "figure.dpi": 100,
    "savefig.dpi": 130,
    "mathtext.default": "regular",
}


def styled(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """A figure function that draws in this style, whatever the reader's own settings are, and without touching them."""

    @wraps(function)
    def drawn(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        with matplotlib.rc_context(RC):
            return function(*args, **kwargs)

    return drawn


def blank(height: float, width: float = WIDTH) -> Figure:
    """Empty figure of a size in inches; no window system and no global state behind it."""
    return Figure(figsize=(width, height), layout="constrained")


def save(figure: Figure, path: str | Path) -> Path:
    """Write a figure to the file type its name asks for; the same figure gives the same bytes."""
    path = Path(path)
    no_date = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}
    with matplotlib.rc_context({**RC, "svg.hashsalt": "wakeflight"}), written(path) as stream:
        figure.savefig(stream, format=path.suffix[1:] or "png", metadata=no_date.get(path.suffix))
    return path


def plain(name: str) -> str:
    """A name as text of a figure: what would be read as a formula, or as a line to be left out of the legend, is not."""
    text = name.replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text


def least_span(axes: Axes, span: float) -> None:
    """Widen the vertical axis to at least `span`: what hardly changes should look as if it hardly changes."""
    low, high = axes.get_ylim()
    if high - low < span:
        middle = (low + high) / 2
        axes.set_ylim(middle - span / 2, middle + span / 2)


def levels(*fields: np.ndarray, symmetric: bool = False) -> tuple[float, float]:
    """Colour range common to several maps; about zero if `symmetric`."""
    low = min(float(np.min(field)) for field in fields)
    high = max(float(np.max(field)) for field in fields)
    if symmetric:
        high = (1 + 1e-6) * max(abs(low), abs(high), 1e-12)
        return -high, high
    # a hair wider than the data: the extremes themselves must be filled too
    margin = max(1e-6 * (high - low), 1e-12)
    return low - margin, high + margin


def looks(names: Iterable[str]) -> dict[str, tuple[str, str]]:
    """Colour and line of each run by its name: those of the inflow model it is named after, else the next free ones."""
    names = list(names)
    taken = {MODELS[name][0] for name in names if name in MODELS}
    pairs = list(zip(COLORS, LINES, strict=True))
    colors = {color for color, _ in MODELS.values()}
    # those that no model has, then those of models that are not drawn
    free = [pair for pair in pairs if pair[0] not in colors]
    free += [pair for pair in MODELS.values() if pair[0] not in taken]
    others = [name for name in names if name not in MODELS]
    turn = {name: free[i % len(free)] for i, name in enumerate(others)}
    return {name: MODELS[name] if name in MODELS else turn[name] for name in names}


def signed(*fields: np.ndarray, share: float = 0.3) -> bool:
    """Whether values change sign for good: the smaller side reaches at least `share` of the larger, outliers left out."""
    low, high = robust(*fields)
    return min(-low, high) > share * max(-low, high)


def robust(*fields: np.ndarray, share: float = 0.01) -> tuple[float, float]:
    """The range of values but for a `share` at either end, which a passing vortex or reversed flow may take anywhere."""
    values = np.concatenate([np.ravel(field) for field in fields])
    low, high = (float(each) for each in np.quantile(values, (share, 1.0 - share)))
    return low, high
